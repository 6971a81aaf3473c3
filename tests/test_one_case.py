"""Tests of verification cases: one case imports only its own module and solvers."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from contact_results.blas_threads import (
    ONE,
    VARIABLES,
)
from verification.cases.catalogue import CASES, MODULE_OF

# What a command has loaded when its first case goes to a worker.
AT_WORK = """
from slipstick.cli.application import main
from verification.running.case_pool import LocalWorkers
def submit(self, *asked):
    print(*sys.modules)
    sys.exit()
import sys
LocalWorkers.submit = submit
main(sys.argv[1:])
"""
JUDGED = """
import sys
from verification.cases.catalogue import CaseToJudge
CaseToJudge(sys.argv[1], "QUICK").compute()
print(*sys.modules)
"""


def loaded(program: str, *arguments: str, cwd: Path) -> set[str]:
    """Names of the modules that a program lists in its last line."""
    ended = subprocess.run(
        [sys.executable, "-c", program, *arguments],
        capture_output=True,
        text=True,
        check=True,
        cwd=cwd,
        env=os.environ | dict.fromkeys(VARIABLES, ONE),
    )
    return set(ended.stdout.splitlines()[-1].split())


def within(modules: set[str], *rooms: str) -> set[str]:
    """The modules of these rooms."""
    return {name for name in modules for room in rooms if f"{name}.".startswith(f"{room}.")}


@pytest.mark.parametrize("program", [AT_WORK, JUDGED], ids=["command", "worker"])
def test_one_case_loads_no_other(program: str, tmp_path: Path) -> None:
    asked = ("verify", "hertz_point", "--workers", "1") if program is AT_WORK else ("hertz_point",)
    modules = loaded(program, *asked, cwd=tmp_path)
    assert "verification.cases.indenters" in modules
    others = {MODULE_OF.get(name, name) for name in CASES} - {"indenters"}
    assert not within(modules, *(f"verification.cases.{name}" for name in others))
    assert not within(
        modules,
        "fem_reference",
        "skfem",
        "matplotlib",
        "jinja2",
        "verification.studies",
        "verification.defects",
        "verification.peers",
        "verification.report.page",
        "verification.report.drawing",
    )
