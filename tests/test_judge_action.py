"""Tests of the GitHub action that judges solvers: its exit code is that of the command."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from verification import Answer, judge
from verification.challenge.saved_judgements import save_judgement
from verification.problems.problem import HERTZ

ACTION = Path(__file__).resolve().parents[1] / ".github" / "actions" / "judge"
SLIPSTICK = Path(sys.executable).with_name("slipstick")
# A function that imports the problem would import all solvers, in its own process.
FILE = f"""
from verification import Answer
APPROACH, RADIUS = {HERTZ.approach!r}, {HERTZ.contact_radius!r}

def right(problem, level):
    return Answer(1e-5, {{("approach", 1): APPROACH, ("contact_radius", 1): RADIUS}})

def off(problem, level):
    return Answer(1e-5, {{("approach", 1): 1.05 * APPROACH}})
"""


def act(folder: Path, **inputs: str) -> tuple[int, str]:
    """Exit code, and what the page of the job shows."""
    summary = folder / "summary.md"
    given = {"SLIPSTICK": str(SLIPSTICK), "GITHUB_STEP_SUMMARY": str(summary), "LEVELS": "1"}
    done = subprocess.run(
        ["bash", ACTION / "judge.sh"],
        cwd=folder,
        env={**os.environ, **given, **inputs},
        capture_output=True,
        text=True,
        check=False,
    )
    return done.returncode, summary.read_text() if summary.exists() else done.stderr


def test_a_failure_on_any_case_is_that_of_the_action(tmp_path):
    (tmp_path / "mine.py").write_text(FILE)
    code, page = act(
        tmp_path, SOLVER="mine.py:off", CASES="hertz_point coated_paraboloid/E1_over_E2=2"
    )
    assert code == 1
    assert re.findall(r"^- (\S+) \| mine.py:off", page, re.MULTILINE) == [
        "hertz_point",
        "coated_paraboloid/E1_over_E2=2",
    ]
    exact = {("approach", 1): HERTZ.approach, ("contact_radius", 1): HERTZ.contact_radius}
    two_levels = judge("hertz_point", lambda *_: Answer(1e-5, exact), 2, seconds=None)
    save_judgement(two_levels, tmp_path / "saved.json")
    given = {"STRICT": "true", "GRADE": "A", "AGAINST": "saved.json"}
    code, page = act(tmp_path, SOLVER="mine.py:right", CASES="hertz_point", **given)
    assert (code, "class A" in page) == (7, True)  # a level is missing
    assert (tmp_path / "judged" / "hertz_point" / "badge.json").is_file()


@pytest.mark.parametrize("inputs", [{}, {"SOLVER": "a.py:f", "ANSWERS": "b"}, {"ANSWERS": "none"}])
def test_inputs_that_name_nothing_to_judge_are_refused(tmp_path, inputs):
    assert act(tmp_path, **inputs)[0] == 2


def test_pip_gets_versions_that_it_takes_with_a_folder(tmp_path):
    """With a hash among them it would install no folder."""
    said = tmp_path / "said"
    stand_in = tmp_path / "python"
    stand_in.write_text(f"""#!/bin/sh\necho "$@" >{said}\ncat "$6" >>{said}\n""")
    stand_in.chmod(0o755)
    path = f"{tmp_path}{os.pathsep}{os.environ['PATH']}"
    subprocess.run(["bash", ACTION / "install.sh"], env={**os.environ, "PATH": path}, check=True)
    asked, *versions = said.read_text().splitlines()
    assert asked.startswith("-m pip install --quiet -c ")
    assert asked.endswith(f" {ACTION.parents[2]}")
    assert any(line.startswith("numpy==") for line in versions)
    assert not any("hash" in line or line.endswith("\\") for line in versions if line[:1] != "#")


def test_no_input_is_pasted_into_the_shell():
    text = (ACTION / "action.yml").read_text(encoding="utf-8")
    runs = re.findall(r"^ +run: (.+)$", text, re.MULTILINE)
    assert runs
    assert not any("${{" in run for run in runs)
