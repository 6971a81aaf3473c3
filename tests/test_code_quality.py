"""Tests that run the code checkers: ruff and codespell on all files, mypy on the packages."""

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]

# mypy keeps nearly all that it makes: looking for garbage is a fifth of its time.
MYPY = """
import gc
gc.disable()
gc.enable = lambda: None
from mypy.__main__ import console_entry
console_entry()
"""
COMMANDS = {
    "lint": ("-m", "ruff", "check", "--no-fix", "."),
    "format": ("-m", "ruff", "format", "--check", "."),
    "types": ("-c", MYPY),
    "spelling": ("-m", "codespell_lib"),
}


@pytest.mark.parametrize("command", COMMANDS.values(), ids=COMMANDS)
def test_code_reads_clean(command):
    outcome = subprocess.run(
        [sys.executable, *command], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert outcome.returncode == 0, outcome.stdout + outcome.stderr
