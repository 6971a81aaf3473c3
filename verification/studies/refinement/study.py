"""Convergence study of a user's scene: its conclusion, tables and picture."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from math import isfinite

from contact_scene.accuracy import AccuracyRequest
from contact_scene.reading.scene_file import read_accuracy
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
from verification.studies.refinement.levels import (
    AccuracyLevel,
    Plan,
    StudiedScene,
    plan_of,
)
from verification.studies.refinement.limits import Estimate, estimates

# Accuracy whose cost is shown beside that of the scene, if the user requires none.
USUAL = "0.1%"
MOST_PANELS = 6
PANEL_HEIGHT = 1.5
REMARKS = (
    "One parameter is refined at a time; the others stay as in a run of the scene. The limit of a "
    "number is its value in the run, changed by the effects of all parameters.",
    "An uncertainty and an error hold at 95 %. They contain the tolerance, and the errors by what "
    "the study does not refine, as a run states them.",
    "CPU seconds are those of one solve without its error estimate and without stored operators.",
)


def scene_study(
    scene: StudiedScene,
    names: Sequence[str],
    count: int | None,
    requirement: str | None,
    most_seconds: float,
) -> Study:
    """Create the convergence study of a scene file.

    scene         scene file, solver and load step
    names         names of the kinds of refinement; empty for all
    count         number of levels of every kind; None for the defaults
    requirement   text of the accuracy that the setting of the scene has to meet; None for the table
                  [accuracy] of the scene, if there is one
    most_seconds  limit of the time to find the setting of a requested accuracy [s]

    Raises SceneError for a mistake in the requirement.
    """
    asked = scene.read().accuracy
    if requirement is not None:
        asked = read_accuracy(requirement, "--require")
    chosen = AccuracyLevel(scene, requirement or USUAL, most_seconds)
    of_request = (chosen,) if requirement or asked is None else ()

    def plan() -> Plan:
        return plan_of(scene, tuple(names), count)

    def cases(settings: Settings) -> tuple[StudyCase, ...]:
        return (*plan().cases, *of_request)

    def conclude(settings: Settings, records: Records) -> Conclusion:
        of = estimates(plan(), records)
        chosen_level = [records[one.name] for one in of_request if one.name in records]
        shown = _shown(of, asked)
        return Conclusion(
            statements=(
                *_refusals(plan(), records),
                *(_requirements(asked, of) if asked else ()),
                *map(_limit_statement, of),
                *_infinite_limits(records.values()),
                *_accuracy_statements(chosen_level),
            ),
            tables=(
                _limit_table(of),
                _order_table(of),
                _level_table(plan(), records, chosen_level, of),
            ),
            charts=(_work_chart(plan(), records, chosen_level, shown, asked),) if shown else (),
            rows=tuple(map(row_of, of)),
            remarks=REMARKS,
        )

    return Study(
        "convergence",
        f"Convergence of {scene.title}",
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


def _size_text(value: float, unit: str) -> str:
    return value_text(value, unit, 2) if isfinite(value) else "unknown"


def _requirements(asked: AccuracyRequest, of: Sequence[Estimate]) -> Iterator[Statement]:
    """Judge the errors of the setting of a run against the required accuracy."""
    found = {one.of for one in of}
    for name in asked.named_quantities:
        if name not in found:
            yield Statement(
                claim=f"required accuracy of the {label(name)}",
                outcome=Status.INCONCLUSIVE,
                measured="it does not change under refinement, or the results of this scene do not "
                "contain it",
            )
    shares = asked.shares()
    for one in of:
        if one.of in shares:
            yield _requirement(one, shares[one.of])


def _requirement(one: Estimate, share: float) -> Statement:
    """Judge the error of a result in a run against the required accuracy.

    The verdict is PASS if the bound of the error at 95 % meets the requirement, FAIL if the error
    exceeds it even with the uncertainty of the limit deducted, and INCONCLUSIVE otherwise.

    one    limit and errors of the result
    share  required error, relative to the largest value in the load history
    """
    error = one.error(one.own)
    least = one.distance(one.own) - one.uncertainty / one.largest
    outcome = Status.FAIL if least > share else Status.INCONCLUSIVE
    if error <= share and not one.small:
        outcome = Status.PASS
    worst = max(one.effects, key=lambda effect: one.share(effect, one.own))
    why = f"; {one.open}" if one.open else ""
    return Statement(
        claim=f"required accuracy of the {label(one.name)}",
        outcome=outcome,
        measured=f"error of the scene's setting {error_text(error)}, required {error_text(share)}",
        because=f"largest part by {worst.kind.noun}: {worst.kind.remedy}{why}",
        about=row_of(one),
    )


def _limit_statement(one: Estimate) -> Statement:
    orders = "; ".join(
        f"{effect.kind.noun}: order {effect.order_text}, theoretical {effect.order:g}"
        for effect in one.effects
    )
    return Statement(
        claim=f"limit of the {label(one.name)}",
        outcome=None,
        measured=f"{value_text(one.limit, one.unit, 7)} ± {_size_text(one.uncertainty, one.unit)}; "
        f"error of the scene's setting {error_text(one.error(one.own))}",
        because=orders + (f"; {one.open}" if one.open else ""),
        about=row_of(one),
    )


def _refusals(plan: Plan, records: Records) -> Iterator[Statement]:
    """State that a level, and above all the scene itself, was refused by the solver."""
    for level in plan.cases:
        words = records[level.name].words if level.name in records else {}
        if "refused" in words:
            yield Statement(
                claim=f"{level.level} can be solved"
                + (", the setting of the scene" if level == plan.run else ""),
                outcome=Status.INCONCLUSIVE,
                measured=words["refused"],
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


def _accuracy_statements(chosen: Sequence[CaseRecord]) -> Iterator[Statement]:
    for record in chosen:
        refused = record.words.get("refused") or record.words.get("stopped")
        yield Statement(
            claim="cost of a requested accuracy",
            outcome=None,
            measured=f"{record.parameters['level']}"
            + (f": not met, {refused}" if refused else f"; {record.seconds:.2g} CPU s"),
        )


def row_of(one: Estimate) -> Row:
    """Return the limit, the uncertainty, the errors and the orders of a result as a study row."""
    known = {"limit": one.limit, "uncertainty": one.uncertainty, "own": one.own}
    measures = {name: finite(value) for name, value in known.items()}
    measures |= {"unrefined": finite(one.unrefined), "error": finite(one.error(one.own))}
    for effect in one.effects:
        observed, noun = effect.observed, effect.kind.noun
        measures[f"error by {noun}"] = finite(one.share(effect, one.own))
        measures[f"error of the finest {noun}"] = finite(one.share(effect, effect.values[-1]))
        measures[f"order in {noun}"] = None if observed is None else observed.order
        measures[f"half width in {noun}"] = None if observed is None else observed.half_width
    return Row(
        parameters={"quantity": one.name, "unit": one.unit or "1"},
        measures=measures,
        units=dict.fromkeys((*known, "unrefined"), "its unit"),
        words={effect.kind.noun: effect.open for effect in one.effects if effect.open},
    )


# ---- tables


def _limit_table(of: Sequence[Estimate]) -> Table:
    kinds = {effect.kind.noun: None for one in of for effect in one.effects}
    return table_of(
        "Limits, and errors of the scene's setting",
        {
            "quantity": lambda one: label(one.name),
            "scene": lambda one: value_text(one.own, one.unit, 7),
            "limit": lambda one: value_text(one.limit, one.unit, 7),
            "uncertainty": lambda one: _size_text(one.uncertainty, one.unit),
            "error": lambda one: error_text(one.error(one.own)),
            **{f"by {noun}": _share_column(noun) for noun in kinds},
        },
        of,
        "The error is relative to the largest value in the history. It contains the uncertainty of "
        "the limit, and so do its parts.",
    )


def _share_column(noun: str) -> Callable[[Estimate], str]:
    def text(one: Estimate) -> str:
        found = [effect for effect in one.effects if effect.kind.noun == noun]
        return error_text(one.share(found[0], one.own)) if found else "–"

    return text


def _order_table(of: Sequence[Estimate]) -> Table:
    rows = [(one, effect) for one in of for effect in one.effects]
    return table_of(
        "Orders of convergence",
        {
            "quantity": lambda row: label(row[0].name),
            "refined": lambda row: row[1].kind.noun,
            "levels": lambda row: str(len(row[1].values)),
            "error of the finest": lambda row: error_text(row[0].share(row[1], row[1].values[-1])),
            "observed order": lambda row: row[1].order_text,
            "theoretical": lambda row: f"{row[1].order:g}",
            "why not asymptotic": lambda row: row[1].open or "–",
        },
        rows,
        "Without an order the limit is the finest value, and its uncertainty follows from the "
        "theoretical order.",
    )


def _level_table(
    plan: Plan, records: Records, chosen: Sequence[CaseRecord], of: Sequence[Estimate]
) -> Table:
    """Build the table of all levels: work, and values with their errors.

    A level that the solver refused has the message of the solver instead.
    """
    rows = [("the scene", plan.run.level, records.get(plan.run.name))]
    for ladder in plan.ladders:
        for level in ladder.levels:
            rows.append((ladder.kind.noun, level.level, records.get(level.name)))
    rows += [("requested", str(record.parameters["level"]), record) for record in chosen]
    found = [(what, level, record) for what, level, record in rows if record is not None]

    def value(one: Estimate) -> Callable[[tuple[str, str, CaseRecord]], str]:
        def text(row: tuple[str, str, CaseRecord]) -> str:
            value = row[2].measures.get(one.name)
            if value is None:
                return "–"
            return f"{value_text(value, one.unit)} ({error_text(one.error(value))})"

        return text

    return table_of(
        "Levels",
        {
            "level": lambda row: row[1],
            "refined": lambda row: row[0],
            "CPU time": lambda row: f"{row[2].seconds:.2g} s" if row[2].measures else "–",
            "unknowns": lambda row: str(row[2].counters.get("unknowns", "–")),
            "increments": lambda row: str(row[2].counters.get("increments", "–")),
            **{label(one.name): value(one) for one in of},
            "largest residual": lambda row: (
                row[2].words.get("refused") or plain(row[2].number(RESIDUAL), 2)
            ),
        },
        found,
        "In brackets: error of the value, relative to the largest value in the history.",
    )


# ---- picture


def _shown(of: Sequence[Estimate], asked: AccuracyRequest | None) -> Sequence[Estimate]:
    """Choose the results of the picture: the required ones first, then those of largest error."""
    required = {} if asked is None else asked.shares()
    known = [one for one in of if isfinite(one.uncertainty)]
    ranked = sorted(known, key=lambda one: (one.of not in required, -one.error(one.own)))
    return [one for one in known if one in ranked[:MOST_PANELS]]


def _work_chart(
    plan: Plan,
    records: Records,
    chosen: Sequence[CaseRecord],
    of: Sequence[Estimate],
    asked: AccuracyRequest | None,
) -> Chart:
    """Draw the error of every level over its CPU time, one panel for each result."""
    shares = {} if asked is None else asked.shares()
    panels = [
        Panel(
            x_label="CPU time of a solve / s" if number == len(of) - 1 else "",
            y_label="relative error",
            title=label(one.name),
            curves=tuple(_work_curves(one, plan, records, chosen, shares.get(one.of))),
            logarithmic=True,
            height=PANEL_HEIGHT,
        )
        for number, one in enumerate(of)
    ]
    return stacked(
        "work", "What accuracy costs",
        "Error bound of each level over its CPU time, relative to the largest value in the "
        "history. A curve refines one parameter; it levels off at the errors of the others.",
        *panels,
    )  # fmt: skip


def _work_curves(
    one: Estimate,
    plan: Plan,
    records: Records,
    chosen: Sequence[CaseRecord],
    share: float | None,
) -> Iterator[Curve]:
    def point(record: CaseRecord) -> tuple[float | None, float | None]:
        value = record.measures.get(one.name)
        return record.seconds, None if value is None else one.error(value)

    def points(found: Sequence[CaseRecord]) -> tuple[list[float], list[float]]:
        kept = drawable(map(point, found))
        return [x for x, _ in kept], [y for _, y in kept]

    def records_of(names: Sequence[str]) -> list[CaseRecord]:
        return [records[name] for name in names if name in records]

    everything = []
    for series, ladder in enumerate(plan.ladders):
        levels = records_of([level.name for level in ladder.levels])
        everything += levels
        yield curve(ladder.kind.noun, *points(levels), Look.POINTS, series)
    if share is not None:
        times = points([*everything, *chosen])[0]
        yield curve("required", [min(times), max(times)], [share, share], Look.BOUND)
    yield curve("this scene", *points(records_of([plan.run.name])), Look.MARKS)
    for record in chosen:
        if points([record])[0]:
            text = str(record.parameters["level"]).partition(":")[0]
            yield curve(text, *points([record]), Look.TILES, len(plan.ladders))
