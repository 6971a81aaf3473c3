"""Convergence studies of a user's scene file: limits of results under refinement, and their errors.

The mesh or the increments are refined. Each level is solved as `slipstick run` solves the file.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

import fem_reference
import semi_analytical
from contact_errors.adaptive_refinement import Levels, refine
from contact_errors.coarse_solves import DiscretisedSolver, compare_with_coarse_solves
from contact_errors.error_formula import (
    BELIEVED,
    PEAK,
    PER_TOLERANCE,
    SolvedRun,
    Values,
    characteristic_size,
    values_of,
)
from contact_errors.on_cells import CellSolver
from contact_errors.on_elements import ElementSolver
from contact_scene import Scene, SceneFile, read_scene_file
from contact_scene.quantities.increment import SCALARS
from contact_scene.quantities.stated_error import StatedError
from contact_scene.quantities.summary import OF_CYCLES
from contact_scene.solver_errors import SolverError
from contact_scene.stepping.increment_error import has_increment_error
from fem_reference import Method
from verification.convergence.observed_order import (
    ORDER_WIDTH,
    ObservedOrder,
    Triplets,
    refined_value,
    triplets_agree,
)
from verification.exhibits.chart import (
    Chart,
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
from verification.quantities import largest_residual
from verification.running.study import (
    RESIDUAL,
    CaseRecord,
    Conclusion,
    Records,
    Row,
    Settings,
    Statement,
    Study,
    Value,
    found,
)

# Solvers by their names on the command line, and the law of contact of the finite elements.
CELLS = "semi-analytical"
METHODS = {"fem": Method.PENALTY, "fem-complementarity": Method.COMPLEMENTARITY}
KEYS = {name: mark for name, mark in SCALARS.items() if mark.key} | OF_CYCLES
ORDER, LARGEST, NATURAL, FLOOR = "order", "largest", "natural", "floor"
UNREFINED = "unrefined"
INCREMENTS = "increments"


class CannotRefine(ValueError):
    """Exception for a scene without the requested load step, or a mesh too coarse to have enough
    levels."""


@dataclass(frozen=True)
class StudiedScene:
    """Scene file whose results a convergence study compares at the end of one load step.

    file       path of the scene file
    overrides  changes of entries of the file, as on the command line
    content    digest of the contents, so that a record of other contents is not reused
    step       number of the load step, from 1
    solver     name of the solver on the command line
    """

    file: str
    overrides: tuple[str, ...]
    content: str
    step: int
    solver: str

    @classmethod
    def of(
        cls, path: Path, overrides: Sequence[str], step: int | None, solver: str
    ) -> StudiedScene:
        """Read a scene file and return the scene that a convergence study solves.

        path       path of the scene file
        overrides  changes of entries of the file, as on the command line
        step       number of the load step at whose end results are compared, from 1; None for the
                   last one
        solver     name of the solver on the command line

        Raises SceneError for mistakes in the file and CannotRefine for an absent load step.
        """
        contents = read_scene_file(path, overrides)
        steps = len(contents.scene.loading)
        if step is not None and not 1 <= step <= steps:
            raise CannotRefine(f"step {step} was asked for, and the scene has {steps}")
        digest = hashlib.sha256(repr(contents).encode()).hexdigest()[:16]
        return cls(str(path.resolve()), tuple(overrides), digest, step or steps, solver)

    @property
    def title(self) -> str:
        """Title of the studied scene, or the name of its file if the scene has none."""
        return self.read().scene.title or Path(self.file).name

    @property
    def on_cells(self) -> bool:
        """True if the semi-analytical solver solves the scene, with tractions on surface cells.

        The alternative is a finite-element solver.
        """
        return self.solver == CELLS

    def read(self) -> SceneFile:
        """Read the scene file of the study, and drop the load steps after the one whose end is
        compared."""
        contents = read_scene_file(self.file, self.overrides)
        return contents.model_copy(update={"loading": contents.loading[: self.step]})

    def asked(self, contents: SceneFile) -> Any:
        """Return the discretisation table of the scene file for the solver of the study.

        contents  contents of the scene file
        """
        return contents.semi_analytical if self.on_cells else contents.fem_reference


def _plan_increments(scene: Scene, asked: Any) -> Any:
    if hasattr(asked, "path_accuracy"):
        return semi_analytical.plan(scene, asked.path_accuracy, asked.edge)
    return fem_reference.plan(scene)


@dataclass(frozen=True)
class SceneLevel:
    """One refinement level of a scene file in a convergence study.

    scene       scene file, solver and load step
    changed     entries of the discretisation table that differ from the file, with their values
    increments  number of increments of each load step
    level       name of the level in tables
    size        abscissa of the convergence fit: relative size of an increment; None for the side of
                a cell or element, which the solver chooses
    refined     part of the error that the study refines, "cells", "elements" or "increments", if
                the other parts are estimated on this level; else empty
    """

    scene: StudiedScene
    changed: tuple[tuple[str, Any], ...]
    increments: tuple[int, ...]
    level: str
    size: float | None = None
    refined: str = ""

    @property
    def name(self) -> str:
        """File name of the record of this refinement level.

        The name includes a digest of the level, the contents of the scene file and the solver.
        """
        digest = hashlib.sha256(repr(self).encode()).hexdigest()[:8]
        return f"{self.scene.solver}-{sum(self.increments)}-{digest}"

    def compute(self) -> CaseRecord:
        """Solve the scene on this refinement level and record its scalar results.

        If the solver refuses the scene, the name and text of the error are recorded instead.
        """
        parameters: dict[str, Value] = {"level": self.level}
        try:
            result = self.solved()
        except SolverError as error:
            words = {"refused": f"{type(error).__name__}: {error}"}
            return CaseRecord(parameters=parameters, words=words)
        return self._level_record(result, parameters)

    def solved(self) -> Any:
        """Solve the scene on this refinement level and return the result of the solver."""
        contents = self.scene.read()
        scene, asked = contents.scene, self.scene.asked(contents)
        asked = asked.model_copy(update=dict(self.changed))
        if self.scene.on_cells:
            plan = _plan_increments(scene, asked).cut_into(self.increments)
            return semi_analytical.solve_discretised(scene, asked, plan=plan)
        method = METHODS[self.scene.solver]
        return fem_reference.solve(scene.with_increments(self.increments), asked, method)

    def _level_record(self, result: Any, parameters: dict[str, Value]) -> CaseRecord:
        steps = values_of(result)
        of: type[DiscretisedSolver] = CellSolver if self.scene.on_cells else ElementSolver
        solver = of.of(result)
        work = "convolutions" if self.scene.on_cells else "iterations"
        features, side = solver.features(result)[-1], max(solver.cell_sides(result))
        ends = list(_key_scalars(steps[-1]))
        errors = _last_errors(solver, result, self.refined) if self.refined else {}
        return CaseRecord(
            parameters=parameters | {"size": self.size or side},
            measures={
                **{name: value for name, _, value in ends},
                RESIDUAL: largest_residual(result),
            },
            units={name: KEYS[stem].unit for name, stem, _ in ends},
            counters={
                "increments": sum(self.increments),
                work: sum(getattr(increment, work) for increment in result.increments),
            },
            words={"infinite": PEAK} if features.infinite else {},
            parts=tuple(
                Row(
                    parameters={"quantity": name, "of": stem},
                    measures={
                        LARGEST: max(np.max(np.abs(step[stem])) for step in steps if stem in step),
                        NATURAL: characteristic_size(stem, steps[-1]),
                        ORDER: features.convergence_order(stem),
                        FLOOR: PER_TOLERANCE * result.tolerance + features.left.get(stem, 0.0),
                        UNREFINED: _unrefined_part(errors.get(stem), name, self.refined),
                    },
                    words={"small": features.unresolved(stem) or ""},
                )
                for name, stem, _ in ends
            ),
        )


def _last_errors(solver: DiscretisedSolver, result: Any, refined: str) -> Mapping[str, StatedError]:
    """Estimate the errors of all scalars at the end of the last load step, by name.

    The errors are those of coarse solves, because references do not separate the parts. If the
    refined parameter is the only one, the coarse solves are omitted, and only the tolerance and
    neglected effects have parts.

    solver   solver of the result, with variable discretisation
    result   result of the finest level
    refined  part of the error that the study refines
    """
    others = any(has_increment_error(result.scene)) or any(
        True for _ in solver.mesh_coarse_solves(solver.space_of(result), result)
    )
    if others or refined != solver.part:
        run, _ = compare_with_coarse_solves(solver, result, by_references=False)
    else:
        run = SolvedRun(
            scene=result.scene,
            values=values_of(result),
            tolerance=solver.residuals(result),
            features=solver.features(result),
            comparisons=(),
            required={},
            neglected=solver.neglected_errors(result),
        )
    return list(run.errors())[-1]


def _unrefined_part(stated: StatedError | None, name: str, refined: str) -> float | None:
    """Return the part of the error of a scalar that a study does not refine, in its unit.

    The tolerance is left out, which has a part of its own in a limit. The result is None if the
    error is unknown.

    stated   error estimate of the scalar, or of the vector with this component
    name     name of the scalar, with _x or _y for a component
    refined  part of the error that the study refines
    """
    if stated is None or stated.error is None:
        return None
    sizes = [size for part, size in stated.parts.items() if part not in (refined, "tolerance")]
    component = int(name.endswith("_y"))
    return sum(size[component] if isinstance(size, tuple) else size for size in sizes)


def _key_scalars(values: Values) -> Iterator[tuple[str, str, float]]:
    """Yield the main scalar results of a load step as (name, quantity, value).

    A component of a vector has the name of its quantity with _x or _y. For a scalar, name and
    quantity are equal.

    values  computed values by quantity, at the end of a load step
    """
    for stem, numbers in values.items():
        if stem in KEYS:
            names = (f"{stem}_x", f"{stem}_y") if numbers.size > 1 else (stem,)
            for name, value in zip(names, numbers.tolist(), strict=True):
                yield name, stem, value


@cache
def discretisation_of_run(
    scene: StudiedScene, requested: bool
) -> tuple[tuple[tuple[str, Any], ...], tuple[int, ...]]:
    """Return the discretisation and the increments that a run of the scene file would choose.

    The refinement levels of a study are derived from these. The first value has entries of the
    discretisation table; it is empty if the run keeps the table of the file. The second has the
    increments of each load step. Raises the errors of a solve.

    requested  if True, refine first until the accuracy requested in the scene file is met
    """
    contents = scene.read()
    problem, asked = contents.scene, scene.asked(contents)
    if contents.accuracy is None or not requested:
        return (), _plan_increments(problem, asked).increments
    method = METHODS.get(scene.solver, Method.COMPLEMENTARITY)
    solver: DiscretisedSolver = (
        CellSolver(problem, asked)
        if scene.on_cells
        else ElementSolver(problem, asked, method=method)
    )
    found = refine(Levels(solver), contents.accuracy).level.fineness
    entries = ("cells", "window") if scene.on_cells else ("elements_per_radius", "harmonics")
    chosen = tuple((name, getattr(found.space, name)) for name in entries)
    return (*chosen, ("tolerance", found.tolerance)), found.increments


FEWEST_LEVELS = 4
NEAR = 3.0  # levels up to this ratio of sizes bound the error without a common power
COVERAGE = 2.0
LEAST_ORDER = 0.1  # a lower order has no limit within reach: 1000 times the cells halve its error
VANISHES = 1e-6  # relative to the natural size; smaller results are zero by symmetry
REMEDY = "use more --cells"


@dataclass(frozen=True)
class Estimate:
    """Limit of one scalar result under refinement, and its error on the finest level, in its unit.

    name         result, with _x or _y for a component
    of           result without component, as a requested accuracy names it
    unit         unit of the result
    sizes        size of cell, element or increment of each level, coarse to fine
    values       result of each level, coarse to fine
    largest      largest value in the load history; requested accuracies are relative to this value
    order        theoretical convergence order
    observed     observed convergence order; None if no power of the size explains the values
    limit        estimated limit
    uncertainty  uncertainty of the limit, at 95 %
    unrefined    part of the uncertainty by what the study does not refine; None if unknown
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
    unrefined: float | None
    remaining: float
    likely: float
    open: str
    resolved: bool

    @property
    def points(self) -> list[tuple[float, float]]:
        """Points of the convergence chart: size of a level, and distance of its result from the
        limit.

        The distance is divided by the largest value in the load history.
        """
        errors = (abs(value - self.limit) / self.largest for value in self.values)
        return list(zip(self.sizes, errors, strict=True))

    @property
    def order_text(self) -> str:
        """Observed convergence order with the half-width of its 95 % interval as text; "none"
        without one."""
        if self.observed is None:
            return "none"
        return f"{self.observed.order:.2f} ± {self.observed.half_width:.2f}"


def estimates(levels: Sequence[CaseRecord], order: float | None) -> tuple[Estimate, ...]:
    """Estimate limit and error of all scalar results that change under refinement.

    The result is empty for fewer than 4 levels. Results whose exact value is infinite are left out.

    levels  records of the refinement levels, coarse to fine
    order   theoretical convergence order of all results; None if each result has its own
    """
    if len(levels) < FEWEST_LEVELS:
        return ()
    return tuple(
        _estimate_limit(part, levels, order)
        for part in levels[-1].parts
        if _changes_with_level(part, levels)
        and str(part.parameters["of"]) != levels[-1].words.get("infinite")
    )


def _changes_with_level(part: Row, levels: Sequence[CaseRecord]) -> bool:
    """Return True if a scalar result is present on all refinement levels and its value changes.

    Results that are zero by symmetry are excluded.

    part    row with the name and the magnitudes of the result
    levels  records of the refinement levels
    """
    name, measures = str(part.parameters["quantity"]), _finite_measures(part.measures)
    values = [level.measures.get(name) for level in levels]
    return (
        name != RESIDUAL
        and None not in values
        and measures[LARGEST] > VANISHES * measures[NATURAL]
        and len(set(values)) > 1
    )


def _finite_measures(measures: Mapping[str, float | None]) -> dict[str, float]:
    return {name: value for name, value in measures.items() if value is not None}


def _estimate_limit(part: Row, levels: Sequence[CaseRecord], order: float | None) -> Estimate:
    name, measures = str(part.parameters["quantity"]), _finite_measures(part.measures)
    sizes = [float(level.parameters["size"] or 0.0) for level in levels]
    values = [_finite_measures(level.measures)[name] for level in levels]
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
        why = _reason_not_asymptotic(fit.observed, fit.triplets)
        if fit.observed is not None and not why:
            followed = refined_value(sizes, values, fit.observed.order)
            limit = followed.limit
            bound = COVERAGE * followed.uncertainty + _reach_of_order(sizes, values, fit.observed)
            likely = abs(values[-1] - limit)
    small = part.words["small"]
    if small:
        why = f"{small}: {REMEDY}, or a smaller window"
    unrefined = measures.get(UNREFINED)
    if unrefined is None and not why:
        why = f"the error by what the study does not refine is unknown: {REMEDY}"
    uncertainty = bound + floor + (unrefined or 0.0)
    return Estimate(
        name, str(part.parameters["of"]), levels[-1].units[name], tuple(sizes), tuple(values),
        measures[LARGEST], p, fit.observed, limit, uncertainty, unrefined,
        abs(values[-1] - limit) + uncertainty, likely, why, not small,
    )  # fmt: skip


def _reach_of_order(
    sizes: Sequence[float], values: Sequence[float], observed: ObservedOrder
) -> float:
    """Compute the largest change of a limit by a convergence order within its 95 % interval.

    An error that the study does not refine changes the observed order, and with it the limit.

    sizes, values  size and result of each level
    observed       observed convergence order
    """
    low, limit, high = (
        refined_value(sizes, values, max(LEAST_ORDER, observed.order + way)).limit
        for way in (-observed.half_width, 0.0, observed.half_width)
    )
    return max(abs(low - limit), abs(high - limit))


def _reason_not_asymptotic(observed: ObservedOrder | None, triplets: Triplets) -> str:
    """Return the reason why the values of a result do not follow one power of the cell size, with a
    remedy.

    The text is empty if they do.

    observed  observed convergence order; None if no power fits
    triplets  convergence orders through two triplets of levels, to compare fine with coarse levels
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


LEVELS = {Level.QUICK: 5, Level.STANDARD: 6, Level.FULL: 7}
# Neighbouring grids are not multiples of each other: an edge cuts the cells of each differently.
RATIO = 2**0.5
FEWEST = {True: 8, False: 4}  # cells along a side; elements over the radius
COARSER, FINER = 4, 4  # coarsest and finest increments over those of a run

REMARKS = (
    "Each level is solved as `slipstick run` solves it, edge correction included.",
    "An uncertainty and a remaining error hold at 95 %. They contain the errors by what the study "
    "does not refine (increments, end of the section, …), estimated by coarse solves of the finest "
    "level.",
    "An order is a finding: numbers are judged where the scene requests an accuracy.",
)


@dataclass(frozen=True)
class Refinement:
    """Description of one kind of refinement of a scene: of the mesh or of the increments.

    name      name of the study
    title     title for readers
    question  question that the study answers
    axis      label of the abscissa: size of a level, in words
    levels    function that returns the refinement levels, coarse to fine
    order     theoretical convergence order of all results; None if each result has its own
    """

    name: str
    title: str
    question: str
    axis: str
    levels: Callable[[Settings], Sequence[SceneLevel]]
    order: float | None = None


SceneStudyOf = Callable[[Path, Sequence[str], int | None, str], Study]


def mesh_study(path: Path, overrides: Sequence[str], step: int | None, solver: str) -> Study:
    """Create the convergence study of a scene file that refines surface cells or finite elements.

    path       scene file
    overrides  changes of entries of the file, as on the command line
    step       number of the load step at whose end results are compared; None for the last one
    solver     name of the solver on the command line

    Raises SceneError for mistakes in the file and CannotRefine for an absent load step.
    """
    scene = StudiedScene.of(path, overrides, step, solver)
    what = "cells" if scene.on_cells else "elements"

    def levels(settings: Settings) -> tuple[SceneLevel, ...]:
        chosen, increments = discretisation_of_run(scene, settings.cells is None)
        contents = scene.read()
        asked = contents.semi_analytical
        if scene.on_cells:
            usual = semi_analytical.discretise(contents.scene, asked).cells
            finest = dict(chosen).get("cells") or usual
            if settings.cells is not None:
                finest = (settings.cells, settings.cells)
            return _with_errors_on_finest(
                [
                    SceneLevel(
                        scene, (*chosen, ("cells", (nx, ny))), increments, f"{nx} x {ny} cells"
                    )
                    for nx, ny in _level_counts(finest, settings, on_cells=True)
                ],
                what,
            )
        planned = contents.fem_reference.elements_per_radius
        elements = settings.cells or dict(chosen).get("elements_per_radius", planned)
        return _with_errors_on_finest(
            [
                SceneLevel(
                    scene,
                    (*chosen, ("elements_per_radius", n)),
                    increments,
                    f"{n} elements over the radius",
                )
                for (n,) in _level_counts((elements,), settings, on_cells=False)
            ],
            what,
        )

    return _refinement_study(
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


def _with_errors_on_finest(levels: list[SceneLevel], refined: str) -> tuple[SceneLevel, ...]:
    """Return the levels of a study; on the finest one, errors by other causes are estimated.

    levels   levels, coarse to fine
    refined  part of the error that the study refines
    """
    return (*levels[:-1], replace(levels[-1], refined=refined))


def _level_counts(
    finest: tuple[int, ...], settings: Settings, *, on_cells: bool
) -> list[tuple[int, ...]]:
    """Return the numbers of cells per side, or of elements over the radius, of all refinement
    levels.

    The levels are in the order from coarse to fine. Consecutive levels differ by a factor √2.
    Raises CannotRefine if there would be too few levels or the coarsest level has too few cells or
    elements.

    finest    numbers of the finest level
    settings  number of levels
    on_cells  True for cells, whose numbers are even; False for finite elements
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
    step       number of the load step at whose end results are compared; None for the last one
    solver     name of the solver on the command line

    Raises SceneError for mistakes in the file and CannotRefine for an absent load step.
    """
    scene = StudiedScene.of(path, overrides, step, solver)
    matters = has_increment_error(scene.read().scene)

    def levels(settings: Settings) -> tuple[SceneLevel, ...]:
        if not any(matters):
            return ()
        chosen, own = discretisation_of_run(scene, settings.cells is None)
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
                SceneLevel(
                    scene, (*chosen, *_requested_cells(settings, scene)), counts, words, 1 / factor
                )
            )
        return _with_errors_on_finest(found, INCREMENTS)

    return _refinement_study(
        scene,
        Refinement(
            INCREMENTS,
            f"Increments of {scene.title}",
            f"What error do finite increments leave at the end of step {scene.step}? From level to "
            "level each load step with an increment error has twice the increments.",
            "increments of a run over those of the level",
            levels,
            1.0,
        ),
    )


def _requested_cells(settings: Settings, scene: StudiedScene) -> tuple[tuple[str, object], ...]:
    if settings.cells is None:
        return ()
    if scene.on_cells:
        return (("cells", (settings.cells, settings.cells)),)
    return (("elements_per_radius", settings.cells),)


def _refinement_study(scene: StudiedScene, refined: Refinement) -> Study:
    """Build the convergence study of a scene file for one kind of refinement.

    scene    scene file, solver and load step
    refined  levels and texts of the kind of refinement
    """
    contents = scene.read()
    shares = {} if contents.accuracy is None else contents.accuracy.shares()

    def conclude(settings: Settings, records: Records) -> Conclusion:
        asked = refined.levels(settings)
        if not asked:
            return Conclusion(statements=(EXACT,))
        every = list(found(asked, records).values())
        solved = [level for level in every if "refused" not in level.words]
        of = estimates(solved, refined.order)
        too_few = () if len(solved) >= FEWEST_LEVELS else (_too_few_levels(len(solved)),)
        return Conclusion(
            statements=(
                *too_few,
                *(_request_statement(one, shares[one.of]) for one in of if one.of in shares),
                *map(_limit_statement, of),
                *_infinite_limits(solved),
            ),
            tables=(_estimate_table(of), _level_table(every)),
            charts=(_error_chart(refined, of),) if of else (),
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


def _too_few_levels(count: int) -> Statement:
    return Statement(
        claim="enough levels",
        outcome=Status.INCONCLUSIVE,
        measured=f"{count} levels were solved, and a limit needs {FEWEST_LEVELS}",
        because="the table of levels gives the reasons; use more --cells or a smaller window",
    )


def _infinite_limits(solved: Iterable[CaseRecord]) -> list[Statement]:
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
    """Return the name of a scalar result in words, "tangential force along x" for
    tangential_force_x."""
    stem, _, axis = name.rpartition("_")
    return f"{stem} along {axis}".replace("_", " ") if axis in "xy" else name.replace("_", " ")


def _request_statement(one: Estimate, share: float) -> Statement:
    """Judge the error of a result on the finest level against the accuracy requested in the scene
    file.

    The verdict is FAIL if the most likely error exceeds the request. It is PASS if the error bound
    at 95 % meets the request, and INCONCLUSIVE otherwise. If the finest level does not resolve the
    features, the verdict is always INCONCLUSIVE.

    one    limit and errors of the result
    share  requested error, relative to the largest value in the load history
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


def _limit_statement(one: Estimate) -> Statement:
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
    """Return the limit, the uncertainty, the finest value and the orders of a result as a study
    row.

    one  estimate of limit and error of the result
    """
    return Row(
        parameters={"quantity": one.name, "unit": one.unit or "1", "theoretical_order": one.order},
        measures={
            "finest": one.values[-1],
            "limit": one.limit,
            "uncertainty": one.uncertainty,
            UNREFINED: one.unrefined,
            "remaining": one.remaining / one.largest,
            "order": None if one.observed is None else one.observed.order,
            "half_width": None if one.observed is None else one.observed.half_width,
        },
        units=dict.fromkeys(("finest", "limit", "uncertainty", UNREFINED), "its unit"),
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
            "of it not refined": lambda one: (
                "unknown" if one.unrefined is None else value_text(one.unrefined, one.unit, 2)
            ),
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

    A level that the solver refused has the message of the solver instead.

    levels  records of the levels, coarse to fine
    """
    solved = [level for level in levels if "refused" not in level.words]
    names = [name for name in (solved[-1].measures if solved else ()) if name != RESIDUAL]
    counters: Mapping[str, int] = solved[-1].counters if solved else {}
    return table_of(
        "Levels",
        {
            "level": lambda row: str(row.parameters["level"]),
            **{label(name): _value_column(name) for name in names},
            **{name: _number_column(name) for name in counters},
            "largest residual": lambda row: (
                row.words.get("refused") or _number_column(RESIDUAL)(row)
            ),
        },
        levels,
    )


def _number_column(name: str) -> Callable[[CaseRecord], str]:
    return lambda row: plain(row.number(name), 2)


def _value_column(name: str) -> Callable[[CaseRecord], str]:
    def text(row: CaseRecord) -> str:
        return value_text(row.measures[name], row.units[name]) if name in row.units else "–"

    return text


def _error_chart(refined: Refinement, of: Sequence[Estimate]) -> Chart:
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
