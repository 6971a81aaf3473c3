"""Tests of the pytest plugin that judges solvers: verdicts become test outcomes."""

import pytest

from verification import Answer
from verification.challenge.cases import challenges
from verification.challenge.python_api import judge
from verification.challenge.saved_judgements import save_judgement
from verification.challenge.solver_process import Posed
from verification.problems.problem import HERTZ

# pytester forgets what an inner run imports: what is imported here need not be made again.
assert challenges()
assert judge
pytest_plugins = ["pytester"]
SOLVER = f"""
from verification import Answer, CannotDo
CASES, LEVELS = ["hertz_point"], 2

def solve(problem, level):
    approach = {HERTZ.approach!r} * (1 + OFF / 4**level)
    return Answer(1e-5 / 2**level, {{("approach", 1): approach,
                                     (RADIUS, 1): {HERTZ.contact_radius!r} * (1 + 1e-5)}})
"""
OUTCOMES = {
    "good": ("", "--slipstick", {"passed": 1}, ""),
    "not asked": ("", "-q", {}, ""),
    "wrong": ("OFF = 0.05", "--slipstick", {"failed": 1}, "*beyond class B*"),
    "omitted": ("RADIUS = 'central_pressure'", "--slipstick", {"failed": 1}, "*omitted*"),
    "partial": (
        "RADIUS, PARTIAL, CLASS = 'central_pressure', True, 'C'",
        "--slipstick",
        {"failed": 1},
        "*central_pressure*",
    ),
    "cannot": (
        "def solve(problem, level):\n    raise CannotDo('balls only')",
        "--slipstick",
        {"skipped": 1},
        "*cannot: balls only*",
    ),
    "strictly cannot": (
        "def solve(problem, level):\n    raise CannotDo('balls only')",
        "--slipstick-strict",
        {"failed": 1},
        "*cannot: balls only*",
    ),
    "raises": (
        "def solve(problem, level):\n    return 1 / 0",
        "--slipstick",
        {"failed": 1},
        "*ZeroDivisionError*",
    ),
    "worse than saved": (
        "OFF, AGAINST = 1.6e-3, 'saved.json'",
        "--slipstick",
        {"failed": 1},
        "*worse hertz_point/approach*was error 0.0001*",
    ),
    "as saved": ("AGAINST = 'saved.json'", "--slipstick", {"passed": 1}, ""),
    "cannot any more": (
        "AGAINST = 'saved.json'\ndef solve(problem, level):\n    raise CannotDo('balls only')",
        "--slipstick",
        {"failed": 1},
        "*cannot: balls only*",
    ),
    "nothing saved": (
        "AGAINST = 'no.json'",
        "--slipstick",
        {"failed": 1},
        "*no.json cannot be read*--save*",
    ),
    "no challenge": ("CASES = ['hertz']", "--slipstick", {"errors": 1}, "*no challenge 'hertz'*"),
    "no solver": ("del solve", "--slipstick", {"errors": 1}, "*no solve; expected*"),
}


def answer(problem: Posed, level: int) -> Answer:
    """The solver of the file with OFF = 4e-4."""
    values = {
        ("approach", 1): HERTZ.approach * (1 + 4e-4 / 4**level),
        ("contact_radius", 1): HERTZ.contact_radius * (1 + 1e-5),
    }
    return Answer(1e-5 / 2**level, values)


@pytest.mark.parametrize("name", OUTCOMES)
def test_verdicts_are_outcomes(pytester, name):
    more, option, outcome, said = OUTCOMES[name]
    pytester.makepyfile(challenge_mine=f"OFF, RADIUS = 1e-4, 'contact_radius'\n{SOLVER}\n{more}")
    judgement = judge("hertz_point", answer, 2)
    save_judgement(judgement, pytester.path / "saved.json")
    found = pytester.runpytest_inprocess("-p", "verification.judged_by_pytest", "-rs", option)
    found.assert_outcomes(**outcome)
    if said:
        found.stdout.fnmatch_lines([said])
