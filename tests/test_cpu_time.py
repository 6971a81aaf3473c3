"""Tests of the CPU time of commands over that of a calibrated loop."""

from pathlib import Path

import pytest

from contact_results.directory.atomic_file import Refused
from verification.judging.outcome import ChangeKind
from verification.regression import cpu_time
from verification.regression.baseline import recorded_by
from verification.regression.cpu_time import CpuTimes, cpu_seconds, cpu_time_changes
from verification.running.provenance import provenance

MADE = provenance("slipstick maintain cpu", {})
KNOWN = CpuTimes(
    by=recorded_by(MADE, "so"),
    processor=str(MADE.machine["processor"]),
    loop_seconds=0.2,
    ratios={"run": 2.0},
)
ELSEWHERE = KNOWN.model_copy(update={"processor": "other"})


@pytest.mark.parametrize(
    ("measured", "known", "kinds"),
    [
        ([9.0, 9.0, 9.0, 9.0, 2.5], KNOWN, []),
        ([2.7, 9.0, 2.7, 2.7, 2.7], KNOWN, [ChangeKind.DRIFT]),
        ([3.3, 9.0, 9.0, 9.0, 9.0], KNOWN, [ChangeKind.DEARER]),
        ([3.3, 9.0, 9.0, 9.0, 9.0], ELSEWHERE, [ChangeKind.DRIFT]),
    ],
)
def test_a_command_is_as_dear_as_its_cheapest_repeat(measured, known, kinds):
    """Stored are 2 loops: above 2.6 is a warning, above 3.2 dearer, on the same processor."""
    repeats = iter(measured)
    rows = cpu_time_changes({"run": ()}, MADE, known, lambda _: next(repeats))
    assert [row.kind for row in rows] == kinds


def test_the_processor_has_the_name_that_the_system_gives_it():
    """Times are compared on processors of one name."""
    lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    names = {line.split(": ")[-1] for line in lines if line.startswith("model name")}
    assert KNOWN.processor in names or not names


def test_a_command_is_compared_with_the_mean_of_the_loops_around_it(monkeypatch):
    seconds = iter([1.0, 6.0, 3.0])
    monkeypatch.setattr(cpu_time, "cpu_seconds", lambda _: next(seconds))
    assert cpu_time.ratio_to_loop(("plan",)) == 3.0


def test_a_command_without_a_stored_time_is_refused():
    with pytest.raises(Refused, match="store the times by"):
        cpu_time_changes({"plan": ()}, MADE, KNOWN)


def test_a_process_is_measured_with_its_imports_and_a_failing_one_is_refused():
    idle, busy = (cpu_seconds(["-c", f"sum(range({n}))"]) for n in (1, 30_000_000))
    assert 0 < idle < busy / 3
    with pytest.raises(Refused, match="-c 1/0 ends with exit code 1: Traceback"):
        cpu_seconds(["-c", "1/0"])
