"""Linear convolution of surface tractions with displacement and stress coefficients at one depth.

Zero padding to at least twice the largest
offset avoids periodic images. About a mirror plane of the tractions, sine and cosine transforms on
half of the window replace the Fourier transform.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from contact_scene.array_types import Field, Indices
from semi_analytical.operator.transforms import (
    Array,
    MirroredWaves,
    cosine_or_sine_sums,
    fast_length,
    mirrored_waves,
)
from semi_analytical.stress.components import FIELDS, acting, each_response

# Coefficients (FIELDS, acting tractions, offsets along x, along y) to fields.
Convolution = Callable[[Field], Field]

ROUND_OFF = 1e-14  # between mirror images, relative to the largest traction


def offsets_between(tractions: Field, rows: Indices) -> tuple[int, int]:
    """Return the number of cell offsets along x and y at which fields are required.

    These are the offsets, from 0, between loaded cells and the cells of some rows. Response
    coefficients are computed at these offsets.

    tractions  tractions of the cells, q_x, q_y, p or p alone (tractions, nx, ny)
    rows       indices along y of the rows where stresses are required
    """
    loaded = np.any(tractions, axis=0)
    counts = []
    for axis, last in enumerate((np.array([0, loaded.shape[0] - 1]), rows[[0, -1]])):
        at = np.flatnonzero(np.any(loaded, axis=1 - axis))
        farthest = np.max(np.abs(at[:, None] - last), initial=loaded.shape[axis] // 2)
        counts.append(1 + int(farthest))
    return counts[0], counts[1]


def mirror_planes(tractions: Field) -> tuple[bool, bool]:
    """Return True for each of the planes x = 0 and y = 0 about which surface tractions are
    symmetric.

    The reflected traction vectors must be equal up to round-off. Symmetry halves the cost of the
    convolution.

    tractions  tractions of the cells, q_x, q_y, p or p alone (tractions, nx, ny)
    """
    size = ROUND_OFF * float(np.max(np.abs(tractions), initial=0.0))
    found = []
    for axis in (0, 1):
        image = np.flip(tractions, 1 + axis).copy()
        if len(tractions) > 1:
            image[axis] *= -1
        found.append(np.allclose(image, tractions, rtol=0.0, atol=size))
    return found[0], found[1]


@dataclass(frozen=True)
class _AxisTransform:
    """Fourier, sine or cosine transform along the last axis of a field, for the subsurface stress.

    Amplitudes of a Fourier transform have the wavenumbers 0 … half for real fields, all wavenumbers
    of a period for complex ones. Those of a mirrored field are those of `MirroredWaves`.

    cells     number of cells of the window along the axis
    half      half the period in cells
    mirrored  True if the middle of the window, between cells, is a mirror plane
    """

    cells: int
    half: int
    mirrored: bool

    def forward(self, values: Array, odd: bool) -> Array:
        """Transform values of a field on the window (…, cells) to amplitudes along one axis.

        values  field on the cells
        odd     True if the field changes its sign at the mirror plane
        """
        if not self.mirrored:
            forward = np.fft.fft if np.iscomplexobj(values) else np.fft.rfft
            return forward(values, 2 * self.half)
        out = np.empty((len(values), self.half), values.dtype)
        return self._waves(odd).forward(values[:, self.cells // 2 :], out)

    def transform_response(self, response: Field, parity: int, odd: bool) -> Field:
        """Transform a response coefficient to factors of the amplitudes of a traction.

        response  values at offsets 0 … half along the last axis
        parity    1 for an even response coefficient, -1 for an odd one
        odd       True if the traction changes its sign at the mirror plane
        """
        sums = cosine_or_sine_sums(response, parity)
        if not self.mirrored:
            return sums
        if odd:  # amplitudes of sines have the last wavenumber in the place of 0
            sums[:, 0] = sums[:, -1]
        return sums[:, :-1]

    def factor(self, odd_response: bool, odd_traction: bool) -> complex:
        """Return the phase factor of a traction amplitude times a response coefficient.

        Response coefficients are represented by sums of cosines (even) or sines (odd) along the
        axis.

        odd_response  True if the response coefficient is odd along the axis
        odd_traction  True if the traction component changes its sign at the mirror plane
        """
        if self.mirrored:
            return -1.0 if odd_response and odd_traction else 1.0
        return -1j if odd_response else 1.0

    def back(self, amplitudes: Array, odd: bool) -> Array:
        """Transform amplitudes along one axis to values of a field on the window or its upper half.

        The upper half (…, cells / 2) suffices with a mirror plane; see `extend`.

        amplitudes  amplitudes by wavenumber along the last axis
        odd         True if the field changes its sign at the mirror plane
        """
        if not self.mirrored:
            inverse = np.fft.irfft if amplitudes.shape[-1] == self.half + 1 else np.fft.ifft
            return inverse(amplitudes, 2 * self.half)[..., : self.cells]
        return self._waves(odd).back(amplitudes)

    def extend(self, values: Array, odd: bool) -> Array:
        """Extend values from `back` to the whole window (…, cells).

        values  values along the last axis
        odd     True if the field changes its sign at the mirror plane
        """
        if not self.mirrored:
            return values
        lower = values[..., ::-1]
        return np.concatenate([-lower if odd else lower, values], axis=-1)

    def _waves(self, odd: bool) -> MirroredWaves:
        return mirrored_waves(self.cells // 2, 2 * self.half, -1 if odd else 1)


def plane_convolution(tractions: Field, offsets: tuple[int, int]) -> Convolution:
    """Return a function that computes displacement and stress on a whole horizontal plane.

    The function convolves the tractions with response coefficients at one depth. It maps
    coefficients (9, tractions, offsets along x, along y) to 3 displacements and 6 stresses (9, nx,
    ny).

    tractions  tractions of the surface cells, q_x, q_y, p or p alone (tractions, nx, ny)
    offsets    number of offsets of the coefficients, at least those of `offsets_between`
    """
    x, y = (
        _AxisTransform(cells, fast_length(count), mirrored and cells % 2 == 0)
        for cells, count, mirrored in zip(
            tractions.shape[1:], offsets, mirror_planes(tractions), strict=True
        )
    )
    names = acting(len(tractions) > 1)
    # Wavenumbers along y first, along x last.
    spectra = [
        x.forward(y.forward(field, name == "y").T, name == "x")
        for field, name in zip(tractions, names, strict=True)
    ]
    padded = np.zeros((x.half + 1, y.half + 1))

    def convolve(coefficients: Field) -> Field:
        fields = np.empty((len(FIELDS), x.cells, y.cells))
        responses = each_response(coefficients)
        for field, axes in zip(fields, FIELDS, strict=True):
            total = np.zeros_like(spectra[0])
            for spectrum, name in zip(spectra, names, strict=True):
                response, (along_x, along_y) = next(responses)
                padded[: offsets[0], : offsets[1]] = response
                lines = y.transform_response(padded, along_y, name == "y").T
                lines = x.transform_response(lines, along_x, name == "x")
                if spectrum.shape[-1] > lines.shape[-1]:
                    lines = np.concatenate([lines, along_x * lines[:, -2:0:-1]], axis=1)
                factor = x.factor(along_x < 0, name == "x") * y.factor(along_y < 0, name == "y")
                total += spectrum * (factor * lines)
            odd_x, odd_y = (axes.count(axis) % 2 == 1 for axis in "xy")
            values = y.extend(y.back(x.back(total, odd_x).T, odd_y), odd_y)
            field[:] = x.extend(values.T, odd_x).T
        return fields

    return convolve
