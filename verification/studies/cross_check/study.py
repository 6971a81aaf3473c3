"""The study of both solvers on the same contacts: moduli, thicknesses and friction."""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping

from verification.cases.cross_check_contacts import MARGIN
from verification.judging.case import Level
from verification.running.study import Conclusion, Records, Settings, Study, StudyCase
from verification.studies.cross_check.charts import difference_chart
from verification.studies.cross_check.contact_run import CrossCheckRecord, CrossCheckRun
from verification.studies.cross_check.contacts import (
    Found,
    Key,
    coated_count,
    expected_contacts,
)
from verification.studies.cross_check.difference import differences
from verification.studies.cross_check.tables import (
    difference_table,
    number_table,
    reference_table,
)
from verification.studies.cross_check.verdicts import answer, statements

CELLS = {Level.QUICK: 128, Level.STANDARD: 256, Level.FULL: 256}
ELEMENTS = {Level.QUICK: 64, Level.STANDARD: 64, Level.FULL: 128}
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


def cases(settings: Settings) -> tuple[StudyCase, ...]:
    """One case per contact."""
    return tuple(_run(key, settings) for key in expected_contacts())


def conclude(settings: Settings, records: Records) -> Conclusion:
    """Differences with the error of each side, their curves, and the verdict."""
    found = _found(settings, records)
    apart = {key: differences(record) for key, record in found.items()}
    return Conclusion(
        statements=statements(found, apart),
        answer=answer(apart, _fineness(settings)),
        tables=(reference_table(apart), difference_table(apart), number_table(found))
        if found
        else (),
        charts=tuple(difference_chart(found, name) for name in ("pressure", "shear") if found),
        remarks=REMARKS,
    )


def exports(settings: Settings, records: Records) -> Mapping[str, str]:
    """`differences.csv`: both solvers' tractions at all radii."""
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    table.writerow(
        ("E1_over_E2", "h_over_aH", "mu", "r_over_a", "p_cells", "p_elements", "q_cells",
         "q_elements", "shear_judged")
    )  # fmt: skip
    for key, record in _found(settings, records).items():
        one, other = record.semi_analytical, record.finite_elements
        columns = (one.pressure, other.pressure, one.shear, other.shear)
        judged = map(int, record.shear_judged)
        rows = zip(record.radii, *columns, judged, strict=True)
        table.writerows((*key, *row) for row in rows)
    return {"differences.csv": text.getvalue()}


def _fineness(settings: Settings) -> str:
    """Of both solvers, on one scale."""
    cells = (settings.cells or CELLS[settings.level]) / (2 * MARGIN)
    return f"{cells:.0f} cells and {ELEMENTS[settings.level]} elements per contact radius"


def _run(key: Key, settings: Settings) -> CrossCheckRun:
    cells = settings.cells or CELLS[settings.level]
    return CrossCheckRun(*key, cells, ELEMENTS[settings.level])


def _found(settings: Settings, records: Records) -> Found:
    found = {key: records.get(_run(key, settings).name) for key in expected_contacts()}
    return {key: r for key, r in found.items() if isinstance(r, CrossCheckRecord)}


STUDY = Study(
    name="cross-check",
    title="Both solvers on the same coated contacts",
    question="A rigid ball is pressed on coated half-spaces with and without friction: "
    f"{len(expected_contacts())} scenes, {coated_count()} of them with a coating unlike its body, "
    "solved by cells with Fourier transforms and by axisymmetric finite elements, which share "
    "nothing but the scene. How far are they apart, and does each side's own error explain it?",
    cases=cases,
    conclude=conclude,
    exports=exports,
)
