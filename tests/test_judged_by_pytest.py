"""pytest judges solvers: verdicts are its outcomes, and what got worse fails."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from verification.challenge.cases import challenges
from verification.challenge.named_solver import named_solver
from verification.problems.paper_scene import HERTZ

# pytester forgets what an inner run imports: what is imported here need not be made again.
assert challenges()
assert named_solver
pytest_plugins = ["pytester"]
SOLVER = f"""
from verification import Answer, CannotDo
CASES, LEVELS = ["hertz_point"], 2

def solve(problem, level):
    approach = {HERTZ.approach!r} * (1 + OFF / 4**level)
    return Answer(1e-5 / 2**level, {{("approach", 1): approach,
                                     ("contact_radius", 1): {HERTZ.contact_radius!r} * (1 + 1e-5)}})
"""


def solver(pytester: pytest.Pytester, off: float = 1e-4, more: str = "") -> None:
    pytester.makepyfile(challenge_mine=f"OFF = {off}\n{SOLVER}\n{more}")


def run(pytester: pytest.Pytester, *options: str) -> pytest.RunResult:
    return pytester.runpytest_inprocess("-p", "verification.judged_by_pytest", "-rs", *options)


def test_nothing_is_collected_unless_asked(pytester: pytest.Pytester) -> None:
    solver(pytester)
    assert run(pytester).ret == pytest.ExitCode.NO_TESTS_COLLECTED


def test_verdicts_are_outcomes_and_what_is_omitted_is_skipped(pytester: pytest.Pytester) -> None:
    solver(pytester)
    found = run(pytester, "--slipstick")
    found.assert_outcomes(passed=2, skipped=2)  # central pressure and pressure are not answered
    assert found.ret == 0


@pytest.mark.parametrize(("more", "failed"), [("", 1), ("PARTIAL = True", 0)])
def test_a_required_number_that_is_omitted_fails(
    pytester: pytest.Pytester, more: str, failed: int
) -> None:
    solver(pytester, more=more)
    path = Path("challenge_mine.py")
    path.write_text(path.read_text().replace('("contact_radius", 1)', '("central_pressure", 1)'))
    run(pytester, "--slipstick", "-k", "::contact_radius").assert_outcomes(
        failed=failed, skipped=1 - failed, deselected=3
    )


def test_strictly_what_is_omitted_fails(pytester: pytest.Pytester) -> None:
    solver(pytester)
    run(pytester, "--slipstick-strict").assert_outcomes(passed=2, failed=2)


def test_an_error_beyond_its_class_fails_in_words(pytester: pytest.Pytester) -> None:
    solver(pytester, off=0.05)
    found = run(pytester, "--slipstick")
    found.assert_outcomes(passed=1, failed=1, skipped=2)
    found.stdout.fnmatch_lines(["*approach, step 1 (error 0.0125): beyond class B*"])


def test_what_is_worse_than_recorded_fails_though_allowed(pytester: pytest.Pytester) -> None:
    solver(pytester, off=4e-4)
    assert run(pytester, "--slipstick-record", "kept.json").ret == 0
    assert json.loads(Path("kept.json").read_text())
    run(pytester, "--slipstick-baseline", "kept.json").assert_outcomes(passed=2, skipped=2)
    for off, worse in ((5e-4, 0), (6.5e-4, 1), (2e-4, 0)):
        solver(pytester, off)
        found = run(pytester, "--slipstick-baseline", "kept.json")
        found.assert_outcomes(passed=2 - worse, failed=worse, skipped=2)
    solver(pytester, 6.5e-4)
    run(pytester, "--slipstick-baseline", "kept.json").stdout.fnmatch_lines(["*recorded 0.0001*"])


def test_what_is_not_recorded_fails(pytester: pytest.Pytester) -> None:
    solver(pytester)
    Path("kept.json").write_text("{}")
    found = run(pytester, "--slipstick-baseline", "kept.json")
    found.assert_outcomes(failed=2, skipped=2)


def test_what_was_answered_and_is_no_longer_fails(pytester: pytest.Pytester) -> None:
    solver(pytester)
    key = "challenge_mine.py::hertz_point::pressure"
    Path("kept.json").write_text(json.dumps({key: {"pressure 1": 1e-3}}))
    found = run(pytester, "--slipstick-baseline", "kept.json", "-k", "::pressure")
    found.assert_outcomes(failed=1, deselected=3)
    found.stdout.fnmatch_lines(["*no longer answered*"])


@pytest.mark.parametrize("text", [None, "[]", "nonsense", '{"a": 1}', '{"a": {"b": "c"}}'])
def test_a_record_that_is_none_is_refused_at_once(
    pytester: pytest.Pytester, text: str | None
) -> None:
    solver(pytester)
    if text is not None:
        Path("kept.json").write_text(text)
    found = run(pytester, "--slipstick-baseline", "kept.json")
    assert found.ret == pytest.ExitCode.USAGE_ERROR
    found.stderr.fnmatch_lines(["*kept.json: no record*"])


def test_a_solver_that_cannot_is_skipped_with_its_reason(pytester: pytest.Pytester) -> None:
    solver(pytester, more="def solve(problem, level):\n    raise CannotDo('balls only')")
    found = run(pytester, "--slipstick")
    found.assert_outcomes(skipped=4)
    found.stdout.fnmatch_lines(["*cannot: balls only*"])


@pytest.mark.parametrize(
    ("more", "said"),
    [("CASES = ['hertz']", "no challenge 'hertz'"), ("del solve", "no solve; expected")],
)
def test_a_file_that_names_no_challenge_or_solver_is_refused(
    pytester: pytest.Pytester, more: str, said: str
) -> None:
    solver(pytester, more=more)
    found = run(pytester, "--slipstick")
    assert found.ret == pytest.ExitCode.INTERRUPTED
    found.stdout.fnmatch_lines([f"*{said}*"])


def test_a_solver_that_raises_fails_where_it_does(pytester: pytest.Pytester) -> None:
    solver(pytester, more="def solve(problem, level):\n    return 1 / 0")
    found = run(pytester, "--slipstick")
    found.assert_outcomes(failed=4)
    found.stdout.fnmatch_lines(["*ZeroDivisionError*"])
