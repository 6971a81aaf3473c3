"""Accuracy and cost over commits: what became worse is red, and only that."""

import re
import subprocess
from pathlib import Path
from typing import Any

import pytest
from command import slipstick

from verification.judging.change import ChangeKind
from verification.regression.baseline import Baseline, Recording
from verification.regression.baseline_files import dump_baseline, read_baselines
from verification.regression.history import Standing, marks, standings_of_commits, worst
from verification.report.history_page import render_history

NAME, QUANTITY = "hertz_point", "peak_pressure"
MOST_BYTES = 200_000


@pytest.fixture(scope="module")
def recorded() -> Recording:
    return read_baselines()[NAME].levels["quick"]


def with_error(recording: Recording, times: float) -> Recording:
    """One quantity's error so many times as large as a tenth of what is allowed."""
    quantity = next(one for one in recording.quantities if one.name == QUANTITY)
    quantities = [
        one.model_copy(update={"value": one.reference + 0.1 * times * one.allowed})
        if one.key == quantity.key
        else one
        for one in recording.quantities
    ]
    return recording.model_copy(update={"quantities": tuple(quantities)})


def with_work(recording: Recording, times: float) -> Recording:
    runs = (run.model_copy(update={"convolutions": round(times * 1000)}) for run in recording.runs)
    return recording.model_copy(update={"runs": tuple(runs)})


def standings(*recordings: Recording) -> list[Standing]:
    return [
        Standing(f"commit {n}", "2026-11-23", "planted", {NAME: one})
        for n, one in enumerate(recordings)
    ]


def kinds(*recordings: Recording) -> list[tuple[int, str, ChangeKind]]:
    found = {(mark.at, mark.name, mark.kind) for mark in marks(standings(*recordings))}
    return sorted(found)


@pytest.mark.parametrize(("times", "marked"), [(1.4, False), (1.6, True), (0.5, False)])
def test_an_error_half_as_large_again_is_worse(
    recorded: Recording, times: float, marked: bool
) -> None:
    planted = kinds(with_error(recorded, 1.0), with_error(recorded, times))
    assert planted == [(1, QUANTITY, ChangeKind.WORSE)] * marked


def test_an_error_that_is_small_beside_what_is_allowed_may_vary(recorded: Recording) -> None:
    assert kinds(with_error(recorded, 0.1), with_error(recorded, 0.4)) == []


@pytest.mark.parametrize(("times", "marked"), [(1.04, False), (1.06, True), (0.9, False)])
def test_a_twentieth_more_work_is_dearer(recorded: Recording, times: float, marked: bool) -> None:
    planted = kinds(with_work(recorded, 1.0), with_work(recorded, times))
    assert planted == [(1, "convolutions", ChangeKind.DEARER)] * marked


def test_work_that_is_counted_for_the_first_time_is_not_dearer(recorded: Recording) -> None:
    assert kinds(with_work(recorded, 0.0), with_work(recorded, 1.0)) == []


def test_the_worst_quantity_is_told_with_its_part(recorded: Recording) -> None:
    found = worst(with_error(recorded, 9.0))
    assert found is not None
    assert found == (QUANTITY, pytest.approx(0.9))


def test_every_worsening_is_a_red_point_and_a_row(recorded: Recording) -> None:
    good, bad, dear = (
        with_work(with_error(recorded, error), work) for error, work in ((1, 1), (3, 1), (3, 1.1))
    )
    page = render_history(standings(good, good, bad, bad, dear), "quick")
    assert page.count("<circle") == 2
    assert re.search(rf"<title>{QUANTITY} worse: 0.1 U → 0.3 U.*\(commit 2\)</title>", page)
    assert "convolutions dearer" in page
    assert render_history(standings(good, good), "quick").count("<circle") == 0


def test_page_needs_nothing_from_elsewhere_and_stays_small(recorded: Recording) -> None:
    many = {f"{NAME}_{n}": with_work(with_error(recorded, 1 + n), 1 + n) for n in range(70)}
    page = render_history([Standing(f"{n:07x}", "2026-11-23", "why", many) for n in range(60)], "x")
    assert len(page.encode()) < MOST_BYTES
    assert "default-src 'none'; style-src 'unsafe-inline'" in page
    assert not re.search(r"<script|<link|<img|\bsrc=|\bhref=|url\(", page)
    assert page.count("<polyline") == 3 * 70


@pytest.fixture
def clone(recorded: Recording, tmp_path: Path) -> Path:
    """Three commits: what is recorded, three times the error, a case that comes, more work."""
    folder = tmp_path / "clone" / "kept"
    folder.mkdir(parents=True)

    def git(*arguments: str) -> None:
        name = ("-c", "user.name=N", "-c", "user.email=n@example.org", "-c", "commit.gpgsign=false")
        subprocess.run(["git", "-C", str(folder), *name, *arguments], check=True)

    def commit(because: str, **recordings: Recording) -> None:
        for case, one in recordings.items():
            text = dump_baseline(Baseline(case=case, levels={"quick": one}))
            (folder / f"{case}.json").write_text(text, encoding="utf-8")
        git("add", ".")
        git("commit", "-q", "-m", because)

    git("init", "-q", "..")
    good = with_work(with_error(recorded, 1.0), 1.0)
    commit("begin", hertz_point=good)
    commit("spoil & go", hertz_point=with_error(good, 3.0))
    commit("add", other=good, hertz_point=with_work(with_error(good, 3.0), 1.1))
    return folder


def test_history_is_read_from_the_commits(clone: Path) -> None:
    found = standings_of_commits("quick", clone)
    assert [one.because for one in found] == ["begin", "spoil & go", "add"]
    assert [sorted(one.recordings) for one in found] == [[NAME], [NAME], [NAME, "other"]]
    assert [(mark.at, mark.kind) for mark in marks(found)] == [
        (1, ChangeKind.WORSE), (2, ChangeKind.DEARER),
    ]  # fmt: skip
    page = render_history(found, "quick")
    assert "spoil &amp; go" in page


def test_command_draws_reports_or_folders_in_their_order(
    clone: Path, recorded: Recording, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    worse = tmp_path / "worse"
    worse.mkdir()
    spoilt = Baseline(case=NAME, levels={"quick": with_error(recorded, 9.0)})
    (worse / f"{NAME}.json").write_text(dump_baseline(spoilt), encoding="utf-8")
    page = tmp_path / "made" / "history.html"
    assert slipstick("maintain", "history", clone, worse, "--output", page) == 0
    assert "2 standings; worse or dearer at the last: 1" in capsys.readouterr().out
    assert page.read_text(encoding="utf-8").count("<circle") == 1
    assert slipstick("maintain", "history", worse, "--level", "full", "--output", page) == 2
    assert "has nothing of level full" in capsys.readouterr().err


def test_without_a_clone_reports_are_asked_for(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def nowhere(level: str, directory: Any = tmp_path) -> list[Standing]:
        return standings_of_commits(level, directory)

    monkeypatch.setenv("GIT_CEILING_DIRECTORIES", str(tmp_path.parent))
    monkeypatch.setattr("verification.regression.history.standings_of_commits", nowhere)
    assert slipstick("maintain", "history", "--output", tmp_path / "page.html") == 2
    assert "use a clone, or name reports" in capsys.readouterr().err
