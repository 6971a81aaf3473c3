"""Convergence study of a user's scene: its conclusion, tables and picture."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from math import isfinite
from typing import TypeAlias

from contact_scene.quantities.per_length import shown_name
from contact_scene.reading.scene_file import read_accuracy
from slipstick.convergence.levels import (
    AccuracyLevel,
    StudiedScene,
    plan_of,
)
from slipstick.convergence.limits import Effect, Estimate, estimates
from verification.exhibits.chart import (
    Chart,
    Curve,
    Look,
    Panel,
    Table,
    curve,
    drawable,
    plain,
    stacked,
    table_of,
    value_text,
)
from verification.judging.outcome import Status, finite
from verification.running.study import (
    RESIDUAL,
    CaseRecord,
    Conclusion,
    Records,
    Row,
    Settings,
    Statement,
    Study,
    StudyCase,
)

# Names of the curves of the picture, and the records of their levels: the run, the kinds of
# refinement, and the setting of a requested accuracy.
Levels: TypeAlias = Sequence[tuple[str, Sequence[CaseRecord]]]
# Accuracy whose cost is shown beside that of the scene, if the user requires none.
USUAL = "0.1%"
SCENE = "this scene"
CHOSEN = "setting of --accuracy"
MOST_PANELS = 4
PANEL_HEIGHT = 1.3
REMARKS = (
    "One parameter is refined at a time; the others stay as in a run of the scene. The limit of a "
    "number is its value in the run, changed by the effects of all parameters.",
    "An uncertainty and an error hold at 95 %. They contain the tolerance, and the errors by what "
    "the study does not refine, as a run states them.",
    "CPU seconds are those of one solve without its error estimate and without stored operators.",
)


def scene_study(
    scene: StudiedScene, count: int | None, requirement: str | None, most_seconds: float
) -> Study:
    """Create the convergence study of a scene file.

    scene         scene file, solver and load step
    count         number of levels of every kind of refinement; None for the defaults
    requirement   text of the accuracy that the setting of the scene has to meet; None for the table
                  [accuracy] of the scene, if there is one
    most_seconds  limit of the time to find the setting of a requested accuracy [s]

    Raises SceneError for a mistake in the requirement, and the errors of a solve.
    """
    asked = scene.contents.accuracy
    if requirement is not None:
        asked = read_accuracy(requirement, "--require", scene.contents.indenter)
    chosen = AccuracyLevel(scene, requirement or USUAL, most_seconds)
    # The setting of a scene with a table [accuracy] is the one that its request chooses.
    of_request = (chosen,) if requirement or asked is None else ()

    plan = plan_of(scene, count)
    curves: list[tuple[str, Sequence[StudyCase]]] = [
        *((one.kind.noun, tuple(one.levels.values())) for one in plan.ladders),
        (SCENE, (plan.run,)),
        *((CHOSEN, (one,)) for one in of_request),
    ]

    def cases(settings: Settings) -> tuple[StudyCase, ...]:
        return (*plan.cases, *of_request)

    def conclude(settings: Settings, records: Records) -> Conclusion:
        of = estimates(plan, records)
        levels = [
            (name, [records[case.name] for case in of_curve if case.name in records])
            for name, of_curve in curves
        ]
        shares = asked.shares() if asked else {}
        line = scene.contents.indenter.is_line
        named = [shown_name(name, line=line) for name in (asked.named_quantities if asked else ())]
        return Conclusion(
            statements=(
                *_refusals(records.values()),
                *_requirements(shares, of, named),
                *_infinite_limits(records.values()),
                *(_cost_statement(records[x.name]) for x in of_request if x.name in records),
            ),
            tables=(_limit_table(of), _order_table(of), _level_table(levels, of)),
            charts=tuple(_work_charts(of, levels, shares)),
            rows=tuple(row_of(one, effect) for one in of for effect in one.effects),
            remarks=REMARKS,
        )

    return Study(
        "convergence",
        f"Convergence of {scene.contents.title or 'the scene'}",
        f"What error has each number at the end of step {scene.step}, by which parameter of the "
        "discretisation, and what does a smaller error cost?",
        cases,
        conclude,
    )


# ---- statements


def label(name: str) -> str:
    """Return the name of a scalar result in words, "tangential force along x" for
    tangential_force_x."""
    stem, _, axis = name.rpartition("_")
    return f"{stem} along {axis}".replace("_", " ") if axis in "xy" else name.replace("_", " ")


def error_text(share: float) -> str:
    """Return the text of a relative error, such as "0.012 %", or "unknown"."""
    return f"{plain(100 * share, 2)} %" if isfinite(share) else "unknown"


def _requirements(
    shares: Mapping[str, float], of: Sequence[Estimate], named: Sequence[str]
) -> Iterator[Statement]:
    """Judge the errors of the setting of a run against the required relative errors.

    The verdict is PASS if the bound of the error at 95 % meets the requirement, FAIL if the error
    exceeds it even with the uncertainty of the limit deducted, and INCONCLUSIVE otherwise.

    shares  required errors by name
    of      limits and errors of the results
    named   names that the requirement contains
    """
    for one in of:
        if one.of in shares:
            error, share = one.error(one.own), shares[one.of]
            known = 2 * one.distance(one.own) - error  # the uncertainty deducted
            outcome = Status.FAIL if known > share else Status.INCONCLUSIVE
            if error <= share and not one.small:
                outcome = Status.PASS
            yield Statement(
                claim=f"required accuracy of the {label(one.name)}",
                outcome=outcome,
                measured=f"error of the scene's setting {error_text(error)}, required "
                f"{error_text(share)}",
                because=f"largest part by {one.worst.noun}: {one.worst.remedy}"
                + (f"; {one.open}" if one.open else ""),
            )
    for name in sorted(set(named) - {known for one in of for known in (one.of, one.name)}):
        yield Statement(
            claim=f"required accuracy of the {label(name)}",
            outcome=Status.INCONCLUSIVE,
            measured="the results do not contain it, or it is the same on every level",
        )


def _refusals(records: Iterable[CaseRecord]) -> Iterator[Statement]:
    refused = [record for record in records if "refused" in record.words]
    if refused:
        yield Statement(
            claim="every level has a result",
            outcome=Status.INCONCLUSIVE,
            measured=f"{len(refused)} have none: {refused[0].words['refused']}",
        )


def _infinite_limits(records: Iterable[CaseRecord]) -> list[Statement]:
    names = {level.words["infinite"] for level in records if "infinite" in level.words}
    return [
        Statement(
            claim=f"limit of the {label(name)}",
            outcome=None,
            measured="it has none: the exact value is infinite",
            because="the shape of the indenter has a rim or a tip; round it, or read another "
            "number",
        )
        for name in names
    ]


def _cost_statement(chosen: CaseRecord) -> Statement:
    stopped = chosen.words.get("stopped")
    return Statement(
        claim=f"cost of {chosen.parameters['level']}",
        outcome=None,
        measured=f"not met, {stopped}" if stopped else f"{chosen.seconds:.2g} CPU s",
    )


def row_of(one: Estimate, effect: Effect) -> Row:
    """Return the limit of a result, and the order and errors by one parameter, as a study row."""
    of_result = {"own": one.own, "limit": one.limit, "uncertainty": one.uncertainty}
    observed = effect.observed
    return Row(
        parameters={"quantity": one.name, "unit": one.unit or "1", "refined": effect.kind.noun},
        measures={
            **{name: finite(value) for name, value in of_result.items()},
            "error": finite(one.error(one.own)),
            "error by it": finite(one.share(effect, one.own)),
            "error of the finest by it": finite(one.share(effect, effect.values[-1])),
            "order": None if observed is None else observed.order,
            "half_width": None if observed is None else observed.half_width,
        },
        units=dict.fromkeys(of_result, "its unit"),
        words={"open": effect.open} if effect.open else {},
    )


# ---- tables


def _limit_table(of: Sequence[Estimate]) -> Table:
    return table_of(
        "Limits, and errors of the scene's setting",
        {
            "quantity": lambda one: label(one.name),
            "scene": lambda one: value_text(one.own, one.unit, 7),
            "limit": lambda one: value_text(one.limit, one.unit, 7),
            "uncertainty": lambda one: (
                value_text(one.uncertainty, one.unit, 2) if isfinite(one.uncertainty) else "unknown"
            ),
            "error": lambda one: error_text(one.error(one.own)),
            "largest part": lambda one: f"by {one.worst.noun}",
        },
        of,
        "The error contains the uncertainty of the limit. It is relative to the largest value in "
        "the history.",
    )


def _order_table(of: Sequence[Estimate]) -> Table:
    return table_of(
        "Errors and orders by parameter",
        {
            "quantity": lambda row: label(row[0].name),
            "refined": lambda row: row[1].kind.noun,
            "error": lambda row: error_text(row[0].share(row[1], row[0].own)),
            "of the finest": lambda row: error_text(row[0].share(row[1], row[1].values[-1])),
            "order": lambda row: row[1].order_text,
            "theory": lambda row: f"{row[1].order:g}",
            "why not asymptotic": lambda row: row[1].open or "–",
        },
        [(one, effect) for one in of for effect in one.effects],
        "Without an order the limit is the finest value, and its uncertainty follows from the "
        "theoretical order.",
    )


def _level_table(levels: Levels, of: Sequence[Estimate]) -> Table:
    """Build the table of all levels: work, and values or the message of a solver that refused."""

    def value(one: Estimate) -> Callable[[tuple[str, CaseRecord]], str]:
        return lambda row: (
            value_text(row[1].measures[one.name], one.unit) if one.name in row[1].measures else "–"
        )

    return table_of(
        "Levels",
        {
            "level": lambda row: str(row[1].parameters["level"]),
            "refined": lambda row: row[0],
            "CPU time": lambda row: f"{row[1].seconds:.2g} s",
            "unknowns": lambda row: str(row[1].counters.get("unknowns", "–")),
            "increments": lambda row: str(row[1].counters.get("increments", "–")),
            **{label(one.name): value(one) for one in of},
            "largest residual": lambda row: (
                row[1].words.get("refused") or plain(row[1].measures.get(RESIDUAL), 2)
            ),
        },
        [(what, record) for what, records in levels for record in records],
    )


# ---- picture


def _work_charts(
    of: Sequence[Estimate], levels: Levels, shares: Mapping[str, float]
) -> Iterator[Chart]:
    """Draw the error of every level over its CPU time, one panel for each result.

    The required results come first, then those of the largest error. Only the first panel has
    labels, because all have the same curves.

    levels  names of the curves, and records of their levels
    shares  required errors by name
    """
    known = [one for one in of if isfinite(one.uncertainty)]
    known.sort(key=lambda one: (one.of not in shares, -one.error(one.own)))
    panels = [
        Panel(
            x_label="",
            y_label="relative error",
            title=label(one.name),
            curves=tuple(_work_curves(one, levels, shares.get(one.of), named=one is known[0])),
            logarithmic=True,
            least_range=10.0,
            height=PANEL_HEIGHT,
        )
        for one in known[:MOST_PANELS]
    ]
    if panels:
        panels[-1] = panels[-1].model_copy(update={"x_label": "CPU time of a solve / s"})
        yield stacked(
            "work",
            "What accuracy costs",
            "Error bound of each level over its CPU time, relative to the largest value in the "
            "history. A curve refines one parameter; it levels off at the errors of the others.",
            *panels,
        )


def _work_curves(
    one: Estimate, levels: Levels, share: float | None, *, named: bool
) -> Iterator[Curve]:
    times: list[float] = []
    for series, (name, records) in enumerate(levels):
        values = [(r.seconds, r.measures.get(one.name)) for r in records]
        points = drawable((x, one.error(value)) for x, value in values if value is not None)
        if points:
            x, y = zip(*points, strict=True)
            times += x
            look = Look.TILES if name == CHOSEN else Look.POINTS
            look = Look.MARKS if name == SCENE else look
            yield curve(name if named else "", x, y, look, series)
    if share is not None and times:
        ends = min(times), max(times)
        yield curve("required" if named else "", ends, (share, share), Look.BOUND)
