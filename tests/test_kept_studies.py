"""Tests of the stored records of studies: the present code has the same cases and statements."""

from functools import cache
from pathlib import Path

import pytest

from verification.judging.case import Level
from verification.running.study import (
    Conclusion,
    Settings,
    StudyRecord,
    dump_study,
    stored_studies,
)
from verification.studies.catalogue import STUDIES
from verification.studies.stability.contacts import (
    CellRecord,
    Refusal,
    StabilityCell,
    Verdict,
    study_cells,
)
from verification.studies.stability.study import CELLS

STUDY_FILES = Path(__file__).resolve().parents[1] / "reports" / "studies"
KEPT = {record.name: record for record in stored_studies(STUDY_FILES)}


def kept(name: str) -> StudyRecord:
    return KEPT[name]


def ended(cell: StabilityCell) -> CellRecord:
    """As it should."""
    end = CellRecord(verdict=Verdict.CONVERGED, tolerance=1e-8, residual=1e-9, increments=1)
    if cell.posable and cell.push <= 1:
        return end
    kind = Refusal.FORCE if cell.posable else Refusal.POSE
    return end.model_copy(update={"verdict": Verdict.REFUSED, "refused_for": kind})


@cache
def today(name: str) -> Conclusion:
    """What today's code concludes at that level, from no records but those of the map."""
    level = Level[kept(name).level.upper()]
    records = {}
    if name == "stability":
        cells = study_cells(level, CELLS[level])
        records = {cell.name: ended(cell).of_cell(cell) for cell in cells}
    return STUDIES[name].conclude(Settings(level), records)


@pytest.mark.parametrize("name", sorted(KEPT))
def test_a_kept_record_is_written_as_it_is_kept(name):
    """Nothing of it is lost by being read, and nothing is kept that says nothing."""
    assert dump_study(kept(name)) == (STUDY_FILES / name / "study.json").read_text("utf-8")


@pytest.mark.parametrize("name", ["coated-tractions", "stability"])
def test_a_kept_record_answers_what_is_asked_today(name):
    assert kept(name).question == STUDIES[name].question
    claims = [statement.claim for statement in kept(name).conclusion.statements]
    assert claims == [statement.claim for statement in today(name).statements]


def test_the_kept_map_has_the_cells_of_today_place_by_place():
    old, new = kept("stability").conclusion, today("stability")
    counts = [[row[:2] for row in conclusion.tables[0].rows] for conclusion in (old, new)]
    assert counts[0] == counts[1]
    for one, other in zip(old.charts, new.charts, strict=True):
        ((before,),), ((after,),) = one.rows, other.rows
        assert (one.name, one.title) == (other.name, other.title)
        assert (before.x_places, before.y_places) == (after.x_places, after.y_places)
        assert [note[:2] for note in before.notes] == [note[:2] for note in after.notes]
