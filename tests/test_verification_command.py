"""Tests of verifications: solves that are bad, given up or lost fail, and a killed one goes on."""

import json
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from command import signalled, succeeded

from contact_scene.solver_errors import NotConverged
from verification.cases.catalogue import choose, lost
from verification.cases.partial_slip import near_sliding
from verification.judging.case import Level
from verification.judging.judgement import judge
from verification.judging.outcome import CaseOutcome, Status
from verification.report.file_names import FILES, PAGE, RECORD
from verification.report.files import EARLIER

pytestmark = pytest.mark.usefixtures("one_process")


# ---- verdicts


def failed(outcome: CaseOutcome) -> set[str]:
    return {verdict.name for verdict in outcome.verdicts if verdict.status is Status.FAIL}


@pytest.fixture(scope="module")
def sliding():
    """A case and the results of its runs."""
    case = near_sliding()
    return case, {run.label: run.solve() for run in case.runs}


def test_residual_above_tolerance_fails(sliding):
    case, solved = sliding

    def solve(run):
        loose = type(run)(run.label, run.scene, run.grid, 1e-4)
        return loose.solve() if run.label == "ν = 0.3, 0.99 µW" else solved[run.label]

    # By the word of the solver, and by its fields.
    seen = {"largest_residual", "observed_violation", "energy_imbalance"}
    assert failed(judge(case, solve)) == seen


def test_solver_that_gives_up_fails_and_the_rest_is_still_judged(
    sliding,
):
    case, solved = sliding

    def solve(run):
        if run is case.runs[0]:
            raise NotConverged("the shear", 60, 1e-3, 1e-8)
        return solved[run.label]

    outcome = judge(case, solve)
    assert failed(outcome) == {"solved"}
    assert "1.00e-03" in outcome.verdicts[0].meaning
    assert len(outcome.runs) == len(case.runs) - 1
    assert outcome.count(Status.PASS) > 1


# ---- killed verifications


ROOT = Path(__file__).resolve().parents[1]
# Of every kind: on a surface grid, on a section, and without a solve.
RESUMED_CASES = ("hertz_approach_control", "fem_classical", "layered_reference")
KILLED = f"""
import sys
sys.path.insert(0, {str(ROOT)!r})
from slipstick.cli import main
{signalled("SIGKILL", saved=2)}
main()
"""


def records(directory: Path) -> dict[str, int]:
    """When the records of finished cases were written; every one of them is whole."""
    found = list((directory / "cases").glob("[a-z]*.json"))
    for path in found:
        json.loads(path.read_bytes())
    return {path.name: path.stat().st_mtime_ns for path in found}


def report(directory: Path) -> dict[str, Any]:
    """What of a report has to be equal: everything but who made it and how long it took."""
    record = json.loads((directory / RECORD).read_bytes())
    assert (directory / PAGE).exists()
    return {key: value for key, value in record.items() if key != "provenance"}


@pytest.fixture(scope="module")
def uninterrupted(tmp_path_factory):
    directory = tmp_path_factory.mktemp("verify") / "report"
    whole = succeeded("verify", *RESUMED_CASES, "-o", directory, cwd=directory.parent)
    assert re.search(r"\(1 of 3, about \d+ s left\)", whole.stderr)
    return directory


def test_killed_verification_goes_on_where_it_stopped(uninterrupted, tmp_path):
    for name in FILES:  # an earlier report, which must not pass for that of the killed one
        shutil.copy(uninterrupted / name, tmp_path)
    subprocess.run(
        [sys.executable, "-c", KILLED, "verify", *RESUMED_CASES, "-o", tmp_path, "--workers", "1"],
        capture_output=True,
        timeout=600,
        check=False,
    )
    kept = records(tmp_path)
    assert len(kept) == 2
    assert not any((tmp_path / name).exists() for name in FILES)
    assert report(tmp_path / EARLIER) == report(uninterrupted)

    again = succeeded(
        "verify", *RESUMED_CASES, "-o", tmp_path, "--workers", "1", cwd=tmp_path.parent
    )
    assert again.stderr.count("already there") == len(kept)
    assert records(tmp_path) | kept == records(tmp_path)
    assert report(tmp_path) == report(uninterrupted)
    assert not (tmp_path / EARLIER).exists()


def test_lost_case_is_a_failed_verdict():
    (case,) = choose(Level.QUICK, ["hertz_approach_control"])
    outcome = lost(case, "its worker was killed")
    assert outcome.status is Status.FAIL
    assert [verdict.name for verdict in outcome.verdicts] == ["solved"]
    assert "its worker was killed" in outcome.verdicts[0].meaning
