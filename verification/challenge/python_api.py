"""Python interface of the challenge, for a solver that is a function and needs no files.

The function receives a challenge and a refinement level, and returns an `Answer`.
"""

from __future__ import annotations

import importlib
import importlib.util
import math
import sys
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cache
from itertools import pairwise
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from contact_results.directory.atomic_file import Refused
from verification.challenge.cases import challenges
from verification.challenge.judgement import Judgement, judged
from verification.challenge.requested_quantities import (
    Answer,
    Challenge,
    Grade,
    Key,
    Solver,
    Vector,
)

LEVELS = 4


class CannotDo(Exception):
    """Exception that a solver function raises for a benchmark problem (challenge) outside its
    scope."""


@dataclass(frozen=True)
class Posed:
    """Challenge without its reference solution, as passed to a solver function.

    A key is the pair of quantity name and load step, counted from 1.

    scene   scene as in a scene file, in SI; a body and a `patch` if the traction is given
    loads   normal and tangential force at the end of every load step [N]; NaN for a prescribed
            motion; `scene["loading"]` contains moments and motions
    asked   unit of each required number, by key
    since   load step from whose end a number counts, by key, for numbers that count from there and
            not from the beginning
    places  points (points, 3) with x, y and depth z at which numbers are required, by key [m]
    fields  keys of the tractions that are required at points of the solver's choice
    window  side of a square that contains the contact with a margin [m]
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
    """Return the challenge of a given name, without its reference solution.

    Raises KeyError with all names for an unknown name.
    """
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
    """Judge a solver function on a challenge, with answers on several refinement levels.

    Parameters
    ----------
    name
        Name of the challenge.
    solve
        Function of the problem and the level 0, 1, 2, … that returns an `Answer`. You choose the
        discretisation of a level. It raises `CannotDo` for a problem outside its scope.
    levels
        Number of refinement levels.
    at_least
        Class "A", "B" or "C" that every error must meet. Default: the class that the solver claims,
        else the class of each quantity.
    solver
        Description of the solver. Default: the name of the function.

    Raises
    ------
    Refused
        For an answer that does not fit the challenge.
    KeyError
        For an unknown challenge; exceptions of `solve` are passed on.
    """
    problem, answers = posed(name), []
    for level in range(levels):
        started = time.process_time()
        answer = _checked_answer(solve(problem, level), challenges()[name], level)
        spent = time.process_time() - started
        seconds = spent if answer.seconds is None else answer.seconds
        answers.append(replace(answer, label=answer.label or str(level), seconds=seconds))
    found = [one for one in answers if 0 not in one.gave_up]
    for coarse, fine in pairwise(found):
        if fine.h > coarse.h:
            raise Refused(
                f"h is {fine.h:g} m on level {fine.label} after {coarse.h:g} m on level "
                f"{coarse.label}; levels go from coarse to fine"
            )
    if not any(one.scalars or one.points or one.fields or one.gave_up for one in answers):
        raise Refused("nothing is answered; there is nothing to judge")
    who = solver or Solver(getattr(solve, "__name__", "solver"))
    grade = None if at_least is None else Grade(at_least)
    return judged(challenges()[name], who, answers, grade)


def _checked_answer(answer: object, challenge: Challenge, level: int) -> Answer:
    """Check the answer of a solver function to a challenge on one level, and convert its numbers to
    float.

    Raises Refused for an invalid answer. A quantity that only another challenge requires is
    accepted; other names are refused.

    level  number of the refinement level, for the message
    """
    if not isinstance(answer, Answer):
        raise Refused(f"level {level}: {type(answer).__name__} came back, expected an Answer")
    if not 0 < answer.h < math.inf:
        raise Refused(f"level {level}: h is {answer.h!r}, expected a positive length [m]")
    steps = max((ramp.step for ramp in challenge.ramps), default=1)
    keys: tuple[Any, ...] = (*answer.scalars, *answer.fields, *answer.points)
    for key in keys:
        if not isinstance(key, tuple) or len(key) != 2:
            raise Refused(f"level {level}: {key!r}, expected a quantity and a loading step")
        if key[0] not in _known_quantities() or key[1] not in range(1, steps + 1):
            known = ", ".join(map(repr, _required_keys(challenge)))
            raise Refused(f"level {level}: {key!r} is not asked; asked: {known}")
    scalars: dict[Key, float | tuple[float, float]] = {}
    given: dict[Key, Any] = {**answer.scalars}
    for key, value in given.items():
        if value is None:
            continue
        try:
            numbers = np.ravel(np.asarray(value, dtype=np.float64))
        except (ValueError, TypeError):
            raise Refused(f"level {level}: {key!r} is {value!r}, expected a number") from None
        if numbers.size == 1:
            scalars[key] = float(numbers[0])
        elif isinstance(value, tuple) and numbers.size == 2:
            scalars[key] = float(numbers[0]), float(numbers[1])
        else:
            raise Refused(
                f"level {level}: {key!r} has {numbers.size} numbers, expected one, or a pair "
                "with its uncertainty"
            )
    return replace(answer, scalars=scalars)


def _required_keys(challenge: Challenge) -> list[Key]:
    return [(one.quantity, one.step) for one in (*challenge.numbers, *challenge.fields)]


@cache
def _known_quantities() -> frozenset[str]:
    """Return the names of all quantities that any benchmark problem (challenge) requires.

    Used to refuse misspelt names in the answer of a solver.
    """
    return frozenset(name for one in challenges().values() for name, _ in _required_keys(one))


EXPECTED = "expected FILE.py:FUNCTION or MODULE:FUNCTION"


def names_a_solver(text: str) -> bool:
    """Return True if an argument of the command line names a solver function as FILE.py:FUNCTION.

    The alternative is the folder of an answer. A text with a colon is a folder only if it exists.
    """
    return ":" in text and not Path(text).exists()


def named_solver(text: str) -> Callable[[Posed, int], Answer]:
    """Import the solver function that an argument FILE.py:FUNCTION or MODULE:FUNCTION names.

    Raises Refused if there is no such function, and passes on any exception of the executed file.
    """
    place, _, name = text.rpartition(":")
    module = module_of(Path(place)) if place.endswith(".py") else _import_module(place, text)
    found: object = getattr(module, name, None)
    if not callable(found):
        raise Refused(f"{text}: {place} has no function {name!r}; {EXPECTED}")
    return found


def module_of(path: Path) -> ModuleType:
    """Execute the Python file of a user's solver function and return its module.

    The file can import modules of its own folder. Raises Refused if the file cannot be read or
    imports a missing module.
    """
    if not path.is_file():
        raise Refused(f"{path}: no such file; {EXPECTED}")
    spec = importlib.util.spec_from_file_location(path.stem, path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.path.insert(0, str(path.parent.resolve()))
    try:
        spec.loader.exec_module(module)
    except (ImportError, SyntaxError) as error:
        raise Refused(f"{path}: {error}") from error
    return module


def _import_module(place: str, text: str) -> ModuleType:
    try:
        return importlib.import_module(place)
    except (ImportError, ValueError) as error:
        raise Refused(f"{text}: {error}; {EXPECTED}") from None
