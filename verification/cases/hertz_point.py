"""Hertz point contact of the paper's ball, as a paraboloid."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from contact_scene import LoadStep
from verification.exhibits.chart import Chart
from verification.exhibits.convergence_chart import convergence_chart
from verification.exhibits.profile_chart import Profile, ProfileLabels, Section, profile_chart
from verification.judging.case import Case, Derived, Level, Quantity, Required
from verification.judging.order_of_convergence import Followed, NotYetAsymptotic, OrderOfConvergence
from verification.judging.refinement import part_of_a_cell, refinement
from verification.judging.run import Run
from verification.norms import relative_l2
from verification.observed.end_state import approach, contact_radius, peak_pressure
from verification.problems import paper_scene as paper
from verification.problems.paper_scene import HERTZ
from verification.problems.reference import closed_form

if TYPE_CHECKING:
    from semi_analytical import Result
    from verification.observed.end_state import Result as EitherResult

SOURCE = "Hertz 1882; Johnson 1985, ch. 4"
ASKED = "required of this scene by the project's accuracy targets"
COARSE = NotYetAsymptotic(
    0.15, "a second term counts on coarse grids: 1.12 up to 256 cells, 1.08 up to 512"
)
REQUIRED_PEAK = {128: 1.5e-4, 256: 4e-5}  # by cells per side
SCENE = paper.frictionless(
    "Ball on a half-space (paper's data, paraboloid)",
    paper.paraboloid(paper.STEEL),
    paper.STEEL,
    LoadStep(normal_force=paper.NORMAL_FORCE),
)


def hertz_point(level: Level = Level.QUICK) -> Case:
    """The case, on finer grids at higher levels."""
    finest = {Level.QUICK: 256, Level.STANDARD: 512, Level.FULL: 1024}[level]
    return hertz_on(refinement(32, finest))


def hertz_on(cells: tuple[int, ...]) -> Case:
    """The case on square grids of these many cells per side; required figures at 128 and 256."""
    runs = tuple(Run(label(n), SCENE, paper.hertz_grid(n)) for n in cells)
    levels = tuple(run.label for run in runs)
    return Case(
        name="hertz_point",
        title="Hertz point contact",
        problem=(
            "The paper's ball (R = 18 mm, 420 GPa, ν = 0.3) on a half-space of the same material "
            "under 1 kN, without friction, on a window of three contact radii. As a paraboloid it "
            "is Hertz's problem exactly."
        ),
        runs=runs,
        quantities=(
            *(_peak_pressure(n, allowed) for n, allowed in REQUIRED_PEAK.items() if n in cells),
            *(_approach(n) for n in REQUIRED_PEAK if n in cells),
            Quantity(
                "approach", "approach of the bodies since first touch", "m", levels[-1], approach,
                closed_form(HERTZ.approach, SOURCE),
                Derived(levels, 2.0, 5e-5, "order 2: the pressure's error has zero mean; the cap "
                        "is the figure required of the coarser grids"),
            ),
            Quantity(
                "contact_radius", "√(contact area / π), cells at the edge counted in part", "m",
                levels[-1], contact_radius, closed_form(HERTZ.contact_radius, SOURCE),
                Derived(levels, 1.0, part_of_a_cell(0.1, cells[-1], paper.WINDOW_PER_RADIUS),
                        "order 1: the edge is known to a part of a cell; the cap is a tenth of "
                        "a cell"),
            ),
        ),
        orders=(
            OrderOfConvergence(
                "order_of_pressure", Followed.PRESSURE,
                "pressure over the window, L2", levels, pressure_error, 1.0,
                "at the edge the pressure rises as a square root: an error of O(√h) on a ring one "
                "cell wide leaves O(h) in L2",
            ),
            OrderOfConvergence(
                "order_of_approach", Followed.APPROACH,
                "approach", levels, approach_error, 2.0,
                "a weighted mean of the displacement: the errors at the edge alternate and cancel",
            ),
            OrderOfConvergence(
                "order_of_peak_pressure", Followed.PEAK_PRESSURE,
                "largest pressure of any cell", levels, peak_error, 2.0,
                "even counts of cells put the centre h/√2 from the next cell centre, where the "
                "exact pressure is lower by p0 h²/4a²",
            ),
            OrderOfConvergence(
                "order_of_contact_radius", Followed.CONTACT_RADIUS,
                "contact radius", levels, radius_error, 1.0,
                "pressures that are constant on cells, matched at their centres, let the contact "
                "reach too far by the same part of a cell, 0.06, on every grid",
                COARSE,
            ),
        ),
        charts=_charts,
        limits=(
            "Pointwise errors at the edge fall as O(√h) only and are not judged.",
        ),
    )  # fmt: skip


def label(cells: int) -> str:
    """Label of a run on a square grid."""
    return f"{cells}x{cells}"


def pressure_error(result: Result) -> float:
    """Relative L2 error of the pressure."""
    x, y = result.grid.coordinates()
    r = (x**2 + y**2) ** 0.5
    return relative_l2(result.steps[-1].pressure, HERTZ.pressure(r))


def approach_error(result: EitherResult) -> float:
    """Relative error of the approach."""
    return abs(approach(result) / HERTZ.approach - 1)


def peak_error(result: EitherResult) -> float:
    """Relative error of the peak pressure."""
    return abs(peak_pressure(result) / HERTZ.peak_pressure - 1)


def radius_error(result: EitherResult) -> float:
    """Relative error of the contact radius."""
    return abs(contact_radius(result) / HERTZ.contact_radius - 1)


def _peak_pressure(cells: int, allowed: float) -> Quantity:
    return Quantity(
        "peak_pressure", "largest pressure of any cell", "Pa", label(cells), peak_pressure,
        closed_form(HERTZ.peak_pressure, SOURCE), Required(allowed, ASKED),
    )  # fmt: skip


def _approach(cells: int) -> Quantity:
    return Quantity(
        "required_approach", "approach of the bodies since first touch", "m", label(cells),
        approach,
        closed_form(HERTZ.approach, SOURCE), Required(5e-5, ASKED),
    )  # fmt: skip


def _charts(results: Mapping[str, Result]) -> tuple[Chart, ...]:
    runs = list(results.values())
    spacings = [run.grid.spacing[0] / HERTZ.contact_radius for run in runs]
    errors = {
        "pressure (L2)": [pressure_error(run) for run in runs],
        "peak pressure": [peak_error(run) for run in runs],
        "approach": [approach_error(run) for run in runs],
        "contact radius": [radius_error(run) for run in runs],
    }
    convergence = convergence_chart(
        "hertz_convergence",
        "Convergence of the Hertz contact",
        "Relative errors against cell side. The pressure falls with the first power of h because "
        "of the square-root edge; approach and peak pressure fall with the second.",
        spacings,
        errors,
        {"pressure (L2)": 1.0, "peak pressure": 2.0, "approach": 2.0, "contact radius": 1.0},
    )
    finest = runs[-1]
    section = Section(finest.grid, HERTZ.contact_radius)
    profile = Profile(
        "computed",
        section.of(finest.steps[-1].pressure) / HERTZ.peak_pressure,
        HERTZ.pressure(section.r) / HERTZ.peak_pressure,
    )
    labels = ProfileLabels(
        "hertz_profile",
        "Pressure next to y = 0",
        f"Computed pressure on {finest.grid.cells[0]} x {finest.grid.cells[1]} cells over Hertz's, "
        "and their difference: it is confined to the cells at the edge of the contact.",
        "p / p₀",
    )
    return (profile_chart(labels, section, [profile]), convergence)
