"""Comparison of the scenes of the gallery with published numbers, and the verdicts."""

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
CONCLUSIVE = 0.1  # largest error, as a part of the number, for which agreement is a statement


class Verdict(StrEnum):
    """Result of the comparison of a published with a computed number."""

    AGREES = "agrees"
    DIFFERS = "differs"
    INCONCLUSIVE = "inconclusive"


@dataclass(frozen=True)
class Solved:
    """A scene of the gallery with changes, which is solved when its result is first read."""

    scene: str
    solver: str
    changes: tuple[str, ...] = ()

    @cached_property
    def result(self) -> Any:
        """Result of the solver for the scene with its changes."""
        contents = read_scene_file(SCENES / f"{self.scene}.toml", self.changes)
        return solve(contents, self.solver)

    @cached_property
    def errors(self) -> Any:
        """Stated errors of all scalars of the result."""
        return stated_errors(self.result)

    def value(self, name: str, step: int = -1) -> tuple[float, float]:
        """Return a scalar at the end of a load step and its stated error, in SI units.

        Of a vector the component along x is returned. The error is infinite if none is stated.
        """
        value = getattr(self.result.steps[step], name)
        error = self.errors.steps[step][name].error
        if isinstance(value, int | float):
            return float(value), float("inf") if error is None else float(error)
        return float(value[0]), float("inf") if error is None else float(error[0])


Ours = Callable[[Solved], tuple[float, float]]


@dataclass(frozen=True)
class Claim:
    """A published number with the computation that is compared with it.

    what       quantity, for the table of the page
    by         author or theory of the published number
    published  published number, in `unit`
    reading    error of the published number in `unit`: digits, digitised curve, neglected effects
    ours       function that returns our value and its error in SI units
    unit, size
               name of the unit, and its size in SI units
    changes    changes of the scene for this number
    verdict    expected verdict; any other verdict stops the build of the pages
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
    """A page of the gallery: one scene, and the published numbers that are compared with it.

    scene       name of the scene file in docs/gallery
    words       description of the contact
    source      publication
    claims      published numbers
    conclusion  text below the table
    shown       changes of the scene that is drawn
    more        function that returns further text of the page, or None
    solved      results by changes of the scene
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

    def with_changes(self, changes: tuple[str, ...]) -> Solved:
        """Return the scene with changes, which is solved once for all its claims."""
        return self.solved.setdefault(changes, Solved(self.scene, self.solver, changes))


@dataclass(frozen=True)
class Comparison:
    """A published number with our value and its error, in the unit of the publication."""

    claim: Claim
    ours: float
    error: float

    @property
    def verdict(self) -> Verdict:
        """DIFFERS if the difference exceeds the sum of both errors.

        AGREES if our error is also small enough for a statement, else INCONCLUSIVE: any number
        agrees within a large error.
        """
        if abs(self.ours - self.claim.published) > self.claim.reading + self.error:
            return Verdict.DIFFERS
        conclusive = self.error <= CONCLUSIVE * abs(self.ours) + self.claim.reading
        return Verdict.AGREES if conclusive else Verdict.INCONCLUSIVE


def compare(entry: Entry, claim: Claim) -> Comparison:
    """Solve the scene of a claim, unless it has been solved, and compare the two numbers."""
    ours, error = claim.ours(entry.with_changes(claim.changes))
    return Comparison(claim, ours / claim.size, error / claim.size)
