"""Every script in examples/ and in the README runs and keeps its promise: it exits with 0.

That of the README runs on few cells."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
EXAMPLES = sorted((ROOT / "examples").glob("*.py"))


def assert_runs(script: Path, folder: Path) -> None:
    outcome = subprocess.run(
        [sys.executable, script], cwd=folder, capture_output=True, text=True, check=False
    )
    assert outcome.returncode == 0, outcome.stdout + outcome.stderr


def test_there_are_examples() -> None:
    assert EXAMPLES


@pytest.mark.parametrize("script", EXAMPLES, ids=lambda path: path.stem)
def test_example_keeps_its_promise(script: Path, tmp_path: Path) -> None:
    assert_runs(script, tmp_path)


def test_python_in_the_readme_runs(tmp_path: Path) -> None:
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    (block,) = re.findall(r"^```python\n(.*?)^```", readme, re.MULTILINE | re.DOTALL)
    fine = "cells=(64, 64)"
    assert fine in block
    script = tmp_path / "readme.py"
    script.write_text(block.replace(fine, "cells=(24, 24)"), encoding="utf-8")
    assert_runs(script, tmp_path)
