"""Both solvers on some contacts of the study cross-check, pressed with and without friction."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Any

from verification.cases.both_solvers.charts import profile_chart
from verification.cases.both_solvers.contacts import CONTACTS, CheckedContact
from verification.cases.both_solvers.differences import COMPARED, Found, differences
from verification.cases.both_solvers.left_out import radii, radii_of_meshes
from verification.cases.both_solvers.sides import CELLS, ELEMENTS, Sides
from verification.cases.both_solvers.stress import stress_difference, stress_of_section
from verification.cases.both_solvers.tables import reference_table
from verification.exhibits.chart import Chart
from verification.exhibits.table import Table
from verification.judging.case import Case, Comparison, Finding, Level
from verification.problems.reference import ReferenceKind

QUICK = (
    CheckedContact(2.0, 1.0, 0.1),
    CheckedContact(10.0, 0.25, 0.0),
    CheckedContact(0.25, 2.0, 0.1),
)
MORE = (*QUICK, CheckedContact(4.0, 1.0, 0.3))
CHOSEN = {Level.QUICK: QUICK, Level.STANDARD: MORE, Level.FULL: MORE}
SIZES = {Level.QUICK: (96, 64), Level.STANDARD: (192, 64), Level.FULL: (256, 96)}

STRESS = 5e-3
ASKED = "asked of two solvers that share nothing but the scene"
OWN = "what is asked of the difference means something only if each side's own error is below it"
SOURCE = "the other solver, on the same increments"
HALF = "the same solver on half as many cells or elements"


def cross_check(level: Level = Level.QUICK) -> Case:
    """The case, on more contacts and finer discretisations at higher levels."""
    return cross_check_on(tuple(Sides(contact, *SIZES[level]) for contact in CHOSEN[level]))


def cross_check_on(sides: tuple[Sides, ...]) -> Case:
    """The case on these contacts; the stress below is compared of the first."""
    first = sides[0]
    fine = first.on_cells[1].label, first.on_elements[1].label
    return Case(
        name="cross_check",
        title="Both solvers on coated contacts",
        problem=(
            "A rigid ball pressed on coated half-spaces by cells with Fourier transforms and by "
            "axisymmetric finite elements, with the same increments. Each solver is first held "
            "against itself on half as many cells or elements, then against the other. The study "
            f"cross-check has all {len(CONTACTS)} contacts."
        ),
        runs=tuple(run for one in sides for run in (*one.on_cells, *one.on_elements)),
        quantities=(),
        comparisons=(
            *(comparison for one in sides for comparison in _comparisons(one)),
            Comparison(
                "stress_difference",
                "largest difference of a component of the stress over p₀: on the axis from 0.1 "
                "to 3 contact radii, above the interface and below it", fine,
                partial(stress_difference, first.contact), STRESS,
                "set by hand: five times what the recovery of the elements leaves of Huber's "
                "stress on as fine a mesh", SOURCE, ReferenceKind.OTHER_SOLVER,
            ),
        ),
        findings=tuple(
            Finding(
                f"{name}_{kind}", f"{meaning}", "", run.label,
                partial(_finding, name), "compare the other solver's",
            )
            for one in sides if one.contact.friction
            for name, meaning in (
                ("stick_radius", "stick radius over contact radius"),
                ("dissipated_energy", "energy lost to friction over W δ"),
            )
            for kind, run in ((CELLS, one.on_cells[1]), (ELEMENTS, one.on_elements[1]))
        ),
        charts=partial(_charts, sides),
        tables=partial(_tables, sides),
        limits=(
            "Both take the same increments: what finite increments cost is not seen here.",
            "The shear is left out at the edge of stick and where that turned outward after it had "
            "come back, and all is at the axis: two cells or two elements to each side.",
        ),
    )  # fmt: skip


def _comparisons(one: Sides) -> tuple[Comparison, ...]:
    """Own errors first, then the difference."""
    cells, elements = one.on_cells, one.on_elements
    own, other = ReferenceKind.OWN_REFINEMENT, ReferenceKind.OTHER_SOLVER
    pairs = (
        ("own_error_of_cells", "change from half the cells", cells, OWN, HALF, own),
        ("own_error_of_elements", "change from half the elements", elements, OWN, HALF, own),
        ("difference", "between the solvers", (cells[1], elements[1]), ASKED, SOURCE, other),
    )
    return tuple(
        Comparison(
            f"{compared.name}_{name}", f"{compared.meaning}: {which}",
            (first.label, second.label), partial(_apart, one, compared.name), compared.required,
            because, source, kind,
        )
        for compared in COMPARED.values()
        if compared.name != "shear" or one.contact.friction
        for name, which, (first, second), because, source, kind in pairs
    )  # fmt: skip


def _apart(sides: Sides, name: str, one: Any, other: Any) -> float:
    """At the rings of the coarser mesh."""
    meshes = not any(hasattr(result, "grid") for result in (one, other))
    at = (radii_of_meshes if meshes else radii)(sides.elements // 2, sides.cells)
    return sides.apart(one, other, at, sides.edges(other))[name]


def _finding(name: str, result: Any) -> float:
    end = result.steps[-1]
    if name == "stick_radius":
        return float(end.stick_radius / end.contact_radius)
    return float(end.dissipated_energy / (end.normal_force * end.approach))


def _found(sides: tuple[Sides, ...], results: Mapping[str, Any]) -> Found:
    """As the study keeps them."""
    return {
        one.contact: one.record(
            {
                CELLS: [results[run.label] for run in one.on_cells],
                ELEMENTS: [results[run.label] for run in one.on_elements],
            },
            one.elements // 2,
        )
        for one in sides
    }


def _tables(sides: tuple[Sides, ...], results: Mapping[str, Any]) -> tuple[Table, ...]:
    found = _found(sides, results)
    return (reference_table({contact: differences(record) for contact, record in found.items()}),)


def _charts(sides: tuple[Sides, ...], results: Mapping[str, Any]) -> tuple[Chart, ...]:
    """Tractions of every contact, and the stress below the first."""
    first = sides[0]
    fine = (results[run.label] for run in (first.on_cells[1], first.on_elements[1]))
    return (
        profile_chart(_found(sides, results)),
        stress_of_section(first.contact, *fine),
    )
