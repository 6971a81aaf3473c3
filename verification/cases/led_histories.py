"""Histories led by forces and by motions in turn: where every increment ends, and how many."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from contact_scene import FlatPunch, LoadStep, Paraboloid, Scene
from contact_scene.loading import CONTROLS
from contact_scene.residuals import worst
from verification.closed_forms.hertz import PointContact
from verification.judging.case import Case, Level, Quantity, Required
from verification.judging.run import Run, SectionRun, per_radius
from verification.problems import paper_scene as paper
from verification.problems.paper_scene import FRICTION, HERTZ, NORMAL_FORCE, NU_ZERO
from verification.problems.reference import Reference, closed_form, identity
from verification.problems.sheared import SLIDING_SHIFT
from verification.problems.torsion import LARGEST, SLIDING_TORQUE

CELLS = {Level.QUICK: 48, Level.STANDARD: 96, Level.FULL: 192}
ELEMENTS = {Level.QUICK: 16, Level.STANDARD: 32, Level.FULL: 64}
MARGIN = 1.3  # half the window over Hertz's radius
PUNCH = FlatPunch(radius=HERTZ.contact_radius, material=NU_ZERO)
ARM = 0.1 * HERTZ.contact_radius  # the punch touches all over up to a third of its radius
SLOPE = 0.1 * HERTZ.approach / HERTZ.contact_radius
FIRST = LoadStep(normal_force=0.5 * NORMAL_FORCE, increments=2)
HELD = LoadStep(normal_force=NORMAL_FORCE, increments=1)
LIMIT = FRICTION * NORMAL_FORCE
AT_HERTZ = 3e-3  # of the smallest contact at the quick level, of 7 cells or elements


def _led(indenter: Paraboloid | FlatPunch, title: str, *loading: LoadStep) -> Scene:
    return paper.frictional(title, indenter, NU_ZERO).model_copy(update={"loading": loading})


_BALL = paper.paraboloid(NU_ZERO)
PRESSED = _led(
    _BALL, "Ball led by force, approach and force", FIRST,
    LoadStep(approach=HERTZ.approach, increments=4),
    LoadStep(normal_force=0.7 * NORMAL_FORCE, increments=3),
)  # fmt: skip
PUSHED = _led(
    _BALL, "Ball led by push, shift and push", HELD,
    LoadStep(tangential_force=(0.4 * LIMIT, 0.0), increments=2),
    LoadStep(tangential_shift=(0.5 * SLIDING_SHIFT, 0.0), increments=4),
    LoadStep(tangential_force=(0.1 * LIMIT, 0.0), increments=3),
)  # fmt: skip
TWISTED = _led(
    _BALL, "Ball led by torque, twist and torque", HELD,
    LoadStep(torque=0.4 * SLIDING_TORQUE, increments=2),
    LoadStep(twist=0.5 * LARGEST.twist, increments=4),
    LoadStep(torque=0.1 * SLIDING_TORQUE, increments=3),
)  # fmt: skip
TILTED = _led(
    PUNCH, "Punch led by moment, tilt and moment", HELD,
    LoadStep(moment=(0.5 * ARM * NORMAL_FORCE, ARM * NORMAL_FORCE), increments=2),
    LoadStep(tilt=(SLOPE, 0.5 * SLOPE), increments=4),
    LoadStep(moment=(-ARM * NORMAL_FORCE, 0.0), increments=3),
)  # fmt: skip
SCENES = {"pressed": PRESSED, "pushed": PUSHED, "twisted": TWISTED, "tilted": TILTED}
ON_ELEMENTS = ("pressed", "pushed", "twisted")  # they keep the indenter upright
LINEAR = identity(0.0, "a step ramps linearly from where the step before it ended")


def led_histories(level: Level = Level.QUICK) -> Case:
    """The case, on finer grids and meshes at higher levels."""
    grid = paper.square_grid(CELLS[level], MARGIN * HERTZ.contact_radius)
    mesh = per_radius(ELEMENTS[level], HERTZ.contact_radius)
    runs: tuple[Run | SectionRun, ...] = (
        # A step begins at the state before the edge correction of the step before it.
        *(Run(name, scene, grid, edge="off") for name, scene in SCENES.items()),
        *(SectionRun(f"{name}, elements", SCENES[name], mesh) for name in ON_ELEMENTS),
    )
    return Case(
        name="led_histories",
        title="Forces and motions in turn",
        problem="A ball led by a force, an approach and a force again, by pushes and a shift, by "
        "torques and a twist, and a flat punch by moments and a tilt. A step that takes over from "
        "the other control begins where that ended, and goes straight, in as many increments as it "
        "names. While the ball is pressed, force and approach are Hertz's in each of them.",
        runs=runs,
        quantities=(
            *(_way(run) for run in runs),
            *(_count(run) for run in runs),
            *(_hertz(run, level) for run in runs if run.scene == PRESSED),
        ),
    )


def _way(run: Run | SectionRun) -> Quantity:
    return Quantity(
        "off_the_way", "largest distance of what leads from the straight way of its step, over "
        "the larger of its ends", "", run.label, lambda result: off_the_way(run.scene, result),
        LINEAR, Required(1e-6, "forces are met to the tolerance of the solver; motions exactly"),
        scale=1.0, scale_name="1",
    )  # fmt: skip


def _count(run: Run | SectionRun) -> Quantity:
    named = sum(step.increments or 0 for step in run.scene.loading)
    return Quantity(
        "increments", "increments of all steps", "", run.label,
        lambda result: float(len(result.increments)),
        Reference(float(named), LINEAR.kind, "the scene names them"),
        Required(1e-9, "a count is met or not"),
    )  # fmt: skip


def _hertz(run: Run | SectionRun, level: Level) -> Quantity:
    return Quantity(
        "force_at_approach", "largest relative difference of the force from Hertz's at the "
        "approach of any increment", "", run.label, _off_hertz,
        closed_form(0.0, "Hertz 1882; Johnson 1985, ch. 4"),
        Required(
            AT_HERTZ / 4**level, "set by hand on the quick grid and mesh, of order 2 on others"
        ),
        scale=1.0, scale_name="1",
    )  # fmt: skip


def off_the_way(scene: Scene, result: Any) -> float:
    """Of what leads in every step. The first step goes from nothing, uniformly in the contact
    radius: a force on a ball with its third power."""
    off = 0.0
    for number, step in enumerate(scene.loading, start=1):
        (name,) = (n for pair in CONTROLS for n in pair if getattr(step, n) is not None)
        inside = [increment for increment in result.increments if increment.step == number]
        if not inside:
            return float("nan")
        values = np.array([_vector(increment, name) for increment in inside])
        named = np.atleast_1d(np.asarray(getattr(step, name), dtype=float))
        way = np.arange(1, len(inside) + 1) / len(inside)
        before = [increment for increment in result.increments if increment.step < number]
        if before:
            start = _vector(before[-1], name)
        else:
            start, way = 0.0 * named, way**3
        straight = start + way[:, None] * (named - start)
        scale = np.max(np.abs([start, named]))
        off = worst(off, float(np.max(np.abs(values - straight)) / scale))
    return off


def _vector(increment: Any, name: str) -> NDArray[np.float64]:
    value = getattr(increment, name)
    return np.atleast_1d(np.asarray(0.0 if value is None else value, dtype=float))


def _off_hertz(result: Any) -> float:
    def off(increment: Any) -> float:
        at = PointContact.at_approach(increment.approach, HERTZ.radius, HERTZ.contact_modulus)
        return abs(increment.normal_force / at.load - 1)

    return worst(*map(off, result.increments))
