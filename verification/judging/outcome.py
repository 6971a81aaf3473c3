"""Records of the outcome of a verification case as stored in `report.json`, and their texts."""

from __future__ import annotations

import math
import sys
from collections.abc import Iterator
from enum import StrEnum
from typing import Annotated, Any, TypeAlias

from pydantic import Field, model_validator

from contact_scene.quantities.summary import EffectSummary
from contact_scene.reading.description import Description
from contact_scene.reading.engineering_units import engineering_unit
from verification.convergence.observed_order import (
    ORDER_WIDTH,
    is_within,
    order_is_kept,
    order_text,
)
from verification.exhibits.chart import NOT_FINITE, Chart, plain, value_text
from verification.solver import Method, Solver

SHORT_COMMIT = 7


def finite(value: float) -> float | None:
    """Convert a number to the form stored in records: None in place of NaN and infinity."""
    return float(value) if math.isfinite(value) else None


class ChangeKind(StrEnum):
    """Result of the comparison of a number with its baseline (stored value of an accepted run)."""

    UNCHANGED = "unchanged"
    """Also what other processors and versions leave: a millionth of what errors are divided by, or
    a hundredth of what is allowed; of counts, a twentieth over a case."""

    DRIFT = "drift"
    """Differs, and is still within what its reference allows, or has none."""

    BETTER = "better"
    """The error has fallen far without a reason on record."""

    WORSE = "worse"
    """The error has grown by half or more, and by more than the noise of machines, though it is
    still allowed; or its tolerance has, or the number is no longer judged."""

    DEARER = "dearer"
    """More iterations, convolutions or factorisations for the same."""

    OUTSIDE = "outside"
    """Fails, and did not when it was recorded; or has moved away from its reference by more than is
    allowed at all. An order that can no longer be judged is held to what was allowed when it was
    recorded."""

    NEW = "new"

    GONE = "gone"
    """Recorded, and no longer measured: deletions are accepted with a reason, too."""

    @property
    def matters(self) -> bool:
        """True if the number differs from the baseline (stored value), so that a new value must be
        stored.
        """
        return self is not ChangeKind.UNCHANGED

    @property
    def regresses(self) -> bool:
        """True for a change for the worse, which a person must accept with a reason before a commit
        passes.
        """
        return self in (ChangeKind.OUTSIDE, ChangeKind.WORSE, ChangeKind.DEARER, ChangeKind.GONE)


class Change(Description):
    """Record of the difference between a number and its baseline (stored value of an
    accepted run).
    """

    kind: ChangeKind
    recorded: bool = True
    """Whether there is anything to compare with."""

    was: float | None = None
    """Null if nothing was recorded, or a number that is not finite."""

    moved: float | None = None
    """|value - was| as a part of the allowed error; null where nothing is allowed or known."""

    since: str
    """Commit that the recorded number is from, as a reader sees it."""

    remark: str = ""


class CounterChange(Description):
    """Record of the difference of a cost count of a case, such as iterations, from its stored
    value.
    """

    name: str
    kind: ChangeKind
    was: int
    now: int
    remark: str = ""


class Gone(Description):
    """Record of a quantity that has a stored value and that the case does not measure any more."""

    name: str
    run: str
    unit: str
    was: float | None


class GoneCase(Description):
    """Record of a case that has stored values and is missing in a report of all cases."""

    name: str
    since: str
    """Commit that its recording is from, as a reader sees it."""


class Origin(Description):
    """Record of the origin of the stored values of a case: commit, date, and reason for accepting
    them.
    """

    commit: str | None
    changed: bool
    """Whether the source differed from that commit."""

    date: str
    reason: str
    """Why they were accepted."""

    differs: tuple[str, ...] = ()
    """What is different now, of processor and versions."""

    @property
    def name(self) -> str:
        """Git commit at which the values of a case were stored, as text for a reader."""
        return commit_text(self.commit, changed=self.changed)


def commit_text(commit: str | None, *, changed: bool) -> str:
    """Return the short hash of a git commit as text, with a remark if the source code differed from
    it.

    commit   hash; None for an unknown commit
    changed  True if the source code contained changes that were not committed
    """
    text = "an unknown commit" if commit is None else commit[:SHORT_COMMIT]
    return f"{text} with changes" if changed else text


# Names of the verdicts that every case has.
SOLVED = "solved"
RESIDUAL = "largest_residual"
VIOLATION = "observed_violation"
IMBALANCE = "energy_imbalance"
# Verdicts on the worst of all runs; the run is a result and does not identify the verdict.
FOUND_IN_A_RUN = (RESIDUAL, VIOLATION, IMBALANCE)

TOLERANCE_KINDS = ("required", "derived", "order")
SAME_BUT_FOR_ROUNDING = 1e-12

# Count of work done. A larger number than any run needs is a sign of a damaged record.
Count: TypeAlias = Annotated[int, Field(ge=0, le=10**15)]


class Status(StrEnum):
    """Result of a judgement: pass, fail, or inconclusive (the data do not permit a judgement)."""

    PASS = "pass"
    FAIL = "fail"
    INCONCLUSIVE = "inconclusive"

    @classmethod
    def of(cls, kept: bool | None) -> Status:
        """Convert an answer to a status; None, an answer that the data do not decide, is
        inconclusive.
        """
        if kept is None:
            return cls.INCONCLUSIVE
        return cls.PASS if kept else cls.FAIL


def status_of_difference(error: float, allowed: float, uncertainty: float) -> Status:
    """Judge the difference of a number from its reference by the tolerance of a case.

    The tolerance limits the difference, and thus contains the uncertainty of the reference: many
    tolerances are twice this uncertainty. A tolerance below one standard uncertainty cannot contain
    it, so that a difference within the tolerance is inconclusive. NaN fails.

    error, allowed, uncertainty  difference, tolerance and standard uncertainty of the reference,
                                 over the error scale
    """
    return Status.of(is_within(error, max(error, uncertainty), allowed))


class OrderRecord(Description):
    """Record of the data from which an order of convergence was computed: sizes and errors of the
    levels.
    """

    of: str
    meaning: str = ""
    """What was followed, exactly; empty in older records."""

    solver: Solver
    refined: str
    sizes: tuple[float, ...]
    """Cell side, element side or part of a step of every level, coarse to fine."""

    errors: tuple[float, ...]
    """Error on each level, or change from it to the next."""


class Verdict(Description):
    """Record of one judged number: value, reference, error, tolerance and status.

    Errors are relative to the scale that `scale_name` describes. Numbers that are not finite are
    null, and the verdict fails.
    """

    name: str
    run: str
    """What it was measured on, in words."""

    runs: tuple[str, ...] = ()
    """Labels of the runs that it was measured on, or that an order was read off."""

    meaning: str
    unit: str
    value: float | None
    reference: float
    reference_kind: str
    source: str
    reference_uncertainty: float | None = None
    """Standard uncertainty of the reference, in its unit; null where it has none."""

    error: float | None
    """|value - reference| / scale."""

    allowed: float
    bound: float | None = None
    """What the case allows, where less is accepted; null where that is what is allowed."""

    scale: float
    scale_name: str
    tolerance_kind: str
    """required, derived, or order."""

    because: str
    status: Status
    interval: float | None = None
    """Half-width of the 95 % interval of an observed order."""

    margin: float | None = None
    """Between an observed order and its lower bound at 95 %; null in older records, where an order
    had to be within its interval or 0.1 of the promised one."""

    order: OrderRecord | None = None
    """What an observed order was read off; null for all other verdicts."""

    stated_error: float | None = None
    """Error that the solver states of the value, in its unit; null where it states none, or where
    the error has not converged."""

    covered: bool | None = None
    """Whether |value - reference| is within the stated error and the uncertainty of the reference;
    null without a stated error."""

    regression: Change | None = None
    """Against the recorded value; null if the case has no baseline of this level."""

    @model_validator(mode="after")
    def _states_what_it_measured(self) -> Verdict:
        """Check that error, tolerance and status of the verdict agree with each other.

        A record that was edited by hand or damaged contradicts itself. Raises ValueError for a
        contradiction.
        """
        problem = _contradiction(self)
        if problem:
            raise ValueError(f"{self.name} [{self.run}]: {problem}")
        return self

    @property
    def most_allowed(self) -> float:
        """Largest error that the case accepts, in the unit of the value."""
        return (self.allowed if self.bound is None else self.bound) * self.scale

    @property
    def least(self) -> float:
        """Standard uncertainty of the reference over the scale [1]. A smaller error cannot be
        judged.
        """
        return (self.reference_uncertainty or 0.0) / self.scale

    @property
    def clearance(self) -> float | None:
        """Error over the accepted error [1]; a value above 1 is a failure.

        The ratio is None if there is no finite error, or if the accepted error is zero and the
        error is not.
        """
        if self.error is None or (self.allowed == 0 and self.error > 0):
            return None
        if self.error == 0:
            return 0.0
        return min(self.error / self.allowed, sys.float_info.max)


def _contradiction(verdict: Verdict) -> str:
    """Describe the first contradiction between the numbers of a verdict, or return "" without one.

    Used to detect records that were edited or damaged.
    """
    if verdict.tolerance_kind not in TOLERANCE_KINDS:
        return f"its tolerance is {verdict.tolerance_kind!r}, not {', '.join(TOLERANCE_KINDS)}"
    # A derived uncertainty is zero if refinement does not change the value.
    allows = verdict.allowed > 0 or (verdict.allowed == 0 and verdict.tolerance_kind == "derived")
    if not (verdict.scale > 0 and allows and math.isfinite(verdict.allowed * verdict.scale)):
        return f"it allows {verdict.allowed:g} of {verdict.scale:g}; both are positive, and finite"
    if not _error_is_consistent(verdict):
        return (
            f"its error is {verdict.error}, but its value is {verdict.value}, its reference "
            f"{verdict.reference} and its scale {verdict.scale}"
        )
    if verdict.covered is not _error_is_covered(verdict):
        return f"it is covered: {verdict.covered}, but it states {verdict.stated_error}"
    status = _status_by_numbers(verdict)
    if verdict.status is not status:
        return (
            f"its status is {verdict.status}, but an error of {verdict.error} where "
            f"{verdict.allowed} is allowed is {status}"
        )
    return ""


def _error_is_consistent(verdict: Verdict) -> bool:
    if verdict.value is None or verdict.error is None:
        return verdict.value is verdict.error
    error = abs(verdict.value - verdict.reference) / verdict.scale
    return math.isclose(verdict.error, error, rel_tol=SAME_BUT_FOR_ROUNDING)


def _error_is_covered(verdict: Verdict) -> bool | None:
    if verdict.stated_error is None or verdict.value is None:
        return None
    known = verdict.stated_error + (verdict.reference_uncertainty or 0.0)
    return abs(verdict.value - verdict.reference) <= known


def _status_by_numbers(verdict: Verdict) -> Status:
    if verdict.error is None:
        return Status.FAIL
    if verdict.interval is not None and verdict.margin is not None:
        assert verdict.value is not None
        above = verdict.value - verdict.reference
        return Status.of(order_is_kept(above, verdict.allowed, verdict.interval, verdict.margin))
    if verdict.interval is not None and verdict.interval > ORDER_WIDTH:
        return Status.INCONCLUSIVE
    return status_of_difference(verdict.error, verdict.allowed, verdict.least)


class RunRecord(Description):
    """Record of one solve of a case: solver, discretisation, residual, and counts of work."""

    label: str
    cells: tuple[int, int] | None
    window: tuple[float, float] | None
    """Cells and window of the surface; null without a surface grid."""

    elements_per_radius: int | None = None
    """Elements over the contact radius; null without finite elements."""

    rings: int | None = None
    """Rings at which the radial solver tells its fields; null for other solvers."""

    method: Method | None = None
    """Null for a surface grid, and in older records."""

    problem: str = ""
    """Which of the problems of its case was solved; empty where there is one."""

    planned: str | None = None
    """Label of the run that differs in its effects alone, which are those that its scene calls for;
    null where this one has them, or there is no such run."""

    tolerance: float
    increments: Count
    iterations: Count
    convolutions: Count
    factorizations: Count = 0
    """Sparse factorisations of finite elements."""

    largest_residual: float | None
    edge_change: float = 0.0
    """Largest relative change in the last iteration of the edge correction; 0 without one."""

    parameters: dict[str, tuple[float, ...]] = Field(default_factory=dict)
    """Dimensionless parameters of the scene by name, such as h/a; empty in older records, and of
    settings that users do not run."""

    @property
    def solver(self) -> Solver:
        """Solver of the run: radial, finite elements or semi-analytical cells."""
        if self.rings is not None:
            return Solver.RADII
        return Solver.ELEMENTS if self.cells is None else Solver.CELLS


class SceneRecord(Description):
    """Record of a scene in words, with the physical effects that the solver includes or
    leaves out.
    """

    title: str
    lines: tuple[tuple[str, str], ...]
    effects: tuple[EffectSummary, ...]


class CaseOutcome(Description):
    """Record of a judged verification case: scenes, runs, verdicts and charts."""

    name: str
    title: str
    problem: str
    scenes: tuple[SceneRecord, ...]
    runs: tuple[RunRecord, ...]
    verdicts: tuple[Verdict, ...]
    charts: tuple[Chart, ...]
    limits: tuple[str, ...]
    equations: tuple[str, ...] = ()
    """Governing equations of the reference, in LaTeX."""

    no_order: str = ""
    """Reason for which no order of convergence is judged; empty where one is."""

    baseline: Origin | None = None
    """Where the recorded numbers are from; null if there are none of this level."""

    counts: tuple[CounterChange, ...] = ()
    """Counts of all solves together that differ from the recorded ones."""

    gone: tuple[Gone, ...] = ()
    """What was recorded and is not measured any more."""

    @model_validator(mode="before")
    @classmethod
    def _leave_out_findings(cls, given: Any) -> Any:
        """Leave out the numbers without a verdict that older records have."""
        if not isinstance(given, dict):
            return given
        return {name: value for name, value in given.items() if name != "findings"}

    @model_validator(mode="after")
    def _names_runs_that_it_has(self) -> CaseOutcome:
        labels = [run.label for run in self.runs]
        named = [label for verdict in self.verdicts for label in verdict.runs]
        named += [run.planned for run in self.runs if run.planned is not None]
        for wrong, problem in (
            ([label for label in labels if labels.count(label) > 1], "twice"),
            ([label for label in named if label not in labels], "not at all"),
        ):
            if wrong:
                raise ValueError(f"{self.name}: it has the run {wrong[0]!r} {problem}")
        return self

    def count(self, status: Status) -> int:
        """Return the number of verdicts of the case that have the given status (pass, fail,
        inconclusive).
        """
        return sum(verdict.status is status for verdict in self.verdicts)

    @property
    def status(self) -> Status:
        """Worst status among the verdicts of the case: fail, then inconclusive, then pass."""
        if self.count(Status.FAIL):
            return Status.FAIL
        return Status.INCONCLUSIVE if self.count(Status.INCONCLUSIVE) else Status.PASS


# Smallest accepted fraction of covered numbers in a report of all cases at the full level.
LEAST_SHARE = 0.95


def judged_errors(cases: tuple[CaseOutcome, ...]) -> Iterator[tuple[CaseOutcome, Verdict]]:
    """Yield all verdicts on numbers for which the solver states an error, with the outcome of the
    case.

    Used to count how often stated errors cover the actual errors.
    """
    for case in cases:
        yield from ((case, verdict) for verdict in case.verdicts if verdict.covered is not None)


def share_covered(cases: tuple[CaseOutcome, ...]) -> float:
    """Compute the fraction of stated errors that are at least as large as the actual errors.

    The uncertainty of the reference is added to the stated error. Numbers without a stated error do
    not count. The fraction is 1 if there are no stated errors.
    """
    found = [verdict.covered for _, verdict in judged_errors(cases)]
    return sum(map(bool, found)) / len(found) if found else 1.0


SYMBOLS = {Status.PASS: "✓", Status.FAIL: "✗", Status.INCONCLUSIVE: "?"}


WORDS = {Status.PASS: "pass", Status.FAIL: "FAIL", Status.INCONCLUSIVE: "inconclusive"}


# Smaller errors, relative to the scale of their verdict, are round-off of sums over 10⁴ cells.
ROUNDING = 1e-12


PERCENT_SHOWN_TO = 9.995


def clearance_text(verdict: Verdict) -> str:
    """Return the error of a verdict over the accepted error as text: a percentage, or a multiple if
    large.
    """
    part = verdict.clearance
    if part is None:
        return "–"
    if part < 0.005:
        return "< 1 %"
    return f"{100 * part:.0f} %" if part < PERCENT_SHOWN_TO else f"{part:.3g} times"


def uncertainty_text(verdict: Verdict) -> str:
    """Return the uncertainty of a reference over the error scale as text, such as "± 1e-4, ".

    The text is empty if the uncertainty is not above rounding.
    """
    part = (verdict.reference_uncertainty or 0.0) / verdict.scale
    return f"± {plain(part, 2)}, " if part > ROUNDING else ""


def error_text(verdict: Verdict) -> str:
    """Return the error of a verdict over its scale as text, below round-off as "< 1e-12"."""
    # No processor's zero: on another one the same error is the last digit of a sum.
    below = verdict.error is not None and verdict.error < ROUNDING
    return f"< {plain(ROUNDING)}" if below else plain(verdict.error)


def verdict_order_text(verdict: Verdict) -> str:
    """Return the observed order of a verdict with its 95 % interval as text."""
    if verdict.value is None or verdict.interval is None:
        return NOT_FINITE
    return order_text(verdict.value, verdict.interval)


def moved_text(change: Change) -> str:
    """Return the change of a number since its recording as text, in units U of the
    accepted error.
    """
    return "–" if change.moved is None else f"{plain(change.moved, 2)} U"


def failure_line(case: str, verdict: Verdict, level: str) -> str:
    """Return one line for a log about a failed or changed verdict, with the command that repeats
    it.

    case     name of the case
    verdict  failed or changed verdict
    level    amount of computation, as in the command line
    """
    word = "FAIL" if verdict.status is Status.FAIL else "MOVED"
    return (
        f"{word} {case}/{verdict.name} [{verdict.run}]: {failure_text(verdict)}; "
        f"reproduce: slipstick verify {case} --level {level}"
    )


def failure_text(verdict: Verdict) -> str:
    """Describe a failed verdict: measured value, expected value with tolerance, recorded value,
    and the place in the run, such as the increment with its energies.
    """
    if verdict.name == SOLVED:
        return verdict.meaning + _was_text(verdict)
    measured, reference = (
        value_text(value, verdict.unit) for value in (verdict.value, verdict.reference)
    )
    excess = "" if verdict.clearance is None else f" ({verdict.clearance:.2g} U)"
    was, place = _was_text(verdict), "".join(verdict.meaning.partition(", increment ")[1:])
    return f"{measured}, expected {reference} ± {_allowed_text(verdict)}{excess}{was}{place}"


def _allowed_text(verdict: Verdict) -> str:
    """Return the accepted error of a verdict as text, in the unit in which the value is shown."""
    allowed, unit = verdict.allowed * verdict.scale, verdict.unit
    if unit in ("", "°"):
        return plain(allowed, 2) + unit
    largest = max(abs(verdict.reference), 0.0 if verdict.reference else abs(verdict.value or 0.0))
    scale = engineering_unit(largest or allowed, unit)
    return f"{plain(allowed / scale.size, 2)} {scale.name}"


def _was_text(verdict: Verdict) -> str:
    """Return the recorded value of a number and its commit as text; "" if no value is recorded."""
    change = verdict.regression
    if change is None or not change.recorded:
        return ""
    why = f" ({change.remark})" if verdict.status is Status.INCONCLUSIVE and change.remark else ""
    return f"; was {value_text(change.was, verdict.unit)} at {change.since}{why}"
