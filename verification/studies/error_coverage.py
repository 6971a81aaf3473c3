"""Study of stated errors: how often the error that a run states for a number covers the true error.

The scenes are drawn at random from families with known results. Each is solved as `slipstick run`
solves it. Requested accuracies are checked on further random scenes.
"""

from __future__ import annotations

import time
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from math import ceil
from zlib import crc32

import numpy as np
from scipy.special import bdtr, betaincinv

from contact_errors.adaptive_refinement import Levels, refine
from contact_errors.coarse_solves import stated_errors
from contact_errors.error_formula import values_of
from contact_scene.accuracy import BOUND, LARGEST_TENSION, AccuracyRequest
from contact_scene.discretised import Fineness
from contact_scene.quantities.stated_error import ErrorStatus, StatedError
from contact_scene.solver_errors import SolverError
from verification.exhibits.chart import NONE, Chart, Look, Table, log_chart, point_curves
from verification.judging.case import Level
from verification.judging.outcome import Status
from verification.problems.drawn.drawing import (
    CELLS,
    KINDS,
    STRESSES,
    KnownScene,
    Truth,
    logarithmic,
)
from verification.problems.drawn.families import (
    CHOOSING,
    FAMILIES,
    JUDGING,
    TRIED,
    drawn,
    stress_maxima,
)
from verification.running.study import (
    CaseRecord,
    Conclusion,
    Records,
    Row,
    Settings,
    Statement,
    Study,
    found,
    judged,
    parameters_of,
    solved,
    value_of,
)

WRONG = "wrong"
STATED = "stated"
UNCERTAIN = "uncertain"
# Origins of a stated error; errors by coarse solves have a part by the tolerance, too.
REFERENCE = "reference"
COARSE_SOLVES = "coarse solves"
OF_REFERENCES = {"cells", "elements", "quadrature", "map"}


@dataclass(frozen=True)
class CoverageCase:
    """Random scene with known results, whose stated errors the study compares with the true errors.

    family  name of the family of scenes
    seed    seed of the random generator
    number  number of the scene in its family
    """

    family: str
    seed: int
    number: int

    @property
    def name(self) -> str:
        return f"{self.family}-{self.seed}-{self.number}"

    def compute(self) -> CaseRecord:
        """Solve the random scene, and record true and stated error of each result with a known
        value.

        If the solver refuses the scene, the text of its error is recorded instead.
        """
        known = drawn(self.family, self.seed, self.number)
        started = time.process_time()
        record = CaseRecord(parameters=parameters_of(self) | {"solver": known.fineness.solver})
        try:
            parts = tuple(_coverage_rows(known))
        except SolverError as error:
            return record.model_copy(update={"words": {"refused": str(error)}})
        seconds = time.process_time() - started
        return record.model_copy(update={"parts": parts, "seconds": seconds})


def _coverage_rows(known: KnownScene) -> Iterator[Row]:
    result = known.solver.run()
    errors = stated_errors(result)
    steps = values_of(result)
    stressed = {truth.step for truth in known.truths if truth.quantity in STRESSES}
    stresses = {step: stress_maxima(result, step, errors) for step in stressed}
    for truth in known.truths:
        if truth.quantity in STRESSES:
            found, stated = stresses[truth.step][truth.quantity]
            yield coverage_row(truth, found, stated)
        elif (found_here := truth.read(steps)) is not None:
            yield coverage_row(truth, found_here, errors.steps[truth.step - 1].get(truth.quantity))


def coverage_row(truth: Truth, found: float, stated: StatedError | None) -> Row:
    """Return true error, stated error and uncertainty of the reference for one result, as a row.

    All three are divided by the magnitude of the reference value.

    truth   known value: quantity, load step and reference with uncertainty
    found   computed value, in the unit of the reference
    stated  error that the run states for the value; None if the run states none
    """
    size = abs(truth.value)
    error = None if stated is None or stated.error is None else float(np.ravel(stated.error)[0])
    return Row(
        parameters={"quantity": truth.quantity, "kind": truth.kind, "step": truth.step},
        measures={
            WRONG: abs(found - truth.value) / size,
            STATED: None if error is None else error / size,
            UNCERTAIN: truth.uncertainty / size,
        },
        words={
            "status": "not stated" if stated is None else str(stated.status),
            "by": REFERENCE if stated and stated.parts.keys() <= OF_REFERENCES else COARSE_SOLVES,
        },
    )


CONFIDENCE = 0.95
COVERED = 0.95
COVERED_IN_ALL = 0.97
SIGNIFICANT = 0.01  # probability of so few covered numbers at a true fraction of COVERED_IN_ALL
TIMES = 10.0  # limit of stated over true error for a tight stated error
TOO_WIDE = 30.0  # stated over true error beyond which a stated error is of no use
SHOWN = 1e-8  # relative error that numbers with at most eight digits show
# If errors scatter like normal numbers and 0.98 of them are covered, 0.82 are within 10 times and
# 0.06 beyond 30 times the true error by chance.
TIGHT = 0.75
WIDE = 0.08
FALSE_MARKS = 0.02
CERTAIN = 0.1  # limit of the uncertainty of a reference over the stated error
MISSED = 3.0  # uncertainties above the stated error for a certain verdict
BELIEVED = str(ErrorStatus.ESTIMATED), str(ErrorStatus.EXACT)
DOUBTED = str(ErrorStatus.NOT_CONVERGED)


@dataclass(frozen=True)
class Share:
    """Observed fraction `count / of`, with its Clopper-Pearson confidence interval (1934).

    Used for the fraction of stated errors that cover the true error.

    count  number of favourable results
    of     number of all results
    """

    count: int
    of: int

    @property
    def part(self) -> float:
        """Observed fraction as a number: `count / of`, or 1 if nothing was counted."""
        return self.count / self.of if self.of else 1.0

    @property
    def interval(self) -> tuple[float, float]:
        """Two-sided 95 % confidence interval of the fraction: the error probability is 2.5 % on
        each side."""
        k, n, tail = self.count, self.of, (1 - CONFIDENCE) / 2
        low = float(betaincinv(k, n - k + 1, tail)) if k else 0.0
        high = float(betaincinv(k + 1, n - k, 1 - tail)) if k < n else 1.0
        return low, high

    @property
    def text(self) -> str:
        """Fraction and its 95 % interval as text, such as 0.962 [0.931, 0.981]."""
        low, high = self.interval
        return f"{self.part:.3f} [{low:.3f}, {high:.3f}]"


@dataclass(frozen=True)
class Coverage:
    """Number of stated errors of a group of results that cover the true error.

    A result is decided if its reference is certain enough to judge the stated error.

    group       name of the group: a kind of quantity or a family of scenes
    covered     fraction of covered results among those that are decided and have the status
                estimated or exact
    tight       among the same results, fraction with a stated error below 10 times the true error
    wide        among the same results, fraction with a stated error beyond 30 times the true error
    apart       fraction of covered results among those that are decided and have the status "not
                converged"
    false_marks fraction of all decided results that are "not converged", although their stated
                error covers the true error and is below 10 times as large
    undecided   number of results whose reference is too uncertain for a verdict
    not_stated  number of results without a stated error
    """

    group: str
    covered: Share
    tight: Share
    wide: Share
    apart: Share
    false_marks: Share
    undecided: int
    not_stated: int

    @classmethod
    def of(cls, group: str, rows: Sequence[Row]) -> Coverage:
        """Count the stated errors of a group of results that cover the true error.

        group  name of the group
        rows   one row per result, with true error, stated error and uncertainty of the reference
        """
        having = [row for row in rows if row.measures[STATED] is not None]
        certain = [row for row in having if is_decided(row)]
        believed = [row for row in certain if row.words["status"] in BELIEVED]
        doubted = [row for row in certain if row.words["status"] == DOUBTED]
        return cls(
            group,
            Share(sum(map(covers, believed)), len(believed)),
            Share(sum(map(is_tight, believed)), len(believed)),
            Share(sum(map(is_wide, believed)), len(believed)),
            Share(sum(map(covers, doubted)), len(doubted)),
            Share(sum(covers(row) and is_tight(row) for row in doubted), len(certain)),
            len(having) - len(certain),
            len(rows) - len(having),
        )


def covers(row: Row) -> bool:
    """Return True if a stated error covers the true error, up to the uncertainty of the reference.

    row  true error, stated error and uncertainty of one result
    """
    return value_of(row, WRONG) <= value_of(row, STATED) + value_of(row, UNCERTAIN)


def is_tight(row: Row) -> bool:
    """Return True if the stated error of a result is at most 10 times its true error.

    Larger stated errors cover the true error, but are of little use. An error that the eight digits
    of a page do not show is tight.

    row  true error, stated error and uncertainty of one result
    """
    return value_of(row, STATED) <= max(TIMES * value_of(row, WRONG), SHOWN)


def is_wide(row: Row) -> bool:
    """Return True if the stated error of a result is beyond 30 times its true error.

    An error that the eight digits of a page do not show is not.

    row  true error, stated error and uncertainty of one result
    """
    return value_of(row, STATED) > max(TOO_WIDE * value_of(row, WRONG), SHOWN)


def is_decided(row: Row) -> bool:
    """Return True if the reference of a result is certain enough to judge the stated error.

    The uncertainty of the reference must be at most 0.1 of the stated error. Otherwise the true
    error must exceed the stated error by more than 3 uncertainties, so that it is certainly not
    covered.

    row  true error, stated error and uncertainty of one result
    """
    stated, uncertain = value_of(row, STATED), value_of(row, UNCERTAIN)
    return uncertain <= CERTAIN * stated or value_of(row, WRONG) > stated + MISSED * uncertain


def coverage_by_group(rows: Iterable[tuple[str, Row]]) -> dict[str, Coverage]:
    """Count the stated errors that cover the true error, for each group of results.

    rows  pairs of the name of a group and the row of one result
    """
    groups: dict[str, list[Row]] = {}
    for name, row in rows:
        groups.setdefault(name, []).append(row)
    return {name: Coverage.of(name, members) for name, members in groups.items()}


SHARES = (2e-4, 0.1)
# Work of the largest level: cells times increments, and elements over the radius times increments.
MAX_CELLS = 1_500_000
MAX_ELEMENTS = 3_000
ASKED = "asked"
REACHED = "reached"
TRUE = "true"


@dataclass(frozen=True)
class LimitedLevels(Levels):
    """Refinement levels of a scene with a limit on the work per level, for checks of requested
    accuracies.

    most  largest product of the number of cells (or elements per radius) and of all increments
    """

    most: float = np.inf

    def beyond_limit(self, fineness: Fineness) -> str | None:
        sizes = self.solver.record_entry(fineness.space).values()
        if np.prod([*sizes]) * sum(fineness.increments) > self.most:
            return "the next level takes more work than the study allows"
        return super().beyond_limit(fineness)


@dataclass(frozen=True)
class RequestCase:
    """Random request of accuracy, which the study checks against the true error.

    A request names a scene with known results, one quantity and the relative error that is allowed.

    seed    seed of the random generator
    number  number of the request
    """

    seed: int
    number: int

    @property
    def name(self) -> str:
        return f"request-{self.seed}-{self.number}"

    def compute(self) -> CaseRecord:
        """Refine the scene until the requested accuracy is reported as met, or refinement stops.

        The record has the requested, the reported and the true relative error.
        """
        family, known, quantity, share = self._draw_request()
        truths = [truth for truth in known.truths if truth.quantity == quantity]
        record = CaseRecord(
            parameters=parameters_of(self) | {"family": family, "quantity": quantity},
            measures={ASKED: share},
        )
        # The largest tension is requested on cells only (`_requestable_quantities`).
        stress_at = truths[0].step if quantity == LARGEST_TENSION else None
        most = MAX_CELLS if known.fineness.solver == CELLS else MAX_ELEMENTS
        levels = LimitedLevels(known.solver, stress_at, most=most)
        try:
            made = refine(levels, AccuracyRequest(**{quantity: share}))
        except SolverError as error:
            return record.model_copy(update={"words": {"outcome": f"refused: {error}"}})
        largest = max(abs(truth.value) for truth in truths)
        found = [truth.read(made.level.values) for truth in truths]
        errors = [
            np.inf if f is None else abs(f - t.value) for f, t in zip(found, truths, strict=True)
        ]
        measures = {REACHED: made.accuracy.reached[quantity], TRUE: max(errors) / largest}
        outcome = "met" if made.accuracy.met else f"stopped: {made.accuracy.stopped}"
        return record.model_copy(
            update={"measures": record.measures | measures, "words": {"outcome": outcome}}
        )

    def _draw_request(self) -> tuple[str, KnownScene, str, float]:
        """Draw a random request: a scene with known results, one of its quantities and an allowed
        error.

        Draws are repeated until a quantity has a reference that is certain enough to check the
        request. Returns the family of the scene, the scene, the quantity and the allowed relative
        error.
        """
        rng = np.random.default_rng([self.seed, crc32(b"request"), self.number])
        while True:
            family = str(rng.choice([*FAMILIES]))
            share, known = logarithmic(rng, *SHARES), FAMILIES[family].known(rng)
            fit = [*dict.fromkeys(_requestable_quantities(known, share))]
            if fit:
                return family, known, fit[int(rng.integers(len(fit)))], share


def _requestable_quantities(known: KnownScene, share: float) -> Iterator[str]:
    """Yield the quantities of a scene for which a requested accuracy can be checked.

    The relative uncertainty of their references must be at most 0.1 of `share` at all load steps.

    known  scene with known results
    share  requested relative error
    """

    def uncertain(truth: Truth) -> float:
        return truth.uncertainty / abs(truth.value)

    for quantity in dict.fromkeys(truth.quantity for truth in known.truths):
        of_it = [truth for truth in known.truths if truth.quantity == quantity]
        stressed = quantity == LARGEST_TENSION and known.fineness.solver != CELLS
        if quantity in BOUND and not stressed and max(map(uncertain, of_it)) <= CERTAIN * share:
            yield quantity


ENOUGH = 100  # results of a group that a verdict requires
# Number of requested accuracies, allowed number of false ones, and their allowed true error over
# the request.
REQUESTS = 60
FALSE = 2
FACTOR = 2.0
# range of x and smallest y of the diagram
PARTS = (1e-2, 1e1)
LEAST_SHARE = 1e-3
ALL = "all numbers"
REMARKS = (
    "Seeds: the believed fraction 0.6 of the convergence orders was chosen with seeds "
    f"{', '.join(map(str, CHOOSING))}; families and repairs were tried with "
    f"{', '.join(map(str, TRIED))}; the scenes of this record have the seed {JUDGING}.",
    "Covered: the true error is at most the stated one, up to the uncertainty of the reference. "
    f"Tight: the stated error is at most {TIMES:g} times the true one; wide: beyond {TOO_WIDE:g} "
    "times. False marks: 'not converged', although covered and tight. Undecided: the reference "
    f"is less certain than {CERTAIN:g} of the stated error. Intervals are Clopper and Pearson's, "
    "95 %. Numbers of one scene are not independent, so that intervals are somewhat too narrow.",
    "The pressing of uncoupled bodies has stated errors by an independent method, often that of "
    "its reference here: these numbers are covered by construction. The numbers by coarse solves "
    "are counted separately.",
    "References: ring solver (twice the rings and increments), closed forms, and the same solver "
    "on finer cells, with the effect of more increments added separately. Numbers that are 'not "
    "converged' are counted apart. Numbers of a scene and unit that agree to two digits share an "
    "error and are counted once. A scene whose contact reaches the edge of its map is drawn again.",
)


def cases(settings: Settings) -> tuple[CoverageCase | RequestCase, ...]:
    """Return the random scenes and the random requests of accuracy that the study solves.

    The standard level has a third of those of the full level. The quick level has one request and
    one scene of each family.
    """
    part = {Level.QUICK: 0, Level.STANDARD: 3, Level.FULL: 1}[settings.level]

    def numbers(count: int) -> range:
        return range(ceil(count / part) if part else 1)

    return (
        *(CoverageCase(f, JUDGING, n) for f, one in FAMILIES.items() for n in numbers(one.count)),
        *(RequestCase(JUDGING, n) for n in numbers(REQUESTS)),
    )


def conclude(settings: Settings, records: Records) -> Conclusion:
    """Judge how often stated errors cover the true errors, and if requested accuracies are met.

    Each kind of quantity and each family of scenes is judged separately.
    """
    asked = cases(settings)
    known = found(asked, records)
    scenes = [record for case, record in known.items() if isinstance(case, CoverageCase)]
    requests = [record for case, record in known.items() if isinstance(case, RequestCase)]
    rows = [(str(scene.parameters["family"]), row) for scene in scenes for row in scene.parts]
    total = Coverage.of(ALL, [row for _, row in rows])
    coarse = [row for _, row in rows if row.words.get("by") == COARSE_SOLVES]
    by_coarse_solves = Coverage.of("numbers by coarse solves", coarse)
    kinds = coverage_by_group((str(row.parameters["kind"]), row) for _, row in rows)
    families = coverage_by_group(rows)
    return Conclusion(
        answer=f"Stated errors cover {total.covered.part:.1%} of {total.covered.of} numbers of "
        f"known answer; {total.tight.part:.1%} are at most {TIMES:g} times the true error, "
        f"{total.wide.part:.1%} beyond {TOO_WIDE:g} times; {total.false_marks.part:.1%} have a "
        "false question mark.",
        statements=(
            solved("every scene and request is solved", len(known), len(asked), "cases"),
            _coverage_statement(total),
            _width_statement(total),
            _coverage_statement(by_coarse_solves),
            *(_group_statement(one) for one in kinds.values()),
            *(_group_statement(one, prefix="family ") for one in families.values()),
            _request_statement(requests),
        ),
        tables=(
            _coverage_table(
                "Stated and true errors by quantity", [total, by_coarse_solves, *kinds.values()]
            ),
            _coverage_table("Stated and true errors by family of scenes", [*families.values()]),
        ),
        charts=(_coverage_chart({kind: _decided_rows_of_kind(kind, rows) for kind in KINDS}),)
        if rows
        else (),
        remarks=REMARKS,
    )


def _decided_rows_of_kind(kind: str, rows: Sequence[tuple[str, Row]]) -> list[Row]:
    """Return the results of one kind of quantity whose stated error can be judged.

    Their status is estimated or exact, and their reference is certain enough. Used for the chart of
    true over stated error.

    kind  kind of quantity
    rows  pairs of the family of a scene and the row of one result
    """
    return [
        row
        for _, row in rows
        if row.parameters["kind"] == kind
        and row.words["status"] in BELIEVED
        and row.measures[STATED] is not None
        and is_decided(row)
    ]


def _coverage_table(title: str, groups: Sequence[Coverage]) -> Table:
    rows = (
        (
            one.group.replace("_", " "),
            str(one.covered.of),
            *(share.text for share in (one.covered, one.tight, one.wide, one.false_marks)),
            f"{one.apart.of}, covered {one.apart.count}",
            str(one.undecided),
            str(one.not_stated),
        )
        for one in groups
    )
    return Table(
        title=title,
        columns=(
            *("group", "numbers", "covered", "tight", "wide", "false marks"),
            *("not converged", "undecided", "not stated"),
        ),
        rows=tuple(rows),
        units=NONE,
    )


def _coverage_statement(coverage: Coverage) -> Statement:
    covered = coverage.covered
    good = covered.part >= COVERED_IN_ALL
    return _statement(
        coverage,
        f"{coverage.group}: covered ≥ {COVERED_IN_ALL:g}",
        judged(good, complete=covered.of >= ENOUGH),
    )


def _group_statement(coverage: Coverage, prefix: str = "") -> Statement:
    """Judge if the coverage of a kind or a family is significantly below that of all numbers.

    With a true fraction of 0.97, so few covered numbers must have a probability of at least 1 %.
    """
    covered, group = coverage.covered, coverage.group.replace("_", " ")
    good = bool(bdtr(covered.count, covered.of, COVERED_IN_ALL) >= SIGNIFICANT)
    return _statement(
        coverage,
        f"{prefix}{group}: covered not significantly below {COVERED_IN_ALL:g} (binomial, "
        f"{SIGNIFICANT:.0%})",
        judged(good, complete=covered.of >= ENOUGH or not good),
    )


def _statement(coverage: Coverage, claim: str, outcome: Status) -> Statement:
    covered = coverage.covered
    return Statement(
        claim=claim,
        outcome=outcome,
        measured=f"covered {covered.text}, tight {coverage.tight.text}, of {covered.of} numbers",
        because=f"at least {ENOUGH} numbers decide",
    )


def _width_statement(total: Coverage) -> Statement:
    """Judge if stated errors are of the size of the true errors, and question marks rare."""
    tight, wide, marks = total.tight, total.wide, total.false_marks
    good = tight.part >= TIGHT and wide.part <= WIDE and marks.part <= FALSE_MARKS
    return Statement(
        claim=f"{ALL}: tight ≥ {TIGHT:g}, wide ≤ {WIDE:g}, false marks ≤ {FALSE_MARKS:g}",
        outcome=judged(good, complete=tight.of >= ENOUGH),
        measured=f"tight {tight.text}, wide {wide.text}, false marks {marks.text}",
        because=f"at least {ENOUGH} numbers decide",
    )


def _request_statement(requests: Sequence[CaseRecord]) -> Statement:
    """Judge if the true errors meet the requested accuracies that refinement reported as met.

    At most 2 of 60 may be false, and no true error may exceed twice the request.

    requests  records with the requested and the true relative error
    """
    met = [one for one in requests if one.words["outcome"] == "met"]
    ratios = [value_of(one, TRUE) / value_of(one, ASKED) for one in met]
    false, worst = sum(ratio > 1 for ratio in ratios), max(ratios, default=0.0)
    return Statement(
        claim=f"requested accuracies: at most {FALSE} of {REQUESTS} reported as met are not, none "
        f"by more than a factor {FACTOR:g}",
        outcome=judged(
            false * REQUESTS <= FALSE * len(met) and worst <= FACTOR,
            complete=len(requests) >= REQUESTS,
        ),
        measured=f"{len(met)} of {len(requests)} met, {false} of them not by the true error, "
        f"largest true error {worst:.2f} of the request",
    )


def _coverage_chart(parts: dict[str, list[Row]]) -> Chart:
    """Draw the distribution of the ratio of true to stated error, one curve per kind of quantity.

    The ordinate is the fraction of the results whose ratio exceeds the abscissa.

    parts  rows of the results by kind of quantity
    """
    lines = [
        (kind.replace("_", " "), _exceedance_curve(rows)) for kind, rows in parts.items() if rows
    ]
    allowed = [(1.0, LEAST_SHARE), (1.0, 1 - COVERED)]
    return log_chart(
        "wrong_over_stated",
        "True over stated error",
        f"Share of the numbers of a kind beyond a part of their stated error. The error does not "
        f"cover those beyond 1, at most {1 - COVERED:.0%} (grey). It is tight for those beyond "
        f"{1 / TIMES:g}.",
        "true / stated error",
        "share beyond",
        [*point_curves(lines, Look.COMPUTED), *point_curves([("allowed", allowed)], Look.BOUND)],
        height=4.0,
    )


def _exceedance_curve(rows: Sequence[Row]) -> list[tuple[float, float]]:
    """Compute the fraction of results whose ratio of true to stated error exceeds x, for several x.

    Returns pairs (x, fraction). Fractions below 1e-3 are left out, because the chart is
    logarithmic.

    rows  true and stated errors of the results
    """
    stated, wrong = (
        np.array([row.measures[name] for row in rows], float) for name in (STATED, WRONG)
    )
    parts = wrong / np.maximum(stated, np.finfo(float).tiny)
    found = [(x, float(np.mean(parts > x))) for x in np.geomspace(*PARTS, 41)]
    return [(float(x), share) for x, share in found if share >= LEAST_SHARE]


STUDY = Study(
    name="error-coverage",
    title="Coverage of stated errors",
    question="Every number of a run has a stated error. Over drawn scenes of known answer, how "
    "often is the true error within the stated one, and how often is it of that size?",
    cases=cases,
    conclude=conclude,
)
