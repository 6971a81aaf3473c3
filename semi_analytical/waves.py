"""Fields on both sides of a plane that is no mirror plane, by their waves along an axis."""

import numpy as np
from numpy.typing import NDArray
from scipy.fft import irfft, rfft

Field = NDArray[np.float64]


class Waves:
    """Values at `cells` places along the last axis to their spectrum with a period, and back; zero
    from the last cell to the period.

    Amplitudes are real and imaginary parts in turns, of the wavenumbers that are not negative.
    `turned`, they are i times as much.
    """

    def __init__(self, cells: int, period: int, *, turned: bool = False) -> None:
        self.cells, self.period, self.turned = cells, period, turned
        self.count = 2 * (period // 2 + 1)

    def forward(self, values: Field) -> Field:
        """(…, cells) to (…, count)."""
        spectrum = rfft(values, n=self.period, axis=-1)
        if self.turned:
            spectrum *= 1j
        return np.asarray(spectrum.view(values.dtype))

    def back(self, amplitudes: Field) -> Field:
        """(…, count) to (…, cells)."""
        amplitudes = np.ascontiguousarray(amplitudes)
        spectrum = amplitudes.view(np.result_type(amplitudes.dtype, np.complex64))
        if self.turned:
            spectrum = -1j * spectrum
        return np.asarray(irfft(spectrum, n=self.period, axis=-1)[..., : self.cells])
