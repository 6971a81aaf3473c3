"""The study of promises: each try can be broken, and what is broken is counted and told."""

from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

import pytest

from contact_scene.kept_arrays import log
from verification.judging.case import Level
from verification.judging.outcome import Status
from verification.running.row import CaseRecord
from verification.running.study import Settings
from verification.studies.promises import (
    kept,
    pages,
    paths,
    planted,
    processes,
    revolution,
    solvers,
    study,
    texts,
)
from verification.studies.promises.browser import ACT, chromium
from verification.studies.promises.promise import Attempt, Promise
from verification.studies.promises.promises import PROMISES
from verification.studies.promises.study import STUDY, Trial


def all_kept(attempts: Iterable[Attempt]) -> bool:
    return all(attempt.kept for attempt in attempts)


def some_broken(attempts: Iterable[Attempt]) -> bool:
    return not all_kept(attempts)


@pytest.mark.parametrize(
    ("name", "count"),
    [("lines", 60), ("bytes", 60), ("numbers", 60), ("damage", 57), ("symmetry", 3), ("scale", 2),
     ("not-a-number", 2), ("soak", 4), ("paths", 20), ("moved", 3), ("turned", 2), ("units", 2),
     ("bits", 1)],
)  # fmt: skip
def test_promise_is_kept(name: str, count: int) -> None:
    assert all_kept(PROMISES[name].attempts(count))


@pytest.mark.slow
@pytest.mark.timeout(3600)
@pytest.mark.parametrize("name", sorted(PROMISES))
def test_every_promise_is_kept_as_often_as_the_quick_level_tries(name: str) -> None:
    tried = list(PROMISES[name].attempts(PROMISES[name].count(Level.QUICK)))
    assert [attempt.told for attempt in tried if not attempt.kept] == []


def test_what_is_no_refusal_breaks_the_promise(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(path: Path) -> None:
        raise KeyError("radius")

    monkeypatch.setattr(texts, "read_scene_file", fail)
    for attempts in (texts.lines_changed, texts.bytes_changed, texts.numbers_changed):
        assert not any(attempt.kept for attempt in attempts(3))


def test_slow_reading_breaks_the_promise(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(texts, "LONGEST", 0.0)
    assert some_broken(texts.lines_changed(3))


def test_silent_cache_breaks_the_promise(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(log, "warning", lambda *told: None)
    broken = [attempt for attempt in kept.damaged(57) if not attempt.kept]
    assert len(broken) == 19
    assert all("used" in attempt.told for attempt in broken)


def test_lopsided_solver_breaks_the_promise(monkeypatch: pytest.MonkeyPatch) -> None:
    sound = solvers.solve

    def lopsided(*given: object) -> object:
        found = sound(*given)  # type: ignore[arg-type]
        pressure = found.steps[-1].pressure
        pressure.flags.writeable = True
        pressure[0, 0] += 1e-10 * pressure.max()
        return found

    monkeypatch.setattr(solvers, "solve", lopsided)
    assert some_broken(solvers.symmetric(3))


def test_solver_that_knows_where_the_middle_is_breaks_the_promise(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(solvers, "left_open", lambda *_: 1e-17)
    assert some_broken(solvers.moved(3))


@pytest.mark.parametrize("name", ["turned", "scaled"])
def test_direction_and_unit_that_count_break_the_promise(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    sound = revolution._end

    def lopsided(*given: object, **changes: float) -> object:
        end = sound(*given, **changes)  # type: ignore[arg-type]
        return replace(end, approach=end.approach * (1 + 1e-8 * len(changes)))

    monkeypatch.setattr(revolution, "_end", lopsided)
    assert some_broken(getattr(revolution, name)(1))


def test_reading_elsewhere_breaks_the_promise(monkeypatch: pytest.MonkeyPatch) -> None:
    sound = paths.read_scene_file

    def curious(path: Path) -> object:
        (path.parent.parent / "out" / "h.npy").read_bytes()
        return sound(path)

    monkeypatch.setattr(paths, "read_scene_file", curious)
    broken = [attempt.told for attempt in paths.escaping(6) if not attempt.kept]
    assert broken
    assert all("opened" in told for told in broken)


@pytest.mark.skipif(chromium() is None, reason="no Chromium here")
def test_page_that_runs_what_it_shows_breaks_the_promise(monkeypatch: pytest.MonkeyPatch) -> None:
    assert all_kept(pages.shown(1))
    page = f"<!doctype html><title>x</title><script>{ACT}</script>"
    monkeypatch.setattr(pages, "page_of_a_run", lambda title: page)
    assert some_broken(pages.shown(1))


def test_answer_from_a_number_that_is_none_breaks_the_promise(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(planted, "OPEN", 0.0)
    assert some_broken(planted.planted(8))


def test_absurd_contacts_are_many_and_each_is_read() -> None:
    from verification.studies.promises.scenes import absurd, read

    found = dict(absurd())
    assert len(found) == 19
    assert len(read(found["50 layers"]).body.layers) == 50
    assert len(found) * len(processes.SOLVERS) == PROMISES["absurd"].tries[1]


BREAKING = Promise(
    "breaking", "nothing breaks", "trying", (2, 4),
    lambda count: [Attempt(n != 1, "number 1", float(n)) for n in range(count)], "mm",
)  # fmt: skip


def test_what_is_broken_is_counted_and_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(study, "PROMISES", {"breaking": BREAKING})
    record = Trial("breaking", 4).compute()
    told = STUDY.conclude(Settings(Level.FULL), {"breaking": record})
    (statement,) = told.statements
    assert statement.outcome is Status.FAIL
    assert (statement.measured, statement.because) == ("3 of 4 tries, worst 3 mm", "number 1")
    assert told.tables[0].rows == (("nothing breaks", "trying", "4", "3", "3 mm"),)


def test_fewer_tries_than_the_level_asks_for_leave_the_promise_open() -> None:
    record = CaseRecord(counters={"tried": 5, "kept": 5})
    told = STUDY.conclude(Settings(Level.FULL), {"lines": record})
    assert [statement.outcome for statement in told.statements] == [Status.INCONCLUSIVE]


def test_no_row_is_without_a_number() -> None:
    for promise in PROMISES.values():
        assert 1 <= promise.tries[0] <= promise.tries[1]
        assert any(character.isdigit() for character in promise.claim) or promise.tries[1] >= 8
