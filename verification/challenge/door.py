"""The same from Python: a function that answers, without files."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

from verification.challenge.answer import Answer, Key, Solver, Vector
from verification.challenge.asked import Grade
from verification.challenge.cases import challenges
from verification.challenge.judgement import Judgement, judged

LEVELS = 4


class CannotDo(Exception):
    """Raised by a solver: it has no such problem."""


@dataclass(frozen=True)
class Posed:
    """A challenge without its reference.

    scene   SI numbers, as in a scene file; a body and a `patch` where the traction is given
    loads   at the end of every loading step: normal and tangential force [N], NaN where a motion
            is prescribed; `scene["loading"]` has the rest
    asked   quantity and loading step, with its unit
    since   of what is counted from the end of an earlier loading step: which
    places  (points, 3) where numbers are asked at x, y and depth z, by quantity and step [m]
    fields  tractions that are wanted at own points
    window  side of a square in which all of it happens, with room [m]
    """

    name: str
    scene: Mapping[str, Any]
    loads: tuple[tuple[float, tuple[float, float]], ...]
    asked: Mapping[Key, str]
    since: Mapping[Key, int]
    places: Mapping[Key, Vector]
    fields: tuple[Key, ...]
    window: float


def posed(name: str) -> Posed:
    """What a solver is told; KeyError names the challenges there are."""
    if name not in challenges():
        raise KeyError(f"no challenge {name!r}; there are {', '.join(challenges())}")
    challenge = challenges()[name]
    return Posed(
        name,
        challenge.document,
        tuple(challenge.loads),
        {(v.quantity, v.step): v.unit for v in challenge.values},
        {(v.quantity, v.step): v.since for v in challenge.values if v.since is not None},
        {(p.quantity, p.step): p.places for p in challenge.points},
        tuple((f.quantity, f.step) for f in challenge.fields),
        challenge.window,
    )


def judge(
    name: str,
    solve: Callable[[Posed, int], Answer],
    levels: int = LEVELS,
    at_least: str | None = None,
    solver: Solver | None = None,
) -> Judgement:
    """How good a solver is on a challenge.

    Parameters
    ----------
    solve
        Problem and level 0, 1, 2, … (you choose what finer means) -> `Answer`; raises `CannotDo`
        where it has no such problem.
    at_least
        Class "A", "B" or "C" that every error must meet; None: the par of each.
    solver
        Who it is; None: the function's name.

    Raises what `solve` raises, and KeyError for an unknown challenge.
    """
    problem, answers = posed(name), []
    for level in range(levels):
        started = time.process_time()
        answer = solve(problem, level)
        spent = time.process_time() - started
        seconds = spent if answer.seconds is None else answer.seconds
        answers.append(replace(answer, label=answer.label or str(level), seconds=seconds))
    who = solver or Solver(getattr(solve, "__name__", "solver"))
    grade = None if at_least is None else Grade(at_least)
    return judged(challenges()[name], who, answers, grade)
