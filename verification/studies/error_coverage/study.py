"""The study of stated errors: do they hold, and are they of the size of what is wrong?"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from contact_scene.stated_error import ErrorStatus
from verification.exhibits.chart import Chart, Look
from verification.exhibits.log_chart import log_chart, point_curves
from verification.exhibits.table import table_of
from verification.judging.case import Level
from verification.problems.drawn.families import CHOOSING, FAMILIES, JUDGING
from verification.problems.drawn.known_scene import CELLS, KINDS, STRESSES
from verification.running.row import CaseRecord, Row, found
from verification.running.rules import judged, solved
from verification.running.study import Conclusion, Records, Settings, Statement, Study
from verification.studies.error_coverage.case import STATED, WRONG, CoverageCase
from verification.studies.error_coverage.coverage import (
    COVERED,
    TIGHT,
    TIMES,
    Coverage,
    Share,
    covers,
    with_status,
)

ENOUGH = 100  # numbers of a kind
MOST_HOMOGENEOUS, LEAST_FRICTION, LEAST_LOOPS, LEAST_STRESSES = 0.3, 0.4, 60, 60
LEAST_SCENES = 300
PARTS, LEAST_SHARE = (1e-2, 1e1), 1e-3  # of the diagram
ESTIMATED, NOT_CONVERGED = str(ErrorStatus.ESTIMATED), str(ErrorStatus.NOT_CONVERGED)
REMARKS = (
    "Scenes are drawn: materials, radii, loads, friction, coatings, histories, 4 to 60 cells per "
    "contact radius, odd and even grids, and, of what is pressed without friction, where the axis "
    "falls in a cell. No rule is fitted to a quantity or a family. The one common factor of the "
    f"convergence orders was chosen with scenes of the seeds {CHOOSING[0]} and {CHOOSING[1]}; the "
    f"scenes of this record have the seed {JUDGING}.",
    "Covered: what is wrong is no more than stated, but for the uncertainty of the truth. Tight: "
    f"less than {TIMES:g} times what is wrong is stated. Intervals are Clopper and Pearson's, 95 "
    "%. Numbers of one scene are not independent of one another, so that intervals are somewhat "
    "too narrow.",
    "Numbers whose error has the status 'not converged' are counted apart. Numbers that symmetry "
    "repeats along a loop are counted once.",
)


def cases(settings: Settings) -> tuple[CoverageCase, ...]:
    """One scene of every family at the quick level, and above all that judge."""
    quick = settings.level is Level.QUICK
    return tuple(
        CoverageCase(name, JUDGING, number)
        for name, family in FAMILIES.items()
        for number in range(1 if quick else family.count)
    )


def conclude(settings: Settings, records: Records) -> Conclusion:
    """A verdict for every kind of quantity."""
    asked = cases(settings)
    known = tuple(found(asked, records).values())
    parts = {kind: _of_kind(kind, known) for kind in KINDS}
    shares = {k: Coverage.of(k, e) for k, rows in parts.items() if (e := _estimated(rows))}
    families = _by_family(known)
    return Conclusion(
        answer=_answer(tuple(shares.values())),
        statements=(
            solved("every scene is solved", len(known), len(asked), "scenes"),
            _composed(known, settings.level is not Level.QUICK),
            *(_statement(coverage) for coverage in shares.values()),
            *(_statement(coverage, "family ") for coverage in families.values()),
        ),
        tables=(
            table_of(
                "Stated errors beside what is wrong",
                {
                    "quantity": lambda row: str(row.parameters["kind"]).replace("_", " "),
                    "numbers": lambda row: str(row.counters["numbers"]),
                    "covered": lambda row: row.words["covered"],
                    "tight": lambda row: row.words["tight"],
                    "not converged": lambda row: row.words["not converged"],
                    "not stated": lambda row: str(row.counters["not stated"]),
                },
                [_row(coverage, parts[kind]) for kind, coverage in shares.items()],
            ),
            table_of(
                "Coverage by family of scenes",
                {
                    "family": lambda row: str(row.parameters["kind"]),
                    "numbers": lambda row: str(row.counters["numbers"]),
                    "covered": lambda row: row.words["covered"],
                    "tight": lambda row: row.words["tight"],
                },
                [_row(coverage, ()) for coverage in families.values()],
            ),
        )
        if shares
        else (),
        charts=(_chart(parts),) if shares else (),
        remarks=REMARKS,
    )


def _by_family(known: Sequence[CaseRecord]) -> dict[str, Coverage]:
    """Coverage of the numbers of each family."""
    rows: dict[str, list[Row]] = {}
    for record in known:
        rows.setdefault(str(record.parameters["family"]), []).extend(record.parts)
    return {f: Coverage.of(f, e) for f, parts in rows.items() if (e := _estimated(parts))}


def _of_kind(kind: str, known: Sequence[CaseRecord]) -> list[Row]:
    return [part for record in known for part in record.parts if part.parameters["kind"] == kind]


def _estimated(rows: Sequence[Row]) -> list[Row]:
    return with_status(rows, ESTIMATED)


def _row(coverage: Coverage, rows: Sequence[Row]) -> Row:
    apart = [r for r in with_status(rows, NOT_CONVERGED) if r.measures[STATED] is not None]
    held = Share(sum(map(covers, apart)), len(apart)).text if apart else "–"
    return Row(
        parameters={"kind": coverage.kind},
        counters={
            "numbers": coverage.covered.of,
            "not stated": len(rows) - coverage.covered.of - len(apart),
        },
        words={
            "covered": coverage.covered.text,
            "tight": coverage.tight.text,
            "not converged": f"{len(apart)}, covered {held}" if apart else "0",
        },
    )


def _statement(coverage: Coverage, prefix: str = "") -> Statement:
    covered, tight = coverage.covered, coverage.tight
    return Statement(
        claim=f"{prefix}{coverage.kind.replace('_', ' ')}: covered ≥ {COVERED:g}, tight ≥ "
        f"{TIGHT:g}",
        outcome=judged(coverage.good, complete=covered.of >= ENOUGH),
        measured=f"covered {covered.text}, tight {tight.text}, of {covered.of} numbers",
        because=f"at least {ENOUGH} numbers decide",
        about=Row(
            parameters={"kind": coverage.kind},
            measures={"covered": covered.part, "tight": tight.part},
            counters={"numbers": covered.of},
        ),
    )


def _composed(known: Sequence[CaseRecord], whole: bool) -> Statement:
    """Whether the scenes are as manifold as they have to be."""
    count = len(known) or 1
    homogeneous, friction, loops = (
        sum(bool(record.parameters[name]) for record in known)
        for name in ("homogeneous", "friction", "loop")
    )
    stresses = sum(part.parameters["kind"] in STRESSES for r in known for part in r.parts)
    sections = sum(record.parameters["solver"] != CELLS for record in known)
    good = (
        homogeneous <= MOST_HOMOGENEOUS * count
        and friction >= LEAST_FRICTION * count
        and loops >= LEAST_LOOPS
        and stresses >= LEAST_STRESSES
        and len(known) >= LEAST_SCENES
        and sections > 0
    )
    return Statement(
        claim=f"at least {LEAST_SCENES} scenes, at most {MOST_HOMOGENEOUS:.0%} of them homogeneous "
        f"and at least {LEAST_FRICTION:.0%} with friction, {LEAST_LOOPS} loops, {LEAST_STRESSES} "
        "largest stresses, both solvers",
        outcome=judged(good, complete=whole),
        measured=f"{len(known)} scenes, {homogeneous / count:.0%} homogeneous, "
        f"{friction / count:.0%} with friction, {loops} loops, {stresses} largest stresses, "
        f"{sections} scenes by finite elements",
    )


def _answer(shares: Sequence[Coverage]) -> str:
    if not shares:
        return ""
    worst = min(shares, key=lambda one: one.covered.part)
    loosest = min(shares, key=lambda one: one.tight.part)
    return (
        f"Of {sum(one.covered.of for one in shares)} numbers whose answer is known from elsewhere, "
        f"stated errors cover {worst.covered.part:.1%} and more of every kind "
        f"({worst.kind.replace('_', ' ')} least), and are less than {TIMES:g} times what is wrong "
        f"in {loosest.tight.part:.1%} and more ({loosest.kind.replace('_', ' ')} least)."
    )


def _chart(parts: dict[str, list[Row]]) -> Chart:
    """Of each kind the share of numbers that exceed a part of their stated error."""
    lines = [
        (kind.replace("_", " "), _exceeding(_estimated(rows)))
        for kind, rows in parts.items()
        if _estimated(rows)
    ]
    allowed = [(1.0, LEAST_SHARE), (1.0, 1 - COVERED)]
    return log_chart(
        "wrong_over_stated",
        "What is wrong over what is stated",
        f"Share of the numbers of a kind beyond a part of their stated error. At 1 are those that "
        f"it does not cover, to be no more than {1 - COVERED:.0%} (grey); at {1 / TIMES:g} those "
        "for which it is tight.",
        "what is wrong / stated error",
        "share beyond",
        [*point_curves(lines, Look.COMPUTED), *point_curves([("allowed", allowed)], Look.BOUND)],
        height=4.0,
    )


def _exceeding(rows: Sequence[Row]) -> list[tuple[float, float]]:
    """Places along the error, and the share of rows beyond each."""
    stated, wrong = (
        np.array([row.measures[name] for row in rows], float) for name in (STATED, WRONG)
    )
    parts = wrong / np.maximum(stated, np.finfo(float).tiny)
    found = [(x, float(np.mean(parts > x))) for x in np.geomspace(*PARTS, 41)]
    return [(float(x), share) for x, share in found if share >= LEAST_SHARE]


STUDY = Study(
    name="error-coverage",
    title="Whether the errors that runs state hold",
    question="Every number of a run has a stated error. Over scenes whose answer is known from "
    "elsewhere, how often is what is wrong within it, and how often is it of that size?",
    cases=cases,
    conclude=conclude,
)
