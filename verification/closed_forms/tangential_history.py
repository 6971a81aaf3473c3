"""Hertz contact under any history of the tangential force at constant normal load.

The method is Masing's rule with return-point memory. A branch after a reversal is the curve of the
first loading with force and displacement doubled. When the force returns to an earlier reversal,
the loop closes and both reversals are removed. For Hertz point contact this is exact under the
assumptions of `cattaneo_mindlin` (Mindlin and Deresiewicz 1953; Jäger 1998).
"""

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray

from verification.closed_forms.cattaneo_mindlin import PartialSlip


@dataclass(frozen=True)
class TangentialHistory:
    """State of a Hertz contact after a history of tangential forces at constant normal load.

    virgin             the contact without tangential force
    turning_points     forces at the reversals of open loops, with decreasing differences [force]
    tangential_force   current T [force]
    dissipated_energy  energy dissipated by friction since the start [force*length]
    """

    virgin: PartialSlip
    turning_points: tuple[float, ...] = ()
    tangential_force: float = 0.0
    dissipated_energy: float = 0.0

    def __post_init__(self) -> None:
        if self.virgin.tangential_force != 0:
            raise ValueError("a history starts from a contact without tangential force")

    def loaded_to(self, force: float) -> "TangentialHistory":
        """Compute the state after a monotonic change of the tangential force to `force` [force].

        Raises ValueError if |force| exceeds the friction limit µW.
        """
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
        """Tangential shift of the indenter relative to the body [length]."""
        return sum(scale * state.shift for scale, state in self.branches())

    def shear(self, r: ArrayLike) -> NDArray[np.float64]:
        """Compute the shear on the lower body at distance r from the axis [force/length²]."""
        total = np.zeros_like(np.asarray(r, dtype=float))
        for scale, state in self.branches():
            total = total + scale * state.shear(r)
        return total

    def slip(self, r: ArrayLike) -> NDArray[np.float64]:
        """Compute the slip of the lower surface relative to the indenter at distance r <= a
        [length].

        The formula holds for ν = 0.
        """
        total = np.zeros_like(np.asarray(r, dtype=float))
        for scale, state in self.branches():
            total = total + scale * state.slip(r)
        return total

    @property
    def stick_radius(self) -> float:
        """Radius of the zone that has not slipped since the last reversal [length]."""
        return self.branches()[-1][1].stick_radius

    def branches(self) -> list[tuple[float, PartialSlip]]:
        """Return the first-loading states whose weighted sum is the current state, with their
        weights.

        The first has weight 1; each later branch has weight 2.
        """
        forces = (*self.turning_points, self.tangential_force)
        branches = [(1.0, replace(self.virgin, tangential_force=forces[0]))]
        for start, end in pairwise(forces):
            branches.append((2.0, replace(self.virgin, tangential_force=(end - start) / 2)))
        return branches

    def _lost(self, points: tuple[float, ...], force: float) -> float:
        """Compute the energy dissipated on the branch from the last reversal to a force
        [force*length].

        points  forces at the reversals; empty for the first loading [force]
        """
        if not points:
            return replace(self.virgin, tangential_force=force).dissipated_energy
        half = (force - points[-1]) / 2
        return 2 * replace(self.virgin, tangential_force=half).dissipated_energy
