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
from verification.running.study import CaseRecord, Settings
from verification.studies.stability import contacts, study
from verification.studies.stability.contacts import (
    CellRecord,
    LoadingPath,
    Posed,
    Refusal,
    SolvedContact,
    Solver,
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
    rounds=7,
    way="alternation",
    iterations=80,
    convolutions=400,
)


@pytest.mark.parametrize(("level", "least"), [(Level.QUICK, 100), (Level.FULL, 2000)])
def test_a_level_has_enough_cells_with_names_of_their_own(level: Level, least: int) -> None:
    cells = study_cells(level, 32)
    assert len(cells) >= least
    assert len({cell.name for cell in cells}) == len(set(cells)) == len(cells)
    assert {cell.path for cell in cells} == set(LoadingPath)
    assert {cell.surface for cell in cells} == set(Surface)


def failing_with(error: Exception) -> Callable[[Posed], SolvedContact]:
    def fail(posed: Posed) -> SolvedContact:
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
def test_what_a_cell_is_refused_for_does_not_hang_on_words(
    error: Exception, kind: Refusal, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(contacts.SOLVERS, ORDINARY.solver, failing_with(error))
    if isinstance(error, SceneError):
        monkeypatch.setattr(contacts, "pose", failing_with(error))
    assert judge_contact(ORDINARY).refused_for is kind


def test_an_answer_above_the_tolerance_is_silent_failure(monkeypatch: pytest.MonkeyPatch) -> None:
    def careless(posed: Posed) -> SolvedContact:
        return by_superposition(replace(posed, tolerance=1e-4))

    monkeypatch.setitem(contacts.SOLVERS, ORDINARY.solver, careless)
    assert judge_contact(ORDINARY).verdict is Verdict.SILENT


def test_giving_up_is_recorded_with_its_residual(monkeypatch: pytest.MonkeyPatch) -> None:
    error = NotConverged("the shear", 60, 1e-3, 1e-8)
    monkeypatch.setitem(contacts.SOLVERS, ORDINARY.solver, failing_with(error))
    record = judge_contact(ORDINARY)
    assert (record.verdict, record.residual) == (Verdict.NOT_CONVERGED, 1e-3)
    assert "NotConverged" in record.reason


def kept(found: dict[str, CellRecord]) -> dict[str, CaseRecord]:
    """As runs leave them."""
    cells = {cell.name: cell for cell in study_cells(Level.QUICK, 32)}
    return {name: record.of_cell(cells[name]) for name, record in found.items()}


def records() -> dict[str, CellRecord]:
    """Good records of all cells of the quick level."""
    found = {}
    for cell in study_cells(Level.QUICK, 32):
        kind = Refusal.FORCE if cell.posable else Refusal.POSE
        refused = cell.push > 1 or not cell.posable
        found[cell.name] = refusal(kind) if refused else GOOD
    return found


def refusal(kind: Refusal) -> CellRecord:
    return GOOD.model_copy(
        update={"verdict": Verdict.REFUSED, "refused_for": kind, "reason": "SomeError: too much"}
    )


def outcomes(found: dict[str, CellRecord]) -> list[Status | None]:
    return [s.outcome for s in study.conclude(Settings(Level.QUICK), kept(found)).statements]


EVERYTHING_GOOD = [Status.PASS] * 3 + [None]


@pytest.mark.parametrize("solver", Solver)
@pytest.mark.parametrize(
    ("verdict", "failing"),
    [(Verdict.SILENT, 0), (Verdict.NOT_CONVERGED, 1), (Verdict.REFUSED, 2)],
)
def test_bad_cells_fail_the_statement_of_their_solver_that_names_them(
    solver: Solver, verdict: Verdict, failing: int
) -> None:
    assert outcomes(records()) == EVERYTHING_GOOD * len(Solver)
    bad = GOOD.model_copy(update={"verdict": verdict, "reason": "because"})
    cells = [c for c in study_cells(Level.QUICK, 32) if c.solver is solver]
    names = [cell.name for cell in cells[:2]]
    conclusion = study.conclude(Settings(Level.QUICK), kept(records() | dict.fromkeys(names, bad)))
    judged_as = [s.outcome for s in conclusion.statements]
    failing += 4 * list(Solver).index(solver)
    assert judged_as[failing] is Status.FAIL
    assert judged_as.count(Status.FAIL) == 1
    assert all(name in conclusion.statements[failing].measured for name in names)
    if verdict is not Verdict.REFUSED:
        listed = next(t for t in conclusion.tables if t.title.startswith("Not solved"))
        assert [row[0] for row in listed.rows] == names


def test_a_refusal_for_another_reason_is_not_due() -> None:
    beyond = replace(ORDINARY, push=1.001)
    for kind in Refusal:
        outcome = Status.PASS if kind is Refusal.FORCE else Status.FAIL
        assert study.refusals_are_due({beyond: refusal(kind)}).outcome is outcome
        assert study.refusals_are_due({ORDINARY: refusal(kind)}).outcome is Status.FAIL


def test_missing_records_make_the_map_inconclusive_not_good() -> None:
    assert outcomes({}) == ([Status.INCONCLUSIVE] * 3 + [None]) * len(Solver)
