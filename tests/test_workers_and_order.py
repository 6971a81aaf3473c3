"""Tests of case workers: their number, order and location do not change the records."""

import os
import re
import signal
import sys
import time
from collections.abc import Sequence
from operator import methodcaller
from pathlib import Path
from threading import Thread

import pytest
from processes import begun, has_ended
from study_cases import Endless, Killed, Loop, Number, Refusing, Square

from verification.running.case_pool import (
    CaseStore,
    ClusterWorkers,
    LocalWorkers,
    run_cases,
)
from verification.running.study import StudyCase

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


def test_neither_the_number_of_workers_nor_the_order_changes_a_bit(tmp_path):
    alone = computed(tmp_path / "alone", CASES, 1)
    together = computed(tmp_path / "together", CASES[::-1], 2)
    assert len(alone) == len(CASES)
    assert together == alone
    again = {
        CaseStore(tmp_path).path(case).name: case.compute().model_dump_json() for case in CASES[::2]
    }
    for name, record in again.items():
        assert record.partition('"fields":"')[2][:64].encode() in alone[name]


ENDLESS = """
import sys
from pathlib import Path
from study_cases import Endless
from verification.running.case_pool import run_cases
from verification.running.case_pool import CaseStore
if __name__ == "__main__":
    run_cases([Endless(sys.argv[1])], CaseStore(Path(sys.argv[2])), 1, print)
"""


def test_closed_workers_begin_no_further_case():
    pool = LocalWorkers(1)
    futures = [pool.submit(methodcaller("compute"), Square(float(n))) for n in range(5)]
    pool.close()
    assert futures[-1].cancelled()


@pytest.mark.skipif(sys.platform != "linux", reason="processes are looked up in /proc")
def test_workers_ignore_interrupts_and_end_with_a_parent_that_is_killed(tmp_path):
    told = tmp_path / "pid"
    parent = begun(tmp_path, str(told), str(tmp_path / "cases"), program=ENDLESS)
    until = time.monotonic() + PATIENCE
    while not (told.exists() and told.read_text(encoding="ascii")):
        assert time.monotonic() < until
        time.sleep(0.05)
    worker = int(told.read_text(encoding="ascii"))
    status = Path(f"/proc/{worker}/status").read_text(encoding="ascii")
    (ignored,) = re.findall(r"SigIgn:\s*(\w+)", status)
    assert int(ignored, 16) & 1 << (signal.SIGINT - 1)
    parent.send_signal(signal.SIGKILL)
    parent.communicate()
    assert has_ended(worker)


# ---- cluster


@pytest.fixture(scope="module")
def address():
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(
        n_workers=3, threads_per_worker=1, dashboard_address=None
    ) as local:
        yield local.scheduler_address


def test_cluster_is_not_the_default_of_other_programs(tmp_path):
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(
        n_workers=1, processes=False, protocol="tcp", dashboard_address=None
    ) as local:
        pool = ClusterWorkers(local.scheduler_address)
        with pytest.raises(ValueError, match="No global client"):
            distributed.get_client()
        (end,) = run_cases((Square(2.0),), CaseStore(tmp_path, Number), pool, lambda end: None)
    assert isinstance(end.record, Number)
    assert end.record.value == 4.0


@pytest.mark.slow
def test_cluster_gives_the_records_and_names_what_is_lost(address, tmp_path):
    cases = (Square(1.0), Refusing(20.0), Square(2.0), Killed(30.0), Square(3.0))
    store = CaseStore(tmp_path, Number)
    dead = []
    ends = run_cases(cases, store, ClusterWorkers(address), lambda end: None, warn=dead.append)
    assert any(re.fullmatch(r"worker tcp://\S+ has died: its cases go to .*", one) for one in dead)
    values = {end.case.name: end.record.value for end in ends if isinstance(end.record, Number)}
    assert values == {"square-1": 1.0, "square-2": 4.0, "square-3": 9.0}
    lost = {end.lost.name: end.lost.reason for end in ends if end.lost is not None}
    assert lost["square-20"] == "ArithmeticError: no square today"
    assert lost["square-30"].startswith("KilledWorker")
    processes = {end.record.process for end in ends if isinstance(end.record, Number)}
    assert os.getpid() not in processes
    assert store.load(cases[0]) == ends[0].record


@pytest.mark.slow
def test_cluster_whose_workers_have_all_died_is_not_waited_for(tmp_path, monkeypatch):
    """The dead worker is named while its case is open, and again as the reason of the loss."""
    distributed = pytest.importorskip("distributed")
    monkeypatch.setattr("verification.running.case_pool.SECONDS_WITHOUT_WORKER", 2)
    told = tmp_path / "pid"
    cases = (Square(1.0), Endless(str(told)), Square(2.0))
    warned = []
    with distributed.LocalCluster(
        n_workers=1, threads_per_worker=1, dashboard_address=None
    ) as local:
        (worker,) = (one.worker_address for one in local.workers.values())

        def end_the_worker():
            while not (told.exists() and told.read_text(encoding="ascii")):
                time.sleep(0.05)
            local.scale(0)

        Thread(target=end_the_worker, daemon=True).start()
        pool = ClusterWorkers(local.scheduler_address)
        store = CaseStore(tmp_path / "cases", Number)
        ends = run_cases(cases, store, pool, lambda end: None, warn=warned.append)
    assert warned == [f"worker {worker} has died: its cases go to other workers"]
    assert ends[0].record is not None
    reasons = [end.lost.reason for end in ends[1:] if end.lost is not None]
    assert len(reasons) == 2
    assert all(one.startswith(f"no worker is left: {worker} died, and none") for one in reasons)
