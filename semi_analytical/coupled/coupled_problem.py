"""Data of the coupled normal and tangential problem of one increment in a box of cells."""

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

# Patches along the shorter side of a box: more make Newton's method stall, fewer cost iterations.
PATCHES = 40


class Preconditioner(Protocol):
    """Interface of an approximate inverse of the map from tractions to surface displacements.

    A call converts displacements to tractions. Krylov solvers use it as preconditioner.
    `ApproximateInverse` implements the interface.
    """

    def __call__(self, displacements: NDArray[Any], /) -> NDArray[Any]: ...

    def with_compliance(self, compliance: float) -> "Preconditioner":
        """Return the approximate inverse for surfaces with an additional compliance in each cell.

        The proximal-point method adds this compliance.

        compliance  additional displacement of a cell by its own unit traction [length^3/force]
        """


@dataclass(frozen=True)
class CoupledProblem:
    """Operators, loads and friction law of one coupled increment in a box of cells.

    p is the pressure (nx, ny), q the shear (2, nx, ny), u_z the normal and u_t the tangential
    surface displacement.

    normal, shear                 maps p -> u_z and q -> u_t
    normal_by_shear               map q -> u_z
    shear_by_pressure             map p -> u_t
    precondition_normal           approximate inverse of `normal`
    invert_shear                  approximate inverse of `shear`, see `tangential_problem`
    together                      map (q_x, q_y, p) -> (u_x, u_y, u_z)
    precondition_together         approximate inverse of `together` without coupling, followed by
                                  those of the bins of slip compliance (see `ApproximateInverse`)
    gap                           undeformed gap (nx, ny) [length], infinite outside the indenter
    friction_limit                map from pressure (nx, ny) to the largest shear (nx, ny)
    friction_slope                map from pressure (nx, ny) to the derivative of the largest shear
                                  (nx, ny)
    target                        displacement that stick requires: c = u_t - rigid motion of the
                                  previous state (2, nx, ny) [length]
    normal_load, tangential_load  prescribed loads
    self_compliance               tangential displacement of a cell by its own unit shear
                                  [length^3/force]
    domain                        domain of all fields: full window or reduced by symmetry
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
        """Stiffness γ that multiplies gap and slip in the natural map [force/length^3].

        γ is the stiffness of a patch of cells. The solution does not depend on γ > 0. An inexact
        linear solve leaves a smooth gap error of the width of the contact. With the stiffness of a
        single small cell, γ times this error would open many loaded cells.
        """
        shortest = min(self.domain.window(self.gap.shape))
        return 1 / (self.self_compliance * max(1.0, shortest / PATCHES))

    def with_compliance(self, compliance: float, tractions: Field) -> "CoupledProblem":
        """Return the coupled problem with an additional compliance, for the proximal-point method.

        Displacements become u + compliance * (t - tractions), with the tractions t. Newton's method
        solves the new problem. Of the operators only `together` and its preconditioner are changed.

        compliance  additional displacement per traction [length^3/force]
        tractions   reference tractions (q_x, q_y, p) (3, nx, ny)
        """
        q, p = tractions[:2], tractions[2]
        return replace(
            self,
            together=lambda t: self.together(t) + compliance * t,
            precondition_together=self.precondition_together.with_compliance(compliance),
            gap=self.gap - compliance * p,
            target=self.target + compliance * q,
            self_compliance=self.self_compliance + compliance,
        )


@dataclass(frozen=True)
class CoupledSolution:
    """Solution of a coupled increment (normal and tangential problem) in a box of cells.

    pressure, shear   p (nx, ny) and q (2, nx, ny) [force/length^2]
    closing           rigid normal motion: approach, and tilt under prescribed moments
    motion            rigid tangential motion: shift, and twist under a prescribed torque
    in_slip           slipping cells (nx, ny)
    at_limit          True if the load reaches the friction limit: gross slip, the motion is
                      undefined
    iterations        sum over all linear solves
    outer_iterations  iterations of the alternating iteration or of Newton's method
    """

    pressure: Field
    shear: VectorField
    closing: Motion
    motion: Vector
    in_slip: NDArray[np.bool_]
    at_limit: bool
    iterations: int
    outer_iterations: int

    @property
    def approach(self) -> float:
        """Approach of the bodies at the origin [length]."""
        return float(np.ravel(self.closing)[0])

    @property
    def shift(self) -> Vector:
        """Tangential shift of the indenter (2,) [length]."""
        return self.motion[:2]
