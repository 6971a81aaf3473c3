"""Ruiz's fretting parameters of a Hertz contact under a tangential force between ±T*, ν = 0.

F1 = τ δ and F2 = σ_T τ δ (Ruiz, Boddington and Chen 1984, Exp. Mech. 24, 208-217), with τ the
largest shear at a position in a cycle, δ half the range of slip and σ_T the largest surface stress
along the force at the ends of the cycle. Assumptions as in `cattaneo_mindlin`.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from verification.closed_forms.cattaneo_mindlin import PartialSlip
from verification.closed_forms.huber_stress import (
    stress_by_hertz_pressure,
    stress_by_hertz_shear,
)

Values = NDArray[np.float64]

# Places at which the largest value is looked for, dense near the edge where σ_T turns to tension.
PLACES = 20_001


@dataclass(frozen=True)
class CycledContact:
    """Steady cycles of a Hertz contact between tangential forces T* and -T* at constant normal
    load.

    Both materials have ν = 0.

    end            state at the end of the first loading, at T* > 0
    peak_pressure  p0 of the Hertz contact [force/length²]
    """

    end: PartialSlip
    peak_pressure: float

    def slip_amplitude(self, r: ArrayLike) -> Values:
        """Compute the slip amplitude δ of a steady cycle at distance r <= a from the axis [length].

        δ is half the range of slip. By Masing's rule the slip of a reversal, which is the whole
        range, is twice that of the first loading.
        """
        return np.abs(self.end.slip(r))

    def largest_shear(self, r: ArrayLike) -> Values:
        """Compute the largest shear τ of a steady cycle at distance r from the axis
        [force/length²].

        τ is the shear at ±T*, which is µp in the slip annulus.
        """
        return np.abs(self.end.shear(r))

    def surface_tension(self, x: ArrayLike) -> Values:
        """Compute the largest tensile stress σ_T of a steady cycle at the surface point (x, 0)
        [force/length²].

        σ_T is the larger value of σ_xx at the two ends of the cycle.
        """
        a, c = self.end.contact_radius, self.end.stick_radius
        q0 = self.end.friction_coefficient * self.peak_pressure
        sheared = stress_by_hertz_shear(x, a, q0, 0.0)
        if c > 0:
            sheared = sheared - stress_by_hertz_shear(x, c, q0 * c / a, 0.0)
        return stress_by_hertz_pressure(x, a, self.peak_pressure, 0.0) + np.abs(sheared)

    @property
    def largest_f1(self) -> float:
        """Largest first Ruiz parameter τ δ on the surface [force/length]."""
        return float(np.max(self._f1(self._radii())))

    @property
    def largest_f2(self) -> float:
        """Largest second Ruiz parameter σ_T τ δ on the surface [force²/length³].

        At a given r the tensile stress is largest on the line through the centre along the force.
        """
        r = self._radii()
        return float(np.max(np.maximum(self.surface_tension(r), 0.0) * self._f1(r)))

    def _f1(self, r: Values) -> Values:
        return self.largest_shear(r) * self.slip_amplitude(r)

    def _radii(self) -> Values:
        """Return radii between the stick zone and the contact edge, dense near the edge
        [length]."""
        a, c = self.end.contact_radius, self.end.stick_radius
        return np.asarray(a - (a - c) * np.linspace(1.0, 0.0, PLACES) ** 2)
