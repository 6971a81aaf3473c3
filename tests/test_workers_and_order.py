"""How many workers compute cases, in what order and beside whom: the records are the same bytes."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path

import pytest
from study_cases import Loop, Number, Square

from verification.running.case_pool import run_cases
from verification.running.case_store import CaseStore, DamagedRecord
from verification.running.study import StudyCase

ROOT = Path(__file__).resolve().parents[1]
CASES = (
    Loop("semi-analytical", 40.0),
    Loop("fem-complementarity", 40.0),
    Loop("semi-analytical", 70.0),
)
PATIENCE = 120.0  # seconds for what takes some; only a failure waits so long


def computed(directory: Path, cases: Sequence[StudyCase], workers: int) -> dict[str, bytes]:
    ends = run_cases(cases, CaseStore(directory), workers, lambda end: None)
    assert [end.lost for end in ends] == [None] * len(cases)
    assert [end.case for end in ends] == list(cases)
    return {path.name: path.read_bytes() for path in directory.iterdir()}


def test_neither_the_number_of_workers_nor_the_order_changes_a_bit(tmp_path: Path) -> None:
    alone = computed(tmp_path / "alone", CASES, 1)
    together = computed(tmp_path / "together", CASES[::-1], 2)
    assert len(alone) == len(CASES)
    assert together == alone
    again = {
        CaseStore(tmp_path).path(case).name: case.compute().model_dump_json() for case in CASES[::2]
    }
    for name, record in again.items():
        assert record.partition('"fields":"')[2][:64].encode() in alone[name]


def python(program: str, *words: str) -> "subprocess.Popen[str]":
    return subprocess.Popen(
        [sys.executable, "-c", program, *words],
        cwd=ROOT / "tests",
        env=os.environ | {"PYTHONPATH": os.pathsep.join([str(ROOT), *filter(None, sys.path)])},
        text=True,
        stdout=subprocess.PIPE,
    )


def gone(process: int) -> bool:
    try:
        state = Path(f"/proc/{process}/stat").read_text(encoding="ascii").rpartition(")")[2]
    except (FileNotFoundError, ProcessLookupError):
        return True
    return state.split()[0] == "Z"  # nobody has asked how it ended


ENDLESS = """
import sys
from pathlib import Path
from study_cases import Endless
from verification.running.case_pool import run_cases
from verification.running.case_store import CaseStore
if __name__ == "__main__":
    run_cases([Endless(sys.argv[1])], CaseStore(Path(sys.argv[2])), 1, print)
"""


@pytest.mark.skipif(sys.platform != "linux", reason="processes are looked up in /proc")
def test_workers_end_with_a_parent_that_is_killed(tmp_path: Path) -> None:
    told = tmp_path / "pid"
    parent = python(ENDLESS, str(told), str(tmp_path / "cases"))
    until = time.monotonic() + PATIENCE
    while not (told.exists() and told.read_text(encoding="ascii")):
        assert time.monotonic() < until
        time.sleep(0.05)
    worker = int(told.read_text(encoding="ascii"))
    assert not gone(worker)
    parent.send_signal(signal.SIGKILL)
    parent.communicate()
    while not gone(worker):
        assert time.monotonic() < until
        time.sleep(0.05)


def test_a_record_that_is_half_written_would_be_seen(tmp_path: Path) -> None:
    store = CaseStore(tmp_path, Number)
    store.save(Square(2.0), Number(value=4.0, process=0))
    path = store.path(Square(2.0))
    path.write_bytes(path.read_bytes()[:-40])
    with pytest.raises(DamagedRecord):
        store.load(Square(2.0))
