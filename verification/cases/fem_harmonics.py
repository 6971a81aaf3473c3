"""Tangential loading by many harmonics with Coulomb's law at points, where closed forms know it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from contact_scene import (
    RIGID,
    Body,
    CoulombFriction,
    FlatPunch,
    IsotropicMaterial,
    LoadStep,
    Scene,
)
from verification.cases.cattaneo_mindlin import CATTANEO, PARTS
from verification.cases.fem_harmonics_run import PointsRun
from verification.cases.levels import because, finest
from verification.exhibits.chart import Chart, Look, Panel, curve
from verification.judging.case import Case, Level
from verification.judging.declared_case import Reported, Within, case, judged
from verification.judging.ladder import Ladder, Rung, asked, ladder, mesh_label, part_of_side
from verification.judging.observable import error_norm
from verification.judging.observables import SHIFT, STICK_RADIUS
from verification.judging.run import per_radius
from verification.observed.ring_tractions import tractions_at
from verification.problems import paper_scene as paper
from verification.problems.paper_scene import FRICTION, HERTZ, STEEL
from verification.problems.problem import Problem
from verification.problems.sheared import OVER_LIMIT, sheared
from verification.quantities import shift_along_x

if TYPE_CHECKING:
    from fem_reference import Increment, Result

Field = NDArray[np.float64]

LIMIT = FRICTION * HERTZ.peak_pressure
ALIKE = sheared("Two alike bodies of steel, sheared", PARTS, STEEL)

# Incompressible, so that pressing leaves no shear; it sticks all over.
RUBBER = IsotropicMaterial(young_modulus=3e6, poisson_ratio=0.5)
PUNCH, PUNCH_FORCE = 5e-3, 10.0


@dataclass(frozen=True)
class StuckDisc:
    """The end of the shearing [length]."""

    shift: float = (2 - 0.5) * PUNCH_FORCE / (8 * RUBBER.shear_modulus * PUNCH)


BONDED = Problem(
    Scene(
        title="Disc that sticks to an incompressible body, sheared",
        indenter=FlatPunch(radius=PUNCH, material=RIGID),
        body=Body(material=RUBBER),
        friction=CoulombFriction(coefficient=100.0),
        loading=(
            LoadStep(normal_force=PUNCH_FORCE, increments=1),
            LoadStep(tangential_force=(PUNCH_FORCE, 0.0), increments=1),
        ),
    ),
    (None, StuckDisc()),
    PUNCH,
    "Mindlin 1949: (2 - ν) T / 8 G a",
)
HIGHEST = 8  # harmonic
CUSP, RIM = 1.5, 1.0  # orders with which errors fall


def _shear_error(result: Any, step: int, problem: Problem) -> float:
    end = result.steps[step]
    q_x, q_y = shear_at_points(end)
    off = np.hypot(q_x - problem.ends[step].shear(end.radii)[:, None], q_y)
    return _integral(end, off) / paper.FRICTION_LIMIT


def _shift_over_mindlin(result: Any, step: int, problem: Problem) -> float:
    return shift_along_x(result.steps[step]) / problem.ends[step].shift - 1


SHEAR = error_norm("shear", "∫|q - q_exact| dA / µW{when}", _shear_error, "µW")
ACROSS = error_norm(
    "shear_across", "largest |q_y| / µp_H{when}",
    lambda result, step, _: shear_across(result.steps[step]), OVER_LIMIT,
)  # fmt: skip
OVER_MINDLIN = error_norm(
    "shift_over_mindlin", "shift{when} over Mindlin's, less one, ν = 0.3", _shift_over_mindlin
)
STOPS = dict(enumerate(PARTS, 1))
ROWS = tuple(
    row
    for step, part in STOPS.items()
    for row in (
        Within(SHIFT.at(step, part, "µW"), asked(3e-4, CUSP), because(CUSP)),
        Within(SHEAR.at(step, part, "µW"), asked(6e-3, CUSP), because(CUSP)),
        Within(ACROSS.at(step, part, "µW"), asked(3e-3, 1.0), because(1.0)),
        Within(
            STICK_RADIUS.at(step, part, "µW"), part_of_side(1.0),
            "an element: stick or slip is known ring by ring",
        ),
    )
)  # fmt: skip
BESIDE_MINDLIN = tuple(
    row
    for step, part in STOPS.items()
    for row in (
        Reported(
            ACROSS.at(step, part, "µW, ν = 0.3"),
            "zero in the closed form, which neglects slip across the load",
        ),
        Reported(
            OVER_MINDLIN.at(step, part, "µW"),
            "the vector law makes the contact stiffer by parts of a per mille",
        ),
    )
)
OF_DISC = (Within(replace(SHIFT, over=""), asked(5e-4, RIM), because(RIM), name="shift_of_disc"),)


def fem_harmonics(level: Level = Level.QUICK) -> Case:
    """The case, on finer meshes at higher levels."""
    elements = min(finest(level), 64)
    exact = _at_points("ν = 0", CATTANEO, elements, 0.99)
    alike = _at_points("ν = 0.3", ALIKE, elements, 0.99)
    disc = _at_points("disc", BONDED, elements, 1.0)
    return case(
        "fem_harmonics",
        "Finite elements: many harmonics",
        "Cattaneo and Mindlin's contact by harmonics 0 … 8 of the section, with Coulomb's law "
        "as a vector law at points of (r, θ): for ν = 0, where the closed form is exact, and "
        "for ν = 0.3, where it neglects slip across the load. Nothing couples here, so that "
        "one increment leads to each force. And a disc that sticks all over.",
        judged(exact, ROWS),
        judged(alike, BESIDE_MINDLIN),
        judged(disc, OF_DISC),
        charts=(lambda results: _chart(results[exact.levels[0]], results[alike.levels[0]]),),
        limits=(
            "The stick zone is known to an element in radius and, between the angles of the "
            "points, to sectors of 22.5°.",
        ),
    )


def _at_points(of: str, problem: Problem, elements: int, over: float) -> Ladder:
    mesh = per_radius(elements, over * problem.radius).model_copy(update={"harmonics": HIGHEST})
    return ladder(
        problem, [Rung(PointsRun(mesh_label(elements, of=of), problem.scene, mesh), elements)]
    )


def shear_at_points(increment: Increment) -> tuple[Field, Field]:
    """q_x and q_y (rings, angles) of an increment sheared along x."""
    assert increment.angles is not None
    r, theta = np.meshgrid(increment.radii, increment.angles, indexing="ij")
    q, _ = tractions_at(increment, r * np.cos(theta), r * np.sin(theta))
    return q[0], q[1]


def shear_across(increment: Increment) -> float:
    """Largest |q_y| over µp_H."""
    _, q_y = shear_at_points(increment)
    return float(np.max(np.abs(q_y)) / LIMIT)


def _integral(increment: Increment, values: Field) -> float:
    """∫ values dA by trapezia in r and θ; mirror symmetric."""
    assert increment.angles is not None
    around = 2 * np.trapezoid(values, increment.angles, axis=1)
    return float(np.trapezoid(increment.radii * around, increment.radii))


def _chart(exact: Result, alike: Result) -> Chart:
    """q_x on the line of the load for both Poisson's ratios, and q_y around for the second."""
    step = PARTS.index(0.6) + 1
    x = np.linspace(-1.1, 1.1, 221)
    curves = []
    for series, (name, result) in enumerate((("ν = 0", exact), ("ν = 0.3", alike))):
        q, _ = tractions_at(result.steps[step], x * HERTZ.contact_radius, 0 * x)
        curves.append(curve(name, x, q[0] / LIMIT, series=series))
    known = CATTANEO.ends[step].shear(np.abs(x) * HERTZ.contact_radius) / LIMIT
    across = []
    for series, angle in enumerate((22.5, 45.0, 67.5)):
        r, theta = np.linspace(0, 1.1, 111), np.radians(angle)
        points = HERTZ.contact_radius * r
        q, _ = tractions_at(alike.steps[step], points * np.cos(theta), points * np.sin(theta))
        across.append(curve(f"θ = {angle:g}°", r, q[1] / LIMIT, series=series))
    return Chart(
        name="fem_harmonics_shear",
        title="Shear at 0.6 µW by harmonics 0 … 8",
        caption=(
            "Above, shear along the load on the line y = 0 for ν = 0 and ν = 0.3 over the closed "
            "form in grey. Below, shear across the load along three rays for ν = 0.3: the closed "
            "form has none."
        ),
        rows=(
            (Panel(x_label="x / a", y_label="q_x / µp_H",
                   curves=(curve("closed form", x, known, Look.REFERENCE), *curves), height=2.0),),
            (Panel(x_label="r / a", y_label="q_y / µp_H", curves=tuple(across), height=1.4),),
        ),
    )  # fmt: skip
