"""Mutants: one change at a time, of every kind, detected by a test that fails."""

import ast
from pathlib import Path

import pytest

from verification.judging.case import Level
from verification.judging.outcome import Status
from verification.running.study import CaseRecord, Settings
from verification.studies import mutants
from verification.studies.mutants import HEALTHY, KERNELS, MutantRun, cases, conclude

SOURCE = """
Number = int | float

def below(a: int | None, b):
    return -a * 2.0 if not a < b[1] else b
"""
CHANGES = [
    ("comparison", "not a < b[1]", "not not a < b[1]"),
    ("comparison", "a < b[1]", "a <= b[1]"), ("comparison", "a < b[1]", "a >= b[1]"),
    ("index", "1", "2"),
    ("factor", "-a * 2.0", "-a / 2.0"), ("sign", "-a", "--a"), ("constant", "2.0", "2.2"),
]  # fmt: skip


def test_each_mutant_has_one_change_and_no_type_is_changed() -> None:
    found = list(mutants.mutants(SOURCE))
    assert [(m.kind, m.old, m.new) for m in found] == CHANGES
    texts = {mutant.text for mutant in found}
    assert len(texts | {ast.unparse(ast.parse(SOURCE))}) == len(found) + 1
    assert all("int | None" in text and "int | float" in text for text in texts)


def test_a_mutant_is_detected_by_a_test_that_fails_and_by_no_other(
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
    monkeypatch.setattr(mutants, "ROOT", tmp_path)
    monkeypatch.setattr(mutants, "COPIED", ("kernel", "tests"))
    monkeypatch.setitem(KERNELS, "kernel/adds.py", ("test_adds",))
    words = [MutantRun("kernel/adds.py", number).compute().words for number in (HEALTHY, 0, 1)]
    assert [word.get("killed_by") for word in words] == [None, "test_adds", None]
    assert "+" in (tmp_path / "kernel" / "adds.py").read_text()
    (tmp_path / "tests" / "test_adds.py").unlink()
    with pytest.raises(ChildProcessError, match="test_adds"):
        MutantRun("kernel/adds.py", 0).compute()


def test_every_kernel_and_its_tests_exist() -> None:
    root = mutants.ROOT
    for kernel, tests in KERNELS.items():
        assert (root / kernel).is_file(), kernel
        assert all((root / "tests" / f"{name}.py").is_file() for name in tests), kernel


@pytest.mark.parametrize(("part", "status"), [(0.95, Status.PASS), (0.85, Status.FAIL)])
def test_nine_in_ten_have_to_be_detected(part: float, status: Status) -> None:
    settings = Settings(Level.FULL)
    asked = cases(settings)
    mutated = [run for run in asked if run.number != HEALTHY]
    assert len(KERNELS) == 12
    assert len(mutated) >= 150
    dead = set(mutated[: round(part * len(mutated))])
    records = {
        run.name: CaseRecord(
            parameters={"kernel": run.kernel}, counters={"line": 1},
            words={"kind": "sign", "old": "a", "new": "b"} | dict.fromkeys(
                ["killed_by"] if run in dead else [], "test"
            ),
        )
        for run in asked
    }  # fmt: skip
    concluded = conclude(settings, records)
    assert [one.outcome for one in concluded.statements] == [Status.PASS, Status.PASS, status]
    assert len(concluded.tables[1].rows) == len(mutated) - len(dead)
    few = dict(list(records.items())[:50])
    assert conclude(settings, few).statements[2].outcome is Status.INCONCLUSIVE
