"""Study of stated errors: coverage of the true errors, tightness, and requested accuracies."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import ceil
from typing import Any
from zlib import crc32

import numpy as np

from contact_errors.adaptive_refinement import Levels, RefinementLevel, refine
from contact_errors.coarse_solves import Fineness
from contact_errors.on_cells import CellSolver
from contact_errors.on_elements import ElementSolver
from contact_scene.accuracy import BOUND, LARGEST_TENSION, AccuracyRequest
from contact_scene.solver_errors import SolverError
from verification.exhibits.chart import Chart, Look, Table, log_chart, point_curves, table_of
from verification.judging.case import Level
from verification.problems.drawn.drawing import CELLS, KINDS, KnownScene, Truth, logarithmic
from verification.problems.drawn.families import CHOOSING, FAMILIES, JUDGING, TRIED
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
from verification.studies.error_coverage.case import (
    BELIEVED,
    CERTAIN,
    COVERED,
    COVERED_IN_ALL,
    STATED,
    TIGHT,
    TIMES,
    WRONG,
    Coverage,
    CoverageCase,
    grouped,
    is_decided,
)

SHARES = (2e-4, 0.1)
# Work of the largest level: cells times increments, and elements over the radius times increments.
MAX_CELLS, MAX_ELEMENTS = 1_500_000, 3_000
ASKED, REACHED, TRUE = "asked", "reached", "true"


@dataclass(frozen=True)
class LimitedLevels(Levels):
    """Refinement levels of a scene, limited by a largest work per level.

    most  largest product of the number of cells (or elements per radius) and of all increments
    """

    most: float = np.inf

    def beyond_limit(self, fineness: Fineness) -> str | None:
        sizes = self.solver.shown(fineness.space).values()
        if np.prod([*sizes]) * sum(fineness.increments) > self.most:
            return "the next level takes more work than the study allows"
        return super().beyond_limit(fineness)


@dataclass(frozen=True)
class RequestCase:
    """Identify a random request of accuracy by the seed of the generator and its number.

    A request names a scene, one quantity and the relative error that is allowed.
    """

    seed: int
    number: int

    @property
    def name(self) -> str:
        return f"request-{self.seed}-{self.number}"

    def compute(self) -> CaseRecord:
        """Refine the scene until the request is reported as met or refinement stops; record the
        true error.
        """
        family, known, quantity, share = self._drawn()
        truths = [truth for truth in known.truths if truth.quantity == quantity]
        record = CaseRecord(
            parameters=parameters_of(self) | {"family": family, "quantity": quantity},
            measures={ASKED: share},
        )
        asked: Any = known.fineness.asked
        if known.fineness.solver == CELLS:
            stress_at = truths[0].step if quantity == LARGEST_TENSION else None
            on_cells = CellSolver(known.scene, asked, stress=stress_at is not None)
            levels = LimitedLevels(on_cells, stress_at, most=MAX_CELLS)
        else:
            levels = LimitedLevels(ElementSolver(known.scene, asked), most=MAX_ELEMENTS)
        try:
            made = refine(levels, AccuracyRequest(**{quantity: share}))
        except SolverError as error:
            return record.model_copy(update={"words": {"outcome": f"refused: {error}"}})
        largest = max(abs(truth.reference.value) for truth in truths)
        found = [_found(truth, made.level) for truth in truths]
        errors = [abs(f - t.reference.value) for f, t in zip(found, truths, strict=True)]
        measures = {REACHED: made.accuracy.reached[quantity], TRUE: max(errors) / largest}
        outcome = "met" if made.accuracy.met else f"stopped: {made.accuracy.stopped}"
        return record.model_copy(
            update={"measures": record.measures | measures, "words": {"outcome": outcome}}
        )

    def _drawn(self) -> tuple[str, KnownScene, str, float]:
        """Draw a scene of known answer, a quantity of the scene and an allowed relative error.

        Draws are repeated until a quantity has a reference that is certain enough for the request.
        Returns the family of the scene, the scene, the quantity and the allowed relative error.
        """
        rng = np.random.default_rng([self.seed, crc32(b"request"), self.number])
        while True:
            family = str(rng.choice([*FAMILIES]))
            share, known = logarithmic(rng, *SHARES), FAMILIES[family].known(rng)
            fit = [*dict.fromkeys(_certain(known, share))]
            if fit:
                return family, known, fit[int(rng.integers(len(fit)))], share


def _found(truth: Truth, level: RefinementLevel) -> float:
    found = truth.read(level.values)
    return np.inf if found is None else found


def _certain(known: KnownScene, share: float) -> Iterator[str]:
    """Yield the quantities of a scene for which an accuracy can be requested and checked.

    The relative uncertainty of the reference must be at most 0.1 of `share` at all load steps.

    share  requested relative error
    """

    def uncertain(truth: Truth) -> float:
        return truth.reference.uncertainty / abs(truth.reference.value)

    for quantity in dict.fromkeys(truth.quantity for truth in known.truths):
        of_it = [truth for truth in known.truths if truth.quantity == quantity]
        stressed = quantity == LARGEST_TENSION and known.fineness.solver != CELLS
        if quantity in BOUND and not stressed and max(map(uncertain, of_it)) <= CERTAIN * share:
            yield quantity


ENOUGH = 100  # results of a group that a verdict requires
REQUESTS, FALSE, FACTOR = 60, 2, 2.0  # number; allowed false ones; allowed true error over request
PARTS, LEAST_SHARE = (1e-2, 1e1), 1e-3  # range of x and smallest y of the diagram
ALL = "all numbers"
REMARKS = (
    "Seeds: none for fitting, as no constant is fitted to scenes. The common factor 0.6 of the "
    f"convergence orders was chosen with seeds {', '.join(map(str, CHOOSING))}; families and "
    f"repairs were tried with {', '.join(map(str, TRIED))}; the scenes of this record have the "
    f"seed {JUDGING}.",
    "Covered: the true error is at most the stated one, up to the uncertainty of the reference. "
    f"Tight: the stated error is less than {TIMES:g} times the true one. Undecided: the reference "
    f"is less certain than {CERTAIN:g} of the stated error. Intervals are Clopper and Pearson's, "
    "95 %. Numbers of one scene are not independent, so that intervals are somewhat too narrow.",
    "References: ring solver (twice the rings and increments), closed forms, and the same solver "
    "on finer cells, with the effect of more increments added separately. Numbers that are 'not "
    "converged' are counted apart. Numbers of a scene and unit that agree to two digits share an "
    "error and are counted once. A scene whose contact reaches the edge of its map is drawn again.",
)


def cases(settings: Settings) -> tuple[CoverageCase | RequestCase, ...]:
    """Return the random scenes and the requests of accuracy that the study solves.

    The standard level has a third of those of the full level, and the quick level one of each kind.
    """
    parts = {Level.QUICK: 0, Level.STANDARD: 3, Level.FULL: 1}
    part = parts[settings.level]

    def numbers(count: int) -> range:
        return range(ceil(count / part) if part else 1)

    return (
        *(CoverageCase(f, JUDGING, n) for f, one in FAMILIES.items() for n in numbers(one.count)),
        *(RequestCase(JUDGING, n) for n in numbers(REQUESTS)),
    )


def conclude(settings: Settings, records: Records) -> Conclusion:
    """Judge the coverage of the stated errors of every group of results, and the requested
    accuracies.
    """
    asked = cases(settings)
    known = found(asked, records)
    scenes = [record for case, record in known.items() if isinstance(case, CoverageCase)]
    requests = [record for case, record in known.items() if isinstance(case, RequestCase)]
    rows = [(str(scene.parameters["family"]), row) for scene in scenes for row in scene.parts]
    total = Coverage.of(ALL, [row for _, row in rows])
    kinds = grouped((str(row.parameters["kind"]), row) for _, row in rows)
    families = grouped(rows)
    return Conclusion(
        answer=f"Stated errors cover {total.covered.part:.1%} of {total.covered.of} numbers of "
        f"known answer; {total.tight.part:.1%} are less than {TIMES:g} times the true error.",
        statements=(
            solved("every scene and request is solved", len(known), len(asked), "cases"),
            _statement(total, COVERED_IN_ALL, TIGHT),
            *(_statement(one, COVERED) for one in kinds.values()),
            *(_statement(one, COVERED, prefix="family ") for one in families.values()),
            _requests(requests),
        ),
        tables=(
            _table("Stated and true errors by quantity", [total, *kinds.values()]),
            _table("Stated and true errors by family of scenes", [*families.values()]),
        ),
        charts=(_chart({kind: _of_kind(kind, rows) for kind in KINDS}),) if rows else (),
        remarks=REMARKS,
    )


def _of_kind(kind: str, rows: Sequence[tuple[str, Row]]) -> list[Row]:
    """Return the results of one kind of quantity whose stated error can be judged.

    Their status is estimated or exact, and their reference is certain enough.

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


def _table(title: str, groups: Sequence[Coverage]) -> Table:
    return table_of(
        title,
        {
            "group": lambda one: one.group.replace("_", " "),
            "numbers": lambda one: str(one.covered.of),
            "covered": lambda one: one.covered.text,
            "tight": lambda one: one.tight.text,
            "not converged": lambda one: f"{one.apart.of}, covered {one.apart.count}",
            "undecided": lambda one: str(one.undecided),
            "not stated": lambda one: str(one.not_stated),
        },
        groups,
    )


def _statement(
    coverage: Coverage, least: float, tightest: float = 0.0, prefix: str = ""
) -> Statement:
    covered, tight = coverage.covered, coverage.tight
    good, group = covered.part >= least and tight.part >= tightest, coverage.group.replace("_", " ")
    of_size = f", tight ≥ {tightest:g}" if tightest else ""
    return Statement(
        claim=f"{prefix}{group}: covered ≥ {least:g}{of_size}",
        outcome=judged(good, complete=covered.of >= ENOUGH),
        measured=f"covered {covered.text}, tight {tight.text}, of {covered.of} numbers",
        because=f"at least {ENOUGH} numbers decide",
        about=Row(
            parameters={"kind": coverage.group},
            measures={"covered": covered.part, "tight": tight.part},
            counters={"numbers": covered.of},
        ),
    )


def _requests(requests: Sequence[CaseRecord]) -> Statement:
    """Judge if results whose requested accuracy is reported as met really have errors below the
    request.

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
        about=Row(measures={"worst": worst}, counters={"met": len(met), "false": false}),
    )


def _chart(parts: dict[str, list[Row]]) -> Chart:
    """Draw, for each kind of quantity, the distribution of the true error over the stated error.

    The ordinate is the fraction of the results whose ratio exceeds the abscissa.

    parts  rows of the results by kind of quantity
    """
    lines = [(kind.replace("_", " "), _exceeding(rows)) for kind, rows in parts.items() if rows]
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


def _exceeding(rows: Sequence[Row]) -> list[tuple[float, float]]:
    """Compute the fraction of results whose ratio of true to stated error exceeds x, at several x.

    Returns pairs (x, fraction). Fractions below 1e-3 are left out, as the diagram is logarithmic.
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
