"""Both solvers on the same coated contacts, pressed with and without friction."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from verification.cases.case import Case, Comparison, Finding, Level, ReferenceKind, Run
from verification.cases.chart import Chart, Curve, Look, Panel, curve
from verification.cases.cross_check_contacts import JUDGED_WITHIN, CheckedContact, Profiles
from verification.cases.cross_check_stress import stress_difference, stress_of_section
from verification.cases.fem_levels import judged_within
from verification.cases.section_run import SectionRun
from verification.cases.table import Table
from verification.report.numbers import plain

if TYPE_CHECKING:
    import fem_reference
    import semi_analytical

    Pair = tuple[semi_analytical.Result, fem_reference.Result]

Field = NDArray[np.float64]

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

PRESSURE, SHEAR, APPROACH, STRESS = 5e-3, 2e-2, 1e-3, 5e-3
ASKED = "asked of two solvers that share nothing but the scene"
OWN = "what is asked of the difference means something only if each side's own error is below it"
SOURCE = "the other solver, on the same increments"
HALF = "the same solver on half as many cells or elements"


@dataclass(frozen=True)
class Sides:
    """A contact by both solvers, each coarse and fine.

    cells, elements  of the finer ones, even
    """

    contact: CheckedContact
    cells: int
    elements: int

    @property
    def on_cells(self) -> tuple[Run, Run]:
        """Coarse and fine."""
        coarse, fine = (
            Run(f"{self.contact.name}, {n} x {n} cells", self.contact.scene, self.contact.grid(n))
            for n in (self.cells // 2, self.cells)
        )
        return coarse, fine

    @property
    def on_elements(self) -> tuple[SectionRun, SectionRun]:
        """Coarse and fine."""
        coarse, fine = (
            SectionRun(
                f"{self.contact.name}, {n} elements", self.contact.scene, self.contact.mesh(n)
            )
            for n in (self.elements // 2, self.elements)
        )
        return coarse, fine

    def radii(self, one: Any, other: Any) -> Field:
        """Where two results are compared: the rings of the coarser mesh; two meshes only where the
        ripple of the coarser one at the edge does not reach."""
        half = self.elements // 2
        on_cells = hasattr(one, "grid") or hasattr(other, "grid")
        within = JUDGED_WITHIN if on_cells else judged_within(half)
        return self.contact.radii(half, self.cells, within)

    def profiles(self, result: Any, radii: Field) -> Profiles:
        """Of either solver."""
        if hasattr(result, "grid"):
            return self.contact.on_grid(result, radii)
        return self.contact.on_rings(result, radii)

    def pressure_difference(self, one: Any, other: Any) -> float:
        """Largest difference of the pressure over the peak without friction."""
        radii = self.radii(one, other)
        apart = self.profiles(one, radii).pressure - self.profiles(other, radii).pressure
        return float(np.max(np.abs(apart)))

    def shear_difference(self, one: Any, other: Any) -> float:
        """The same of the shear over µ times it, away from the edge of stick."""
        radii = self.radii(one, other)
        stick = other.steps[-1].stick_radius
        judged = self.contact.away_from_stick_edge(radii, stick, self.cells, self.elements)
        apart = np.abs(self.profiles(one, radii).shear - self.profiles(other, radii).shear)
        return float(np.max(apart, where=judged, initial=0.0))

    def comparisons(self) -> tuple[Comparison, ...]:
        """Own errors first, then the difference."""
        cells, elements = self.on_cells, self.on_elements
        pairs = (
            ("own_error_of_cells", "change from half the cells", cells, HALF),
            ("own_error_of_elements", "change from half the elements", elements, HALF),
            ("difference", "between the solvers", (cells[1], elements[1]), SOURCE),
        )
        measures: list[tuple[str, str, Callable[[Any, Any], float], float]] = [
            ("pressure", "pressure within 0.9 a over p₀", self.pressure_difference, PRESSURE),
            ("approach", "approach, relative", approach_difference, APPROACH),
        ]
        if self.contact.friction:
            meaning = "shear within 0.9 a, away from the edge of stick, over µp₀"
            measures.append(("shear", meaning, self.shear_difference, SHEAR))
        return tuple(
            Comparison(
                f"{quantity}_{name}", f"{meaning}: {which}", (first.label, second.label),
                measure, allowed, ASKED if source is SOURCE else OWN, source,
                ReferenceKind.OTHER_SOLVER,
            )
            for quantity, meaning, measure, allowed in measures
            for name, which, (first, second), source in pairs
        )  # fmt: skip


def approach_difference(one: Any, other: Any) -> float:
    """Relative."""
    return abs(float(one.steps[-1].approach / other.steps[-1].approach) - 1)


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
        charts=partial(_charts, sides),
        tables=partial(_tables, sides),
        limits=(
            "Both take the same increments: what finite increments cost is not seen here.",
            "The shear is left out at the edge of stick, and all is at the axis: two cells or two "
            "elements to each side.",
        ),
    )  # fmt: skip


def _finding(one: Sides, name: str, result: Any) -> float:
    end = result.steps[-1]
    if name == "stick_radius":
        return float(end.stick_radius / end.contact_radius)
    return float(end.dissipated_energy / (end.normal_force * end.approach))


def _tables(sides: Sequence[Sides], results: Mapping[str, Any]) -> tuple[Table, ...]:
    rows = []
    for one in sides:
        pair = results[one.on_cells[1].label], results[one.on_elements[1].label]
        radii = one.contact.radii(one.elements // 2, one.cells)
        known = one.contact.reference(radii)
        approach = one.contact.reference_approach
        row = [one.contact.name]
        for result in pair:
            if known is None or approach is None:
                row += ["–"] * 3
                continue
            found = one.profiles(result, radii)
            row.append(plain(float(np.max(np.abs(found.pressure - known.pressure))), 2))
            row.append(plain(float(np.max(np.abs(found.shear - known.shear))), 2))
            row.append(plain(abs(result.steps[-1].approach / approach - 1), 2))
        rows.append(tuple(row))
    return (
        Table(
            title="Which is nearer to a reference that neither made",
            columns=("contact", "p: cells", "q: cells", "δ: cells", "p: elements", "q: elements",
                     "δ: elements"),
            rows=tuple(rows),
            note="Largest errors over p₀, µp₀ (the edge of stick included) and relative; with "
            "friction the reference has no increments.",
        ),
    )  # fmt: skip


def _charts(sides: Sequence[Sides], results: Mapping[str, Any]) -> tuple[Chart, ...]:
    rows: list[tuple[Panel, ...]] = []
    for one in sides:
        pair = results[one.on_cells[1].label], results[one.on_elements[1].label]
        r = one.contact.radii(one.elements // 2, one.cells)
        on_cells, on_elements = (one.profiles(result, r) for result in pair)
        rows.append((
            _panel(one, r, (on_cells.pressure, on_elements.pressure), "p / p₀", len(rows)),
            _panel(one, r, (on_cells.shear, on_elements.shear), "q / µp₀", len(rows)),
        ))  # fmt: skip
    return (
        Chart(
            name="cross_check_profiles",
            title="Tractions by both solvers",
            caption="Pressure (left) and outward shear (right) over the radius: finite elements in "
            "grey, cells on top of them, for each contact of the case.",
            rows=tuple(rows),
        ),
        stress_of_section(sides[0].contact, results[sides[0].on_cells[1].label],
                          results[sides[0].on_elements[1].label]),
    )  # fmt: skip


def _panel(one: Sides, r: Any, values: tuple[Any, Any], label: str, row: int) -> Panel:
    curves: list[Curve] = [
        curve("elements" if row == 0 else "", r, values[1], Look.REFERENCE),
        curve("cells" if row == 0 else "", r, values[0]),
    ]
    return Panel(
        x_label="r / a",
        y_label=label,
        curves=tuple(curves),
        title=one.contact.name if label.startswith("p") else "",
        height=1.4,
    )
