"""Levels of the convergence study of a scene: the discretisation of its run, coarser and finer.

Each discretisation parameter is refined in turn, while the others stay as in a run of the scene.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from math import ceil, log
from typing import Any

import numpy as np

from contact_errors.adaptive_refinement import Levels, refine
from contact_errors.coarse_solves import stated_errors
from contact_errors.error_formula import (
    Values,
    characteristic_size,
    largest_so_far,
    values_of,
)
from contact_results.solvers import SolverName, solver_of
from contact_scene import SceneFile
from contact_scene.contact_features import PEAK
from contact_scene.discretised import PER_TOLERANCE, DiscretisedSolver, Fineness
from contact_scene.quantities.increment import SCALARS
from contact_scene.quantities.per_length import shown_name, shown_unit
from contact_scene.quantities.stated_error import Part
from contact_scene.quantities.summary import OF_CYCLES
from contact_scene.reading.scene_file import read_accuracy
from contact_scene.solver_errors import SolverError
from contact_scene.stepping.increment_error import has_increment_error
from fem_reference.discretised import (
    FEWEST_ELEMENTS,
    FEWEST_HARMONICS,
    LARGEST_OVERLAP,
    SMALLEST_BOX,
)
from verification.judging.outcome import finite
from verification.quantities import largest_residual
from verification.running.cold_cache import cold_cache, timed
from verification.running.study import RESIDUAL, CaseRecord, Row

KEYS = {name: mark for name, mark in SCALARS.items() if mark.key} | OF_CYCLES
ORDER = "order"
LARGEST = "largest"
NATURAL = "natural"
FLOOR = "floor"
UNREFINED = "unrefined"
INCREMENTS: Part = "increments"
FEWEST_LEVELS = 4
# Fewest increments of a load step on the coarsest level: fewer converge irregularly.
FEWEST_INCREMENTS = 4
ROOT = 2**0.5
# Steps of refinement from the discretisation of a run that are tried, until there are enough.
STEPS = (0, 1, *range(-1, -13, -1), *range(2, 9))


@dataclass(frozen=True)
class Kind:
    """Kind of refinement of a scene: one parameter of its discretisation.

    noun   name of the parameter in texts and legends; of a mesh parameter also its key
    text   text of a level, with the value of the parameter
    key    key of the scene file, or option, that refines the parameter
    cause  reason why the values of several levels may follow no power of the parameter
    bounds  smallest and largest value of a level
    ratio  factor of the parameter from level to level
    count  number of levels
    """

    noun: str
    text: str
    key: str
    cause: str
    bounds: tuple[float, float] = (0.0, np.inf)
    ratio: float = 2.0
    count: int = FEWEST_LEVELS

    @property
    def remedy(self) -> str:
        """What a user changes for a smaller error."""
        return f"refine {self.key}"


_EDGES = "the edges of contact and stick zone cut the {} of each level differently"
KINDS: Mapping[Part, Kind] = {
    "cells": Kind(
        "cells", "{} cells", "semi_analytical.cells", _EDGES.format("cells"), (8, np.inf), ROOT, 5
    ),
    "elements": Kind(
        "elements",
        "{} elements per radius",
        "fem_reference.elements_per_radius",
        _EDGES.format("elements"),
        (FEWEST_ELEMENTS, np.inf),
        ROOT,
        5,
    ),
    "quadrature": Kind(
        "rings",
        "{} times the rings",
        "the rings by --accuracy",
        _EDGES.format("rings"),
        (0.25, np.inf),
        ROOT,
        5,
    ),
    INCREMENTS: Kind(
        INCREMENTS,
        "{} increments",
        "the increments of the load steps",
        "points change between stick and slip at other places of the load path on each level",
        ratio=ROOT,
        count=6,
    ),
    "penalty": Kind(
        "overlap",
        "overlap {}",
        "fem_reference.overlap",
        "the multipliers are updated until the overlap is below its limit, by any factor",
        (0.0, LARGEST_OVERLAP),
        4.0,
    ),
    "section": Kind(
        "box",
        "box of {} radii",
        "fem_reference.box",
        "the elements far from the contact change with the size of the section",
        (SMALLEST_BOX, np.inf),
    ),
    "harmonics": Kind(
        "harmonics",
        "{} harmonics",
        "fem_reference.harmonics",
        "the error falls faster than any power of the number of harmonics",
        (FEWEST_HARMONICS, np.inf),
        ROOT,
    ),
}

# Strips are solved in milliseconds; many levels sample the places of the edge within a strip.
STRIPS = replace(KINDS["cells"], ratio=ROOT**0.5, count=10)


@dataclass(frozen=True)
class StudiedScene:
    """Scene whose results a convergence study compares at the end of one load step.

    contents  contents of the scene file
    step      number of the load step, from 1
    solver    name of the solver on the command line
    """

    contents: SceneFile
    step: int
    solver: str

    def discretised(self) -> DiscretisedSolver:
        """Return the solver of the scene with variable discretisation."""
        return SolverName(self.solver).solver.of_file(self.contents)


@dataclass(frozen=True)
class SceneLevel:
    """One refinement level of a scene file in a convergence study.

    scene     scene file, solver and load step
    fineness  discretisation
    level     name of the level in tables
    is_run    True for the discretisation of a run
    """

    scene: StudiedScene
    fineness: Fineness
    level: str
    is_run: bool = False

    @property
    def name(self) -> str:
        """File name of the record of this refinement level, with a digest of the level."""
        digest = hashlib.sha256(repr(self).encode()).hexdigest()[:8]
        return f"{self.scene.solver}-{self.level.split(',')[0].replace(' ', '-')}-{digest}"

    def compute(self) -> CaseRecord:
        """Solve the scene on this refinement level and record its scalar results.

        If the solver refuses the scene, the name and text of the error are recorded instead.
        """
        solver = self.scene.discretised()
        try:
            result, seconds, _ = timed(lambda: solver.solve(self.fineness))
        except SolverError as error:
            words = {"refused": f"{type(error).__name__}: {error}"}
            return CaseRecord(parameters={"level": self.level}, words=words)
        return level_record(self, result, seconds)


@dataclass(frozen=True)
class AccuracyLevel:
    """Discretisation that a run with a requested accuracy chooses, as a case of a study.

    scene         scene file, solver and load step
    request       text of `--accuracy`
    most_seconds  limit of the elapsed time [s]
    """

    scene: StudiedScene
    request: str
    most_seconds: float

    @property
    def name(self) -> str:
        """File name of the record of this case."""
        digest = hashlib.sha256(repr(self).encode()).hexdigest()[:8]
        return f"{self.scene.solver}-accuracy-{digest}"

    def compute(self) -> CaseRecord:
        """Refine the scene until its stated errors meet the request, and record the last level.

        A reason why the request is not met is recorded as `stopped`.
        """
        level = f"--accuracy {self.request}"
        request = read_accuracy(self.request, "--accuracy", self.scene.contents.indenter)
        solver = self.scene.discretised()
        try:
            with cold_cache():
                found = refine(Levels(solver), request, self.most_seconds)
        except SolverError as error:
            return CaseRecord(parameters={"level": level}, words={"stopped": str(error)})
        last = found.level
        text = f"{level}: {fineness_text(solver, last.fineness)}"
        record = level_record(
            SceneLevel(self.scene, last.fineness, text), last.result, last.solve_seconds
        )
        stopped = {} if found.accuracy.stopped is None else {"stopped": found.accuracy.stopped}
        return record.model_copy(update={"words": record.words | stopped})


def level_record(level: SceneLevel, result: Any, seconds: float) -> CaseRecord:
    """Return the record of a solved refinement level.

    level    refinement level
    result   result of the solver
    seconds  CPU time of the solve [s]
    """
    solver, at = solver_of(result), level.scene.step - 1
    steps, features = values_of(result), solver.features(result)[at]
    sizes = {stem: float(np.max(size)) for stem, size in largest_so_far(steps)[-1].items()}
    line = result.scene.indenter.is_line
    ends, counts = list(_key_scalars(steps[at], line=line)), solver.unknowns(result)
    unrefined = dict(solver.neglected_errors(result))
    if level.is_run and solver.with_half_the_points() is not None:
        for stem, stated in stated_errors(result).steps[at].items():
            by_points = np.max(stated.parts.get("map", np.inf)) / sizes[stem]
            unrefined[stem] = unrefined.get(stem, 0.0) + float(by_points)
    return CaseRecord(
        parameters={"level": level.level, "side": max(solver.cell_sides(result))},
        measures={**{name: value for name, _, value in ends}, RESIDUAL: largest_residual(result)},
        units={name: shown_unit(KEYS[stem].unit, line=line) for name, stem, _ in ends},
        counters={"increments": len(result.increments), "unknowns": counts},
        words={"infinite": PEAK} if features.infinite else {},
        seconds=seconds,
        parts=tuple(
            Row(
                parameters={"quantity": name, "of": stem},
                measures={
                    LARGEST: sizes[stem],
                    NATURAL: characteristic_size(stem, steps[at]),
                    ORDER: features.convergence_order(stem),
                    FLOOR: PER_TOLERANCE * result.tolerance + features.left.get(stem, 0.0),
                    UNREFINED: finite(unrefined.get(stem, 0.0)),
                },
                words={"small": features.unresolved(stem) or ""},
            )
            for name, stem, _ in ends
        ),
    )


def _key_scalars(values: Values, *, line: bool) -> Iterator[tuple[str, str, float]]:
    """Yield the main scalar results of a load step as (name, quantity, value)."""
    for stem, numbers in values.items():
        if stem in KEYS:
            names = (f"{stem}_x", f"{stem}_y") if numbers.size > 1 else (stem,)
            for name, value in zip(names, numbers.tolist(), strict=True):
                yield shown_name(name, line=line), stem, value


@dataclass(frozen=True)
class Ladder:
    """Levels of one kind of refinement, coarse to fine.

    part      part of the error that is refined, which is the key of its kind
    levels    levels by size of the parameter, relative to that of a run
    scatters  True if the errors scatter from level to level by a factor: the single edge of a line
              contact is at another place within a strip on each level
    power     power of the size with which the parameter of a level changes
    """

    part: Part
    levels: Mapping[float, SceneLevel]
    scatters: bool = False
    power: float = 1.0

    @property
    def kind(self) -> Kind:
        """Texts of the kind of refinement."""
        return KINDS[self.part]


@dataclass(frozen=True)
class Plan:
    """All solves of the convergence study of a scene.

    run      discretisation of a run of the scene file
    ladders  levels of every kind of refinement, the mesh first
    """

    run: SceneLevel
    ladders: tuple[Ladder, ...]

    @property
    def cases(self) -> tuple[SceneLevel, ...]:
        """All levels without repetitions, that of a run first."""
        others = (level for one in self.ladders for level in one.levels.values())
        return tuple(dict.fromkeys((self.run, *others)))


def plan_of(scene: StudiedScene, count: int | None) -> Plan:
    """Plan the solves of the convergence study of a scene.

    scene  scene file, solver and load step
    count  number of levels of every kind; None for the default of the kind

    If the scene file requests an accuracy, a run has the discretisation that meets the request.
    Raises the errors of a solve.
    """
    solver, request = scene.discretised(), scene.contents.accuracy
    own = (
        solver.run_fineness() if request is None else refine(Levels(solver), request).level.fineness
    )
    run = SceneLevel(scene, own, fineness_text(solver, own), is_run=True)
    ladders = [_space_ladder(solver, run, part, count) for part in solver.parts]
    if any(has_increment_error(solver.scene)):
        ladders.append(_increment_ladder(solver, run, count))
    return Plan(run, tuple(ladders))


def _space_ladder(
    solver: DiscretisedSolver, run: SceneLevel, part: Part, count: int | None
) -> Ladder:
    """Refine and coarsen one parameter of the grid or mesh of a run.

    The finest level is one step finer than the run. Where coarser levels are impossible, there are
    finer ones instead.
    """
    kind, own, found = KINDS[part], run.fineness, {1.0: run.fineness.space}
    least, most = kind.bounds
    if scatters := part == "cells" and solver.scene.indenter.is_line:
        kind = STRIPS
    for factor in (kind.ratio**step for step in STEPS):
        if len(found) == (count or kind.count):
            break
        space = solver.refine_space(own.space, {part: factor})
        size = np.atleast_1d(_parameter(solver, part, space))
        if solver.scene.indenter.is_line:
            size = size[:1]  # strips are one row of cells
        if space not in found.values() and least <= np.min(size) and np.max(size) <= most:
            found[1 / factor] = space
    levels = {
        size: replace(
            run,
            fineness=replace(own, space=found[size]),
            level=_parameter_text(solver, part, found[size]),
            is_run=False,
        )
        for size in sorted(found, reverse=True)
    }
    # In plane strain the error falls as the inverse of the section: levels change it by squares.
    power = 2.0 if part == "section" and solver.scene.indenter.is_line else 1.0
    return Ladder(part, levels | {1.0: run}, scatters, power)


def _increment_ladder(solver: DiscretisedSolver, run: SceneLevel, count: int | None) -> Ladder:
    """Refine the increments of the load steps with an increment error, from 4 in a step.

    The finest level has at least twice the increments of the run.
    """
    kind, own, matters = KINDS[INCREMENTS], run.fineness, has_increment_error(solver.scene)
    most = max(n for n, matter in zip(own.increments, matters, strict=True) if matter)
    first, levels = ceil(log(FEWEST_INCREMENTS / most, kind.ratio)), {}
    last = max(2, first + kind.count - 1)
    for step in range(max(first, last + 1 - (count or kind.count)), last + 1):
        factor = kind.ratio**step
        counts = tuple(
            max(min(FEWEST_INCREMENTS, n), round(factor * n)) if matter else n
            for n, matter in zip(own.increments, matters, strict=True)
        )
        fineness, text = replace(own, increments=counts), kind.text.format(sum(counts))
        level = replace(run, fineness=fineness, level=text, is_run=False)
        levels[sum(own.increments) / sum(counts)] = run if fineness == own else level
    return Ladder(INCREMENTS, levels)


def fineness_text(solver: DiscretisedSolver, fineness: Fineness) -> str:
    """Return the text of a discretisation, such as "64 x 64 cells, 30 increments"."""
    mesh, count = _parameter_text(solver, solver.part, fineness.space), sum(fineness.increments)
    return f"{mesh}, {count} increment{'s' * (count > 1)}"


def _parameter(solver: DiscretisedSolver, part: Part, space: Any) -> Any:
    """Return the value of one parameter of a grid or mesh, a pair for cells."""
    (size,) = solver.record_entry(space).values()
    return size if part == solver.part else getattr(space, KINDS[part].noun)


def _parameter_text(solver: DiscretisedSolver, part: Part, space: Any) -> str:
    sizes = np.atleast_1d(_parameter(solver, part, space))
    text = KINDS[part].text.format(" x ".join(f"{size:.5g}" for size in sizes))
    if solver.scene.indenter.is_line:
        text = text.replace("radii", "half widths").replace("radius", "half width")
    return text
