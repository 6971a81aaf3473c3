"""The paper's figure 4 by both solvers: a coated body, pressed and then sheared."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from contact_scene import FiniteElementDiscretisation
from verification.cases.apart_everywhere import Apart, apart_everywhere
from verification.cases.both_solvers.line import Line
from verification.cases.fem_harmonics_run import PointsRun
from verification.exhibits.chart import Chart, Look, Panel, curve
from verification.exhibits.table import Table
from verification.judging.case import Case, Comparison, Finding, Level
from verification.judging.ladder import cells_label
from verification.judging.run import Run
from verification.problems import paper_scene as paper
from verification.problems.layered_scene import coated, film, pressed, rigid_ball
from verification.problems.paper_scene import FRICTION, HERTZ
from verification.problems.reference import ReferenceKind
from verification.quantities import shift_along_x

if TYPE_CHECKING:
    import radial
    import semi_analytical
    from fem_reference import Result

Field = NDArray[np.float64]
Mask = NDArray[np.bool_]

PARTS = (0.0, 0.3, 0.6, 0.9)  # of µW, one loading step each
PRESSING, SHEARING = 20, 6  # increments of a step
RATIO = 2.0  # E1/E2
EDGE = 0.82  # contact radius over a_H, about
SCENE = pressed(
    f"Coated body under a rigid ball, sheared, E1/E2 = {RATIO:g} (paper, figure 4)",
    rigid_ball(),
    coated(film(RATIO, 1.0)),
    paper.pressing(PRESSING),
    *(paper.tangential_step(part, SHEARING) for part in PARTS[1:]),
    friction=FRICTION,
)
ASKED = "asked of two solvers that share nothing but the scene"
HAND = "set by hand: twice what both leave on the coarsest meshes here"
SOURCE = "the other solver, on the same increments"
THIRD = "the radial solver, on the same increments"


@dataclass(frozen=True)
class Sizes:
    """How fine both solvers are: cells per side, an odd number so that a row lies on y = 0."""

    cells: int
    elements: int
    harmonics: int

    @property
    def section(self) -> PointsRun:
        """The scene by finite elements."""
        mesh = FiniteElementDiscretisation(
            elements_per_radius=self.elements,
            contact_radius=EDGE * HERTZ.contact_radius,
            harmonics=self.harmonics,
        )
        name = f"{self.elements} elements per radius, harmonics 0 … {self.harmonics}"
        return PointsRun(name, SCENE, mesh)

    @property
    def surface(self) -> Run:
        """The scene on cells."""
        grid = paper.square_grid(self.cells, 1.16 * EDGE * HERTZ.contact_radius)
        return Run(cells_label(self.cells), SCENE, grid)


SIZES = {
    Level.QUICK: Sizes(65, 32, 8),
    Level.STANDARD: Sizes(129, 64, 12),
    Level.FULL: Sizes(257, 64, 16),
}


def cross_check_tangential(level: Level = Level.QUICK) -> Case:
    """The case, on finer discretisations at higher levels."""
    return cross_check_tangential_on(SIZES[level])


def cross_check_tangential_on(sizes: Sizes) -> Case:
    """The case at one fineness of both solvers."""
    section, surface = sizes.section, sizes.surface
    runs = section.label, surface.label
    fewer = Sizes(sizes.cells, sizes.elements, sizes.harmonics // 2).section
    return Case(
        name="cross_check_tangential",
        title="Both solvers on a sheared coated body",
        problem=(
            "The paper's ball, rigid, on a coating twice as stiff as its base and as thick as the "
            "Hertz radius: pressed by 1 kN in 20 increments, which leaves radial shear, and then "
            "sheared to 0.3, 0.6 and 0.9 of µW in 6 increments each. Finite elements with "
            "harmonics of the angle against cells with Fourier transforms, on the same "
            "increments; and the radial solver on rings and angles, a third that shares "
            "with the cells how layers answer one wavenumber, and with the elements nothing."
        ),
        runs=(section, fewer, surface),
        quantities=(),
        comparisons=(
            *(c for step, part in enumerate(PARTS, 1) for c in _at(step, part, runs)),
            *(c for step, part in enumerate(PARTS, 1) for c in _third(step, part, runs)),
            Comparison(
                "harmonics", f"shift at 0.9 µW by harmonics 0 … {sizes.harmonics // 2}, relative",
                (fewer.label, section.label), relative_shift(len(PARTS)), 6e-3,
                "set by hand: harmonics 0 … 4 leave 4e-3, more leave less", "the same solver",
            ),
        ),
        findings=tuple(
            Finding(
                f"stick_part_at_{part:g}", f"stick area over contact area at {part:g} µW", "", run,
                stick_part_at(step), "compared above",
            )
            for step, part in enumerate(PARTS, 1) for run in runs
        ),
        charts=lambda results: (_chart(results[section.label], results[surface.label]),),
        tables=lambda results: (
            _columns(results[section.label], results[surface.label]),
            _everywhere(results[section.label], results[surface.label]),
        ),
        limits=(
            "Compared away from the axis, from the edge, and from where stick begins or ends on "
            "the line: there both discretisations round a cusp, each in its way. Pressing ends "
            "with stick within 0.034 a_H, in 10 or 80 increments: two or three elements. The push "
            "makes all behind it stick at once, so that the cusp is kept there: it is left out, "
            "too, until slip passes over it.",
            "The increments are the same for both, so that their error is not seen.",
        ),
    )  # fmt: skip


def _at(step: int, part: float, runs: tuple[str, str]) -> tuple[Comparison, ...]:
    def compared(
        name: str,
        meaning: str,
        difference: Callable[[Result, semi_analytical.Result], float],
        allowed: float,
        because: str = ASKED,
    ) -> Comparison:
        return Comparison(
            f"{name}_at_{part:g}", f"{meaning} at {part:g} µW", runs, difference, allowed, because,
            SOURCE, ReferenceKind.OTHER_SOLVER,
        )  # fmt: skip

    comparisons = (
        compared(
            "shear", "largest difference of q_x on y = 0, over µp_H, away from axis, edge and "
            "borders of stick,",
            lambda fem, sam: float(np.max(Line(fem, sam, step).shear_difference)), 5e-2,
        ),
        compared(
            "mean_shear", "mean difference of q_x on y = 0, over µp_H",
            lambda fem, sam: float(np.mean(Line(fem, sam, step).shear_difference)), 5e-3, HAND,
        ),
        compared(
            "pressure", "largest difference of p on y = 0, over p_H",
            lambda fem, sam: float(np.max(Line(fem, sam, step).pressure_difference)), 1e-2,
        ),
        compared(
            "stick_area", "difference of the stick areas over the contact area",
            lambda fem, sam: abs(stick_part_at(step)(fem) - stick_part_at(step)(sam)), 3e-2,
        ),
        compared(
            "approach", "relative difference of the approach",
            lambda fem, sam: abs(fem.steps[step - 1].approach / sam.steps[step - 1].approach - 1),
            2e-4, HAND,
        ),
    )  # fmt: skip
    if part == 0:
        return comparisons
    shift = "relative difference of the shift"
    return (*comparisons, compared("shift", shift, relative_shift(step), 1e-3, HAND))


def _third(step: int, part: float, runs: tuple[str, str]) -> tuple[Comparison, ...]:
    """The radial solver beside the other two: its larger difference."""

    def compared(
        name: str, meaning: str, difference: Callable[[Any, Any], float], allowed: float
    ) -> Comparison:
        def larger(fem: Result, sam: semi_analytical.Result) -> float:
            return max(difference(_radial(), fem), difference(_radial(), sam))

        return Comparison(
            f"radial_{name}_at_{part:g}", f"{meaning} of the radial solver at {part:g} µW", runs,
            larger, allowed, HAND, THIRD, ReferenceKind.OTHER_SOLVER,
        )  # fmt: skip

    def approach(one: Any, other: Any) -> float:
        return float(abs(one.steps[step - 1].approach / other.steps[step - 1].approach - 1))

    def stick(one: Any, other: Any) -> float:
        return abs(stick_part_at(step)(one) - stick_part_at(step)(other))

    comparisons = (
        compared("approach", "relative difference of the approach", approach, 2e-4),
        compared("stick_area", "difference of the stick area over the contact area", stick, 3e-2),
    )
    if part == 0:
        return comparisons
    shift = "relative difference of the shift"
    return (*comparisons, compared("shift", shift, relative_shift(step), 1.5e-3))


@cache
def _radial() -> radial.Result:
    """The scene on rings and angles."""
    import radial

    return radial.solve(SCENE)


def _columns(fem: Result, sam: semi_analytical.Result) -> Table:
    """All three solvers beside one another."""
    solved: dict[str, Any] = {"cells": sam, "finite elements": fem, "radial": _radial()}
    rows = [
        (f"{part:g} µW", name, f"{end.approach * 1e6:.5f}", f"{shift_along_x(end) * 1e6:.5f}")
        for step, part in enumerate(PARTS)
        for name, end in ((name, result.steps[step]) for name, result in solved.items())
    ]
    return Table(
        title="Three solvers on the sheared coated body",
        columns=("T", "solver", "approach", "shift"),
        rows=tuple(rows),
        units={"approach": "µm", "shift": "µm"},
    )


def relative_shift(step: int) -> Callable[[Any, Any], float]:
    """Relative difference of the shifts of two results at the end of a step."""

    def difference(one: Any, other: Any) -> float:
        return float(
            abs(shift_along_x(one.steps[step - 1]) / shift_along_x(other.steps[step - 1]) - 1)
        )

    return difference


def stick_part_at(step: int) -> Callable[[Any], float]:
    """Stick area over contact area at the end of a step."""

    def stick_part(result: Any) -> float:
        end = result.steps[step - 1]
        return float((end.stick_radius or 0.0) ** 2 / end.contact_radius**2)

    return stick_part


def _everywhere(fem: Result, sam: semi_analytical.Result) -> Table:
    lines = [Line(fem, sam, step) for step in range(1, len(PARTS) + 1)]
    apart = [
        Apart(f"{part:g} µW", line.x / HERTZ.contact_radius, line.shear_apart, line.left_out)
        for part, line in zip(PARTS, lines, strict=True)
    ]
    return apart_everywhere(apart, "q_x on y = 0", "µp_H", "a_H")


def _chart(fem: Result, sam: semi_analytical.Result) -> Chart:
    lines = [Line(fem, sam, step) for step in range(1, len(PARTS) + 1)]
    x = sam.grid.x / HERTZ.contact_radius
    limit = FRICTION * HERTZ.peak_pressure
    above, below = [], []
    for series, (part, line) in enumerate(zip(PARTS, lines, strict=True)):
        ours, theirs = line.fem_tractions()[0] / limit, line.sam_tractions()[0] / limit
        above.append(curve("cells" if series == 0 else "", x, theirs, Look.REFERENCE))
        above.append(curve(f"{part:g} µW", x, ours, series=series))
        below.append(curve("", x, ours - theirs, series=series))
    return Chart(
        name="cross_check_tangential_shear",
        title="Shear on y = 0 by both solvers",
        caption=(
            "Shear along the load on the line y = 0 at four tangential forces, by finite elements "
            "in colour over that on cells in grey, and their difference: it sits where stick "
            "begins and at the edge."
        ),
        rows=(
            (Panel(x_label="", y_label="q_x / µp_H", curves=tuple(above), height=2.6),),
            (Panel(x_label="x / a_H", y_label="Δq_x / µp_H", curves=tuple(below)),),
        ),
    )
