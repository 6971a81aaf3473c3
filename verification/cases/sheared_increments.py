"""Pressing and shearing a contact that is coupled, cut into more and more increments."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from contact_scene import LoadStep
from verification.cases.indentation_refinement import ONE
from verification.exhibits.chart import Chart
from verification.exhibits.convergence_chart import convergence_chart
from verification.judging.case import Case, Comparison, Level
from verification.judging.order_of_convergence import Followed, OrderOfChange, Refinement
from verification.judging.run import Run
from verification.observed.changes import approach_change
from verification.problems import paper_scene as paper
from verification.problems.reference import ReferenceKind
from verification.quantities import shear_of, shift_along_x

if TYPE_CHECKING:
    from semi_analytical import Result

CELLS = 48
INCREMENTS = {
    Level.QUICK: (4, 8),
    Level.STANDARD: (4, 8, 16, 32, 64),
    Level.FULL: (4, 8, 16, 32, 64, 128, 256),
}
PART = 0.5  # of µW
BACKWARD = (
    "slip turns and the friction limit moves while an increment takes both as they are at its end: "
    "Euler's backward rule"
)


def sheared_increments(level: Level = Level.QUICK) -> Case:
    """The case; orders above the quick level."""
    return sheared_increments_on(INCREMENTS[level])


def sheared_increments_on(increments: tuple[int, ...]) -> Case:
    """The case with these increments per step; orders where there are five or more."""
    runs = tuple(_run(count) for count in increments)
    labels = tuple(run.label for run in runs)
    return Case(
        name="sheared_increments",
        title="Shearing a coupled contact in smaller increments",
        problem=(
            "The rigid ball of indentation_refinement pressed on the body of ν = 0, with friction "
            f"of {ONE.friction:.2f}, and sheared by {PART:g} µW. Shear and pressure act on each "
            "other, slip turns from outward to along the load: the path decides, and nobody knows "
            "the exact answer. Each doubling of the increments changes it less."
        ),
        runs=runs,
        quantities=(),
        comparisons=(
            Comparison(
                "shift", f"change of the shift from {increments[-2]} to {increments[-1]} "
                "increments", (labels[-2], labels[-1]), shift_change, 2e-2 * 4 / increments[-2],
                "2 % from 4 to 8 increments, and half by each further doubling: first order",
                "the same solver with half as many increments", ReferenceKind.OWN_REFINEMENT,
            ),
        ),
        orders=_orders(labels) if len(labels) >= 5 else (),
        charts=lambda results: _charts([results[label] for label in labels]),
        limits=(
            "Contact and stick radius move by parts of a cell from path to path: no order.",
            "The energy lost has no one order: neighbouring changes give 1.58, 1.61, 2.17, 1.67 "
            "and 2.03 on 4 to 256 increments.",
            "Changes of the approach give 0.82 on the three coarsest levels and rise to 0.99: the "
            "coarsest is left out of its order.",
        ),
    )  # fmt: skip


def _orders(labels: tuple[str, ...]) -> tuple[OrderOfChange, ...]:
    return tuple(
        OrderOfChange(
            f"order_of_{name}", of, Refinement.INCREMENTS, meaning, levels, change, increment_size,
            1.0, because,
        )
        for name, of, meaning, change, because, levels in (
            ("shift", Followed.SHIFT, "tangential shift", shift_change, BACKWARD, labels),
            ("shear", Followed.SHEAR, "shear (L1)", shear_change, BACKWARD, labels),
            ("approach", Followed.APPROACH, "approach", approach_change, BACKWARD, labels[1:]),
        )
    )  # fmt: skip


def shift_change(coarse: Result, fine: Result) -> float:
    """Change of the tangential shift relative to the finer path."""
    return abs(shift_along_x(coarse.steps[-1]) / shift_along_x(fine.steps[-1]) - 1)


def shear_change(coarse: Result, fine: Result) -> float:
    """Σ|q_coarse - q_fine| / Σµp."""
    difference = np.hypot(*(shear_of(coarse.steps[-1]) - shear_of(fine.steps[-1])))
    return float(np.sum(difference) / np.sum(ONE.friction * fine.steps[-1].pressure))


def increment_size(result: Result) -> float:
    """Part of a step that an increment takes."""
    return len(result.steps) / len(result.increments)


def _run(increments: int) -> Run:
    force = PART * ONE.friction * paper.NORMAL_FORCE
    loading = (
        paper.pressing(increments),
        LoadStep(tangential_force=(force, 0.0), increments=increments),
    )
    scene = ONE.problem(increments).scene.model_copy(update={"loading": loading})
    grid = paper.square_grid(CELLS, paper.WINDOW_PER_RADIUS / 2 * ONE.contact_radius)
    return Run(f"{increments} increments", scene, grid)


def _charts(results: list[Result]) -> tuple[Chart, ...]:
    def changes(change: Callable[[Result, Result], float]) -> list[float]:
        return [change(one, other) for one, other in pairwise(results)]

    if len(results) < 5:
        return ()
    errors: Mapping[str, list[float]] = {
        "tangential shift": changes(shift_change),
        "shear (L1)": changes(shear_change),
        "approach": changes(approach_change),
    }
    return (
        convergence_chart(
            "sheared_increments",
            "Smaller increments under a tangential force",
            f"Change by twice the increments on {CELLS} x {CELLS} cells. Lines go through the "
            "levels that are judged; others are points alone.",
            [increment_size(level) for level in results[:-1]],
            errors,
            {"tangential shift": 1.0},
            "1 / increments of a step",
            {"approach": len(results) - 2},
        ),
    )
