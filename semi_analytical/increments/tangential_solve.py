"""Solution of the tangential problem at a given pressure, in a box around the contact."""

from dataclasses import dataclass, replace

import numpy as np

from contact_scene.array_types import Field, Vector, VectorField
from contact_scene.bulk_strain import Strain
from contact_solver.conjugate_gradients import Point
from contact_solver.rigid_motion import RigidMotion, RigidMotions
from contact_solver.shear import ShearProblem, ShearSolution, solve_shear
from semi_analytical.model import ContactModel
from semi_analytical.operator.box import Box, box_around
from semi_analytical.operator.points import map_of_points, points_of, shear_inverse_in


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

    def motions(self, model: ContactModel, box: Box | None = None) -> RigidMotions:
        """Return the tangential rigid motions of the indenter: shifts, and twist under a torque.

        A prescribed twist is not among them: it changes the displacement that stick requires. On a
        reduced domain, a component of the shear that is odd about a mirror plane has no resultant,
        and the indenter does not move along it. With force or torque prescribed, only the
        displacement operator contains the spring of a test rig.

        model  contact model
        box    box of cells in which the tangential problem is solved; None for all cells
        """
        area, found = model.grid.cell_area, list[RigidMotion]()
        for unit, axis in zip(np.eye(2)[:, :, None], (0, 1), strict=True):
            if not model.domain.summed[axis]:
                continue
            if self.force is not None:
                found.append(RigidMotion(unit, float(self.force[axis]) / area))
            else:
                assert self.shift is not None
                spring = model.springs[1] if self.torque is None else 0.0
                found.append(RigidMotion(unit, None, float(self.shift[axis]), spring))
        if self.torque is not None:
            cells = (...,) if box is None else (..., *box.slices)
            turn = points_of(model.rotation[cells]) / model.reach
            found.append(RigidMotion(turn, self.torque / (area * model.reach)))
        return RigidMotions(2, tuple(found))

    def scaled(self, model: ContactModel, motion: Vector) -> Vector:
        """Convert shift (2,), or shift and twist (3,), to rigid motions in the order of `motions`.

        model   contact model
        motion  shift and twist as in `rigid_motion`
        """
        chosen, scales = self._order(model)
        return np.asarray((motion * scales)[chosen])

    def unscaled(self, model: ContactModel, motion: Vector) -> Vector:
        """Convert rigid motions in the order of `motions` to shift, or shift and twist.

        model   contact model
        motion  rigid motions (k,)
        """
        chosen, scales = self._order(model)
        found = np.zeros(len(scales))
        found[chosen] = motion
        return np.asarray(found / scales)

    def _order(self, model: ContactModel) -> tuple[list[bool], Vector]:
        """Return which of shift x, shift y and twist are among `motions`, and their scales."""
        if self.torque is None:
            return [*model.domain.summed], np.ones(2)
        return [*model.domain.summed, True], np.array([1.0, 1.0, model.reach])


def shear(
    model: ContactModel,
    bound: Field,
    target: VectorField,
    load: TangentialTarget,
    start: Point,
    motion: Vector,
    tolerance: float,
) -> ShearSolution:
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
    box = box_around(bound > 0, 0, model.domain)
    operator, cells = model.operator(box.shape), bound.shape
    inside = (..., *box.slices)
    problem = ShearProblem(
        map_of_points(operator.tangential, box.shape),
        shear_inverse_in(operator, box.shape),
        points_of(bound[box.slices]),
        points_of(target[inside]),
        load.motions(model, box),
        model.self_compliance,
    )
    guess = Point(*(points_of(field[inside]) for field in start))
    solution = solve_shear(problem, guess, load.scaled(model, motion), tolerance)
    q = box.embed(solution.shear.reshape(2, *box.shape), cells)
    u = solution.displacement.reshape(2, *box.shape)
    in_slip = solution.in_slip.reshape(box.shape).astype(np.float64)
    return replace(
        solution,
        shear=q,
        displacement=u if box.shape == cells else model.operator(cells).tangential(q),
        in_slip=box.embed(in_slip, cells) > 0,
        motion=load.unscaled(model, solution.motion),
    )
