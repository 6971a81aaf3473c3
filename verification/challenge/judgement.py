"""All verdicts on an answer, and what they amount to."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from verification.challenge.answer import Answer, Solver
from verification.challenge.requested_quantities import (
    Challenge,
    Grade,
)
from verification.challenge.verdicts import Row, omitted, rows_of
from verification.judging.outcome import Status

PASSED, ACCURACY, GAVE_UP, INCONCLUSIVE = 0, 1, 3, 6  # exit codes
COLOURS = {"A": "brightgreen", "B": "green", "C": "yellowgreen"}


@dataclass(frozen=True)
class Judgement:
    """What came out.

    omitted  asked and not answered: quantity, step, whether it is required
    """

    challenge: Challenge
    solver: Solver
    answers: tuple[Answer, ...]
    rows: tuple[Row, ...]
    omitted: tuple[tuple[str, int, bool], ...]

    def count(self, status: Status) -> int:
        """Of the verdicts."""
        return sum(row.status is status for row in self.rows)

    @property
    def grade(self) -> str:
        """The worst of all errors; "partial" where something required is not answered, "none" where
        an error meets no class, or a field does not carry the load or cover the contact."""
        if any(required for *_, required in self.omitted):
            return "partial"
        judged = [row for row in self.rows if row.error is not None and row.bound is not None]
        errors = [row for row in judged if ":" not in row.quantity]
        unsound = any(":" in r.quantity and r.status is Status.FAIL for r in judged)
        if unsound or not errors or any(row.grade is None for row in errors):
            return "none"
        return max(row.grade for row in errors if row.grade is not None)

    @property
    def line(self) -> str:
        """One line for a log."""
        counts = ", ".join(
            f"{self.count(status)} {status}"
            for status in (Status.PASS, Status.FAIL, Status.INCONCLUSIVE)
        )
        grade = self.grade if self.grade in ("none", "partial") else f"class {self.grade}"
        asked = len(self.challenge.numbers) + len(self.challenge.fields)
        left_out = f"{len(self.omitted)} of {asked} omitted"
        return f"{self.challenge.name} | {self.solver.name} | {grade} | {counts}, {left_out}"

    def exit_code(self, *, strict: bool = False, partial: bool = False) -> int:
        """Return 0 if all passed, 1 if a verdict failed or a required number is omitted, 3 if the
        solver gave up and nothing else failed; with `strict`, 6 if something is inconclusive.

        partial  accept omissions
        """
        failed = [row for row in self.rows if row.status is Status.FAIL]
        if failed and all(row.quantity == "solved" for row in failed):
            return GAVE_UP
        if failed or (not partial and any(required for *_, required in self.omitted)):
            return ACCURACY
        return INCONCLUSIVE if strict and self.count(Status.INCONCLUSIVE) else PASSED

    def badge(self) -> str:
        """For an endpoint of shields."""
        passed, all_rows = self.count(Status.PASS), len(self.rows)
        colour = "red" if self.count(Status.FAIL) else COLOURS.get(self.grade, "lightgrey")
        content: dict[str, Any] = {
            "schemaVersion": 1, "label": self.challenge.name,
            "message": f"{self.grade} · {passed}/{all_rows}", "color": colour,
        }  # fmt: skip
        return json.dumps(content, ensure_ascii=False) + "\n"


def judged(
    challenge: Challenge, solver: Solver, answers: Sequence[Answer], grade: Grade | None = None
) -> Judgement:
    """The verdicts.

    grade  that all must meet; None: what the solver claims, else the par of each quantity
    """
    rows = tuple(rows_of(challenge, solver, answers, grade))
    return Judgement(challenge, solver, tuple(answers), rows, tuple(omitted(challenge, answers)))
