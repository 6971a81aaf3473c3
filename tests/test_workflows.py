"""Tests of the workflows: commands exist, jobs end, actions are pinned, no test is skipped."""

import os
import re
import shlex
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from slipstick.cli.application import ALL_COMMANDS, MAINTAIN
from verification.report.summary_text import TITLES
from verification.studies.catalogue import STUDIES

ROOT = Path(__file__).resolve().parents[1]


CONFTEST = Path(__file__).with_name("conftest.py")
SKIPPED = {
    "in_the_test": "def test_it(): pytest.importorskip('no_such_package')",
    "by_a_mark": "@pytest.mark.skip(reason='tired')\ndef test_it(): pass",
    "with_its_module": "pytest.importorskip('no_such_package')\ndef test_it(): pass",
}
EXPECTED_FAILURE = {"expected": "@pytest.mark.xfail\ndef test_it(): assert 0"}


def run_pytest(folder: Path, sources: dict[str, str], no_skip: str) -> str:
    """What it says at its end, test by test, of a module of each source."""
    (folder / "conftest.py").write_text(CONFTEST.read_text(encoding="utf-8"), encoding="utf-8")
    for name, source in sources.items():
        (folder / f"test_{name}.py").write_text(f"import pytest\n{source}\n", encoding="utf-8")
    return subprocess.run(
        [
            sys.executable,
            "-m",
            "pytest",
            "-rA",
            "--continue-on-collection-errors",
            "-p",
            "no:cacheprovider",
            "--rootdir",
            folder,
            folder,
        ],
        env=os.environ | {"SLIPSTICK_NO_SKIP": no_skip},
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
    ).stdout


def test_skip_fails_where_forbidden_and_an_expected_failure_is_none(tmp_path):
    said = run_pytest(tmp_path, SKIPPED | EXPECTED_FAILURE, no_skip="1")
    for name in SKIPPED:
        assert re.search(rf"^(FAILED|ERROR) test_{name}\.py", said, re.MULTILINE), said
    assert said.count("skipped although SLIPSTICK_NO_SKIP=1") >= len(SKIPPED)
    assert "XFAIL test_expected.py" in said
    assert re.search(r"^=+ 1 failed, 1 xfailed, 2 errors in", said, re.MULTILINE), said


WORKFLOWS = ROOT / ".github" / "workflows"
NIGHTLY = (WORKFLOWS / "nightly.yml").read_text(encoding="utf-8")
LONGEST_JOB = 360  # minutes, after which the service ends it without a word


def studies_of_the_night() -> list[str]:
    matrix = re.search(r"^ +name:\n((?: +- .+\n)+)", NIGHTLY, re.MULTILINE)
    return [line.strip().removeprefix("- ") for line in matrix[1].splitlines()]


def commands() -> Iterator[str]:
    """Every call of slipstick, with the studies of the night one by one."""
    for path in (*WORKFLOWS.glob("*.yml"), ROOT / ".github" / "compare.sh"):
        text = path.read_text(encoding="utf-8").replace("./run", "").replace(".venv/bin/", "")
        for call in re.findall(r"(?:^|&&|run:) *slipstick (.+?)(?: \|\| .*)?$", text, re.MULTILINE):
            yield from (
                call.replace("${{ matrix.name }}", study)
                for study in (studies_of_the_night() if "matrix" in call else [""])
            )


@pytest.mark.parametrize("command", sorted(commands()))
def test_commands_of_the_workflows_are_known(command):
    called = shlex.split(command)
    name, *words = called[called[0] == MAINTAIN :]
    known = ALL_COMMANDS[" ".join(called[: len(called) - len(words)])]
    assert known
    values = known.load(name).make_context(name, without_shell(words)).params
    if name == "study":
        assert values["name"] in STUDIES


def without_shell(words: list[str]) -> list[str]:
    """With a number in the place of a number that the shell finds."""
    return ["2" if word == "$(nproc)" else word for word in words]


def test_all_ways_to_the_program_are_looked_at():
    called = {" ".join(command.split()[:2]).split(" --")[0] for command in commands()}
    assert called == {"verify", "maintain study", "maintain compare", "maintain records"}


def test_every_job_ends_by_itself():
    workflows = [*WORKFLOWS.glob("*.yml")]
    assert workflows
    for path in workflows:
        text = path.read_text(encoding="utf-8")
        minutes = [int(number) for number in re.findall(r"timeout-minutes: (\d+)", text)]
        assert len(minutes) == text.count("runs-on:")
        assert max(minutes) < LONGEST_JOB


def test_actions_are_pinned_by_commit():
    """A tag can be moved to other code; it stands beside for people."""
    texts = [path.read_text(encoding="utf-8") for path in (ROOT / ".github").rglob("*.yml")]
    actions = [used for text in texts for used in re.findall(r"uses: (.+)", text)]
    pinned = re.compile(r"\./.*|[\w/-]+@[0-9a-f]{40} # v[\d.]+")
    assert actions
    assert [used for used in actions if not pinned.fullmatch(used)] == []


def test_every_study_of_the_report_is_computed_at_night():
    alone = [study for study in studies_of_the_night() if " " not in study]
    assert alone == sorted(TITLES.keys() & STUDIES.keys())


def test_studies_that_the_report_shows_are_in_the_catalogue():
    assert TITLES.keys() <= STUDIES.keys()
