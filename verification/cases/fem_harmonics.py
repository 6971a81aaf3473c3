"""Tangential loading by many harmonics with Coulomb's law at points, where closed forms know it."""

from __future__ import annotations

from typing import TYPE_CHECKING

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
from fem_reference.contact.harmonics.surface_tractions import tractions_at
from verification.cases.cattaneo_mindlin import CATTANEO, PARTS
from verification.cases.fem_harmonics_run import PointsRun
from verification.cases.fem_levels import allowed, because, finest, label
from verification.exhibits.chart import Chart, Look, Panel, curve
from verification.judging.case import Case, Finding, Level, Quantity, Required
from verification.judging.run import per_radius
from verification.problems import paper_scene as paper
from verification.problems.paper_scene import FRICTION, HERTZ, STEEL
from verification.problems.reference import closed_form, exact_zero
from verification.problems.sheared import SLIDING_SHIFT, SOURCE

if TYPE_CHECKING:
    from fem_reference import Increment, Result

Field = NDArray[np.float64]

LIMIT = FRICTION * HERTZ.peak_pressure
ALIKE = paper.frictional(
    "Two alike bodies of steel, sheared",
    paper.paraboloid(STEEL),
    STEEL,
    *(paper.tangential_step(part, increments=1) for part in PARTS),
)
EXACT = dict(zip(PARTS, CATTANEO.ends[1:], strict=True))
MINDLIN = {part: paper.partial_slip(STEEL, part * paper.FRICTION_LIMIT) for part in PARTS}

# Incompressible, so that pressing leaves no shear; it sticks all over.
RUBBER = IsotropicMaterial(young_modulus=3e6, poisson_ratio=0.5)
PUNCH, PUNCH_FORCE = 5e-3, 10.0
BONDED = Scene(
    title="Disc that sticks to an incompressible body, sheared",
    indenter=FlatPunch(radius=PUNCH, material=RIGID),
    body=Body(material=RUBBER),
    friction=CoulombFriction(coefficient=100.0),
    loading=(
        LoadStep(normal_force=PUNCH_FORCE, increments=1),
        LoadStep(tangential_force=(PUNCH_FORCE, 0.0), increments=1),
    ),
)
BONDED_SHIFT = (2 - 0.5) * PUNCH_FORCE / (8 * RUBBER.shear_modulus * PUNCH)

# At 64 elements per radius, and the order with which they fall: cusps at stick edges, and the
# infinite shear at the rim of the disc.
ASKED = {"shift": 3e-4, "shear": 6e-3, "across": 3e-3, "disc": 5e-4}
CUSP, RIM = 1.5, 1.0


def fem_harmonics(level: Level = Level.QUICK) -> Case:
    """The case, on finer meshes at higher levels."""
    return fem_harmonics_on(min(finest(level), 64))


def fem_harmonics_on(elements: int) -> Case:
    """The case on meshes of so many elements per contact radius."""
    mesh = per_radius(elements, 0.99 * HERTZ.contact_radius)
    exact = PointsRun(f"ν = 0, {label(elements)}", CATTANEO.scene, mesh)
    alike = PointsRun(f"ν = 0.3, {label(elements)}", ALIKE, mesh)
    disc = PointsRun(f"disc, {label(elements)}", BONDED, per_radius(elements, PUNCH))
    return Case(
        name="fem_harmonics",
        title="Finite elements: many harmonics",
        problem=(
            "Cattaneo and Mindlin's contact by harmonics 0 … 8 of the section, with Coulomb's law "
            "as a vector law at points of (r, θ): for ν = 0, where the closed form is exact, and "
            "for ν = 0.3, where it neglects slip across the load. Nothing couples here, so that "
            "one increment leads to each force. And a disc that sticks all over."
        ),
        runs=(exact, alike, disc),
        quantities=(
            *(
                quantity
                for step, part in enumerate(PARTS, 2)
                for quantity in _at(step, part, exact.label, elements)
            ),
            Quantity(
                "shift_of_disc", "tangential shift of the disc that sticks all over", "m",
                disc.label, lambda result: shift_at(result, -1),
                closed_form(BONDED_SHIFT, "Mindlin 1949: (2 - ν) T / 8 G a"),
                Required(allowed(ASKED["disc"], elements, RIM), because(RIM)),
            ),
        ),
        findings=tuple(
            finding
            for step, part in enumerate(PARTS, 2)
            for finding in _mindlin(step, part, alike.label)
        ),
        charts=lambda results: (_chart(results[exact.label], results[alike.label]),),
        limits=(
            "The stick zone is known to an element in radius and, between the angles of the "
            "points, to sectors of 22.5°.",
        ),
    )  # fmt: skip


def _at(step: int, part: float, run: str, elements: int) -> tuple[Quantity, ...]:
    exact = EXACT[part]

    def stick_radius(result: Result) -> float:
        return float(result.steps[step - 1].stick_radius or 0.0)

    def shear_error(result: Result) -> float:
        end = result.steps[step - 1]
        q_x, q_y = shear_at_points(end)
        off = np.hypot(q_x - exact.shear(end.radii)[:, None], q_y)
        return _integral(end, off) / paper.FRICTION_LIMIT

    return (
        Quantity(
            f"shift_at_{part:g}", f"tangential shift at {part:g} µW", "m", run,
            lambda result: shift_at(result, step - 1),
            closed_form(exact.shift, SOURCE, SLIDING_SHIFT),
            Required(allowed(ASKED["shift"], elements, CUSP), because(CUSP)), SLIDING_SHIFT,
            "the shift at gross sliding", "shift", part,
        ),
        Quantity(
            f"shear_at_{part:g}", f"∫|q - q_exact| dA / µW at {part:g} µW", "", run, shear_error,
            exact_zero(SOURCE), Required(allowed(ASKED["shear"], elements, CUSP), because(CUSP)),
            1.0, "µW",
        ),
        Quantity(
            f"shear_across_at_{part:g}", f"largest |q_y| / µp_H at {part:g} µW", "", run,
            lambda result: shear_across(result.steps[step - 1]), exact_zero(SOURCE),
            Required(allowed(ASKED["across"], elements, 1.0), because(1.0)), 1.0, "µp_H",
        ),
        Quantity(
            f"stick_radius_at_{part:g}", f"√(stick area / π) at {part:g} µW", "m", run,
            stick_radius, closed_form(exact.stick_radius, SOURCE, HERTZ.contact_radius),
            Required(1 / elements, "an element: stick or slip is known ring by ring"),
            HERTZ.contact_radius, "the contact radius", "stick_radius", part,
        ),
    )  # fmt: skip


def _mindlin(step: int, part: float, run: str) -> tuple[Finding, ...]:
    return (
        Finding(
            f"shear_across_at_{part:g}", f"largest |q_y| / µp_H at {part:g} µW, ν = 0.3", "", run,
            lambda result: shear_across(result.steps[step - 1]),
            "zero in the closed form, which neglects slip across the load",
        ),
        Finding(
            f"shift_over_mindlin_at_{part:g}",
            f"shift at {part:g} µW over Mindlin's, less one, ν = 0.3", "", run,
            lambda result: shift_at(result, step - 1) / MINDLIN[part].shift - 1,
            "the vector law makes the contact stiffer by parts of a per mille",
        ),
    )  # fmt: skip


def shift_at(result: Result, step: int) -> float:
    """Tangential shift along x at the end of a step, counted from 0 [length]."""
    shift = result.steps[step].tangential_shift
    return 0.0 if shift is None else shift[0]


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
    part, step = 0.6, PARTS.index(0.6) + 2
    x = np.linspace(-1.1, 1.1, 221)
    curves = []
    for series, (name, result) in enumerate((("ν = 0", exact), ("ν = 0.3", alike))):
        q, _ = tractions_at(result.steps[step - 1], x * HERTZ.contact_radius, 0 * x)
        curves.append(curve(name, x, q[0] / LIMIT, series=series))
    known = EXACT[part].shear(np.abs(x) * HERTZ.contact_radius) / LIMIT
    across = []
    for series, angle in enumerate((22.5, 45.0, 67.5)):
        r, theta = np.linspace(0, 1.1, 111), np.radians(angle)
        points = HERTZ.contact_radius * r
        q, _ = tractions_at(alike.steps[step - 1], points * np.cos(theta), points * np.sin(theta))
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
