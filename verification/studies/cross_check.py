"""The study of both solvers on the same contacts: moduli, thicknesses and friction."""

from __future__ import annotations

from dataclasses import dataclass

from verification.cases.both_solvers.charts import difference_chart
from verification.cases.both_solvers.contacts import CONTACTS, CheckedContact
from verification.cases.both_solvers.differences import differences
from verification.cases.both_solvers.left_out import MARGIN
from verification.cases.both_solvers.sides import Sides
from verification.cases.both_solvers.statements import answer, statements
from verification.cases.both_solvers.tables import (
    difference_table,
    number_table,
    reference_table,
)
from verification.judging.case import Level
from verification.running.row import CaseRecord, found
from verification.running.study import Conclusion, Records, Settings, Study

CELLS = {Level.QUICK: 128, Level.STANDARD: 256, Level.FULL: 256}
ELEMENTS = {Level.QUICK: 64, Level.STANDARD: 64, Level.FULL: 128}
COATED = sum(contact.is_coated for contact in CONTACTS)
REMARKS = (
    "The own error of a side is the change from half as many cells or elements: what is left on "
    "the finer one, were the order 1. The joint uncertainty is the root of the sum of both "
    "squares. A difference beyond what is required is inconclusive as long as twice the joint "
    "uncertainty covers it. That of the elements is taken where the ripple of the coarser mesh's "
    "last five elements does not reach.",
    "Nothing is judged nearer to the axis than two cells or two elements, and no shear nearer to "
    "a kink: the edge of stick, and where that edge turned outward after it had come back by more "
    "than a cell or an element. What sticks keeps the kink that it had there, and both sides round "
    "it. Where that is within an element of the axis, the outward shear jumps there as far as "
    "elements can tell and the pressure has a logarithmic peak, with the same error two elements "
    "away on every mesh: nothing is judged at these two elements either.",
    "Both solvers take the same increments: what finite increments cost is not seen here.",
    "The cells' tractions are means over 16 directions by cubic splines; those of the elements are "
    "values at their rings.",
    "References: without friction an integral equation for every coating; with friction the "
    "self-similar solution of the homogeneous body and one coated body, neither with increments.",
)


@dataclass(frozen=True)
class CrossCheckRun:
    """A contact by both solvers, each on two finenesses."""

    sides: Sides

    @property
    def name(self) -> str:
        return f"{self.sides.contact.file_name}-{self.sides.cells}-{self.sides.elements}"

    def compute(self) -> CaseRecord:
        on_cells = [run.solve() for run in self.sides.on_cells]
        on_elements = [run.solve() for run in self.sides.on_elements]
        return self.sides.record(on_cells, on_elements, self.sides.elements)


def cases(settings: Settings) -> tuple[CrossCheckRun, ...]:
    """One case per contact."""
    cells, elements = settings.cells or CELLS[settings.level], ELEMENTS[settings.level]
    return tuple(CrossCheckRun(Sides(contact, cells, elements)) for contact in CONTACTS)


def conclude(settings: Settings, records: Records) -> Conclusion:
    """Differences with the error of each side, their curves, and the verdict."""
    runs = cases(settings)
    known: dict[CheckedContact, CaseRecord] = {
        run.sides.contact: record for run, record in found(runs, records).items()
    }
    apart = {contact: differences(record) for contact, record in known.items()}
    return Conclusion(
        statements=statements(known, apart),
        answer=answer(apart, _fineness(runs[0].sides)),
        tables=(reference_table(apart), difference_table(apart), number_table(known))
        if known
        else (),
        charts=tuple(difference_chart(known, name) for name in ("pressure", "shear") if known),
        remarks=REMARKS,
    )


def _fineness(sides: Sides) -> str:
    """Of both solvers, on one scale."""
    cells = sides.cells / (2 * MARGIN)
    return f"{cells:.0f} cells and {sides.elements} elements per contact radius"


STUDY = Study(
    name="cross-check",
    title="Both solvers on the same coated contacts",
    question="A rigid ball is pressed on coated half-spaces with and without friction: "
    f"{len(CONTACTS)} scenes, {COATED} of them with a coating unlike its body, "
    "solved by cells with Fourier transforms and by axisymmetric finite elements, which share "
    "nothing but the scene. How far are they apart, and does each side's own error explain it?",
    cases=cases,
    conclude=conclude,
)
