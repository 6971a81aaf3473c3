"""When a state is accepted: how much it misses of each equation of contact, dimensionless.

Either solver measures on its own fields (see its `residuals`); the names, and what is acceptable,
are the same.
"""

from dataclasses import dataclass, replace

import numpy as np

from contact_scene.solver_errors import NotConverged


def worst(*measures: float | None) -> float:
    """The largest of those that apply; a NaN is the worst of all.

    Not by Python's `max`, which loses a NaN that does not come first.
    """
    return float(np.max([measure for measure in measures if measure is not None]))


@dataclass(frozen=True)
class ShearResiduals:
    """What shear misses, by the names of `Residuals`; None where undefined."""

    friction_cone: float
    slip_direction: float | None
    tangential_equilibrium: float | None
    torque_equilibrium: float | None = None

    @property
    def worst(self) -> float:
        """The largest of those that apply; NaN wins."""
        return worst(*vars(self).values())


@dataclass(frozen=True)
class Residuals:
    """What an increment misses; None where the effect or the control is off.

    complementarity         ∫|gap| p dA / (approach W)
    penetration             largest overlap / approach
    normal_equilibrium      |∫p dA - W| / W, under force control
    friction_cone           largest |q| - µp / largest µp
    slip_direction          ∫(µp|Δs| + q·Δs) dA / ∫µp|Δs| dA, Δs the slip increment
    tangential_equilibrium  |∫q dA - T| / ∫µp dA, under force control
    moment_equilibrium      |∫p (y, x) dA - M| / ∫p r dA, under force control of the tilt
    torque_equilibrium      |∫(q_y x - q_x y) dA - M_z| / ∫µp r dA, under force control of the twist
    """

    complementarity: float
    penetration: float
    normal_equilibrium: float | None = None
    friction_cone: float | None = None
    slip_direction: float | None = None
    tangential_equilibrium: float | None = None
    moment_equilibrium: float | None = None
    torque_equilibrium: float | None = None

    def with_shear(self, shear: ShearResiduals) -> "Residuals":
        """These and what shear misses."""
        return replace(self, **vars(shear))

    @property
    def worst(self) -> float:
        """The largest of those that apply; NaN wins."""
        return worst(*vars(self).values())

    def require(self, tolerance: float, problem: str, iterations: int) -> None:
        """Raise NotConverged unless all that apply are at most the tolerance.

        problem, iterations  what was solved, and how many iterations that took
        """
        if not self.worst <= tolerance:
            raise NotConverged(problem, iterations, self.worst, tolerance)
