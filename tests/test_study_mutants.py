"""Mutants: one operator at a time, killed by the tests of their kernel or listed."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

from verification.judging.case import Level
from verification.judging.outcome import Status
from verification.running.row import CaseRecord
from verification.running.study import Settings
from verification.studies.mutants import runs
from verification.studies.mutants.mutation import mutants
from verification.studies.mutants.runs import HEALTHY, KERNELS, MutantRun
from verification.studies.mutants.study import NOT_SAID, cases, conclude

SOURCE = """
Number = int | float

def below(a: int | None, b):
    # Neither is a number.
    return -a * 2 if not a < b else b
"""
FULL = Settings(Level.FULL)


def test_each_mutant_differs_in_one_operator_and_no_type_is_touched() -> None:
    found = list(mutants(SOURCE))
    assert [(m.old, m.new) for m in found] == [
        ("not a < b", "not not a < b"), ("a < b", "a <= b"), ("a < b", "a >= b"),
        ("-a * 2", "-a / 2"), ("-a", "--a"),
    ]  # fmt: skip
    assert {mutant.line for mutant in found} == {6}
    texts = {mutant.text for mutant in found}
    assert len(texts | {ast.unparse(ast.parse(SOURCE))}) == len(found) + 1
    assert all("int | None" in text and "int | float" in text for text in texts)


def test_a_mutant_is_killed_by_a_test_that_fails_and_by_no_other(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for folder, name, text in (
        ("kernel", "adds.py", "def add(a, b):\n    return a + b * 1\n"),
        ("tests", "test_adds.py",
         "from kernel.adds import add\n\ndef test_adds():\n    assert add(2, 3) == 5\n"),
    ):  # fmt: skip
        (tmp_path / folder).mkdir()
        (tmp_path / folder / name).write_text(text)
    (tmp_path / "pyproject.toml").touch()
    monkeypatch.setattr(runs, "ROOT", tmp_path)
    monkeypatch.setattr(runs, "COPIED", ("kernel", "tests"))
    monkeypatch.setitem(KERNELS, "kernel/adds.py", ("test_adds",))
    words = [MutantRun("kernel/adds.py", number).compute().words for number in (HEALTHY, 0, 1)]
    assert words == [
        {},
        {"old": "a + b * 1", "new": "a - b * 1", "killed_by": "test_adds"},
        {"old": "b * 1", "new": "b / 1"},
    ]
    assert "+" in (tmp_path / "kernel" / "adds.py").read_text()
    (tmp_path / "tests" / "test_adds.py").unlink()
    with pytest.raises(ChildProcessError, match="test_adds"):
        MutantRun("kernel/adds.py", 0).compute()


@pytest.mark.parametrize(("part", "status"), [(0.95, Status.PASS), (0.85, Status.FAIL)])
def test_nine_in_ten_have_to_be_killed(part: float, status: Status) -> None:
    asked = cases(FULL)
    mutated = [run for run in asked if run.number != HEALTHY]
    dead = set(mutated[: round(part * len(mutated))])
    records = {
        run.name: CaseRecord(
            parameters={"kernel": run.kernel, "number": run.number}, counters={"line": 1},
            words={"old": "a", "new": "b"} | ({"killed_by": "test"} if run in dead else {}),
        )
        for run in asked
    }  # fmt: skip
    concluded = conclude(FULL, records)
    assert [one.outcome for one in concluded.statements] == [Status.PASS, Status.PASS, status]
    survivors = concluded.tables[1].rows
    assert len(survivors) == len(mutated) - len(dead)
    assert {row[-1] for row in survivors} == {NOT_SAID}
    broken = next(run.name for run in asked if run.number == HEALTHY)
    records[broken] = records[broken].model_copy(update={"words": {"killed_by": "test"}})
    assert conclude(FULL, records).statements[1].outcome is Status.FAIL
    few = dict(list(records.items())[:50])
    assert conclude(FULL, few).statements[2].outcome is Status.INCONCLUSIVE


def test_at_least_150_mutants_of_seven_kernels_decide() -> None:
    asked = [run for run in cases(FULL) if run.number != HEALTHY]
    assert len(asked) >= 150
    assert {run.kernel for run in asked} == set(KERNELS)
    assert len(set(asked)) == len(asked)
