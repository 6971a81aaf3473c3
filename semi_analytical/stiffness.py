"""Contact stiffnesses at the end of an increment: normal, tangential and torsional."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from contact_scene.array_types import Matrix
from contact_scene.rig import compliances
from contact_scene.stepping.load_path import LoadChange
from contact_solver.conjugate_gradients import Point
from contact_solver.rigid_motion import RigidMotions
from contact_solver.tangent import (
    coupled_tangent,
    pressing_tangent,
    shearing_tangent,
    stiffnesses,
    zones_of_solution,
    zones_of_stick,
)
from semi_analytical.increments.increment import State
from semi_analytical.increments.normal_solve import MARGIN
from semi_analytical.increments.tangential_solve import TangentialTarget, shear_problem
from semi_analytical.increments.tangential_state import surface_target, untouched_state
from semi_analytical.model import ContactModel
from semi_analytical.operator.box import Box, box_around
from semi_analytical.operator.points import points_of

# Tangents in the zones of the solution (True) and with stick in the whole contact (False).
Tangents = Mapping[bool, Matrix]


def contact_stiffness(
    model: ContactModel,
    before: State | None,
    after: State,
    load: TangentialTarget | None,
    change: LoadChange,
    *,
    coupled: bool,
) -> dict[str, float]:
    """Compute the contact stiffnesses at the end of an increment, by the names of the results.

    before   state at the start of the increment; None before first contact
    after    state at its end
    load     prescribed tangential load; None without shear
    change   loads that the load step changes
    coupled  True if pressure and shear were solved together
    raises   NotConverged
    """
    box = box_around(after.pressing.pressure > 0, MARGIN, model.domain)
    closing = after.target.motions(model, box)
    required = set(change.changes.values())
    if coupled:
        assert load is not None
        motions = load.all_motions(model, box).with_closing(closing)
        tangents = _coupled_tangents(model, box, before, after, load, motions, required)
        return _reported(model, tangents, motions, change)
    p = points_of(after.pressing.pressure[box.slices])
    pressed = pressing_tangent(after.target.problem(model, box), p)
    only = RigidMotions(2).with_closing(closing)
    found = _reported(model, {True: pressed, False: pressed}, only, change)
    if load is None:
        return found
    motions = load.all_motions(model, box)
    tangents = _shearing_tangents(model, box, before, after, load, motions, required)
    return found | _reported(model, tangents, motions, change)


def _reported(
    model: ContactModel, tangents: Tangents, motions: RigidMotions, change: LoadChange
) -> dict[str, float]:
    """Convert tangents to the contact stiffnesses of the results.

    tangents  derivatives of the forces by the motions, per area of a cell (k, k)
    motions   the motions; rotations are multiplied by `ContactModel.reach`
    change    loads that the load step changes
    """
    uniform, k = motions.shapes.uniform, len(motions)
    rotates = np.arange(k) >= len(uniform)
    sizes = np.where(rotates, model.reach, 1.0)
    shift, approach, twist = np.zeros((3, k))
    shift[: len(uniform)] = uniform[:, :2] @ (change.direction or (0.0, 0.0))
    approach[: len(uniform)] = uniform[:, 2:] @ np.ones(motions.components - 2)
    twist[rotates] = [np.any(one.shape[:2]) for one in motions.each[len(uniform) :]]
    normal, tangential = compliances(model.scene.rig)
    scale = model.grid.cell_area * np.outer(sizes, sizes)
    return stiffnesses(
        {key: scale * tangent for key, tangent in tangents.items()},
        motions,
        {
            "normal_stiffness": approach,
            "tangential_stiffness": shift,
            "torsional_stiffness": twist,
        },
        change.changes,
        {"normal_stiffness": normal, "tangential_stiffness": tangential},
    )


def _shearing_tangents(
    model: ContactModel,
    box: Box,
    before: State | None,
    after: State,
    load: TangentialTarget,
    motions: RigidMotions,
    required: set[bool],
) -> Tangents:
    """Compute the derivatives of the tangential forces by the motions at constant pressure.

    box            box of cells with the contact
    before, after  states at the start of the increment, None before first contact, and at its end
    load           prescribed tangential load
    motions        motions of the derivatives
    required       keys of the required tangents
    """
    sheared, last = after.sheared, before.sheared if before is not None else None
    assert sheared is not None
    bound = model.friction_limit(sheared.pressure)
    if not np.any(bound):
        return dict.fromkeys(required, np.zeros((len(motions), len(motions))))
    target = surface_target(model, last or untouched_state(model.grid.cells), load, sheared.free)
    inside = (..., *box.slices)
    problem = shear_problem(model, box, bound, target, load)
    q = points_of(sheared.shear[inside])
    found: dict[bool, Matrix] = {}
    if False in required:
        found[False] = shearing_tangent(problem, np.zeros_like(q), motions)
    if True in required and sheared.shift is None:
        found[True] = np.zeros((len(motions), len(motions)))
    elif True in required:
        motion = load.scaled(model, load.rigid_motion(sheared.shift, sheared.twist))
        solution = Point(q, points_of(sheared.displacement[inside]))
        found[True] = shearing_tangent(problem, problem.natural(solution, motion).z, motions)
    return found


def _coupled_tangents(
    model: ContactModel,
    box: Box,
    before: State | None,
    after: State,
    load: TangentialTarget,
    motions: RigidMotions,
    required: set[bool],
) -> Tangents:
    """Compute the derivatives of all forces by the motions, with pressure and shear coupled.

    box            box of cells with the contact
    before, after  states at the start of the increment, None before first contact, and at its end
    load           prescribed tangential load
    motions        motions of the derivatives
    required       keys of the required tangents
    """
    from semi_analytical.coupled.coupled_increment import coupled_problem

    sheared, last = after.sheared, before.sheared if before is not None else None
    assert sheared is not None
    motion = None
    if sheared.shift is not None:
        motion = load.scaled(model, load.rigid_motion(sheared.shift, sheared.twist))
    p = points_of(after.pressing.pressure[box.slices])
    t = np.concatenate([points_of(sheared.shear[(..., *box.slices)]), p[None]])
    last = last or untouched_state(model.grid.cells)
    if last.shift is None:  # without effect on gross slip
        last = replace(last, shift=np.zeros(2))
    problem = coupled_problem(model, box, last, after.target, load)
    return {
        key: coupled_tangent(
            problem,
            zones_of_solution(problem, t, motion)
            if key
            else zones_of_stick(p, problem.friction_limit(p)),
            motions,
        )
        for key in required
    }
