"""Contact stiffnesses at the end of an increment: normal, tangential and torsional."""

import numpy as np

from contact_scene.array_types import Matrix
from contact_scene.rig import compliances
from contact_solver.conjugate_gradients import Point
from contact_solver.rigid_motion import RigidMotions
from contact_solver.tangent import (
    coupled_tangent,
    pressing_tangent,
    shearing_tangent,
    stiffnesses,
)
from semi_analytical.increments.increment import State
from semi_analytical.increments.normal_solve import MARGIN
from semi_analytical.increments.tangential_solve import TangentialTarget, shear_problem
from semi_analytical.increments.tangential_state import surface_target, untouched_state
from semi_analytical.model import ContactModel
from semi_analytical.operator.box import Box, box_around
from semi_analytical.operator.points import points_of

Pair = tuple[float, float]


def contact_stiffness(
    model: ContactModel,
    before: State | None,
    after: State,
    load: TangentialTarget | None,
    direction: Pair | None,
    *,
    coupled: bool,
) -> dict[str, float]:
    """Compute the contact stiffnesses at the end of an increment, by the names of the results.

    A stiffness is the derivative of the force at the end of the increment by the motion there. The
    other loads and the state at the start are kept.

    before     state at the start of the increment; None before first contact
    after      state at its end
    load       prescribed tangential load; None without shear
    direction  unit vector along which the tangential load changes; None without a tangential load
    coupled    True if pressure and shear were solved together
    raises     NotConverged
    """
    box = box_around(after.pressing.pressure > 0, MARGIN, model.domain)
    closing = after.target.motions(model, box)
    if coupled:
        assert load is not None
        motions = load.all_motions(model, box).with_closing(closing)
        tangent = _coupled_tangent(model, box, before, after, load, motions)
        return _reported(model, tangent, motions, direction)
    p = points_of(after.pressing.pressure[box.slices])
    pressed = pressing_tangent(after.target.problem(model, box), p)
    found = _reported(model, pressed, RigidMotions(2).with_closing(closing), None)
    if load is None:
        return found
    motions = load.all_motions(model, box)
    tangent = _shearing_tangent(model, box, before, after, load, motions)
    return found | _reported(model, tangent, motions, direction)


def _reported(
    model: ContactModel, tangent: Matrix, motions: RigidMotions, direction: Pair | None
) -> dict[str, float]:
    """Convert a tangent to the contact stiffnesses of the results.

    tangent    derivative of the forces by the motions, per area of a cell (k, k)
    motions    the motions; rotations are multiplied by `ContactModel.reach`
    direction  unit vector of the tangential stiffness; None for none
    """
    uniform, k = motions.shapes.uniform, len(motions)
    rotates = np.arange(k) >= len(uniform)
    sizes = np.where(rotates, model.reach, 1.0)
    shift, approach, twist = np.zeros((3, k))
    shift[: len(uniform)] = uniform[:, :2] @ (direction or (0.0, 0.0))
    approach[: len(uniform)] = uniform[:, 2:] @ np.ones(motions.components - 2)
    twist[rotates] = [np.any(one.shape[:2]) for one in motions.each[len(uniform) :]]
    normal, tangential = compliances(model.scene.rig)
    return stiffnesses(
        model.grid.cell_area * tangent * np.outer(sizes, sizes),
        motions,
        {
            "normal_stiffness": approach,
            "tangential_stiffness": shift,
            "torsional_stiffness": twist,
        },
        {"normal_stiffness": normal, "tangential_stiffness": tangential},
    )


def _shearing_tangent(
    model: ContactModel,
    box: Box,
    before: State | None,
    after: State,
    load: TangentialTarget,
    motions: RigidMotions,
) -> Matrix:
    """Compute the derivative of the tangential forces by the motions at constant pressure (k, k).

    box      box of cells with the contact
    before   state at the start of the increment; None before first contact
    after    state at its end
    load     prescribed tangential load
    motions  motions of the derivative
    """
    sheared = after.sheared
    assert sheared is not None
    bound = model.friction_limit(sheared.pressure)
    if sheared.shift is None or not np.any(bound):
        return np.zeros((len(motions), len(motions)))
    last = before.sheared if before is not None else None
    target = surface_target(model, last or untouched_state(model.grid.cells), load, sheared.free)
    inside = (..., *box.slices)
    return shearing_tangent(
        shear_problem(model, box, bound, target, load),
        Point(points_of(sheared.shear[inside]), points_of(sheared.displacement[inside])),
        load.scaled(model, load.rigid_motion(sheared.shift, sheared.twist)),
        motions,
    )


def _coupled_tangent(
    model: ContactModel,
    box: Box,
    before: State | None,
    after: State,
    load: TangentialTarget,
    motions: RigidMotions,
) -> Matrix:
    """Compute the derivative of all forces by the motions, with pressure and shear coupled (k, k).

    box      box of cells with the contact
    before   state at the start of the increment; None before first contact
    after    state at its end
    load     prescribed tangential load
    motions  motions of the derivative
    """
    from semi_analytical.coupled.coupled_increment import coupled_problem

    sheared, last = after.sheared, before.sheared if before is not None else None
    assert sheared is not None
    last, motion = last or untouched_state(model.grid.cells), None
    if sheared.shift is not None:
        motion = load.scaled(model, load.rigid_motion(sheared.shift, sheared.twist))
    inside = (..., *box.slices)
    p, q = points_of(after.pressing.pressure[box.slices]), points_of(sheared.shear[inside])
    problem = coupled_problem(model, box, last, after.target, load)
    return coupled_tangent(problem, np.concatenate([q, p[None]]), motion, motions)
