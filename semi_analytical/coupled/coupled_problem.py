"""An increment of coupled bodies as its solvers see it, in a box of cells."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from contact_scene.array_types import Field, Vector, VectorField
from semi_analytical.normal.normal_load import (
    Motion,
    NormalLoad,
)
from semi_analytical.operator.domain import WINDOW, ReducedDomain
from semi_analytical.tangential.admissible_shear import TangentialLoad

# Along the shorter side of a box. With more Newton's method stalls, with fewer it takes more steps.
PATCHES = 40


class Preconditioner(Protocol):
    """Roughly the tractions that cause displacements; see `ApproximateInverse`."""

    def __call__(self, displacements: NDArray[Any], /) -> NDArray[Any]: ...

    def yielding(self, compliance: float) -> "Preconditioner":
        """The same for cells that yield to their own tractions by as much more."""


@dataclass(frozen=True)
class CoupledProblem:
    """One increment in a box of cells; operators and preconditioners as in the two solvers.

    normal, shear            u_z by pressure, u_t by shear
    normal_by_shear          u_z by shear
    shear_by_pressure        u_t by pressure
    invert_shear             see `tangential_problem.solve_tangential`
    together                 (u_x, u_y, u_z) by (q_x, q_y, p): all four of them at once
    precondition_together    roughly the inverse without the coupling, and behind that the shears of
                             one component that are held back (see `ApproximateInverse`)
    gap                      undeformed gap (nx, ny), infinite where the bodies can never touch
    friction_limit           pressure (nx, ny) -> largest shear (nx, ny)
    friction_slope           pressure (nx, ny) -> derivative of the largest shear (nx, ny)
    target                   u_t - motion of the state before (2, nx, ny)
    self_compliance          tangential displacement of a cell by its own unit shear
    domain                   that all fields are on
    """

    normal: Callable[[Field], Field]
    precondition_normal: Callable[[Field], Field]
    shear: Callable[[VectorField], VectorField]
    invert_shear: Callable[[VectorField], VectorField]
    normal_by_shear: Callable[[VectorField], Field]
    shear_by_pressure: Callable[[Field], VectorField]
    together: Callable[[Field], Field]
    precondition_together: Preconditioner
    gap: Field
    friction_limit: Callable[[Field], Field]
    friction_slope: Callable[[Field], Field]
    target: VectorField
    normal_load: NormalLoad
    tangential_load: TangentialLoad
    self_compliance: float
    domain: ReducedDomain = WINDOW

    @property
    def gamma(self) -> float:
        """γ of the natural map [force/length^3]: what a patch of cells resists, a cell on few.

        Any γ > 0 has the same solutions. What an unfinished linear solve leaves of the gap is
        smooth and as wide as the contact; against the compliance of one cell of very many it looks
        so large that cells which carry pressure would part in masses.
        """
        shortest = min(self.domain.window(self.gap.shape))
        return 1 / (self.self_compliance * max(1.0, shortest / PATCHES))

    def yielding(self, compliance: float, tractions: Field) -> "CoupledProblem":
        """The same where every cell is on springs of a compliance more, which are at rest at
        tractions (3, nx, ny): for Newton's method, by `together` alone."""
        q, p = tractions[:2], tractions[2]
        return replace(
            self,
            together=lambda t: self.together(t) + compliance * t,
            precondition_together=self.precondition_together.yielding(compliance),
            gap=self.gap - compliance * p,
            target=self.target + compliance * q,
            self_compliance=self.self_compliance + compliance,
        )


@dataclass(frozen=True)
class CoupledSolution:
    """Pressure (nx, ny), shear (2, nx, ny), the motions of both loads, slip zone, iterations,
    rounds.

    at_limit  the force is as large as friction can carry or larger: everything slips along it, and
              the motion is not defined
    """

    pressure: Field
    shear: VectorField
    closing: Motion
    motion: Vector
    in_slip: NDArray[np.bool_]
    at_limit: bool
    iterations: int
    rounds: int

    @property
    def approach(self) -> float:
        """Approach of the bodies at the origin [length]."""
        return float(np.ravel(self.closing)[0])

    @property
    def shift(self) -> Vector:
        """Shift of the indenter (2,) [length]."""
        return self.motion[:2]
