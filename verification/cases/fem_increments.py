"""Finite elements: pressing with friction, cut into more and more increments."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from verification.cases.indentation_refinement import ONE
from verification.exhibits.chart import Chart
from verification.exhibits.convergence_chart import convergence_chart
from verification.judging.case import Case, Level
from verification.judging.order_of_convergence import (
    Followed,
    NotYetAsymptotic,
    OrderOfChange,
    Refinement,
)
from verification.judging.run import SectionRun, per_radius
from verification.observed.changes import approach_change, increment_size
from verification.observed.end_state import contact_radius
from verification.observed.ring_errors import at_radii

if TYPE_CHECKING:
    from fem_reference import Result

# The stick edge moves from node to node: that shows beyond 12 increments on 256 elements per radius
# and beyond 24 on 512, and an order read off more is too low.
ELEMENTS = 256
SLOWLY = NotYetAsymptotic(
    0.12,
    "the next term is of second order and of the other sign: by 1/h = 2 … 12 increments the change "
    "is h^3/2 (0.0761 - 0.0209 √h) within 0.5 % on 512 elements per radius, whose order rises from "
    "1.40 to 1.45 and to 1.5 as √h falls",
)
INCREMENTS = (2, 3, 4, 6, 8, 12)
APART = 2  # levels from some increments to twice as many
APPROACH, RADIUS, SHEAR = "approach", "contact radius", "shear (L1)"
EXPECTED = {APPROACH: 2.0, RADIUS: 2.0, SHEAR: 1.5}
PRESSURES = (
    "slip keeps its direction while the contact grows; what increments miss of the stick zone "
    "alternates and cancels in a mean"
)


def fem_increments(level: Level = Level.QUICK) -> Case:
    """The case, the same at every level."""
    del level
    return fem_increments_on(ELEMENTS, INCREMENTS)


def fem_increments_on(elements: int, increments: tuple[int, ...]) -> Case:
    """The case with these increments."""
    runs = tuple(_run(elements, count) for count in increments)
    labels = tuple(map(_label, increments))

    def charts(results: Mapping[str, Result]) -> tuple[Chart, ...]:
        return _charts([results[label] for label in labels])

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
                "order_of_approach", Followed.APPROACH, Refinement.INCREMENTS,
                APPROACH, labels, approach_change, increment_size, EXPECTED[APPROACH], PRESSURES,
                apart=APART,
            ),
            OrderOfChange(
                "order_of_contact_radius", Followed.CONTACT_RADIUS, Refinement.INCREMENTS,
                RADIUS, labels, radius_change, increment_size, EXPECTED[RADIUS], PRESSURES,
                apart=APART,
            ),
            OrderOfChange(
                "order_of_shear", Followed.SHEAR, Refinement.INCREMENTS,
                "shear (L1)", labels, shear_change, increment_size,
                EXPECTED[SHEAR],
                "the shear of a ring is fixed where the stick edge passes; next to it the shear "
                "leaves the friction limit as a square root: O(√h) on bands of width h",
                SLOWLY, APART,
            ),
        ),
        charts=charts,
        limits=(
            "Where an increment moves the stick edge by less than an element, smaller increments "
            "say nothing more: the mesh has to become finer with them.",
        ),
    )  # fmt: skip


def radius_change(coarse: Result, fine: Result) -> float:
    """Change of the contact radius relative to the finer path."""
    return abs(contact_radius(coarse) / contact_radius(fine) - 1)


def shear_change(coarse: Result, fine: Result) -> float:
    """∫|q_coarse - q_fine| r dr / ∫µp r dr."""
    one, other = coarse.steps[-1], fine.steps[-1]
    assert one.shear_radial is not None
    assert other.shear_radial is not None
    r = one.radii
    difference = np.abs(one.shear_radial - at_radii(other, other.shear_radial, r))
    limit = ONE.friction * at_radii(other, other.pressure, r)
    return float(np.trapezoid(difference * r, r) / np.trapezoid(limit * r, r))


def _label(increments: int) -> str:
    return f"{increments} increments"


def _run(elements: int, increments: int) -> SectionRun:
    return SectionRun(
        _label(increments),
        ONE.problem(increments).scene,
        per_radius(elements, 0.97 * ONE.contact_radius),
    )


def _charts(results: list[Result]) -> tuple[Chart, ...]:
    followed = {APPROACH: approach_change, RADIUS: radius_change, SHEAR: shear_change}
    elements = results[0].discretisation.elements_per_radius
    pairs = list(zip(results, results[APART:], strict=False))
    chart = convergence_chart(
        "fem_increments",
        "Smaller increments, finite elements",
        f"Change by twice the increments on {elements:g} elements per contact radius.",
        [increment_size(coarse) for coarse, _ in pairs],
        {label: [change(*pair) for pair in pairs] for label, change in followed.items()},
        EXPECTED,
        "1 / increments",
    )
    return (chart,)
