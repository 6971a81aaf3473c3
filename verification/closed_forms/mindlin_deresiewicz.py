"""Fretting loop: Hertz point contact, constant load, tangential force cycling between ±T*.

Same assumptions and the same caveat for Poisson's ratio other than zero as `cattaneo_mindlin`.
"""

from dataclasses import dataclass
from enum import Enum
from math import pi

import numpy as np
from numpy.typing import ArrayLike, NDArray

from verification.closed_forms.validity import require_positive, require_within_friction_limit


class Branch(Enum):
    """Part of the loading history: T from 0 to T*, from T* to -T*, and from -T* to T*."""

    LOADING = "loading"
    UNLOADING = "unloading"
    RELOADING = "reloading"


@dataclass(frozen=True)
class FrettingLoop:
    """The loop at constant load (Mindlin and Deresiewicz 1953).

    load                  normal load W > 0 [force]
    contact_radius        Hertz radius a > 0 [length]
    friction_coefficient  µ > 0
    tangential_modulus    G* with 1/G* = sum of (2-nu)/4G [force/length²]
    amplitude             T*, 0 < T* <= µW [force]

    Methods take the tangential force T [force] and the branch it lies on, and raise ValueError for
    T outside [0, T*] while loading and outside [-T*, T*] afterwards.
    """

    load: float
    contact_radius: float
    friction_coefficient: float
    tangential_modulus: float
    amplitude: float

    def __post_init__(self) -> None:
        require_positive(
            load=self.load,
            contact_radius=self.contact_radius,
            friction_coefficient=self.friction_coefficient,
            tangential_modulus=self.tangential_modulus,
            amplitude=self.amplitude,
        )
        require_within_friction_limit(self.amplitude, self.friction_coefficient, self.load)

    @property
    def friction_limit(self) -> float:
        """Largest tangential force µW [force]."""
        return self.friction_coefficient * self.load

    @property
    def sliding_shift(self) -> float:
        """Shift K = 3µW/4aG* at which the whole contact would slide [length]."""
        return 3 * self.friction_limit / (4 * self.contact_radius * self.tangential_modulus)

    @property
    def energy_per_cycle(self) -> float:
        """Area of the closed loop, (24/5) K µW f(T*/µW) [force*length]."""
        return 4 * self._energy_lost(self.amplitude)

    def stick_radius(self, force: float, branch: Branch) -> float:
        """Radius of the zone that does not slip on this branch [length].

        After a reversal it starts from a and is a (1 - |change of T|/2µW)^(1/3).
        """
        self._check(force, branch)
        return self._radius(self._reversed_change(force, branch))

    def shear(self, r: ArrayLike, force: float, branch: Branch) -> NDArray[np.float64]:
        """Shear traction on the lower body at r [force/length²], parallel to the force."""
        self._check(force, branch)
        inner = self._hertz_shear(r, self._radius(self._reversed_change(force, branch)))
        full = self._hertz_shear(r, self.contact_radius)
        if branch is Branch.LOADING:
            return full - inner
        start = self._hertz_shear(r, self._radius(self.amplitude))
        unloading = -full + 2 * inner - start
        return unloading if branch is Branch.UNLOADING else -unloading

    def shift(self, force: float, branch: Branch) -> float:
        """Tangential shift of the indenter [length]."""
        self._check(force, branch)
        a, K = self.contact_radius, self.sliding_shift
        inner = (self._radius(self._reversed_change(force, branch)) / a) ** 2
        if branch is Branch.LOADING:
            return K * (1 - inner)
        start = (self._radius(self.amplitude) / a) ** 2
        unloading = K * (2 * inner - start - 1)
        return unloading if branch is Branch.UNLOADING else -unloading

    def dissipated_energy(self, force: float, branch: Branch, completed_cycles: int = 0) -> float:
        """Energy lost to friction from the start of the history to this point [force*length].

        completed_cycles  closed loops T* → -T* → T* that came before this branch; the first
                          loading is counted on its own and precedes them
        """
        self._check(force, branch)
        if completed_cycles < 0 or (branch is Branch.LOADING and completed_cycles):
            raise ValueError(f"{completed_cycles} completed cycles cannot precede {branch.value}")
        if branch is Branch.LOADING:
            return self._energy_lost(force)
        # after a reversal the same slip law holds with both force and slip doubled
        lost = self._energy_lost(self.amplitude) + completed_cycles * self.energy_per_cycle
        if branch is Branch.RELOADING:
            lost += 2 * self._energy_lost(self.amplitude)
        return lost + 2 * self._energy_lost(self._reversed_change(force, branch))

    def _check(self, force: float, branch: Branch) -> None:
        lower = 0.0 if branch is Branch.LOADING else -self.amplitude
        if not lower <= force <= self.amplitude:
            raise ValueError(
                f"tangential force {force!r} outside [{lower!r}, {self.amplitude!r}], "
                f"the range of the {branch.value} branch"
            )

    def _reversed_change(self, force: float, branch: Branch) -> float:
        if branch is Branch.LOADING:
            return force
        return (self.amplitude + (force if branch is Branch.RELOADING else -force)) / 2

    def _radius(self, force: float) -> float:
        return self.contact_radius * float(np.cbrt(1 - min(force / self.friction_limit, 1.0)))

    def _hertz_shear(self, r: ArrayLike, radius: float) -> NDArray[np.float64]:
        rho = np.abs(np.asarray(r, dtype=float))
        slope = 3 * self.friction_limit / (2 * pi * self.contact_radius**3)
        return np.asarray(slope * np.sqrt(np.maximum((radius - rho) * (radius + rho), 0)))

    def _energy_lost(self, force: float) -> float:
        x = min(force / self.friction_limit, 1.0)
        # (6/5) K µW f(x), f = 1 - (1-x)^(5/3) - (5x/6)[1 + (1-x)^(2/3)], factored with
        # y = (1-x)^(1/3) because the published bracket loses all digits for small x
        y = float(np.cbrt(1 - x))
        slipped = x / (1 + y + y**2)
        return self.sliding_shift * self.friction_limit * slipped**3 * (1 + 3 * y + y**2) / 5
