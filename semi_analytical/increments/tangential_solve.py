"""Solution of the tangential problem at a given pressure, in a box around the contact."""

from dataclasses import dataclass, replace

import numpy as np

from contact_scene.array_types import Field, Vector, VectorField
from contact_scene.bulk_strain import Strain
from semi_analytical.model import ContactModel
from semi_analytical.operator.box import box_around
from semi_analytical.operator.domain import WINDOW, ReducedDomain
from semi_analytical.tangential.admissible_shear import TangentialLoad
from semi_analytical.tangential.linearised_shear import Point
from semi_analytical.tangential.tangential_problem import TangentialSolution, solve_tangential


@dataclass(frozen=True)
class TangentialTarget:
    """Prescribed tangential load of an increment: force or shift, torque or twist, and bulk strain.

    force, shift   tangential force T [force] or shift of the indenter [length], each (2,): exactly
                   one is given
    torque, twist  torque M_z [force length] or twist: exactly one is given; both None without
                   torsion
    strain         bulk strain (xx, yy, xy) of the lower body since first contact; None
                   without strain
    """

    force: Vector | None = None
    shift: Vector | None = None
    torque: float | None = None
    twist: float | None = None
    strain: Strain | None = None

    @property
    def twists(self) -> bool:
        """True if the load includes torsion: a torque or a twist is prescribed."""
        return self.torque is not None or self.twist is not None

    def rigid_motion(self, shift: Vector | None, twist: float | None) -> Vector:
        """Return a rigid tangential motion: shift (2,), or shift and twist (3,) under a torque.

        shift, twist  shift (2,) [length] and twist of the indenter; None for a twist of 0
        """
        assert shift is not None
        return shift if self.torque is None else np.array([*shift, twist or 0.0])

    def as_load(
        self,
        cell_area: float,
        rotation: VectorField | None,
        domain: ReducedDomain = WINDOW,
        spring: float = 0.0,
    ) -> TangentialLoad:
        """Convert the prescribed tangential load to the load object of the tangential solver.

        The object projects shears on the prescribed forces.

        cell_area  area of a cell and its mirror images [length^2]
        rotation   (-y, x) of the cells (2, nx, ny) [length]; None without torsion
        domain     domain of the cells: full window or reduced by symmetry
        spring     displacement of a test rig's spring per sum of the shear [length^3/force]
        """
        return TangentialLoad(
            total=None if self.force is None else self.force / cell_area,
            shift=self.shift,
            torque=(self.torque or 0.0) / cell_area,
            rotation=None if self.torque is None else rotation,
            compliance=spring if self.force is None and self.torque is None else 0.0,
            summed=domain.summed,
        )


def shear(
    model: ContactModel,
    bound: Field,
    target: VectorField,
    load: TangentialTarget,
    start: Point,
    motion: Vector,
    tolerance: float,
) -> TangentialSolution:
    """Solve the tangential problem of one increment at a given pressure.

    The problem is solved in a box around the contact. The solution is then extended to the whole
    domain, with the displacements of all cells.

    model          contact model
    bound          friction limit µp (nx, ny), not zero everywhere
    target         relative surface displacement that stick requires (2, nx, ny) [length], without
                   the motion of the load
    load           prescribed tangential load
    start, motion  initial guesses of the shear with its displacement, and of the rigid motion
    tolerance      limit of the residuals of friction law and slip direction
    raises         NotConverged
    """
    cells = bound.shape
    box = box_around(bound > 0, 0, model.domain)
    operator = model.operator(box.shape)
    inside = (..., *box.slices)
    rotation = model.rotation[inside] if load.twists else None
    solution = solve_tangential(
        operator.tangential,
        operator.shear_inverse,
        bound[box.slices],
        target[inside],
        load.as_load(model.grid.cell_area, rotation, model.domain, model.springs[1]),
        Point(start.shear[inside], start.displacement[inside]),
        motion,
        model.self_compliance,
        tolerance,
    )
    q, u = box.embed(solution.shear, cells), solution.displacement
    return replace(
        solution,
        shear=q,
        displacement=u if box.shape == cells else model.operator(cells).tangential(q),
        in_slip=box.embed(solution.in_slip.astype(np.float64), cells) > 0,
    )
