"""Tests of the output directory of a run: complete or absent, and other files are kept."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from contact_results.directory.atomic_file import OutputRefused
from contact_results.directory.file_names import SUMMARY, TIMING
from contact_results.directory.run_directory import run_directory
from contact_results.directory.timing import Stopwatch, write_timing


class WorkFailed(Exception):
    """What the tests throw into a run."""


def fill(directory: Path, text: str = "new") -> None:
    """Write what a run would: a summary, a table and its times."""
    (directory / SUMMARY).write_text(text)
    (directory / "profiles.csv").write_text(text)
    write_timing(Stopwatch(), directory, ())


def contents(directory: Path) -> dict[str, str]:
    return {path.name: path.read_text() for path in directory.iterdir() if path.name != TIMING}


def run(target: Path, text: str = "new", *, overwrite: bool = False) -> None:
    with run_directory(target, overwrite=overwrite) as staging:
        fill(staging, text)


def failing_run(target: Path) -> None:
    with run_directory(target) as staging:
        fill(staging)
        raise WorkFailed


def stopped_run(target: Path, number: signal.Signals) -> None:
    with run_directory(target) as staging:
        fill(staging)
        signal.raise_signal(number)


def refused_run(target: Path) -> None:
    with run_directory(target):
        pytest.fail("the work began")


@pytest.fixture
def earlier_run(tmp_path):
    target = tmp_path / "out"
    run(target, "old")
    return target


def test_directory_appears_only_when_it_is_complete(tmp_path):
    target = tmp_path / "deep" / "out"
    with run_directory(target) as staging:
        fill(staging)
        assert not target.exists()
    assert contents(target) == {SUMMARY: "new", "profiles.csv": "new"}
    assert os.listdir(target.parent) == ["out"]


def test_failed_run_leaves_nothing_not_even_parents(tmp_path):
    with pytest.raises(WorkFailed):
        failing_run(tmp_path / "deep" / "er" / "out")
    assert os.listdir(tmp_path) == []


def test_rerun_replaces_results_and_drops_stale_ones_but_no_foreign_file(
    earlier_run,
):
    (earlier_run / "shear.png").write_text("of the earlier run")
    (earlier_run / "notes.txt").write_text("mine")
    run(earlier_run)
    assert contents(earlier_run) == {SUMMARY: "new", "profiles.csv": "new", "notes.txt": "mine"}


def test_foreign_results_are_refused_before_work_unless_told(tmp_path):
    (tmp_path / "profiles.csv").write_text("mine")
    with pytest.raises(OutputRefused, match="not the result of an earlier run"):
        refused_run(tmp_path)
    assert contents(tmp_path) == {"profiles.csv": "mine"}
    run(tmp_path, overwrite=True)
    assert contents(tmp_path) == {SUMMARY: "new", "profiles.csv": "new"}


def test_abandoned_directory_is_cleared_away(tmp_path):
    abandoned = tmp_path / ".out.partial-0badcafe"
    abandoned.mkdir()
    (abandoned / "result.h5").write_text("half")
    with run_directory(tmp_path / "out") as staging:
        assert not abandoned.exists()
        fill(staging)
    assert os.listdir(tmp_path) == ["out"]


@pytest.fixture
def handlers_restored(monkeypatch):
    numbers = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
    before = [signal.getsignal(number) for number in numbers]
    # A run leaves ignored signals ignored, and `nohup` has tests start with SIGHUP ignored.
    defaults = (signal.default_int_handler, signal.SIG_DFL, signal.SIG_DFL)
    for number, handler in zip(numbers, defaults, strict=True):
        signal.signal(number, handler)
    monkeypatch.setattr(os, "_exit", sys.exit)  # which would end the tests, too
    yield
    left = [signal.getsignal(number) for number in numbers]
    for number, handler in zip(numbers, before, strict=True):
        signal.signal(number, handler)
    assert left == list(defaults)


@pytest.mark.usefixtures("handlers_restored")
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_signal_during_work_cleans_up(tmp_path, number):
    with pytest.raises(SystemExit) as stop:
        stopped_run(tmp_path / "out", number)
    assert stop.value.code == 128 + number
    assert os.listdir(tmp_path) == []


@pytest.mark.usefixtures("handlers_restored")
def test_signal_during_publication_waits_for_its_end(earlier_run, monkeypatch):
    real_replace = os.replace

    def interrupted_replace(source, target):
        signal.raise_signal(signal.SIGTERM)
        real_replace(source, target)

    monkeypatch.setattr(os, "replace", interrupted_replace)
    with pytest.raises(SystemExit):
        run(earlier_run)
    assert contents(earlier_run) == {SUMMARY: "new", "profiles.csv": "new"}


def test_summary_is_the_sign_of_completeness(earlier_run, monkeypatch):
    """A kill between two replacements leaves no summary, and the next run repairs it."""
    real_replace = os.replace
    moved = []

    def dying_replace(source, target):
        if len(moved) == 1:
            raise WorkFailed
        moved.append(target.name)
        real_replace(source, target)

    with monkeypatch.context() as patch:
        patch.setattr(os, "replace", dying_replace)
        with pytest.raises(WorkFailed):
            run(earlier_run)
    assert SUMMARY not in contents(earlier_run)
    run(earlier_run)
    assert contents(earlier_run) == {SUMMARY: "new", "profiles.csv": "new"}


# ---- lock


ROOT = Path(__file__).resolve().parents[1]
HOLD = """
import sys, time
from pathlib import Path
from contact_results.directory.run_lock import in_sole_use

with in_sole_use(Path(sys.argv[1])):
    print("held", flush=True)
    time.sleep(100)
"""


def entered(target: Path) -> bool:
    try:
        with run_directory(target):
            return True
    except OutputRefused:
        return False


@pytest.fixture(params=[True, False], ids=["there", "not there yet"])
def target(request, tmp_path):
    target = tmp_path / "out"
    if request.param:
        target.mkdir()
    return target


def test_second_run_is_refused_and_told_of_the_first(target):
    with run_directory(target):
        with pytest.raises(OutputRefused, match=f"in use by process {os.getpid()} on"):
            run_directory(target).__enter__()
        target.mkdir(exist_ok=True)  # by somebody else: the first one's lock is beside it
        assert not entered(target)
    assert entered(target)
    assert [path.name for path in target.parent.rglob("*")] == ["out"]


def test_lock_of_a_dead_process_stops_nobody(target):
    holder = subprocess.Popen(
        [sys.executable, "-c", HOLD, target], cwd=ROOT, stdout=subprocess.PIPE, text=True
    )
    assert holder.stdout.readline() == "held\n"
    assert not entered(target)
    holder.send_signal(signal.SIGKILL)
    holder.communicate()
    assert list(target.parent.rglob(".out.in-use"))
    target.mkdir(exist_ok=True)
    assert entered(target)
    assert [path.name for path in target.parent.rglob("*")] == ["out"]
