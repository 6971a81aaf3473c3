"""A killed verification loses no finished case; its report is that of one that was not killed."""

import json
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from command import outcome, signalled

from verification.cases.catalogue import choose
from verification.cases.judged_case import lost
from verification.judging.case import Level
from verification.judging.outcome import Status
from verification.report.files import EARLIER, FILES, PAGE, RECORD

ROOT = Path(__file__).resolve().parents[1]
# Of every kind: on a surface grid, on a section, and without a solve.
CASES = ("dissimilar_bodies", "fem_indentation", "flat_punch", "layered_identities")
PROGRAM = f"""
import sys
sys.path.insert(0, {str(ROOT)!r})
from slipstick.cli import main
"""


def started(directory: Path, *options: str, dying: str = "") -> "subprocess.Popen[str]":
    code = PROGRAM + dying + "main()"
    return subprocess.Popen(
        [sys.executable, "-c", code, "verify", *CASES, "-o", str(directory), *options],
        cwd=directory.parent, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip


def ended(process: "subprocess.Popen[str]") -> tuple[str, str]:
    return process.communicate(timeout=600)


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
def uninterrupted(tmp_path_factory: pytest.TempPathFactory) -> Path:
    directory = tmp_path_factory.mktemp("verify") / "report"
    process = started(directory, "--workers", "1")
    _, log = ended(process)
    assert process.returncode == 0, log
    assert re.search(r"\(1 of 4, about \d+ s left\)", log)
    return directory


def test_killed_verification_goes_on_where_it_stopped(uninterrupted: Path, tmp_path: Path) -> None:
    for name in FILES:  # an earlier report, which must not pass for that of the killed one
        shutil.copy(uninterrupted / name, tmp_path)
    ended(started(tmp_path, "--workers", "1", dying=signalled("SIGKILL", saved=2)))
    kept = records(tmp_path)
    assert len(kept) == 2
    assert not any((tmp_path / name).exists() for name in FILES)
    assert report(tmp_path / EARLIER) == report(uninterrupted)

    again = outcome("verify", *CASES, "-o", tmp_path, "--workers", "1", cwd=tmp_path.parent)
    assert again.returncode == 0, again.stderr
    assert again.stderr.count("already there") == len(kept)
    assert records(tmp_path) | kept == records(tmp_path)
    assert report(tmp_path) == report(uninterrupted)
    assert not (tmp_path / EARLIER).exists()


def test_damaged_record_is_named_and_computed_again(uninterrupted: Path, tmp_path: Path) -> None:
    target = tmp_path / "cases"
    target.mkdir()
    for path in (uninterrupted / "cases").glob("[a-z]*.json"):
        content = path.read_bytes()
        damaged = path.name.startswith("layered_identities")
        (target / path.name).write_bytes(content[:-100] if damaged else content)
    again = outcome("verify", *CASES, "-o", tmp_path, "--workers", "1", cwd=tmp_path.parent)
    log = again.stderr
    assert again.returncode == 0, log
    assert log.count("is damaged") == 1
    assert log.count("already there") == len(CASES) - 1
    assert report(tmp_path) == report(uninterrupted)


def test_lost_case_is_a_failed_verdict() -> None:
    (case,) = choose(Level.QUICK, ["load_paths"])
    outcome = lost(case, "its worker was killed")
    assert outcome.status is Status.FAIL
    assert [verdict.name for verdict in outcome.verdicts] == ["solved"]
    assert "its worker was killed" in outcome.verdicts[0].meaning
