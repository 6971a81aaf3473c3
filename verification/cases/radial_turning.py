"""Torsion of coupled bodies, torsion beside a push, and a push that turns, by the radial solver."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from math import hypot, pi
from typing import Any

import numpy as np

import contact_errors.on_cells
import contact_errors.on_radii
import radial
from contact_scene import LoadStep, Scene, SurfaceDiscretisation
from contact_scene.residuals import worst
from semi_analytical import solve_discretised
from verification.cases.torsion import ENERGY_PER_CYCLE, LOOP_TWISTS, SLIDING
from verification.judging.case import Case, Check, Level, Required
from verification.judging.declared_case import Within, case, judged
from verification.judging.ladder import on_radii
from verification.judging.observable import error_norm
from verification.judging.observables import TWIST
from verification.judging.run import OVER_ANGLES
from verification.problems import paper_scene as paper
from verification.problems.layered_scene import coated, film, pressed, rigid_ball
from verification.problems.paper_scene import FRICTION, FRICTION_LIMIT, HERTZ
from verification.problems.problem import Problem
from verification.problems.reference import ReferenceKind, identity
from verification.problems.sheared import OVER_LIMIT
from verification.problems.torsion import OVER_TWIST, PARTS, TO_AND_FRO, TWISTED

CELLS = {Level.QUICK: 64, Level.STANDARD: 96, Level.FULL: 192}
TORQUE = 3 * pi / 16 * FRICTION_LIMIT * HERTZ.contact_radius  # at which bare alike bodies slide
SAME = "a scene that is turned has turned answers"
SCALARS = ("approach", "contact_radius", "stick_radius", "dissipated_energy", "elastic_energy")
MOTIONS = ("tangential_shift", "twist")


def _twist(share: float, increments: int, **more: Any) -> LoadStep:
    return LoadStep(torque=share * TORQUE, increments=increments, **more)


def _push(x: float, y: float, increments: int) -> LoadStep:
    return LoadStep(
        tangential_force=(x * FRICTION_LIMIT, y * FRICTION_LIMIT), increments=increments
    )


def _scene(title: str, *steps: LoadStep) -> Scene:
    """A rigid ball on a coating twice as stiff, as thick as the contact is wide."""
    body = coated(film(2.0, 1.0))
    return pressed(title, rigid_ball(), body, paper.pressing(8), *steps, friction=FRICTION)


TURNING = ((0.6, 0.0), (0.0, 0.6))
SCENES = {
    "torsion": _scene(
        "Ball twisted on a coating", _twist(0.5, 6), _twist(-0.2, 6),
        _twist(0.2, 4, normal_force=1.2 * paper.NORMAL_FORCE),
    ),
    "beside": _scene(
        "Ball twisted and pushed on a coating", _twist(0.4, 4), _push(0.5, 0.0, 4), _twist(-0.1, 4)
    ),
    "turning": _scene(
        "Ball on a coating pushed along x, then y", _push(*TURNING[0], 4), _push(*TURNING[1], 6)
    ),
}  # fmt: skip


def _mean_shear_error(result: Any, step: int, problem: Problem) -> float:
    end, known = result.steps[step], problem.ends[step]
    inside = end.radii < problem.radius
    r = end.radii[inside]
    off = np.abs(end.shear_circumferential[inside] - known.shear(r))
    return float(np.trapezoid(off * r, r) / np.trapezoid(r, r) / problem.scale(OVER_LIMIT))


MEAN_SHEAR = error_norm(
    "mean_shear", "mean error of q_θ over the contact{when}", _mean_shear_error, OVER_LIMIT
)
OF_TWIST = "asked of the rings at any number of increments"
OF_BALL = tuple(
    row
    for step, part in PARTS.items()
    for row in (
        Within(replace(TWIST, over=OVER_TWIST).at(step, part, SLIDING), 5e-4, OF_TWIST),
        Within(MEAN_SHEAR.at(step, part, SLIDING), 5e-3, "asked of the radial solver, in the mean"),
    )
)
OF_LOOP = (
    *(Within(twist, 5e-4, OF_TWIST) for twist in LOOP_TWISTS),
    Within(ENERGY_PER_CYCLE, 2e-3, "set by hand: four times what rings leave of a cycle"),
)


def radial_turning(level: Level = Level.QUICK) -> Case:
    """The case; at higher levels beside finer cells."""
    return case(
        "radial_turning",
        "Torsion and turning pushes on rings and angles",
        "The paper's ball of steel twisted as in radial_torsion, by points on rings, where "
        "the exact shear has no increments; and a rigid ball on a coating twice as stiff: pressed "
        "and twisted to and fro, and pressed further while it is twisted; twisted, then pushed, "
        "and twisted back; pushed along x, then along y. All of them beside cells, in the same "
        "increments.",
        judged(on_radii(TWISTED, "ball", at_points=True), OF_BALL),
        judged(on_radii(TO_AND_FRO, "to and fro", at_points=True), OF_LOOP),
        *(
            judged(
                on_radii(
                    _beside_cells(scene, CELLS[level]), name, laws=OVER_ANGLES
                ),
                OF_COATED,
            )
            for name, scene in SCENES.items()
        ),
        checks=(
            Check(
                "turned", "difference of the shift after a quarter turn", "", "the radial solver",
                _turned, identity(0.0, SAME), Required(1e-10, "points are turned onto points"),
                1.0, "the shift",
            ),
        ),
        limits=(
            "Of coupled bodies cells are the only other voice: finite elements take one line, or "
            "torsion of alike bodies.",
        ),
    )  # fmt: skip


def _beside_cells(scene: Scene, cells: int) -> Problem:
    """What cells return, with edges inside them, is the answer."""
    return Problem(
        scene, (lambda: _on_cells(scene, cells),), HERTZ.contact_radius, f"{cells}² cells",
        ReferenceKind.OTHER_SOLVER,
    )  # fmt: skip


@cache
def _on_cells(scene: Scene, cells: int) -> Any:
    return solve_discretised(scene, SurfaceDiscretisation(cells=(cells, cells)))


def _motion_apart(ours: Any, _: int, problem: Problem) -> float:
    theirs = problem.ends[-1]()
    errors = []
    for of in MOTIONS:
        both = [
            (np.asarray(getattr(one, of)), np.asarray(getattr(other, of)))
            for one, other in zip(ours.steps, theirs.steps, strict=True)
            if getattr(one, of) is not None and getattr(other, of) is not None
        ]
        size = max((np.linalg.norm(one) for one, _ in both), default=0.0)
        if size:
            errors += [float(np.linalg.norm(one - other) / size) for one, other in both]
    return worst(*errors)


def _apart_of_stated(ours: Any, _: int, problem: Problem) -> float:
    theirs = problem.ends[-1]()
    said = (
        contact_errors.on_radii.stated_errors(ours),
        contact_errors.on_cells.stated_errors(theirs),
    )
    shares = []
    for one, other, *stated in zip(
        ours.steps, theirs.steps, *(errors.steps for errors in said), strict=True
    ):
        for of in (*SCALARS, *MOTIONS):
            values = getattr(one, of), getattr(other, of)
            if any(value is None for value in values):
                continue
            allowed = sum(_size(errors[of].error) for errors in stated)
            if allowed:
                shares.append(_size(np.subtract(*values)) / allowed)
    return worst(*shares)


def _size(value: Any) -> float:
    """Of a number or vector; none of what is not stated."""
    return 0.0 if value is None else float(np.linalg.norm(value))


OF_COATED = (
    Within(
        error_norm(
            "motion", "largest difference of shift and twist", _motion_apart,
            "the largest of the history",
        ),
        7e-4, "set by hand: 64 cells along a side and rings leave some 3e-4 each",
    ),
    Within(
        error_norm(
            "stated", "largest difference of motions, radii and energies", _apart_of_stated,
            "what both state together",
        ),
        1.0, "both state how far off they are",
    ),
)  # fmt: skip


def _turned() -> float:
    """Of the last step, on half the rings and eight angles, turned by two of them."""
    here = _scene("pushed along x, then y", *(_push(*push, 2) for push in TURNING))
    scene = _scene("pushed along y, then -x", *(_push(*_quarter(push), 2) for push in TURNING))
    plan = replace(radial.plan(here), fineness=0.5)
    one, other = (
        np.asarray(radial.solve(asked, plan=plan).steps[-1].tangential_shift)
        for asked in (here, scene)
    )
    return float(hypot(*np.subtract(_quarter(one), other)) / hypot(*_quarter(one)))


def _quarter(vector: Any) -> tuple[float, float]:
    """Turned by a quarter."""
    x, y = vector
    return -y, x
