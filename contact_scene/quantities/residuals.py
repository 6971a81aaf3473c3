"""Dimensionless residuals of the contact equations, and the criterion of convergence.

Each solver evaluates the residuals from its fields (see its module `residuals`); names and
criterion are common to all solvers.
"""

from dataclasses import dataclass, replace
from typing import Annotated

import numpy as np

from contact_scene.quantities.field_metadata import Reported
from contact_scene.solver_errors import NotConverged


def worst(*measures: float | None) -> float:
    """Return the largest of several residuals of the contact equations.

    Residuals that are None are ignored. The result is NaN if any residual is NaN, unlike that of
    Python's `max`.

    measures  residuals [1]; None where the residual is not defined
    """
    return float(np.max([measure for measure in measures if measure is not None]))


@dataclass(frozen=True)
class ShearResiduals:
    """Dimensionless residuals of the tangential problem; None where undefined.

    Here q is the shear, µp the friction limit, Δs the slip in the increment and r the distance from
    the origin. T and M_z are the prescribed tangential force and torque.

    friction_cone           largest |q| - µp / largest µp
    slip_direction          ∫(µp|Δs| + q·Δs) dA / ∫µp|Δs| dA
    tangential_equilibrium  |∫q dA - T| / ∫µp dA, under force control
    torque_equilibrium      |∫(q_y x - q_x y) dA - M_z| / ∫µp r dA, under force control of the twist
    """

    friction_cone: float
    slip_direction: float | None
    tangential_equilibrium: float | None
    torque_equilibrium: float | None = None

    @property
    def worst(self) -> float:
        """Largest residual of the tangential contact problem [1]; NaN if any is NaN."""
        return worst(*vars(self).values())


@dataclass(frozen=True)
class Residuals:
    """Dimensionless residuals of the contact equations at the end of an increment.

    A residual is None where its effect or its control is off. Here p is the pressure, q the shear,
    µp the friction limit and r the distance from the origin. W, T, M and M_z are the prescribed
    normal force, tangential force, moments and torque. Δs is the slip in the increment.

    complementarity         ∫|gap| p dA / (approach W)
    penetration             largest overlap / approach
    normal_equilibrium      |∫p dA - W| / W, under force control
    friction_cone           largest |q| - µp / largest µp
    slip_direction          ∫(µp|Δs| + q·Δs) dA / ∫µp|Δs| dA
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
            "Difference between the work of the friction limit along the slip and that of the "
            "shear, relative to the former.",
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
            "Difference of the moments of the pressure from the prescribed ones, relative to the "
            "pressure times its distance from the origin; null where the tilt is prescribed.",
        ),
    ] = None
    torque_equilibrium: Annotated[
        float | None,
        Reported(
            "",
            "Difference of the torque of the shear from the prescribed one, relative to the "
            "friction limit times its distance from the origin; null where the twist is "
            "prescribed.",
        ),
    ] = None

    def with_shear(self, shear: ShearResiduals) -> "Residuals":
        """Combine the residuals of the normal problem with those of the tangential problem.

        shear  residuals of the tangential problem, which replace those of this object
        """
        return replace(self, **vars(shear))

    @property
    def worst(self) -> float:
        """Largest residual of the contact equations of an increment [1]; NaN if any is NaN."""
        return worst(*vars(self).values())

    def require(self, tolerance: float, problem: str, iterations: int) -> None:
        """Raise NotConverged if a residual of an increment exceeds the tolerance or is NaN.

        tolerance   limit of every residual [1]
        problem     name of the problem, for the message
        iterations  number of iterations, for the message
        """
        if not self.worst <= tolerance:
            raise NotConverged(problem, iterations, self.worst, tolerance)
