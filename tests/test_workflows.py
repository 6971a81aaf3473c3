"""What the workflows ask for exists, ends in time, and has its place in the report."""

import re
import shlex
from collections.abc import Iterator
from pathlib import Path

import pytest

from slipstick.cli.lazy_commands import ALL_COMMANDS, MAINTAIN
from verification.report.sections import TITLES
from verification.studies.catalogue import SCENE_STUDIES, STUDIES

ROOT = Path(__file__).resolve().parents[1]
WORKFLOWS = ROOT / ".github" / "workflows"
NIGHTLY = (WORKFLOWS / "nightly.yml").read_text(encoding="utf-8")
LONGEST_JOB = 360  # minutes, after which the service ends it without a word


def studies_of_the_night() -> list[str]:
    matrix = re.search(r"^ +name:\n((?: +- .+\n)+)", NIGHTLY, re.MULTILINE)
    assert matrix is not None
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
def test_commands_of_the_workflows_are_known(command: str) -> None:
    called = shlex.split(command)
    name, *words = called[called[0] == MAINTAIN :]
    known = ALL_COMMANDS[" ".join(called[: len(called) - len(words)])]
    assert known
    values = known.load(name).make_context(name, without_shell(words)).params
    if name == "study":
        study, scene = values["name"], values["scene"]
        assert study in (STUDIES if scene is None else SCENE_STUDIES)
        assert scene is None or (ROOT / scene).is_file()


def without_shell(words: list[str]) -> list[str]:
    """With a number in the place of a number that the shell finds."""
    return ["2" if word == "$(nproc)" else word for word in words]


def test_all_ways_to_the_program_are_looked_at() -> None:
    called = {" ".join(command.split()[:2]).split(" --")[0] for command in commands()}
    assert called == {"verify", "maintain study", "maintain compare", "maintain records"}


def test_every_job_ends_by_itself() -> None:
    workflows = [*WORKFLOWS.glob("*.yml")]
    assert workflows
    for path in workflows:
        text = path.read_text(encoding="utf-8")
        minutes = [int(number) for number in re.findall(r"timeout-minutes: (\d+)", text)]
        assert len(minutes) == text.count("runs-on:")
        assert max(minutes) < LONGEST_JOB


def test_actions_are_pinned_by_commit() -> None:
    """A tag can be moved to other code; it stands beside for people."""
    texts = [path.read_text(encoding="utf-8") for path in (ROOT / ".github").rglob("*.yml")]
    actions = [used for text in texts for used in re.findall(r"uses: (.+)", text)]
    pinned = re.compile(r"\./.*|[\w/-]+@[0-9a-f]{40} # v[\d.]+")
    assert actions
    assert [used for used in actions if not pinned.fullmatch(used)] == []


def test_no_workflow_writes_where_a_report_is_committed() -> None:
    """What was there before would be taken for what did not end."""
    for command in commands():
        if "--output" in (words := shlex.split(command)):
            assert words[words.index("--output") + 1].startswith("out/")
    assert "/out/" in (ROOT / ".gitignore").read_text(encoding="utf-8").split()


def test_every_study_of_the_report_is_computed_at_night() -> None:
    alone = [study for study in studies_of_the_night() if " " not in study]
    assert alone == sorted(TITLES.keys() & STUDIES.keys())


def test_studies_that_the_report_shows_are_in_the_catalogue() -> None:
    assert TITLES.keys() <= STUDIES.keys()
