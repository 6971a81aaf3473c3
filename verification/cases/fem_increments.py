"""Finite elements: pressing with friction, cut into more and more increments."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from verification.cases.indentation_refinement import LOST, ONE
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
from verification.observed.changes import approach_change, energy_change, increment_size
from verification.observed.end_state import contact_radius
from verification.observed.ring_errors import at_radii

if TYPE_CHECKING:
    from fem_reference import Result

# The stick edge moves from node to node. Where an increment moves it by less than an element the
# order of the shear seems lower than it is: 1.29 with 96 elements per radius, 1.38 with 256, 1.41
# with 512.
ELEMENTS = 256
SLOWLY = NotYetAsymptotic(
    0.15,
    "the stick edge moves from node to node: it is 1.28, 1.38 and 1.41 on 128, 256 and 512 "
    "elements per radius",
)
INCREMENTS = (2, 4, 8, 16, 32)
# The energy is lost at so many places that fewer elements per increment do it no harm, and it needs
# more increments until its error is of one order.
OF_ENERGY = (4, 8, 16, 32, 64, 128)
APPROACH, RADIUS, SHEAR = "approach", "contact radius", "shear (L1)"
ENERGY = "dissipated energy"
EXPECTED = {APPROACH: 2.0, RADIUS: 2.0, SHEAR: 1.5}
PRESSURES = (
    "slip keeps its direction while the contact grows; what increments miss of the stick zone "
    "alternates and cancels in a mean"
)


def fem_increments(level: Level = Level.QUICK) -> Case:
    """The case, with the order of the energy above the quick level."""
    if level is Level.QUICK:
        return fem_increments_on(ELEMENTS, INCREMENTS)
    return fem_increments_on(ELEMENTS, INCREMENTS, OF_ENERGY)


def fem_increments_on(
    elements: int, increments: tuple[int, ...], of_energy: tuple[int, ...] = ()
) -> Case:
    """The case with these increments; others for the order of the energy, or none."""
    runs = tuple(_run(elements, count) for count in sorted({*increments, *of_energy}))
    labels, energetic = (tuple(map(_label, counts)) for counts in (increments, of_energy))

    def charts(results: Mapping[str, Result]) -> tuple[Chart, ...]:
        return _charts(*([results[label] for label in chosen] for chosen in (labels, energetic)))

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
            ),
            OrderOfChange(
                "order_of_contact_radius", Followed.CONTACT_RADIUS, Refinement.INCREMENTS,
                RADIUS, labels, radius_change, increment_size, EXPECTED[RADIUS], PRESSURES,
            ),
            OrderOfChange(
                "order_of_shear", Followed.SHEAR, Refinement.INCREMENTS,
                "shear (L1)", labels, shear_change, increment_size,
                EXPECTED[SHEAR],
                "the shear of a ring is fixed where the stick edge passes; next to it the shear "
                "leaves the friction limit as a square root: O(√h) on bands of width h",
                SLOWLY,
            ),
            *_orders_of_energy(energetic),
        ),
        charts=charts,
        limits=(
            "Where an increment moves the stick edge by less than an element, smaller increments "
            "say nothing more: the mesh has to become finer with them.",
        ),
    )  # fmt: skip


def _orders_of_energy(levels: tuple[str, ...]) -> tuple[OrderOfChange, ...]:
    if not levels:
        return ()
    return (
        OrderOfChange(
            "order_of_energy", Followed.ENERGY, Refinement.INCREMENTS,
            ENERGY, levels, energy_change, increment_size, 1.0, LOST,
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


def _charts(results: list[Result], energetic: list[Result]) -> tuple[Chart, ...]:
    followed = {APPROACH: approach_change, RADIUS: radius_change, SHEAR: shear_change}
    charts = [_chart("fem_increments", "Smaller increments, finite elements", results, followed)]
    if energetic:
        charts.append(
            _chart(
                "fem_increments_energy", "Dissipated energy in smaller increments", energetic,
                {ENERGY: energy_change},
            )
        )  # fmt: skip
    return tuple(charts)


def _chart(
    name: str, title: str, results: list[Result],
    followed: Mapping[str, Callable[[Result, Result], float]],
) -> Chart:  # fmt: skip
    elements = results[0].discretisation.elements_per_radius
    return convergence_chart(
        name,
        title,
        f"Change by twice the increments on {elements:g} elements per contact radius.",
        [increment_size(level) for level in results[:-1]],
        {
            label: [change(*pair) for pair in pairwise(results)]
            for label, change in followed.items()
        },
        {**EXPECTED, ENERGY: 1.0},
        "1 / increments",
    )
