"""The tools that read the code agree with it: ruff and codespell on everything, mypy on the
packages."""

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]

COMMANDS = {
    "lint": ("ruff", "check", "--no-fix", "."),
    "format": ("ruff", "format", "--check", "."),
    "types": ("mypy",),
    "spelling": ("codespell_lib",),
}


@pytest.mark.parametrize("command", COMMANDS.values(), ids=COMMANDS)
def test_code_reads_clean(command: tuple[str, ...]) -> None:
    outcome = subprocess.run(
        [sys.executable, "-m", *command], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert outcome.returncode == 0, outcome.stdout + outcome.stderr
