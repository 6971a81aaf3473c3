"""Any history of the tangential force at constant load, by Masing's rule with return-point memory.

A branch after a reversal is the first-loading curve with force and displacement doubled; when the
force returns to an earlier turning point, the loop closes and is forgotten. For Hertz point
contact this is exact under the assumptions of `cattaneo_mindlin` (Mindlin and Deresiewicz 1953;
Jäger 1998).
"""

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray

from verification.closed_forms.cattaneo_mindlin import PartialSlip


@dataclass(frozen=True)
class TangentialHistory:
    """State after a history of tangential forces.

    virgin             the contact without tangential force
    turning_points     forces at remembered reversals, differences shrinking [force]
    tangential_force   current T [force]
    dissipated_energy  energy lost to friction since the start [force*length]
    """

    virgin: PartialSlip
    turning_points: tuple[float, ...] = ()
    tangential_force: float = 0.0
    dissipated_energy: float = 0.0

    def __post_init__(self) -> None:
        if self.virgin.tangential_force != 0:
            raise ValueError("a history starts from a contact without tangential force")

    def loaded_to(self, force: float) -> "TangentialHistory":
        """Next state after T moves monotonically to `force`; ValueError when |force| > µW."""
        replace(self.virgin, tangential_force=force)
        if force == self.tangential_force:
            return self
        points, lost = self.turning_points, self.dissipated_energy
        here, rising = self.tangential_force, force > self.tangential_force
        origin = points[-1] if points else 0.0
        if here != origin and (here > origin) != rising:
            points = (*points, here)
        while points:
            closing = points[-2] if len(points) > 1 else -points[0]
            if (force < closing) if rising else (force > closing):
                break
            lost += self._lost(points, closing) - self._lost(points, here)
            points, here = points[:-2], closing
        lost += self._lost(points, force) - self._lost(points, here)
        return TangentialHistory(self.virgin, points, force, lost)

    @property
    def shift(self) -> float:
        """Tangential shift of the indenter [length]."""
        return sum(scale * state.shift for scale, state in self.branches())

    def shear(self, r: ArrayLike) -> NDArray[np.float64]:
        """Shear traction on the lower body [force/length²]."""
        total = np.zeros_like(np.asarray(r, dtype=float))
        for scale, state in self.branches():
            total = total + scale * state.shear(r)
        return total

    def slip(self, r: ArrayLike) -> NDArray[np.float64]:
        """Slip of the lower surface relative to the indenter, nu = 0, r <= a [length]."""
        total = np.zeros_like(np.asarray(r, dtype=float))
        for scale, state in self.branches():
            total = total + scale * state.slip(r)
        return total

    @property
    def stick_radius(self) -> float:
        """Radius of the zone that does not slip on the current branch [length]."""
        return self.branches()[-1][1].stick_radius

    def branches(self) -> list[tuple[float, PartialSlip]]:
        """The first loading and every branch since, with the factors by which they add up."""
        forces = (*self.turning_points, self.tangential_force)
        branches = [(1.0, replace(self.virgin, tangential_force=forces[0]))]
        for start, end in pairwise(forces):
            branches.append((2.0, replace(self.virgin, tangential_force=(end - start) / 2)))
        return branches

    def _lost(self, points: tuple[float, ...], force: float) -> float:
        """Energy lost on the branch from the last turning point to `force`."""
        if not points:
            return replace(self.virgin, tangential_force=force).dissipated_energy
        half = (force - points[-1]) / 2
        return 2 * replace(self.virgin, tangential_force=half).dissipated_energy
