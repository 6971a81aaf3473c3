"""Partial slip under a cone, by the superposition of Ciavarella and Jäger, ν = 0."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

import numpy as np

from contact_results.quantities import shear_of
from contact_scene import Cone
from verification.cases.cone_contact import EXACT as FULL
from verification.cases.cone_contact import MEAN_PRESSURE, SLOPE
from verification.closed_forms.ciavarella_jaeger import Superposition, superpose
from verification.closed_forms.cone import ConeContact
from verification.exhibits.chart import Chart
from verification.exhibits.profile_chart import Profile, ProfileLabels, Section, profile_chart
from verification.judging.case import Case, Derived, Level, Quantity, Required
from verification.judging.ladder import cells_label
from verification.judging.order_of_convergence import Followed, OrderOfConvergence
from verification.judging.refinement import part_of_a_cell, refinement
from verification.judging.run import Run
from verification.norms import shear_error
from verification.observed.end_state import shift, stick_radius
from verification.problems import paper_scene as paper
from verification.problems.paper_scene import FRICTION, NU_ZERO
from verification.problems.reference import closed_form, exact_zero

if TYPE_CHECKING:
    from semi_analytical import Result

SOURCE = "Ciavarella 1998; Jäger 1998, with Love's cone"
PARTS = (0.4, 0.8)
MODULUS_RATIO = 1.0  # E*/G* of two identical bodies with ν = 0
SCENE = paper.frictional(
    "Cone on a half-space, sheared, ν = 0",
    Cone(slope_angle=SLOPE, material=NU_ZERO),
    NU_ZERO,
    *(paper.tangential_step(part, increments=1) for part in PARTS),
)


def _exact(part: float) -> Superposition:
    return superpose(
        lambda load: ConeContact.under_load(load, SLOPE, paper.CONTACT_MODULUS),
        paper.NORMAL_FORCE, part * paper.FRICTION_LIMIT, FRICTION, MODULUS_RATIO,
    )  # fmt: skip


EXACT = {part: _exact(part) for part in PARTS}
SLIDING_SHIFT = FRICTION * MODULUS_RATIO * FULL.approach


def sheared_cone(level: Level = Level.QUICK) -> Case:
    """The case, on finer grids above the quick level."""
    return sheared_cone_on(refinement(32, 128 if level is Level.QUICK else 256))


def sheared_cone_on(cells: tuple[int, ...]) -> Case:
    """The case on square grids of these many cells per side."""
    half_width = paper.WINDOW_PER_RADIUS / 2 * FULL.contact_radius
    runs = tuple(Run(cells_label(n), SCENE, paper.square_grid(n, half_width)) for n in cells)
    levels = tuple(run.label for run in runs)
    return Case(
        name="sheared_cone",
        title="Partial slip under a cone",
        problem=(
            "The cone of cone_contact with ν = 0 and friction, sheared by 0.4 and 0.8 of µW. For "
            "any profile the shear is the difference of two pressures times µ; the stick radius is "
            "a √(1 - T/µW), not the cube root of a ball."
        ),
        runs=runs,
        quantities=tuple(
            quantity
            for step, part in enumerate(PARTS, 2)
            for quantity in _at(step, part, levels, cells[-1])
        ),
        orders=(
            OrderOfConvergence(
                "order_of_shear", Followed.SHEAR,
                "Σ|q - q_exact| / Σµp at 0.4 µW", levels, error_at(2, 0.4), 1.5,
                "square-root edges of stick zone and contact",
            ),
        ),
        charts=_charts,
    )  # fmt: skip


def error_at(step: int, part: float) -> Callable[[Result], float]:
    """Σ|q - q_exact| / Σµp at the end of a loading step."""

    def error(result: Result) -> float:
        end = result.steps[step - 1]
        exact = EXACT[part].shear(np.hypot(*result.grid.coordinates()))
        return shear_error(shear_of(end), exact, FRICTION * end.pressure)

    return error


def _at(step: int, part: float, levels: tuple[str, ...], finest_cells: int) -> tuple[Quantity, ...]:
    exact, finest = EXACT[part], levels[-1]
    exact_stick_radius = FULL.contact_radius * float(np.sqrt(1 - part))
    return (
        Quantity(
            f"shear_at_{part:g}", f"Σ|q - q_exact| / Σµp at {part:g} µW", "", finest,
            error_at(step, part), exact_zero(SOURCE),
            Required(4e-3, "twice what is required of the ball at 128 x 128: the apex is an "
                     "infinite peak that cells average"),
            1.0, "Σµp",
        ),
        Quantity(
            f"stick_radius_at_{part:g}", f"√(stick area / π) at {part:g} µW, in part cells", "m",
            finest, lambda result: stick_radius(result, step - 1),
            closed_form(exact_stick_radius, SOURCE, FULL.contact_radius),
            Derived(levels, 1.0, part_of_a_cell(0.2, finest_cells, paper.WINDOW_PER_RADIUS),
                    "order 1: the border is known to a part of a cell; the cap is a fifth of a "
                    "cell"),
            FULL.contact_radius, "the contact radius",
        ),
        Quantity(
            f"shift_at_{part:g}", f"tangential shift at {part:g} µW", "m", finest,
            lambda result: shift(result, step - 1), closed_form(exact.shift, SOURCE, SLIDING_SHIFT),
            Derived(levels, 2.0, 1e-4, "order 2 and cap as the approach of the frictionless cone, "
                    "of which the shift is a copy"),
            SLIDING_SHIFT, "the shift at gross sliding",
        ),
    )  # fmt: skip


def _charts(results: Mapping[str, Result]) -> tuple[Chart, ...]:
    finest = list(results.values())[-1]
    section = Section(finest.grid, FULL.contact_radius)
    scale = FRICTION * MEAN_PRESSURE
    profiles = [
        Profile(
            f"{part:g} µW",
            section.of(shear_of(finest.steps[number])[0]) / scale,
            EXACT[part].shear(section.r) / scale,
        )
        for number, part in enumerate(PARTS, 1)
    ]
    labels = ProfileLabels(
        "sheared_cone_profiles",
        "Shear next to y = 0",
        "Computed shear under the cone over the superposition of two pressures, in units of µ "
        "times the mean pressure, and their difference. The infinite peaks at the apex cancel.",
        "qₓ / (µ mean p)",
    )
    return (profile_chart(labels, section, profiles),)
