"""What a scene of the gallery is held against: a published number, ours, and the verdict."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from enum import StrEnum
from functools import cached_property
from pathlib import Path
from typing import Any

from contact_scene import read_scene_file
from slipstick import solve, stated_errors

SCENES = Path(__file__).parent / "gallery"
TELLS = 0.1  # agreement within a larger part of the number is no statement


class Verdict(StrEnum):
    """What comparing says."""

    AGREES = "agrees"
    DIFFERS = "differs"
    CANNOT_TELL = "cannot tell"


@dataclass(frozen=True)
class Solved:
    """A scene with changes, solved once."""

    scene: str
    solver: str
    changes: tuple[str, ...] = ()

    @cached_property
    def result(self) -> Any:
        """Of the solver."""
        contents = read_scene_file(SCENES / f"{self.scene}.toml", self.changes)
        return solve(contents, self.solver)

    @cached_property
    def errors(self) -> Any:
        """Stated beside it."""
        return stated_errors(self.result)

    def value(self, name: str, step: int = -1) -> tuple[float, float]:
        """A scalar at the end of a step, of a vector what is along x, and its stated error."""
        value = getattr(self.result.steps[step], name)
        error = self.errors.steps[step][name].error
        if isinstance(value, int | float):
            return float(value), float("inf") if error is None else float(error)
        return float(value[0]), float("inf") if error is None else float(error[0])


Ours = Callable[[Solved], tuple[float, float]]


@dataclass(frozen=True)
class Claim:
    """A number that somebody vouches for.

    published  in `unit`
    reading    how far it may be off as it stands there: digits, a digitised curve, what its theory
               leaves out [unit]
    ours       value and error [SI]
    size       of the unit in SI
    verdict    that is expected; another one is a failure of the gallery
    """

    what: str
    by: str
    published: float
    reading: float
    ours: Ours
    unit: str = ""
    size: float = 1.0
    changes: tuple[str, ...] = ()
    verdict: Verdict = Verdict.AGREES


@dataclass(frozen=True)
class Entry:
    """A scene with its claims.

    words   what it is about; conclusion: what follows
    source  of what was published
    shown   changes of the scene that is drawn
    more    what else stands below the claims, as text
    """

    scene: str
    title: str
    words: str
    source: str
    claims: tuple[Claim, ...]
    conclusion: str
    solver: str = "semi-analytical"
    shown: tuple[str, ...] = ()
    more: Callable[[Entry], str] | None = None
    solved: dict[tuple[str, ...], Solved] = field(default_factory=dict, compare=False)

    def of(self, changes: tuple[str, ...]) -> Solved:
        """The scene with these changes."""
        return self.solved.setdefault(changes, Solved(self.scene, self.solver, changes))


@dataclass(frozen=True)
class Found:
    """A claim that has been put to the test; ours and error in the claim's unit."""

    claim: Claim
    ours: float
    error: float

    @property
    def verdict(self) -> Verdict:
        """The two differ where they are further apart than the errors of both allow.

        Any number agrees within a large error: such a one does not tell.
        """
        if abs(self.ours - self.claim.published) > self.claim.reading + self.error:
            return Verdict.DIFFERS
        tells = self.error <= TELLS * abs(self.ours) + self.claim.reading
        return Verdict.AGREES if tells else Verdict.CANNOT_TELL


def found(entry: Entry, claim: Claim) -> Found:
    """Solve what it takes."""
    ours, error = claim.ours(entry.of(claim.changes))
    return Found(claim, ours / claim.size, error / claim.size)
