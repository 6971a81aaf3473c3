"""Torsion of coupled bodies, torsion beside a push, and a push that turns, by the radial solver."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import cache, partial
from math import hypot, pi
from typing import Any

import numpy as np

import contact_errors.on_cells
import contact_errors.on_radii
import radial
from contact_scene import LoadStep, Scene, SurfaceDiscretisation
from contact_scene.residuals import worst
from radial.circle import Circle
from semi_analytical import solve_discretised
from verification.judging.case import Case, Check, Level, Required
from verification.problems import paper_scene as paper
from verification.problems.layered_scene import coated, film, pressed, rigid_ball
from verification.problems.paper_scene import FRICTION, FRICTION_LIMIT, HERTZ
from verification.problems.problem import Problem
from verification.problems.reference import Reference, ReferenceKind
from verification.problems.sheared import OVER_LIMIT
from verification.problems.torsion import LARGEST, SOURCE, TO_AND_FRO, TWISTED

CELLS = {Level.QUICK: 64, Level.STANDARD: 96, Level.FULL: 192}
TORQUE = 3 * pi / 16 * FRICTION_LIMIT * HERTZ.contact_radius  # at which bare alike bodies slide
OF_TWIST = Required(5e-4, "asked of the rings at any number of increments")
OF_SHEAR = Required(5e-3, "asked of the radial solver, in the mean")
OF_ENERGY = Required(2e-3, "set by hand: four times what rings leave of a cycle")
OF_CELLS = Required(7e-4, "set by hand: 64 cells along a side and rings leave some 3e-4 each")
OF_STATED = Required(1.0, "both state how far off they are")
OF_TURN = Required(1e-10, "points are turned onto points")
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


def radial_turning(level: Level = Level.QUICK) -> Case:
    """The case; at higher levels beside finer cells."""
    cells = CELLS[level]
    return Case(
        name="radial_turning",
        title="Torsion and turning pushes on rings and angles",
        problem="The paper's ball of steel twisted as in radial_torsion, by points on rings, where "
        "the exact shear has no increments; and a rigid ball on a coating twice as stiff: pressed "
        "and twisted to and fro, and pressed further while it is twisted; twisted, then pushed, "
        "and twisted back; pushed along x, then along y. All of them beside cells, in the same "
        "increments.",
        runs=(),
        quantities=(),
        checks=(
            _known(
                "twist", "largest error of the twist", _twist_error, OF_TWIST, "the largest twist"
            ),
            _known(
                "shear", "largest mean error of q_θ over the contact", _shear_error, OF_SHEAR,
                "µp_H",
            ),
            _known(
                "loop_energy", "error of the energy per cycle relative to itself", _energy_error,
                OF_ENERGY, "1",
            ),
            *(check for name in SCENES for check in _beside_cells(name, cells)),
            Check(
                "turned", "difference of the shift after a quarter turn", "", "the radial solver",
                _turned, Reference(0.0, ReferenceKind.IDENTITY, SAME), OF_TURN, 1.0, "the shift",
            ),
        ),
        limits=(
            "Of coupled bodies cells are the only other voice: finite elements take one line, or "
            "torsion of alike bodies.",
        ),
    )  # fmt: skip


def _known(
    name: str, meaning: str, error: Callable[[], float], required: Required, unit: str
) -> Check:
    reference = Reference(0.0, ReferenceKind.CLOSED_FORM, f"{SOURCE}; Masing's rule", 0.0)
    return Check(name, meaning, "", "the radial solver", error, reference, required, 1.0, unit)


def _beside_cells(name: str, cells: int) -> Iterator[Check]:
    title = SCENES[name].title
    for of, meaning, measure, required, unit in (
        (
            "motion", "largest difference of shift and twist", _motion_apart, OF_CELLS,
            "the largest of the history",
        ),
        (
            "stated", "largest difference of motions, radii and energies",
            _apart_of_stated, OF_STATED, "what both state together",
        ),
    ):  # fmt: skip
        yield Check(
            f"{name}_{of}", meaning, "", title, partial(measure, name, cells),
            Reference(0.0, ReferenceKind.OTHER_SOLVER, f"{cells}² cells", 0.0), required, 1.0, unit,
        )  # fmt: skip


# ---- closed forms -----------------------------------------------------------------------------


def _ends(problem: Problem) -> list[tuple[Any, Any]]:
    steps = _at_points(problem.scene.model_dump_json()).steps
    return list(zip(steps[1:], problem.ends[1:], strict=True))


@cache
def _at_points(text: str) -> radial.Result:
    scene = Scene.model_validate_json(text)
    return radial.solve(scene, plan=replace(radial.plan(scene), circle=Circle.ONE))


def _twist_error() -> float:
    both = _ends(TWISTED) + _ends(TO_AND_FRO)
    return worst(*(abs(end.twist - known.twist) for end, known in both)) / LARGEST.twist


def _shear_error() -> float:
    errors = []
    for end, known in _ends(TWISTED):
        inside = end.radii < TWISTED.radius
        r = end.radii[inside]
        off = np.abs(end.shear_circumferential[inside] - known.shear(r))
        errors.append(np.trapezoid(off * r, r) / np.trapezoid(r, r))
    return worst(*errors) / TWISTED.scale(OVER_LIMIT)


def _energy_error() -> float:
    (first, _), *_, (last, known) = _ends(TO_AND_FRO)
    lost = last.dissipated_energy - first.dissipated_energy
    return float(abs(lost / known.energy_per_cycle - 1))


# ---- beside cells -----------------------------------------------------------------------------


@cache
def _on_radii(name: str) -> radial.Result:
    return radial.solve(SCENES[name])


@cache
def _on_cells(name: str, cells: int) -> Any:
    return solve_discretised(SCENES[name], SurfaceDiscretisation(cells=(cells, cells)))


def _motion_apart(name: str, cells: int) -> float:
    ours, theirs = _on_radii(name).steps, _on_cells(name, cells).steps
    errors = []
    for of in MOTIONS:
        both = [
            (np.asarray(one), np.asarray(other))
            for one, other in zip(_all(ours, of), _all(theirs, of), strict=True)
            if one is not None and other is not None
        ]
        size = max((np.linalg.norm(one) for one, _ in both), default=0.0)
        if size:
            errors += [float(np.linalg.norm(one - other) / size) for one, other in both]
    return worst(*errors)


def _all(steps: Any, of: str) -> list[Any]:
    return [getattr(step, of) for step in steps]


def _apart_of_stated(name: str, cells: int) -> float:
    ours, theirs = _on_radii(name), _on_cells(name, cells)
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
            apart = _size(np.subtract(*values))
            if allowed:
                shares.append(apart / allowed)
    return worst(*shares)


def _size(value: Any) -> float:
    """Of a number or vector; none of what is not stated."""
    return 0.0 if value is None else float(np.linalg.norm(value))


def _turned() -> float:
    """Of the last step, on half the rings and eight angles, turned by two of them."""
    here = _scene("pushed along x, then y", *(_push(*push, 2) for push in TURNING))
    scene = _scene("pushed along y, then -x", *(_push(*_quarter(push), 2) for push in TURNING))
    plan = radial.plan(here)
    one, other = (
        np.asarray(radial.solve(asked, plan=plan, fineness=0.5).steps[-1].tangential_shift)
        for asked in (here, scene)
    )
    return float(hypot(*np.subtract(_quarter(one), other)) / hypot(*_quarter(one)))


def _quarter(vector: Any) -> tuple[float, float]:
    """Turned by a quarter."""
    x, y = vector
    return -y, x
