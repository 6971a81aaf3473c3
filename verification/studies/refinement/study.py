"""Convergence studies of a scene: refine the mesh, the increments or the section, and judge."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from contact_errors.error_formula import BELIEVED
from contact_scene.stepping.increment_error import with_error
from semi_analytical import discretise
from verification.convergence.observed_order import (
    ORDER_WIDTH,
    ObservedOrder,
    Triplets,
    refined_value,
    triplets_agree,
)
from verification.exhibits.chart import (
    Chart,
    Points,
    Table,
    drawable,
    log_chart,
    plain,
    point_curves,
    slope_line,
    table_of,
    value_text,
)
from verification.judging.case import Level
from verification.judging.outcome import Status
from verification.running.study import (
    RESIDUAL,
    CaseRecord,
    Conclusion,
    Records,
    Row,
    Settings,
    Statement,
    Study,
    found,
)
from verification.studies.refinement.scene_level import (
    FLOOR,
    LARGEST,
    NATURAL,
    ORDER,
    CannotRefine,
    SceneLevel,
    StudiedScene,
    of_run,
    section_size,
)

FEWEST_LEVELS = 4
NEAR = 3.0  # levels up to this ratio of sizes bound the error without a common power
COVERAGE = 2.0
VANISHES = 1e-6  # relative to the natural size; smaller results are zero by symmetry
REMEDY = "use more --cells"


@dataclass(frozen=True)
class Estimate:
    """Limit of one scalar result under refinement, and its error on the finest level, in its unit.

    name         result, with _x or _y for a component
    of           result without component, as a requested accuracy names it
    unit         unit of the result
    sizes        size of the discretisation of each level, coarse to fine
    values       result of each level, coarse to fine
    largest      largest value in the load history; requested accuracies are relative to it
    order        theoretical convergence order
    observed     observed convergence order; None if no power of the size explains the values
    limit        estimated limit
    uncertainty  uncertainty of the limit, at 95 %
    remaining    bound of the error on the finest level, at 95 %
    likely       most likely error on the finest level, without safety factor
    open         reason why the levels are not asymptotic, with a remedy; empty if they are
    resolved     True if the finest level resolves the features on which the result depends
    """

    name: str
    of: str
    unit: str
    sizes: tuple[float, ...]
    values: tuple[float, ...]
    largest: float
    order: float
    observed: ObservedOrder | None
    limit: float
    uncertainty: float
    remaining: float
    likely: float
    open: str
    resolved: bool

    @property
    def points(self) -> list[tuple[float, float]]:
        """Pairs (size h of a level, distance of its result from the limit over the
        largest result)."""
        errors = (abs(value - self.limit) / self.largest for value in self.values)
        return list(zip(self.sizes, errors, strict=True))

    @property
    def order_text(self) -> str:
        """Observed convergence order with its 95 % interval as text; "none" without an observed
        order.
        """
        if self.observed is None:
            return "none"
        return f"{self.observed.order:.2f} ± {self.observed.half_width:.2f}"


def estimates(levels: Sequence[CaseRecord], order: float | None) -> tuple[Estimate, ...]:
    """Estimate limit and error of all scalar results of the finest level that change with
    refinement.

    The result is empty for fewer than 4 levels.

    levels  records of the levels, coarse to fine
    order   theoretical convergence order of all results; None if each result has its own
    """
    if len(levels) < FEWEST_LEVELS:
        return ()
    return tuple(
        _estimate(part, levels, order)
        for part in levels[-1].parts
        if _varies(part, levels) and str(part.parameters["of"]) != levels[-1].words.get("infinite")
    )


def _varies(part: Row, levels: Sequence[CaseRecord]) -> bool:
    """Determine if a scalar result is present on all refinement levels and changes between them.

    Results that are zero by symmetry are excluded.
    """
    name, measures = str(part.parameters["quantity"]), _known(part.measures)
    values = [level.measures.get(name) for level in levels]
    return (
        name != RESIDUAL
        and None not in values
        and measures[LARGEST] > VANISHES * measures[NATURAL]
        and len(set(values)) > 1
    )


def _known(measures: Mapping[str, float | None]) -> dict[str, float]:
    return {name: value for name, value in measures.items() if value is not None}


def _estimate(part: Row, levels: Sequence[CaseRecord], order: float | None) -> Estimate:
    name, measures = str(part.parameters["quantity"]), _known(part.measures)
    sizes = [float(level.parameters["size"] or 0.0) for level in levels]
    values = [_known(level.measures)[name] for level in levels]
    p = order or measures[ORDER]
    floor = measures[FLOOR] * measures[LARGEST]
    near = [(h / sizes[-1], v) for h, v in zip(sizes, values, strict=True) if h < NEAR * sizes[-1]]
    bound, likely = (
        max(abs(values[-1] - value) / (ratio**power - 1) for ratio, value in near if ratio > 1)
        for power in (BELIEVED * p, p)
    )
    fit = refined_value(sizes, values, p)
    limit, why = values[-1], ""
    if bound > floor:
        why = _not_asymptotic(fit.observed, fit.triplets)
        if fit.observed is not None and not why:
            followed = refined_value(sizes, values, fit.observed.order)
            limit, bound = followed.limit, COVERAGE * followed.uncertainty
            likely = abs(values[-1] - limit)
    small = part.words["small"]
    if small:
        why = f"{small}: {REMEDY}, or a smaller window"
    uncertainty = bound + floor
    return Estimate(
        name, str(part.parameters["of"]), levels[-1].units[name], tuple(sizes), tuple(values),
        measures[LARGEST], p, fit.observed, limit, uncertainty,
        abs(values[-1] - limit) + uncertainty, likely, why, not small,
    )  # fmt: skip


def _not_asymptotic(observed: ObservedOrder | None, triplets: Triplets) -> str:
    """Return the reason why the levels do not follow one power of the size, with a remedy.

    The text is empty if the levels follow one power.

    observed  observed convergence order; None if no power fits
    triplets  convergence orders of three consecutive levels each
    """
    if observed is None:
        return (
            "no power of the size explains the levels: the edges of contact and stick zone cut the "
            "cells of each level differently. The limit is the finest value; its uncertainty falls "
            f"with the cells: {REMEDY}"
        )
    if observed.half_width > ORDER_WIDTH:
        return (
            f"the order is known to ± {observed.half_width:.2g} alone: the levels scatter. The "
            f"limit is the finest value; {REMEDY}, or more --levels"
        )
    if not triplets_agree(triplets):
        shown = " and ".join("none" if t is None else f"{t:.2f}" for t in triplets)
        return (
            f"the order by the finest levels and by coarser ones differs ({shown}): the coarse "
            f"levels are not asymptotic. {REMEDY[0].upper()}{REMEDY[1:]}, with as many --levels"
        )
    return ""


Text = Callable[[Row], str]


def number(name: str, digits: int = 2) -> Text:
    """Return a function that formats one number of a row, for a column of a table.

    name    name of the number in the row
    digits  significant digits
    """
    return lambda row: plain(row.number(name), digits)


def points(rows: Iterable[Row], x: str, y: str) -> Points:
    """Return the points (x, y) of all rows that a chart with logarithmic axes can draw.

    x, y  names of the numbers of a row
    """
    return drawable((row.number(x), row.number(y)) for row in rows)


LEVELS = {Level.QUICK: 5, Level.STANDARD: 6, Level.FULL: 7}
# Neighbouring grids are not multiples of each other: an edge cuts the cells of each differently.
RATIO = 2**0.5
FEWEST = {True: 8, False: 4}  # cells along a side; elements over the radius
COARSER, FINER = 4, 4  # coarsest and finest increments over those of a run
SMALLEST, SPAN = 5.0, 16.0  # smallest section in contact radii; the section of a run over it
SECTION_ORDER = 2.0  # as in the error estimate of a run

REMARKS = (
    "Each level is solved as `slipstick run` solves it, edge correction included.",
    "An uncertainty and a remaining error hold at 95 %. The limit of one kind of refinement still "
    "has the error of the others.",
    "An order is a finding: numbers are judged where the scene requests an accuracy.",
)


@dataclass(frozen=True)
class Refinement:
    """Describe one kind of refinement: of the mesh, the increments or the section.

    axis    label of the abscissa: size of a level, in words
    levels  function that returns the levels, coarse to fine
    order   theoretical convergence order of all results; None if each result has its own
    """

    name: str
    title: str
    question: str
    axis: str
    levels: Callable[[Settings], Sequence[SceneLevel]]
    order: float | None = None


SceneStudyOf = Callable[[Path, Sequence[str], int | None, str], Study]


def mesh_study(path: Path, overrides: Sequence[str], step: int | None, solver: str) -> Study:
    """Create the convergence study of a scene file that refines the surface cells or the finite
    elements.

    path       scene file
    overrides  changes of entries of the file, as on the command line
    step       number of the load step whose end is compared; None for the last one
    solver     name of the solver on the command line

    Raises SceneError and CannotRefine.
    """
    scene = StudiedScene.of(path, overrides, step, solver)
    what = "cells" if scene.on_cells else "elements"

    def levels(settings: Settings) -> tuple[SceneLevel, ...]:
        chosen, increments = of_run(scene, settings.cells is None)
        contents = scene.read()
        asked = contents.semi_analytical
        if scene.on_cells:
            finest = dict(chosen).get("cells") or discretise(contents.scene, asked).cells
            if settings.cells is not None:
                finest = (settings.cells, settings.cells)
            return tuple(
                SceneLevel(scene, (*chosen, ("cells", (nx, ny))), increments, f"{nx} x {ny} cells")
                for nx, ny in _counts(finest, settings, on_cells=True)
            )
        usual = contents.fem_reference.elements_per_radius
        elements = settings.cells or dict(chosen).get("elements_per_radius", usual)
        return tuple(
            SceneLevel(
                scene,
                (*chosen, ("elements_per_radius", n)),
                increments,
                f"{n} elements over the radius",
            )
            for (n,) in _counts((elements,), settings, on_cells=False)
        )

    return _study(
        scene,
        Refinement(
            "mesh",
            f"{what.capitalize()} of {scene.title}",
            f"What error do finite {what} leave at the end of step {scene.step}? From level to "
            f"level the {what} become smaller by √2, up to those of a run.",
            f"side of the {what} over that of the finest",
            levels,
        ),
    )


def _counts(
    finest: tuple[int, ...], settings: Settings, *, on_cells: bool
) -> list[tuple[int, ...]]:
    """Return the numbers of cells per side, or of elements over the radius, of all levels, coarse
    to fine.

    Consecutive levels differ by a factor √2. Raises CannotRefine if the coarsest level has too few.

    finest  numbers of the finest level
    """
    least, even = FEWEST[on_cells], 2 if on_cells else 1
    counts = [
        tuple(even * round(count / RATIO**number / even) for count in finest)
        for number in reversed(range(settings.levels or LEVELS[settings.level]))
    ]
    if settings.levels is None:
        counts = [count for count in counts if min(count) >= least] or counts
    if len(counts) < FEWEST_LEVELS or min(counts[0]) < least:
        raise CannotRefine(
            f"{max(FEWEST_LEVELS, len(counts))} levels up to {finest} would begin below {least}; "
            "use more --cells or fewer levels"
        )
    return counts


def increments_study(path: Path, overrides: Sequence[str], step: int | None, solver: str) -> Study:
    """Create the convergence study of a scene file that refines the increments of its load steps.

    Only load steps that have an increment error are refined.

    path       scene file
    overrides  changes of entries of the file, as on the command line
    step       number of the load step whose end is compared; None for the last one
    solver     name of the solver on the command line

    Raises SceneError and CannotRefine.
    """
    scene = StudiedScene.of(path, overrides, step, solver)
    matters = with_error(scene.read().scene)

    def levels(settings: Settings) -> tuple[SceneLevel, ...]:
        if not any(matters):
            return ()
        chosen, own = of_run(scene, settings.cells is None)
        most = max(count for count, matter in zip(own, matters, strict=True) if matter)
        found = []
        for doublings in range(settings.levels or LEVELS[settings.level]):
            factor = 2**doublings / min(COARSER, most)
            counts = tuple(
                max(1, round(factor * count)) if matter else count
                for count, matter in zip(own, matters, strict=True)
            )
            words = f"{round(factor * most)} in a step"
            found.append(
                SceneLevel(scene, (*chosen, *_cells(settings, scene)), counts, words, 1 / factor)
            )
        return tuple(found)

    return _study(
        scene,
        Refinement(
            "increments",
            f"Increments of {scene.title}",
            f"What error do finite increments leave at the end of step {scene.step}? From level to "
            "level each load step with an increment error has twice the increments.",
            "increments of a run over those of the level",
            levels,
            1.0,
        ),
    )


def _cells(settings: Settings, scene: StudiedScene) -> tuple[tuple[str, object], ...]:
    if settings.cells is None:
        return ()
    if scene.on_cells:
        return (("cells", (settings.cells, settings.cells)),)
    return (("elements_per_radius", settings.cells),)


def domain_study(path: Path, overrides: Sequence[str], step: int | None, solver: str) -> Study:
    """Create the convergence study of a scene file that enlarges the section of the finite
    elements.

    The largest section is that of a run.

    path       scene file
    overrides  changes of entries of the file, as on the command line
    step       number of the load step whose end is compared; None for the last one
    solver     name of the solver on the command line

    Raises SceneError, and CannotRefine for a section that is too small to refine.
    """
    scene = StudiedScene.of(path, overrides, step, solver)
    own, radius = section_size(scene)
    bodies = scene.read().scene.body, scene.read().scene.indenter
    layers = max(sum(layer.thickness for layer in body.layers) for body in bodies)
    smallest = max(own / SPAN, SMALLEST, 2 * layers / radius)
    if own < 2 * smallest:
        raise CannotRefine(
            f"a section of {own:.3g} contact radii is less than twice the smallest, "
            f"{smallest:.3g}; use a larger fem_reference.box"
        )

    def levels(settings: Settings) -> tuple[SceneLevel, ...]:
        chosen, increments = of_run(scene, settings.cells is None)
        last = (settings.levels or LEVELS[settings.level]) - 1
        boxes = [smallest * (own / smallest) ** (number / last) for number in range(last + 1)]
        return tuple(
            SceneLevel(
                scene, (*chosen, *_cells(settings, scene), ("box", box)), increments,
                f"{box:.4g} contact radii", 1 / box,
            )
            for box in boxes
        )  # fmt: skip

    return _study(
        scene,
        Refinement(
            "domain",
            f"Section of {scene.title}",
            "What error does the end of the section leave? Outside, the displacements of a point "
            "load are prescribed. The section grows to that of a run, with equal elements in the "
            "contact.",
            "contact radius over size of the section",
            levels,
            SECTION_ORDER,
        ),
    )


def _study(scene: StudiedScene, refined: Refinement) -> Study:
    """Build the study of one kind of refinement of a scene: its levels and its conclusions."""
    contents = scene.read()
    shares = {} if contents.accuracy is None else contents.accuracy.shares()

    def conclude(settings: Settings, records: Records) -> Conclusion:
        asked = refined.levels(settings)
        if not asked:
            return Conclusion(statements=(EXACT,))
        every = list(found(asked, records).values())
        solved = [level for level in every if "refused" not in level.words]
        of = estimates(solved, refined.order)
        too_few = () if len(solved) >= FEWEST_LEVELS else (_too_few(len(solved)),)
        return Conclusion(
            statements=(
                *too_few,
                *(_requested(one, shares[one.of]) for one in of if one.of in shares),
                *map(_finding, of),
                *_infinite(solved),
            ),
            tables=(_estimate_table(of), _level_table(every)),
            charts=(_chart(refined, of),) if of else (),
            rows=tuple(map(row_of, of)),
            remarks=REMARKS,
        )

    def cases(settings: Settings) -> tuple[SceneLevel, ...]:
        return tuple(refined.levels(settings))

    return Study(refined.name, refined.title, refined.question, cases, conclude)


EXACT = Statement(
    claim="no load step has an increment error",
    outcome=None,
    measured="one increment per step is exact, and nothing was computed: 'slipstick plan' gives "
    "the reasons",
)


def _too_few(count: int) -> Statement:
    return Statement(
        claim="enough levels",
        outcome=Status.INCONCLUSIVE,
        measured=f"{count} levels were solved, and a limit needs {FEWEST_LEVELS}",
        because="the table of levels gives the reasons; use more --cells or a smaller window",
    )


def _infinite(solved: Iterable[CaseRecord]) -> list[Statement]:
    names = {level.words["infinite"] for level in solved if "infinite" in level.words}
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


def label(name: str) -> str:
    """Return the name of a scalar result in words: "tangential_force_x" becomes "tangential force
    along x".
    """
    stem, _, axis = name.rpartition("_")
    return f"{stem} along {axis}".replace("_", " ") if axis in "xy" else name.replace("_", " ")


def _requested(one: Estimate, share: float) -> Statement:
    """Judge the error of a result on the finest level against the requested accuracy of the scene.

    The verdict is FAIL if the most likely error exceeds the request, PASS if the error bound at 95
    % meets the request, and INCONCLUSIVE otherwise or if the finest level does not resolve the
    features.

    share  requested error, relative to the largest value in the history
    """
    reached, likely = one.remaining / one.largest, one.likely / one.largest
    outcome = Status.PASS if reached <= share else Status.INCONCLUSIVE
    if likely > share:
        outcome = Status.FAIL
    return Statement(
        claim=f"requested accuracy of the {label(one.name)}",
        outcome=outcome if one.resolved else Status.INCONCLUSIVE,
        measured=f"error on the finest level {plain(reached, 2)}, most likely {plain(likely, 2)}, "
        f"requested {plain(share, 2)}",
        because="relative to its largest value in the history"
        + (f"; not asymptotic, because {one.open}" if one.open else ""),
        about=row_of(one),
    )


def _finding(one: Estimate) -> Statement:
    limit = value_text(one.limit, one.unit, 7)
    open_ = f"; not asymptotic, because {one.open}" if one.open else ""
    return Statement(
        claim=f"limit of the {label(one.name)}",
        outcome=None,
        measured=f"{limit} ± {value_text(one.uncertainty, one.unit, 2)}; error on the finest level "
        f"{plain(one.remaining / one.largest, 2)}",
        because=f"observed order {one.order_text}, theoretical order {one.order:g}{open_}",
        about=row_of(one),
    )


def row_of(one: Estimate) -> Row:
    """Return the numbers of an estimate in SI units: finest value, limit, uncertainty and order."""
    return Row(
        parameters={"quantity": one.name, "unit": one.unit or "1", "theoretical_order": one.order},
        measures={
            "finest": one.values[-1],
            "limit": one.limit,
            "uncertainty": one.uncertainty,
            "remaining": one.remaining / one.largest,
            "order": None if one.observed is None else one.observed.order,
            "half_width": None if one.observed is None else one.observed.half_width,
        },
        units=dict.fromkeys(("finest", "limit", "uncertainty"), "its unit"),
        words={"open": one.open} if one.open else {},
    )


def _estimate_table(of: Sequence[Estimate]) -> Table:
    return table_of(
        "Limits and errors",
        {
            "quantity": lambda one: label(one.name),
            "finest": lambda one: value_text(one.values[-1], one.unit, 7),
            "limit": lambda one: value_text(one.limit, one.unit, 7),
            "uncertainty": lambda one: value_text(one.uncertainty, one.unit, 2),
            "error on the finest": lambda one: plain(one.remaining / one.largest, 2),
            "observed order": lambda one: one.order_text,
            "theoretical order": lambda one: f"{one.order:g}",
            "asymptotic": lambda one: "no" if one.open else "yes",
        },
        of,
        "Errors are relative to the largest value in the history.",
    )


def _level_table(levels: Sequence[CaseRecord]) -> Table:
    """Build the table of the refinement levels of a scene: results, work and residual of each
    level.

    A level that the solver refused has the message instead.
    """
    solved = [level for level in levels if "refused" not in level.words]
    names = [name for name in (solved[-1].measures if solved else ()) if name != RESIDUAL]
    counters: Mapping[str, int] = solved[-1].counters if solved else {}
    return table_of(
        "Levels",
        {
            "level": lambda row: str(row.parameters["level"]),
            **{label(name): _value(name) for name in names},
            **{name: number(name) for name in counters},
            "largest residual": lambda row: row.words.get("refused") or number(RESIDUAL)(row),
        },
        levels,
    )


def _value(name: str) -> Callable[[CaseRecord], str]:
    def text(row: CaseRecord) -> str:
        return value_text(row.measures[name], row.units[name]) if name in row.units else "–"

    return text


def _chart(refined: Refinement, of: Sequence[Estimate]) -> Chart:
    finest = of[0].sizes[-1] if refined.order is None else 1.0
    lines = [(label(one.name), drawable((h / finest, e) for h, e in one.points)) for one in of]
    slopes = [
        line
        for order in sorted({one.order for one in of})
        for line in slope_line(max((points for _, points in lines), key=len), order)
    ]
    return log_chart(
        f"{refined.name}_errors",
        "Errors under refinement",
        "Distance from the limit, relative to the largest value in the history. Lines: theoretical "
        "orders.",
        refined.axis,
        "relative error",
        [*point_curves(lines), *slopes],
    )  # fmt: skip
