"""When a state is accepted: how much it misses of each equation of contact, dimensionless.

Either solver measures on its own fields (see its `residuals`); the names, and what is acceptable,
are the same.
"""

from dataclasses import dataclass, replace
from typing import Annotated

import numpy as np

from contact_scene.quantities.field_metadata import Reported
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

    complementarity: Annotated[
        float, Reported("", "Pressure where there is a gap, relative to load and approach.")
    ]
    penetration: Annotated[float, Reported("", "Largest penetration relative to the approach.")]
    normal_equilibrium: Annotated[
        float | None,
        Reported(
            "",
            "Difference of the integrated pressure from the normal force, relative to it; null "
            "where the approach is prescribed.",
        ),
    ] = None
    friction_cone: Annotated[
        float | None,
        Reported(
            "",
            "Largest excess of shear over the friction limit, relative to the largest limit.",
        ),
    ] = None
    slip_direction: Annotated[
        float | None,
        Reported(
            "",
            "Work that slip would do along the shear instead of against it, relative to the "
            "limit's.",
        ),
    ] = None
    tangential_equilibrium: Annotated[
        float | None,
        Reported(
            "",
            "Difference of the integrated shear from the tangential force, relative to the limit.",
        ),
    ] = None
    moment_equilibrium: Annotated[
        float | None,
        Reported(
            "",
            "Difference of the moments of the pressure from the given ones, relative to the "
            "pressure times its distance from the origin; null where the tilt is prescribed.",
        ),
    ] = None
    torque_equilibrium: Annotated[
        float | None,
        Reported(
            "",
            "Difference of the torque of the shear from the given one, relative to the friction "
            "limit times its distance from the origin; null where the twist is prescribed.",
        ),
    ] = None

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
