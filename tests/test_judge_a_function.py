"""Tests of `slipstick judge FILE.py:FUNCTION --case CASE`: exit codes and refusals."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from slipstick.cli import main

FILE = """
from verification import Answer, CannotDo
from verification.problems.problem import HERTZ

def right(problem, level):
    values = {("approach", 1): HERTZ.approach, ("contact_radius", 1): HERTZ.contact_radius}
    return Answer(1e-5, values)

def off(problem, level):
    return Answer(1e-5, {("approach", 1): 1.05 * HERTZ.approach})

def part(problem, level):
    return Answer(1e-5, {("approach", 1): HERTZ.approach})

def gives_up(problem, level):
    return Answer(1e-5, gave_up={0: "too steep"})

def raises(problem, level):
    raise RuntimeError("singular matrix")

def cannot(problem, level):
    raise CannotDo("balls only")

def nothing(problem, level):
    return None

def no_values(problem, level):
    return Answer(1e-5, {("approach", 1): None})

def typo(problem, level):
    return Answer(1e-5, {("approach_z", 1): HERTZ.approach})

def alone(problem, level):
    return Answer(1e-5, {"approach": HERTZ.approach})

def word(problem, level):
    return Answer(1e-5, {("approach", 1): "8 um"})

def three(problem, level):
    return Answer(1e-5, {("approach", 1): [1.0, 2.0, 3.0]})

def endless(problem, level):
    return Answer(float("nan"), {("approach", 1): HERTZ.approach})

def rising(problem, level):
    return Answer(1e-5 * (1 + level), {("approach", 1): HERTZ.approach})

number = 3
"""


def judge(*arguments: object) -> int:
    try:
        main(["judge", *map(str, arguments)])
    except SystemExit as end:
        return int(end.code or 0)
    return 0


@pytest.mark.parametrize(
    ("function", "options", "code", "said"),
    [
        ("right", (), 0, "hertz_point"),
        ("right", ("--strict", "--class", "A"), 0, "class A"),
        ("off", ("--partial",), 1, "beyond class B"),
        ("part", (), 1, "partial"),
        ("part", ("--partial",), 0, "partial"),
        ("gives_up", (), 3, "too steep"),
        ("raises", (), 3, "singular matrix"),
        ("cannot", (), 0, "cannot: balls only"),
        ("cannot", ("--strict",), 6, "cannot: balls only"),
        ("missing", (), 2, "has no function 'missing'"),
        ("number", (), 2, "has no function 'number'"),
        ("nothing", (), 2, "NoneType came back, expected an Answer"),
        ("no_values", (), 2, "nothing to judge"),
        ("typo", (), 2, "('approach_z', 1) is not asked; asked: ('approach', 1)"),
        ("alone", (), 2, "'approach', expected a quantity and a loading step"),
        ("word", (), 2, "is '8 um', expected a number"),
        ("three", (), 2, "has 3 numbers, expected one"),
        ("endless", (), 2, "h is nan, expected a positive length"),
        ("rising", ("--levels", "2"), 2, "levels go from coarse to fine"),
    ],
)
def test_the_exit_code_says_how_a_function_did(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], function: str,
    options: tuple[str, ...], code: int, said: str,
) -> None:  # fmt: skip
    file = tmp_path / "mine.py"
    file.write_text(FILE)
    case = ("--case", "hertz_point", "--levels", "1")
    assert judge(f"{file}:{function}", *case, *options) == code
    told = capsys.readouterr()
    assert said in told.out + told.err


def test_a_file_imports_what_lies_beside_it(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "path", list(sys.path))
    (tmp_path / "kernel_of_a_stranger.py").write_text(FILE)
    beside, lost = tmp_path / "beside.py", tmp_path / "lost.py"
    beside.write_text("from kernel_of_a_stranger import right\n")
    lost.write_text("from no_such_kernel import right\n")
    asked = ("--case", "hertz_point", "--levels", "1")
    assert judge(f"{beside}:right", *asked) == 0
    assert judge(f"{lost}:right", *asked) == 2
    assert (
        f"{lost.name}: ModuleNotFoundError: No module named 'no_such_kernel'"
        in capsys.readouterr().err
    )


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("none.py:solve", "--case", "hertz_point"), "none.py: no such file"),
        (("no_module:solve", "--case", "hertz_point"), "No module named 'no_module'"),
        (("none.py:solve",), "needs --case"),
        (("none.py:solve", "--case", "hertz_pont"), "hertz_point"),
        (("folder", "--case", "hertz_point"), "--case applies to functions"),
        (("folder",), "expected the folder of 'slipstick challenge export'"),
    ],
)
def test_what_names_no_solver_is_refused(
    capsys: pytest.CaptureFixture[str], arguments: tuple[str, ...], said: str
) -> None:
    assert judge(*arguments) == 2
    assert said in capsys.readouterr().err.replace("\n", " ")


def test_our_own_solvers_are_named_by_their_module() -> None:
    solver = "verification.adapters.own_solvers:answer_on_radii"
    assert judge(solver, "--case", "coated_paraboloid/E1_over_E2=2", "--levels", "2") == 0
