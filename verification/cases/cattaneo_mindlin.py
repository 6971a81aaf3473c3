"""Cattaneo-Mindlin: constant normal force, tangential force raised step by step, ν = 0."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from contact_results.quantities import shear_of
from verification.cases.stopped_shearing import StoppedShearing
from verification.exhibits.chart import Chart
from verification.exhibits.convergence_chart import convergence_chart
from verification.exhibits.profile_chart import Profile, ProfileLabels, Section, profile_chart
from verification.judging.case import Case, Derived, Level, Quantity, Required
from verification.judging.ladder import cells_label
from verification.judging.order_of_convergence import Followed, OrderOfConvergence
from verification.judging.refinement import part_of_a_cell, refinement
from verification.judging.run import Run
from verification.norms import shear_error
from verification.observed.end_state import shift, stick_radius
from verification.problems import paper_scene as paper
from verification.problems.paper_scene import FRICTION, HERTZ, NU_ZERO
from verification.problems.reference import closed_form, exact_zero
from verification.problems.shifted_grid import ShiftedGrid

if TYPE_CHECKING:
    from semi_analytical import Result

SOURCE = "Cattaneo 1938; Mindlin 1949"
PARTS = (0.3, 0.6, 0.9, 0.99)  # of µW, one loading step each
LOOPED = 0.9  # of µW, the amplitude of the fretting loop
EXACT = {part: paper.partial_slip(NU_ZERO, part * paper.FRICTION_LIMIT) for part in PARTS}
SLIDING_SHIFT = EXACT[PARTS[0]].sliding_shift
SHEARING = StoppedShearing(NU_ZERO, PARTS)
# Where the contact's axis is in a cell, in its sides; the symmetries of a square make others equal.
OFFSETS = ((0.0, 0.0), (0.5, 0.5), (0.5, 0.0), (0.25, 0.25), (0.1, 0.35), (0.4, 0.15))
SCENE = paper.frictional(
    "Cattaneo-Mindlin, ν = 0",
    paper.paraboloid(NU_ZERO),
    NU_ZERO,
    *(paper.tangential_step(part, increments=1) for part in PARTS),
)


def cattaneo_mindlin(level: Level = Level.QUICK) -> Case:
    """The case, on finer grids at higher levels, and on shifted ones above the quick one."""
    finest = {Level.QUICK: 128, Level.STANDARD: 256, Level.FULL: 512}[level]
    shifted = () if level is Level.QUICK else refinement(32, 256)
    return cattaneo_mindlin_on(refinement(32, finest), shifted)


def cattaneo_mindlin_on(cells: tuple[int, ...], shifted: tuple[int, ...] = ()) -> Case:
    """The case on square grids of these many cells per side.

    shifted  cells per side of grids that fall on the contact in other ways too
    """
    runs = tuple(Run(cells_label(n), SCENE, paper.hertz_grid(n)) for n in cells)
    levels = tuple(run.label for run in runs)
    others = tuple(_shifted(n, offset) for n in shifted for offset in OFFSETS)
    return Case(
        name="cattaneo_mindlin",
        title="Cattaneo-Mindlin partial slip",
        problem=(
            "The paper's contact with ν = 0 and the same E*, under 1 kN, sheared by 0.3, 0.6, 0.9 "
            "and 0.99 of µW. Only for ν = 0 does the slip of the closed form oppose its traction "
            "everywhere, so only there is it the exact answer to Coulomb's vector law."
        ),
        runs=(*runs, *others),
        quantities=(
            *(
                quantity
                for number, part in enumerate(PARTS, 2)
                for quantity in _at(number, part, levels, cells[-1])
            ),
            _energy(levels[-1]),
        ),
        orders=(
            OrderOfConvergence(
                "order_of_shear", Followed.SHEAR,
                "Σ|q - q_exact| / Σµp at 0.9 µW", levels,
                error_at(PARTS.index(0.9) + 2, 0.9), 1.5,
                "square-root edges of stick zone and contact: an error of O(√h) on rings one cell "
                "wide leaves O(h^3/2) in L1",
            ),
            *(_orders_of_means(tuple(run.label for run in others)) if others else ()),
        ),
        charts=lambda results: _charts(
            [results[name] for name in levels], [results[run.label] for run in others]
        ),
    )  # fmt: skip


def _shifted(cells: int, offset: tuple[float, float]) -> Run:
    grid = paper.hertz_grid(cells)
    name = f"{cells_label(cells)}, shifted by ({offset[0]:g}, {offset[1]:g}) cells"
    return Run(name, SCENE, ShiftedGrid(grid.cells, grid.window, offset))


def _orders_of_means(levels: tuple[str, ...]) -> tuple[OrderOfConvergence, ...]:
    return SHEARING.orders(
        levels, 2.5,
        "the shift is the difference of two approaches, of the contact and of the stick zone "
        "(Cattaneo), and both are wrong by the same 0.04 h²/R; what is left depends on how "
        "circles cut the cells, O(h^5/2)",
        "what the area below the curve of approach over load differs from its trapezium: a "
        "constant error of the approach cancels, and what is left depends on how circles cut "
        "the cells, O(h^5/2)",
    )  # fmt: skip


def error_at(step: int, part: float) -> Callable[[Result], float]:
    """Σ|q - q_exact| / Σµp at the end of a loading step."""

    def error(result: Result) -> float:
        end = result.steps[step - 1]
        exact = EXACT[part].shear(np.hypot(*result.grid.coordinates()))
        return shear_error(shear_of(end), exact, FRICTION * end.pressure)

    return error


def slip_error_at(step: int, part: float) -> Callable[[Result], float]:
    """Mean of |s - s_exact| over the contact at the end of a loading step, both components
    [length]."""

    def error(result: Result) -> float:
        end = result.steps[step - 1]
        assert end.slip is not None
        exact = EXACT[part].slip(np.hypot(*result.grid.coordinates()))
        missed = np.hypot(end.slip[0] - exact, end.slip[1])
        return float(np.mean(missed[end.in_contact]))

    return error


def _at(step: int, part: float, levels: tuple[str, ...], finest_cells: int) -> tuple[Quantity, ...]:
    exact, finest = EXACT[part], levels[-1]
    return (
        Quantity(
            f"shear_at_{part:g}", f"Σ|q - q_exact| / Σµp at {part:g} µW", "", finest,
            error_at(step, part), exact_zero(SOURCE),
            Required(2e-3, "required of the fretting loop at 128 x 128, which passes through here"),
            1.0, "Σµp",
        ),
        Quantity(
            f"stick_radius_at_{part:g}", f"√(stick area / π) at {part:g} µW, in part cells", "m",
            finest, lambda result: stick_radius(result, step - 1),
            closed_form(exact.stick_radius, SOURCE, HERTZ.contact_radius),
            Derived(levels, 1.0, part_of_a_cell(0.2, finest_cells, paper.WINDOW_PER_RADIUS),
                    "order 1: the border is known to a part of a cell; the cap is a fifth of a "
                    "cell"),
            HERTZ.contact_radius, "the contact radius",
        ),
        Quantity(
            f"shift_at_{part:g}", f"tangential shift at {part:g} µW", "m", finest,
            lambda result: shift(result, step - 1), closed_form(exact.shift, SOURCE, SLIDING_SHIFT),
            Required(1e-4, "required of the fretting loop, which passes through here"),
            SLIDING_SHIFT, "the shift at gross sliding",
        ),
        Quantity(
            f"slip_at_{part:g}", f"mean difference of the slip in the contact at {part:g} µW", "m",
            finest, slip_error_at(step, part), exact_zero(SOURCE),
            Derived(levels, 1.5, 1e-4, "order 3/2 of the shear's L1 error; the cap is what is "
                    "required of the shift, of which slip is a part"),
            SLIDING_SHIFT, "the shift at gross sliding",
        ),
    )  # fmt: skip


def _energy(run: str) -> Quantity:
    step = PARTS.index(LOOPED) + 1
    return Quantity(
        f"energy_at_{LOOPED:g}", f"energy dissipated up to {LOOPED:g} µW", "J", run,
        lambda result: float(result.steps[step].dissipated_energy or 0.0),
        closed_form(SHEARING.stops[step - 1].dissipated_energy, "Mindlin and Deresiewicz 1953"),
        Required(5e-4, "required of the energy per cycle of the fretting loop, which is four times "
                 "as much"),
    )  # fmt: skip


def _charts(runs: list[Result], shifted: list[Result]) -> tuple[Chart, ...]:
    finest = runs[-1]
    section = Section(finest.grid, HERTZ.contact_radius)
    scale = FRICTION * HERTZ.peak_pressure
    profiles = [
        Profile(
            f"{part:g} µW",
            section.of(shear_of(finest.steps[number])[0]) / scale,
            EXACT[part].shear(section.r) / scale,
        )
        for number, part in enumerate(PARTS, 1)
    ]
    labels = ProfileLabels(
        "cattaneo_profiles",
        "Shear next to y = 0",
        f"Computed shear on {finest.grid.cells[0]} x {finest.grid.cells[1]} cells at four "
        "tangential forces over the closed form, and their difference: it sits at the border of "
        "the stick zone and at the edge of the contact.",
        "qₓ / µp₀",
    )
    convergence = convergence_chart(
        "cattaneo_convergence",
        "Convergence of the shear",
        "Σ|q - q_exact| / Σµp against cell side for four tangential forces, with a line of the "
        "expected slope 3/2.",
        [run.grid.spacing[0] / HERTZ.contact_radius for run in runs],
        {
            f"{part:g} µW": [error_at(step, part)(run) for run in runs]
            for step, part in enumerate(PARTS, 2)
        },
        {"0.9 µW": 1.5},
    )
    charts = (profile_chart(labels, section, profiles), convergence)
    return (*charts, _convergence_of_means(shifted)) if shifted else charts


def _convergence_of_means(runs: list[Result]) -> Chart:
    return convergence_chart(
        "cattaneo_convergence_of_means",
        "Convergence of shift and dissipated energy",
        "Errors at all four tangential forces on grids that fall on the contact in several ways, "
        "root mean square: single ones change their sign.",
        [run.grid.spacing[0] / HERTZ.contact_radius for run in runs],
        {
            "tangential shift": [SHEARING.shift_error(run) for run in runs],
            "dissipated energy": [SHEARING.energy_error(run) for run in runs],
        },
        {"tangential shift": 2.5, "dissipated energy": 2.5},
    )
