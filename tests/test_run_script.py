"""Tests of the script `./run`: tests run on all cores unless a file or a number is given."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest
from conftest import LONGEST

ROOT = Path(__file__).resolve().parents[1]
# Says its version, runs no code, installs nothing, and repeats whatever else it is asked.
PYTHON = """#!/bin/sh
case $1 in -VV) echo Python ;; -c) ;; *) echo "$@" ;; esac
"""
SPREAD = "--numprocesses auto --dist loadfile --no-loadscope-reorder"


@pytest.fixture
def clone(tmp_path):
    """What `run` needs, with a Python that repeats its arguments."""
    for name in ("run", "pyproject.toml", "constraints.txt"):
        shutil.copy(ROOT / name, tmp_path)
    binaries = tmp_path / ".venv" / "bin"
    binaries.mkdir(parents=True)
    (binaries / "python").write_text(PYTHON, encoding="utf-8")
    (binaries / "python").chmod(0o755)
    return tmp_path


@pytest.mark.parametrize(
    ("options", "spread"),
    [
        ("", True),
        ("-q", True),
        ("-k grid", True),
        ("-m slow --timeout 9", True),
        ("--ignore=tests/test_plan.py", True),
        ("tests/test_plan.py -q", False),
        ("tests/test_grid.py::test_it", False),
        ("-n 0", False),
        ("-n0 -q", False),
        ("--numprocesses=3", False),
    ],
)
def test_tests_run_on_every_core_unless_a_file_or_n_is_named(options, spread, clone):
    said = subprocess.run(
        ["bash", clone / "run", "test", *options.split()],
        env=os.environ | {"PYTHON": str(clone / ".venv" / "bin" / "python")},
        capture_output=True,
        text=True,
        check=True,
    ).stdout.split()
    assert said == ["-m", "pytest", *(SPREAD.split() if spread else []), *options.split()]


def test_files_that_begin_first_are_there():
    assert {*LONGEST} <= {path.stem for path in (ROOT / "tests").glob("test_*.py")}
