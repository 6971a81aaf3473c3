"""Tests of the study of stability: names of its contacts, their verdicts, and its statements."""

from collections.abc import Callable
from dataclasses import replace

import pytest

from contact_scene import SceneError
from contact_scene.reading.scene_error import Problem
from contact_scene.solver_errors import GrossSliding, ResourceRefused, UnsupportedScene
from semi_analytical import NotConverged
from verification.judging.case import Level
from verification.judging.outcome import Status
from verification.studies.stability import contacts, study
from verification.studies.stability.contacts import (
    CellRecord,
    LoadingPath,
    Posed,
    Refusal,
    Solved,
    StabilityCell,
    Surface,
    Verdict,
    by_superposition,
    judge_contact,
    study_cells,
)

ORDINARY = StabilityCell(cells=16)
GOOD = CellRecord(
    verdict=Verdict.CONVERGED,
    tolerance=1e-8,
    residual=2e-9,
    observed=3e-9,
    increments=4,
    way="alternation",
    iterations=80,
    convolutions=400,
)


@pytest.mark.parametrize(("level", "least"), [(Level.QUICK, 100), (Level.FULL, 2000)])
def test_a_level_has_enough_cells_with_names_of_their_own(level, least):
    cells = study_cells(level, 32)
    assert len(cells) >= least
    assert len({cell.name for cell in cells}) == len(set(cells)) == len(cells)
    assert {cell.path for cell in cells} == set(LoadingPath)
    assert {cell.surface for cell in cells} == set(Surface)


def failing_with(error: Exception) -> Callable[[Posed], Solved]:
    def fail(posed: Posed) -> Solved:
        raise error

    return fail


@pytest.mark.parametrize(
    ("error", "kind"),
    [
        (GrossSliding("in other words"), Refusal.FORCE),
        (UnsupportedScene("exceeds the friction limit"), Refusal.POSE),
        (ResourceRefused("exceeds the friction limit"), Refusal.OTHER),
        (SceneError([Problem(("loading", 1, "tangential_force"), "in words")]), Refusal.FORCE),
        (SceneError([Problem(("loading", 1, "normal_force"), "in words")]), Refusal.OTHER),
    ],
    ids=repr,
)
def test_what_a_cell_is_refused_for_does_not_hang_on_words(error, kind, monkeypatch):
    monkeypatch.setitem(contacts.SOLVERS, ORDINARY.solver, failing_with(error))
    if isinstance(error, SceneError):
        monkeypatch.setattr(contacts, "pose", failing_with(error))
    assert judge_contact(ORDINARY).refused_for is kind


def test_an_answer_above_the_tolerance_is_silent_failure(monkeypatch):
    def careless(posed):
        return by_superposition(replace(posed, tolerance=1e-4))

    monkeypatch.setitem(contacts.SOLVERS, ORDINARY.solver, careless)
    assert judge_contact(ORDINARY).verdict is Verdict.SILENT


def test_giving_up_is_recorded_with_its_residual(monkeypatch):
    error = NotConverged("the shear", 60, 1e-3, 1e-8)
    monkeypatch.setitem(contacts.SOLVERS, ORDINARY.solver, failing_with(error))
    record = judge_contact(ORDINARY)
    assert (record.verdict, record.residual) == (Verdict.NOT_CONVERGED, 1e-3)
    assert "NotConverged" in record.reason


@pytest.mark.parametrize(("share", "outcome"), [(1, Status.PASS), (2, Status.FAIL)])
def test_one_cell_in_a_hundred_may_give_up(share, outcome):
    cells = [replace(ORDINARY, friction=0.001 * n) for n in range(100)]
    given_up = GOOD.model_copy(update={"verdict": Verdict.NOT_CONVERGED})
    found = dict.fromkeys(cells, GOOD) | dict.fromkeys(cells[:share], given_up)
    assert study.nearly_everything_converges(found).outcome is outcome
