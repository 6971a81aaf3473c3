"""Judgement of a code on a challenge, and its Python interface for a solver without files.

A solver is a function of a challenge and a refinement level that returns an `Answer`. Each number
and traction field gets a verdict: errors are compared with the bounds of accuracy classes A, B and
C. Convergence, stated uncertainties, and the areas of field points are judged, too.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Sequence
from contextlib import closing
from dataclasses import dataclass, replace
from functools import cache, cached_property
from itertools import pairwise
from math import pi
from typing import Any

import numpy as np

from contact_results.directory.atomic_file import Refused
from verification.challenge.answer import Answer, Field, Solver
from verification.challenge.cases import challenges
from verification.challenge.requested_quantities import AskedField, AskedValue, Challenge, Grade
from verification.challenge.solver_process import (
    SECONDS_PER_LEVEL,
    Posed,
    Solve,
    answers_of,
)
from verification.convergence.observed_order import (
    ObservedOrder,
    is_within,
    observed_order,
    order_text,
)
from verification.judging.outcome import Status
from verification.norms import cell_means

# Factor on N^(-3/4) π^(-1/4), the √radius over the area of a disc of N cells. The product bounds
# the relative error of the number of cell centres in the disc (Gauss circle problem).
# Our grids, which are centred on the disc, reach twice this scale.
SCATTER = 3.0


def field_sums(
    asked: AskedField, field: Field
) -> Iterator[tuple[str, str, float, float, float, float]]:
    """Yield sums over the points of an answered traction field that must agree with the exact
    traction.

    The sums are the force, its second moment, and the covered contact area. Each item has a name, a
    description, the value, the expected value, the scale of the difference, and the largest
    deviation (dimensionless) that the discrete points make unavoidable.
    """
    forces, exact = field.value * field.area, asked.traction
    yield "load carried", "Σ value·area", float(np.sum(forces)), asked.total, asked.scale, 0.0
    spread = float(np.sum(forces * (field.x**2 + field.y**2)))
    reach = asked.scale * max(exact.semi_axes) ** 2
    yield "spread of the load", "Σ value·area·r²", spread, exact.spread, reach, 0.0
    area, scatter = _covered_area(field, exact.semi_axes)
    yield "contact covered", "Σ area in the contact, over its own", area, 1.0, 1.0, scatter


def _covered_area(field: Field, semi_axes: tuple[float, float]) -> tuple[float, float]:
    """Compute the fraction of the contact area that the points of a field cover, and its tolerance.

    The areas of the points are summed outwards, each area centred at its point, and interpolated to
    the contact edge. Points on one ray represent rings; their sum may end half a ring before the
    edge. For cell centres the sum scatters. The second result is this unavoidable deviation of the
    fraction from 1.

    semi_axes  semi-axes of the contact ellipse around the origin, along x and y [length]
    """
    whole = pi * semi_axes[0] * semi_axes[1]
    out = (field.x / semi_axes[0]) ** 2 + (field.y / semi_axes[1]) ** 2
    order = np.argsort(out)
    out, area = out[order], field.area[order] / whole
    middles = np.cumsum(area) - area / 2
    within = float(np.interp(1.0, out, middles, right=np.nan))
    if np.isnan(within):
        within = float(np.sum(area))
    if not np.any(field.y):
        return within, float(area[max(int(np.searchsorted(out, 1.0, "right")) - 1, 0)]) / 2
    cells = 1 / float(np.median(area))
    return within, SCATTER * cells**-0.75 * pi**-0.25


AskedQuantity = AskedValue | AskedField

# Errors stall if the order is below this value at 95 %.
STALLS_BELOW = 0.5
FEWEST_LEVELS = 3
# A standard uncertainty that exceeds the error by this factor on every level is not informative.
IDLE = 25.0
WHOLE = "–"  # in place of a loading step


@dataclass(frozen=True)
class Row:
    """Verdict on one number, one field or one property of an answer to a challenge.

    quantity   name of the quantity, or "quantity: property"
    step       number of the load step; None for the whole history
    level      name of the refinement level
    status     pass, fail or inconclusive
    because    reason for the status
    value      answered value in the required unit; None if there is no number
    reference  reference value in the required unit
    error      error divided by its scale
    bound      largest accepted error; None if a property other than the error is judged
    grade      best accuracy class whose bound the error meets; None for no class
    order      observed order of convergence with its uncertainty; None if it is unknown
    errors     pairs of size h and error of all levels
    """

    quantity: str
    step: int | None
    level: str
    status: Status
    because: str
    value: float | None = None
    reference: float | None = None
    error: float | None = None
    bound: float | None = None
    grade: Grade | None = None
    order: ObservedOrder | None = None
    errors: tuple[tuple[float, float], ...] = ()  # by h, of all levels


def rows_of(
    challenge: Challenge, solver: Solver, answers: Sequence[Answer], asked: Grade | None
) -> Iterator[Row]:
    """Yield all verdicts on the answers of a code: errors on its finest level, and convergence.

    answers  one answer per refinement level, in any order
    asked    accuracy class that all errors must meet; None: the class that the code claims, else
             the default class of each quantity
    """
    levels = sorted(answers, key=lambda one: -one.h)
    demanded = asked or (Grade(solver.claimed_grade) if solver.claimed_grade else None)
    for level in levels:
        for step, reason in level.gave_up.items():
            yield Row("solved", step or None, level.label, Status.FAIL, f"gave up: {reason}")
    for quantity in challenge.asked:
        given = [(one, _given_value(quantity, one)) for one in levels]
        found = tuple((one, value) for one, value in given if value is not None)
        if found:
            yield from _Judge(quantity, solver, demanded or quantity.par, found).rows(levels[-1])


def omitted(challenge: Challenge, answers: Sequence[Answer]) -> list[tuple[str, int, bool]]:
    """List the quantities of a challenge that the finest level of an answer does not contain.

    Each item has the quantity, the load step, and True if the quantity is required.

    answers  one answer per refinement level
    """
    finest = min(answers, key=lambda one: one.h)
    return [(*one.key, one.required) for one in challenge.asked if not finest.has(one.key)]


def _given_value(asked: AskedQuantity, answer: Answer) -> Any:
    """Return the number, field or numbers at points that an answer gives for a required quantity.

    The result is None if the quantity is missing.
    """
    if isinstance(asked, AskedField):
        return answer.fields.get(asked.key)
    return answer.value(asked.key) if asked.places is None else answer.points.get(asked.key)


@dataclass(frozen=True)
class _Judge:
    """Judge of one quantity of an answer: its error, convergence, and other properties.

    Other properties are the stated uncertainty of a number and the areas of the points of a field.

    asked   required quantity
    solver  description of the code, with its claims
    grade   accuracy class that the error must meet
    found   levels with the quantity, and what they give for it, from coarse to fine
    """

    asked: AskedQuantity
    solver: Solver
    grade: Grade
    found: tuple[tuple[Answer, Any], ...]

    def rows(self, finest: Answer) -> Iterator[Row]:
        """Yield the verdicts; `finest` is the finest level, with or without the quantity."""
        yield from self._missing_on(finest)
        yield self._error()
        yield from self._convergence()
        if isinstance(self.asked, AskedValue):
            yield from self._claimed_uncertainty(self.asked)
        else:
            yield from self._point_areas(self.asked)

    @property
    def _level(self) -> str:
        return self.found[-1][0].label

    @property
    def _wide(self) -> float:
        """Twice the standard uncertainty of the reference, divided by the error scale."""
        return 2 * self.asked.uncertainty

    @cached_property
    def _errors(self) -> tuple[tuple[float, float], ...]:
        """Pairs of size h and relative error, from coarse to fine."""
        return tuple((one.h, self._relative_error(given)) for one, given in self.found)

    @cached_property
    def _order(self) -> ObservedOrder | None:
        """Order of those errors that are well above the uncertainty of the reference; None if fewer
        than 3 sizes remain.
        """
        told = [(h, e) for h, e in self._errors if e > 1.5 * self._wide and 0 < e < math.inf]
        if len({h for h, _ in told}) < FEWEST_LEVELS:
            return None
        return observed_order(*zip(*told, strict=True))

    def _row(self, about: str, level: str, status: Status, because: str, **more: Any) -> Row:
        return Row(f"{self.asked.quantity}{about}", self.asked.step, level, status, because, **more)

    def _relative_error(self, given: Any) -> float:
        """Compute the relative error of an answered quantity.

        The error of a number is divided by the error scale of the challenge; of numbers at points,
        the largest error counts. The error of a field is that of `_field_error`.

        given  answered number, field or numbers at points
        """
        if isinstance(self.asked, AskedField):
            return _field_error(self.asked, given, self.solver.sampling)
        return float(np.max(np.abs(given - self.asked.value)) / self.asked.scale)

    def _missing_on(self, finest: Answer) -> Iterator[Row]:
        """Yield an inconclusive verdict if the finest level of an answer lacks a quantity that
        coarser levels have.

        Without this verdict a code could hide its worst numbers by omitting them.
        """
        if not finest.has(self.asked.key) and not {0, self.asked.step} & finest.gave_up.keys():
            because = f"not answered there; judged on level {self._level}"
            yield self._row(": finest level", finest.label, Status.INCONCLUSIVE, because)

    def _error(self) -> Row:
        """Judge the error of a quantity on the finest level against the bound of an accuracy class.

        The class limits the error against the exact solution, from which the reference differs by
        up to twice its uncertainty. The verdict is inconclusive where this difference decides.
        """
        error, bound = self._errors[-1][1], self.grade.bound
        status = Status.of(is_within(error - self._wide, error + self._wide, bound))
        because = {
            Status.PASS: f"within class {self.grade}",
            Status.INCONCLUSIVE: "the reference is not certain enough to tell",
        }.get(status, "no finite number")
        if status is Status.FAIL and math.isfinite(error):
            because = f"beyond class {self.grade}{self._slip_hint()}"
        value = reference = None
        if isinstance(self.asked, AskedValue) and self.asked.places is None:
            value, reference = self.found[-1][1], self.asked.value
        return self._row(
            "",
            self._level,
            status,
            because,
            value=value,
            reference=reference,
            error=error,
            bound=bound,
            grade=_class_of(error + self._wide),
            order=self._order,
            errors=self._errors,
        )

    def _convergence(self) -> Iterator[Row]:
        """Yield verdicts on the convergence of a quantity: errors must decrease, and a claimed
        order must hold."""
        fit = self._order
        if fit is None:
            return
        most = fit.order + fit.margin
        if self._errors[-1][1] > Grade.A.bound and most < STALLS_BELOW:
            because = f"order below {most:.2f}: finer is hardly better"
            yield self._row(": stalls", WHOLE, Status.FAIL, because, order=fit)
        claimed = self.solver.claimed_orders.get(self.asked.quantity)
        if claimed is not None:
            status = Status.of(fit.reaches(claimed))
            because = f"order {order_text(*fit.interval)}, claimed {claimed:g}"
            yield self._row(": order", WHOLE, status, because, order=fit)

    def _claimed_uncertainty(self, asked: AskedValue) -> Iterator[Row]:
        """Judge the standard uncertainty that a code states for a number: twice its value must
        cover the error.

        The verdict is inconclusive if the stated uncertainty exceeds the bound of the accuracy
        class and is far above the error on every level.
        """
        scale, claims = asked.scale, [one.uncertainty(asked.key) for one, _ in self.found]
        claimed, error = claims[-1], self._errors[-1][1] * scale
        if claimed is None:
            return
        honest = error <= 2 * math.hypot(claimed, asked.uncertainty * scale)
        idle = 2 * claimed > self.grade.bound * scale and all(
            u is not None and u > IDLE * max(e, self._wide) * scale
            for u, (_, e) in zip(claims, self._errors, strict=True)
        )
        status = Status.INCONCLUSIVE if idle else Status.PASS if honest else Status.FAIL
        because = f"error {error:.3g}, claimed 2u = {2 * claimed:.3g} {asked.unit}"
        because += ": so wide that it says nothing" if idle else ""
        yield self._row(": own uncertainty", self._level, status, because)

    def _point_areas(self, asked: AskedField) -> Iterator[Row]:
        """Judge the areas of the points of an answered field by sums that the exact traction
        determines.

        The force, its second moment and the covered contact area must be correct. Without this
        check an answer could omit the points with the largest errors.
        """
        bound = max(self.grade.bound, Grade.B.bound)
        for name, sums, has, should, scale, least in field_sums(asked, self.found[-1][1]):
            missed, allowed = abs(has - should) / scale, max(bound, least)
            status, because = Status.PASS, sums
            if not missed <= allowed:
                of = f"{has / should:.4g} of what it should be" if should else f"{has:.3g}, not 0"
                status, because = Status.FAIL, f"{sums}: {of}"
            yield self._row(
                f": {name}",
                self._level,
                status,
                because,
                value=has,
                reference=should,
                error=missed,
                bound=allowed,
            )

    def _slip_hint(self) -> str:
        """Return a hint that another sign, a factor of 2 or another unit would explain a wrong
        answer.

        The hint names the accuracy class that the corrected answer meets. It is empty if no such
        mistake explains the answer.
        """
        given = self.found[-1][1]
        slips = {"with the sign reversed": -1.0, "halved": 0.5, "doubled": 2.0}
        slips |= {f"times 1e{n}": 10.0**n for n in (-9, -6, -3, 3, 6, 9)}
        for words, factor in slips.items():
            corrected = (
                replace(given, value=factor * given.value)
                if isinstance(given, Field)
                else factor * given
            )
            if met := _class_of(self._relative_error(corrected) + self._wide):
                expected = f"; expected: {self.asked.meaning}" if factor < 0 else ""
                return f"; {words} it meets class {met}{expected}"
        return ""


def _field_error(asked: AskedField, field: Field, sampling: str) -> float:
    """Compute the relative L2 or L1 error of an answered traction field over its points.

    The L2 error is divided by the L2 norm of the exact traction, the L1 error by the force scale of
    the challenge. With sampling "cell", the field is compared with means of the exact traction over
    squares around the points.
    """
    side = np.sqrt(field.area)
    if sampling == "cell":
        exact = cell_means(asked.traction.at, field.x, field.y, (side, side))
    else:
        exact = asked.traction.at(field.x, field.y)
    off = np.abs(field.value - exact)
    if asked.norm == "L1":
        return float(np.sum(field.area * off) / asked.scale)
    own = np.linalg.norm(side * exact)
    return float(np.linalg.norm(side * off) / own) if own > 0 else math.inf


def _class_of(error: float) -> Grade | None:
    """Return the best accuracy class whose bound an error meets; None for no class."""
    return next((one for one in Grade if error <= one.bound), None)


# exit codes
PASSED = 0
ACCURACY = 1
GAVE_UP = 3
INCONCLUSIVE = 6
COLOURS = {"A": "brightgreen", "B": "green", "C": "yellowgreen"}


@dataclass(frozen=True)
class Judgement:
    """Result of the judgement of one code on one challenge.

    answers  judged answers, one per refinement level
    rows     verdicts
    omitted  missing quantities: name, load step, True if required
    """

    challenge: Challenge
    solver: Solver
    answers: tuple[Answer, ...]
    rows: tuple[Row, ...]
    omitted: tuple[tuple[str, int, bool], ...]

    def count(self, status: Status) -> int:
        """Return the number of verdicts on the answer that have the given status: pass, fail or
        inconclusive."""
        return sum(row.status is status for row in self.rows)

    @property
    def grade(self) -> str:
        """Accuracy class of the worst error of an answer to a challenge: "A", "B", "C", "none" or
        "partial".

        "partial": a required quantity is missing. "none": an error meets no class, or the areas of
        a field do not give its load or its contact area.
        """
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
        """Text of the judgement in one line of a log: problem, code, accuracy class and numbers of
        verdicts."""
        counts = ", ".join(
            f"{self.count(status)} {status}"
            for status in (Status.PASS, Status.FAIL, Status.INCONCLUSIVE)
        )
        grade = self.grade if self.grade in ("none", "partial") else f"class {self.grade}"
        left_out = f"{len(self.omitted)} of {len(self.challenge.asked)} omitted"
        return f"{self.challenge.name} | {self.solver.name} | {grade} | {counts}, {left_out}"

    def exit_code(self, *, strict: bool = False, partial: bool = False) -> int:
        """Return the exit code of the command that judges an answer.

        0: all verdicts passed. 1: a verdict failed, or a required quantity is missing. 3: the
        solver gave up, and nothing else failed. 6: with `strict`, a verdict is inconclusive.

        strict   True if inconclusive verdicts are reported as code 6
        partial  True if missing quantities are accepted
        """
        failed = [row for row in self.rows if row.status is Status.FAIL]
        if failed and all(row.quantity == "solved" for row in failed):
            return GAVE_UP
        if failed or (not partial and any(required for *_, required in self.omitted)):
            return ACCURACY
        return INCONCLUSIVE if strict and self.count(Status.INCONCLUSIVE) else PASSED

    def badge(self) -> str:
        """Return the JSON text of a status badge of the judgement, in the endpoint format of
        shields.io."""
        passed, all_rows = self.count(Status.PASS), len(self.rows)
        colour = "red" if self.count(Status.FAIL) else COLOURS.get(self.grade, "lightgrey")
        content: dict[str, Any] = {
            "schemaVersion": 1,
            "label": self.challenge.name,
            "message": f"{self.grade} · {passed}/{all_rows}",
            "color": colour,
        }
        return json.dumps(content, ensure_ascii=False) + "\n"


def judged(
    challenge: Challenge, solver: Solver, answers: Sequence[Answer], grade: Grade | None = None
) -> Judgement:
    """Judge the answers of a code to a challenge and return the verdicts.

    answers  one answer for each refinement level
    grade    accuracy class that all errors must meet; None: the class that the code claims, else
             the default class of each quantity

    Raises Refused for a claimed order of a quantity that no challenge requires.
    """
    if unknown := sorted(solver.claimed_orders.keys() - _known_quantities()):
        asked = ", ".join(sorted({one.quantity for one in challenge.asked}))
        raise Refused(f"claimed order of {unknown[0]!r}: no such quantity; asked here: {asked}")
    rows = tuple(rows_of(challenge, solver, answers, grade))
    return Judgement(challenge, solver, tuple(answers), rows, tuple(omitted(challenge, answers)))


LEVELS = 4


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
        {one.key: one.unit for one in challenge.values},
        {one.key: one.since for one in challenge.values if one.since is not None},
        {one.key: one.places for one in challenge.points},
        tuple(one.key for one in challenge.fields),
        challenge.window,
    )


def judge(
    name: str,
    solve: Solve | str,
    levels: int = LEVELS,
    at_least: str | None = None,
    solver: Solver | None = None,
    seconds: float | None = SECONDS_PER_LEVEL,
) -> Judgement:
    """Judge a solver function on a challenge, with answers on several refinement levels.

    The function runs in a child process with a time limit, and receives a copy of the problem.

    Parameters
    ----------
    name
        Name of the challenge.
    solve
        Function of the problem and the level 0, 1, 2, … that returns an `Answer`, or its name
        FILE.py:FUNCTION or MODULE:FUNCTION. You choose the discretisation of a level. It raises
        `CannotDo` for a problem outside its scope. A function runs in a copy of this process
        (Linux; elsewhere in this process, without time limit), a name in a new interpreter.
    levels
        Number of refinement levels.
    at_least
        Class "A", "B" or "C" that every error must meet. Default: the class that the solver claims,
        else the class of each quantity.
    solver
        Description of the solver. Default: the name of the function.
    seconds
        Time limit of each level. Default: 600 s. None: call the function in this process, without
        time limit, for example in a debugger.

    Raises
    ------
    Refused
        For an answer that does not fit the challenge.
    SolverFailed
        If the function raises an exception, ends its process, or exceeds the time limit.
    KeyError
        For an unknown challenge. In this process, exceptions of `solve` are passed on.
    """
    challenge, answers = challenges()[posed(name).name], []
    with closing(answers_of(solve, posed(name), levels, seconds)) as given:
        for answer in given:
            _refuse_other_quantities(answer, challenge)
            answers.append(answer)
    own_name = solve if isinstance(solve, str) else getattr(solve, "__name__", "solver")
    grade = None if at_least is None else Grade(at_least)
    return judged(challenge, solver or Solver(own_name), checked(challenge, answers), grade)


def checked(challenge: Challenge, answers: Sequence[Answer]) -> tuple[Answer, ...]:
    """Return the answers of a code, from coarse to fine levels, if they can be judged.

    Raises Refused for quantities that are not required, for levels in another order, and if nothing
    is answered.
    """
    for answer in answers:
        _refuse_other_quantities(answer, challenge)
    found = [one for one in answers if 0 not in one.gave_up]
    for coarse, fine in pairwise(found):
        if fine.h > coarse.h:
            raise Refused(
                f"h is {fine.h:g} m on level {fine.label} after {coarse.h:g} m on level "
                f"{coarse.label}; levels go from coarse to fine"
            )
    if not any(one.scalars or one.points or one.fields or one.gave_up for one in answers):
        raise Refused("nothing is answered; there is nothing to judge")
    return tuple(answers)


def _refuse_other_quantities(answer: Answer, challenge: Challenge) -> None:
    """Raise Refused if an answer has a quantity that no challenge requires, a list in place of one
    number or the reverse, or not one number at each of the places of the challenge.

    A quantity that only another challenge requires is accepted.
    """
    steps = max((ramp.step for ramp in challenge.ramps), default=1)
    for key in (*answer.scalars, *answer.fields, *answer.points):
        if key[0] not in _known_quantities() or key[1] not in range(1, steps + 1):
            known = ", ".join(repr(one.key) for one in challenge.asked)
            raise Refused(f"level {answer.label}: {key!r} is not asked; asked: {known}")
    single, placed = ({one.key for one in asked} for asked in (challenge.values, challenge.points))
    for key in (*(answer.points.keys() & single), *(answer.scalars.keys() & placed)):
        expected = "one number" if key in single else "a list with one number for each place"
        raise Refused(f"level {answer.label}: {key[0]} of step {key[1]}: expected {expected}")
    for asked in challenge.points:
        values = answer.points.get(asked.key)
        if values is not None and values.shape != asked.value.shape:
            raise Refused(
                f"level {answer.label}: {asked.quantity} of step {asked.step}: {values.size} "
                f"numbers, expected one at each of the {asked.value.size} places"
            )


@cache
def _known_quantities() -> frozenset[str]:
    """Return the names of all quantities that any challenge requires.

    Used to refuse misspelt names in the answer of a solver.
    """
    return frozenset(asked.quantity for one in challenges().values() for asked in one.asked)
