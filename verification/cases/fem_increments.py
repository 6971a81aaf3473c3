"""Finite elements: pressing with friction, cut into more and more increments."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from contact_scene import LoadStep
from verification.cases import paper_scene as paper
from verification.cases.case import Case, Level, OrderOfChange
from verification.cases.chart import Chart
from verification.cases.convergence_chart import convergence_chart
from verification.cases.end_state import approach
from verification.cases.fem_profiles import at_radii
from verification.cases.indentation_reference import FEW
from verification.cases.indentation_refinement import ONE
from verification.cases.section_run import SectionRun, per_radius

if TYPE_CHECKING:
    from fem_reference import Result

# The stick edge has to pass several elements in every increment: it moves from node to node.
ELEMENTS = 128
INCREMENTS = (2, 4, 8, 16, 32)
APPROACH, SHEAR = "approach", "shear (L1)"
EXPECTED = {APPROACH: 2.0, SHEAR: 1.5}


def fem_increments(level: Level = Level.QUICK) -> Case:
    """The case, the same at every level."""
    runs = tuple(_run(count) for count in INCREMENTS)
    labels = tuple(run.label for run in runs)

    def charts(results: Mapping[str, Result]) -> tuple[Chart, ...]:
        return (_chart([results[label] for label in labels]),)

    return Case(
        name="fem_increments",
        title="Finite elements: pressing with friction in smaller increments",
        problem=(
            "The rigid ball on a body of ν = 0, with friction that lets half of the radius stick, "
            "on one mesh. Each doubling of the increments changes the answer less; how much less "
            "is the order of the path's error."
        ),
        runs=runs,
        quantities=(),
        orders=(
            OrderOfChange(
                "order_of_approach", "approach", labels, approach_change, increment_size,
                EXPECTED[APPROACH],
                "slip keeps its direction while the contact grows; what increments miss of the "
                "stick zone alternates and cancels in a mean",
            ),
            OrderOfChange(
                "order_of_shear", "shear (L1)", labels, shear_change, increment_size,
                EXPECTED[SHEAR],
                "the shear of a ring is fixed where the stick edge passes; next to it the shear "
                "leaves the friction limit as a square root: O(√h) on bands of width h",
            ),
        ),
        charts=charts,
        limits=(
            "Where an increment moves the stick edge by less than an element, smaller increments "
            "say nothing more: the mesh has to become finer with them.",
        ),
    )  # fmt: skip


def approach_change(coarse: Result, fine: Result) -> float:
    """Change of the approach relative to the finer path."""
    return abs(approach(coarse) / approach(fine) - 1)


def shear_change(coarse: Result, fine: Result) -> float:
    """∫|q_coarse - q_fine| r dr / ∫µp r dr."""
    one, other = coarse.steps[-1], fine.steps[-1]
    assert one.shear_radial is not None
    assert other.shear_radial is not None
    r = one.radii
    difference = np.abs(one.shear_radial - at_radii(other, other.shear_radial, r))
    limit = ONE.friction * at_radii(other, other.pressure, r)
    return float(np.trapezoid(difference * r, r) / np.trapezoid(limit * r, r))


def increment_size(result: Result) -> float:
    """Part of the contact radius that an increment adds."""
    return 1 / len(result.increments)


def _run(increments: int) -> SectionRun:
    step = LoadStep(normal_force=paper.NORMAL_FORCE, increments=increments)
    return SectionRun(
        f"{increments} increments",
        ONE.scene[FEW].model_copy(update={"loading": (step,)}),
        per_radius(ELEMENTS, 0.97 * ONE.contact_radius),
    )


def _chart(results: list[Result]) -> Chart:
    pairs = list(pairwise(results))
    return convergence_chart(
        "fem_increments",
        "Smaller increments, finite elements",
        f"Change by twice the increments on {ELEMENTS} elements per contact radius.",
        [increment_size(level) for level in results[:-1]],
        {
            APPROACH: [approach_change(*pair) for pair in pairs],
            SHEAR: [shear_change(*pair) for pair in pairs],
        },
        EXPECTED,
        "1 / increments",
    )
