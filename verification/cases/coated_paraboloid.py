"""The paper's coatings under a rigid paraboloid, without friction."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from verification.cases import hertz_point
from verification.cases.flat_punch import central_pressure
from verification.cases.hertz_point import ASKED, label
from verification.exhibits.chart import Chart
from verification.exhibits.convergence_chart import convergence_chart
from verification.exhibits.profile_chart import Profile, ProfileLabels, Section, profile_chart
from verification.judging.case import Case, Comparison, Derived, Level, Quantity, Required
from verification.judging.order_of_convergence import Followed, OrderOfConvergence
from verification.judging.refinement import part_of_a_cell, refinement
from verification.judging.run import Run
from verification.norms import relative_l2
from verification.observed.end_state import approach, contact_radius
from verification.problems import paper_scene as paper
from verification.problems.layered_scene import coated, exact_contact, film, pressed, rigid_ball
from verification.problems.paper_scene import HERTZ
from verification.problems.reference import Reference, ReferenceKind
from verification.references import load_reference

if TYPE_CHECKING:
    from semi_analytical import Result

Error = Callable[["Result"], float]
SOURCE = "references/coated_frictionless_paraboloid.json: Fredholm equation, two settings agree"
REQUIRED = {128: 2e-4, 256: 5e-5}  # by cells per side
COARSER = (32, 46, 64, 90)  # cells per side on which no figure is asked: for errors by fineness
BARE = "Rigid ball on the uncoated half-space"
STUDIED = 2.0  # E1/E2 of the row whose convergence is studied


@dataclass(frozen=True)
class Coating:
    """One row of the reference."""

    row: Mapping[str, Any]

    @property
    def name(self) -> str:
        """For labels: the ratio of Young's moduli."""
        return f"E1/E2 = {self.row['E1_over_E2']:g}"

    @property
    def contact_radius(self) -> float:
        """Reference contact radius [length]."""
        return float(self.row["a_over_aH"]) * HERTZ.contact_radius

    def run(self, cells: int) -> Run:
        """The contact on a window of three contact radii."""
        body = coated(film(self.row["E1_over_E2"], self.row["h_over_aH"]))
        title = f"Rigid ball on a coating, {self.name}, h = {self.row['h_over_aH']:g} a_H"
        half_width = paper.WINDOW_PER_RADIUS / 2 * self.contact_radius
        return Run(
            f"{self.name}, {label(cells)}",
            pressed(title, rigid_ball(), body),
            paper.square_grid(cells, half_width),
        )

    def reference(self, key: str, unit: float) -> Reference:
        """A number of the row, which is relative to the homogeneous substrate's."""
        value = float(self.row[key]) * unit
        return Reference(
            value, ReferenceKind.SEMI_CLOSED, SOURCE, self.row["est_rel_error"] * value
        )


COATINGS = tuple(map(Coating, load_reference("coated_frictionless_paraboloid")["rows"]))
STUDY = next(c for c in COATINGS if c.row["E1_over_E2"] == STUDIED)
EXACT = exact_contact(coated(film(STUDIED, STUDY.row["h_over_aH"])))


def pressure_error(result: Result) -> float:
    """Relative L2 error of the pressure of the studied coating."""
    r = np.hypot(*result.grid.coordinates())
    return relative_l2(result.steps[-1].pressure, EXACT.pressure(r))


def approach_error(result: Result) -> float:
    """Relative error of the approach."""
    return abs(approach(result) / EXACT.approach - 1)


def centre_error(result: Result) -> float:
    """Relative error of the pressure at the axis."""
    return abs(central_pressure(result) / float(EXACT.pressure(0.0)) - 1)


CONSTANTS: dict[str, tuple[str, Error, Error]] = {
    "approach": ("approach", approach_error, hertz_point.approach_error),
    "central_pressure": ("pressure around the axis", centre_error, hertz_point.peak_error),
    "pressure": ("pressure over the window, L2", pressure_error, hertz_point.pressure_error),
}


def coated_paraboloid(level: Level = Level.QUICK) -> Case:
    """The case, on finer grids at higher levels."""
    finest = {Level.QUICK: 256, Level.STANDARD: 512, Level.FULL: 1024}[level]
    return coated_paraboloid_on(refinement(32, finest), tuple(REQUIRED), COARSER)


def coated_paraboloid_on(
    cells: tuple[int, ...], required: tuple[int, ...], coarser: tuple[int, ...] = ()
) -> Case:
    """The case on square grids: these for the study, those for all coatings, the last unjudged."""
    study = tuple(STUDY.run(n) for n in cells)
    bare = tuple(
        Run(f"uncoated, {label(n)}", pressed(BARE, rigid_ball(), coated()), paper.hertz_grid(n))
        for n in cells
    )
    others = tuple(c.run(n) for c in COATINGS for n in (*coarser, *required) if c is not STUDY)
    levels = tuple(run.label for run in study)
    return Case(
        name="coated_paraboloid",
        title="Rigid ball on coated half-spaces",
        problem=(
            "A rigid paraboloid of the paper's radius under 1 kN on a coated half-space (210 GPa, "
            "ν = 0.3), coatings from a quarter to ten times as stiff, without friction, on windows "
            "of three contact radii. The references come from an axisymmetric integral equation "
            "that shares nothing with the surface grid. Under the stiffest coating the largest "
            "pressure is not at the centre; the centre's is compared."
        ),
        runs=(*study, *bare, *others),
        quantities=(
            *(q for c in COATINGS for n in required for q in _required(c, n) if n in REQUIRED),
            Quantity(
                "approach", "approach of the bodies since first touch", "m", levels[-1], approach,
                STUDY.reference("delta_over_deltaH", HERTZ.approach),
                Derived(levels, 2.0, 5e-5, "order 2 as for the homogeneous body; the cap is the "
                        "figure required at 256 x 256"),
            ),
            Quantity(
                "contact_radius", "√(contact area / π), cells at the edge counted in part", "m",
                levels[-1], contact_radius, STUDY.reference("a_over_aH", HERTZ.contact_radius),
                Derived(levels, 1.0, part_of_a_cell(0.1, cells[-1], paper.WINDOW_PER_RADIUS),
                        "order 1: the edge is known to a part of a cell; the cap is a tenth of "
                        "a cell"),
            ),
        ),
        orders=(
            OrderOfConvergence(
                "order_of_pressure", Followed.PRESSURE,
                "pressure over the window, L2", levels, pressure_error, 1.0,
                "as for the homogeneous body: the square-root edge",
            ),
            OrderOfConvergence(
                "order_of_approach", Followed.APPROACH,
                "approach", levels, approach_error, 2.0,
                "as for the homogeneous body: the errors at the edge cancel",
            ),
            OrderOfConvergence(
                "order_of_central_pressure", Followed.PEAK_PRESSURE,
                "pressure around the axis", levels, centre_error, 2.0,
                "as for the homogeneous body: the cells lie h/√2 from the axis",
            ),
        ),
        comparisons=tuple(
            Comparison(
                f"constant_of_{name}", f"{meaning}: error over that of the uncoated body, less 1",
                (levels[-1], bare[-1].label), _error_ratio(ours, hertz), 0.3,
                "the same scheme must have the same constant, up to what the shape of the "
                "pressure does to it", "errors on equal grids per contact radius",
            )
            for name, (meaning, ours, hertz) in CONSTANTS.items()
        ),
        charts=lambda results: _charts(
            [results[name] for name in levels], [results[run.label] for run in bare]
        ),
    )  # fmt: skip


def _error_ratio(coated_error: Error, bare_error: Error) -> Callable[[Result, Result], float]:
    return lambda result, bare: abs(coated_error(result) / bare_error(bare) - 1)


def _required(coating: Coating, cells: int) -> tuple[Quantity, Quantity]:
    run = coating.run(cells).label
    tolerance = Required(REQUIRED[cells], ASKED)
    return (
        Quantity(
            "required_approach", "approach of the bodies since first touch", "m", run, approach,
            coating.reference("delta_over_deltaH", HERTZ.approach), tolerance,
        ),
        Quantity(
            "central_pressure", "pressure of the four cells around the axis", "Pa", run,
            central_pressure, coating.reference("p0_over_pH", HERTZ.peak_pressure), tolerance,
        ),
    )  # fmt: skip


def _charts(runs: Sequence[Result], bare: Sequence[Result]) -> tuple[Chart, ...]:
    spacings = [run.grid.spacing[0] / EXACT.contact_radius for run in runs]
    errors: dict[str, list[float]] = {}
    for meaning, ours, hertz in CONSTANTS.values():
        errors[meaning] = [ours(run) for run in runs]
        errors[f"{meaning}, uncoated"] = [hertz(run) for run in bare]
    convergence = convergence_chart(
        "coated_convergence",
        "Convergence of the coated contact beside the uncoated one",
        "Relative errors against cell side, for the coating of E1/E2 = 2 and for the homogeneous "
        "body: the same orders and nearly the same constants, because the coefficients of the "
        "coated body are as exact as the closed form.",
        spacings,
        errors,
        {"pressure over the window, L2": 1.0, "approach": 2.0},
    )
    finest = runs[-1]
    section = Section(finest.grid, EXACT.contact_radius)
    unit = HERTZ.peak_pressure
    profile = Profile(
        "computed",
        section.of(finest.steps[-1].pressure) / unit,
        EXACT.pressure(section.r) / unit,
    )
    labels = ProfileLabels(
        "coated_profile",
        "Pressure next to y = 0 under a coating of E1/E2 = 2",
        f"Computed pressure on {finest.grid.cells[0]} x {finest.grid.cells[1]} cells over the "
        "semi-closed one, and their difference, in units of the peak pressure without coating.",
        "p / p_H",
    )
    return (profile_chart(labels, section, [profile]), convergence)
