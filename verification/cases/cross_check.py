"""Both solvers on the same coated contacts, pressed with and without friction."""

from __future__ import annotations

from functools import partial
from typing import Any

from verification.cases.cross_check_contacts import CheckedContact
from verification.cases.cross_check_sides import SOURCE, Sides
from verification.cases.cross_check_stress import stress_difference
from verification.cases.cross_check_views import charts, tables
from verification.judging.case import Case, Comparison, Finding, Level
from verification.problems.reference import ReferenceKind

CONTACTS: dict[Level, tuple[CheckedContact, ...]] = {
    Level.QUICK: (
        CheckedContact(2.0, 1.0, 0.1),
        CheckedContact(10.0, 0.25, 0.0),
        CheckedContact(0.25, 2.0, 0.1),
    ),
}
CONTACTS[Level.STANDARD] = (*CONTACTS[Level.QUICK], CheckedContact(4.0, 1.0, 0.3))
CONTACTS[Level.FULL] = CONTACTS[Level.STANDARD]
SIZES = {Level.QUICK: (96, 64), Level.STANDARD: (192, 64), Level.FULL: (256, 96)}

STRESS = 5e-3


def cross_check(level: Level = Level.QUICK) -> Case:
    """The case, on more contacts and finer discretisations at higher levels."""
    return cross_check_on(tuple(Sides(contact, *SIZES[level]) for contact in CONTACTS[level]))


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
            "cross-check has all 54 contacts."
        ),
        runs=tuple(run for one in sides for run in (*one.on_cells, *one.on_elements)),
        quantities=(),
        comparisons=(
            *(comparison for one in sides for comparison in one.comparisons()),
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
                partial(_finding, one, name), "compare the other solver's",
            )
            for one in sides if one.contact.friction
            for name, meaning in (
                ("stick_radius", "stick radius over contact radius"),
                ("dissipated_energy", "energy lost to friction over W δ"),
            )
            for kind, run in (("cells", one.on_cells[1]), ("elements", one.on_elements[1]))
        ),
        charts=partial(charts, sides),
        tables=partial(tables, sides),
        limits=(
            "Both take the same increments: what finite increments cost is not seen here.",
            "The shear is left out at the edge of stick and where that turned outward after it had "
            "come back, and all is at the axis: two cells or two elements to each side.",
        ),
    )  # fmt: skip


def _finding(one: Sides, name: str, result: Any) -> float:
    end = result.steps[-1]
    if name == "stick_radius":
        return float(end.stick_radius / end.contact_radius)
    return float(end.dissipated_energy / (end.normal_force * end.approach))
