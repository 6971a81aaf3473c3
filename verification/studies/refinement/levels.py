"""Levels of the convergence study of a scene: the discretisation of its run, coarser and finer.

Each discretisation parameter is refined in turn, while the others stay as in a run of the scene.
"""

from __future__ import annotations

import hashlib
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, partial
from math import ceil, log2
from pathlib import Path
from typing import Any

import numpy as np

from contact_errors.adaptive_refinement import Levels, refine
from contact_errors.coarse_solves import DiscretisedSolver, Fineness, compare_with_coarse_solves
from contact_errors.error_formula import (
    ORDERS,
    PEAK,
    PER_TOLERANCE,
    SolvedRun,
    Values,
    characteristic_size,
    largest_so_far,
    values_of,
)
from contact_errors.on_cells import CellSolver
from contact_errors.on_elements import LARGEST_OVERLAP, SMALLEST_BOX, ElementSolver
from contact_errors.on_radii import RingSolver
from contact_scene import SceneFile, read_scene_file
from contact_scene.disk_cache import without_cache
from contact_scene.quantities.increment import SCALARS
from contact_scene.quantities.stated_error import StatedError
from contact_scene.quantities.summary import OF_CYCLES
from contact_scene.reading.scene_file import read_accuracy
from contact_scene.solver_errors import SolverError
from contact_scene.stepping.increment_error import has_increment_error
from fem_reference import Method
from fem_reference.memory import NODES_PER_ELEMENT
from verification.quantities import largest_residual
from verification.running.study import RESIDUAL, CaseRecord, Row

# Table of the scene file and class of every solver, by the name on the command line.
SOLVERS: Mapping[str, tuple[str, Callable[..., DiscretisedSolver]]] = {
    "semi-analytical": ("semi_analytical", CellSolver),
    "fem": ("fem_reference", partial(ElementSolver, method=Method.PENALTY)),
    "fem-complementarity": ("fem_reference", ElementSolver),
    "radial": ("radial", RingSolver),
}
KEYS = {name: mark for name, mark in SCALARS.items() if mark.key} | OF_CYCLES
ORDER, LARGEST, NATURAL, FLOOR = "order", "largest", "natural", "floor"
UNREFINED = "unrefined"
INCREMENTS = "increments"
FEWEST_LEVELS = 4
# Fewest increments of a load step on the coarsest level: fewer converge irregularly.
FEWEST_INCREMENTS = 4
# Cells along a side, elements over the radius and multiple of the rings of the coarsest level.
LEAST = {"cells": 8, "elements": 4, "quadrature": 0.25}
# Steps of refinement from the discretisation of a run that are tried, until there are enough.
STEPS = (0, 1, *range(-1, -13, -1), *range(2, 9))
# A shorter solve is repeated, because the first one of a process imports its packages.
SHORT_SECONDS = 2.0


class CannotRefine(ValueError):
    """Exception for a scene or parameter that a convergence study cannot refine as requested."""


@dataclass(frozen=True)
class Kind:
    """Kind of refinement of a scene: one parameter of its discretisation.

    name   name on the command line
    noun   name of the parameter in texts and legends
    ratio  factor of the parameter from level to level
    count  number of levels
    key    key of the scene file, or option, that refines the parameter
    cause  reason why the values of several levels may follow no power of the parameter
    """

    name: str
    noun: str
    ratio: float
    count: int
    key: str
    cause: str

    @property
    def remedy(self) -> str:
        """What a user changes for a smaller error."""
        return f"refine {self.key}"


_EDGES = "the edges of contact and stick zone cut the {} of each level differently"
KINDS: Mapping[str, Kind] = {
    "cells": Kind("mesh", "cells", 2**0.5, 5, "semi_analytical.cells", _EDGES.format("cells")),
    "elements": Kind(
        "mesh", "elements", 2**0.5, 5, "fem_reference.elements_per_radius",
        _EDGES.format("elements"),
    ),
    "quadrature": Kind(
        "mesh", "rings", 2**0.5, 5, "the rings by --accuracy",
        "the rings of each level lie differently to the edges of contact and stick zone",
    ),
    INCREMENTS: Kind(
        INCREMENTS, "increments", 2.0, 4, "the increments of the load steps",
        "points change between stick and slip at other places of the load path on each level",
    ),
    "penalty": Kind(
        "penalty", "overlap", 4.0, 4, "fem_reference.overlap",
        "the multipliers are updated until the overlap is below its limit, by any factor",
    ),
    "section": Kind(
        "section", "section", 2.0, 4, "fem_reference.box",
        "the elements far from the contact change with the size of the section",
    ),
    "harmonics": Kind(
        "harmonics", "harmonics", 2**0.5, 4, "fem_reference.harmonics",
        "the error falls faster than any power of the number of harmonics",
    ),
}  # fmt: skip
NAMES = tuple(dict.fromkeys(kind.name for kind in KINDS.values()))


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

    def read(self) -> SceneFile:
        """Read the scene file of the study."""
        return read_scene_file(self.file, self.overrides)

    def discretised(self) -> DiscretisedSolver:
        """Return the solver of the scene with variable discretisation."""
        contents, (table, kind) = self.read(), SOLVERS[self.solver]
        return kind(contents.scene, getattr(contents, table))


@cache
def fineness_of_run(scene: StudiedScene) -> Fineness:
    """Return the discretisation of a run of the scene file, from which all levels are derived.

    If the file requests an accuracy, it is the discretisation that meets the request. Raises the
    errors of a solve.
    """
    solver, request = scene.discretised(), scene.read().accuracy
    return solver.of_run() if request is None else refine(Levels(solver), request).level.fineness


@dataclass(frozen=True)
class SceneLevel:
    """One refinement level of a scene file in a convergence study.

    scene     scene file, solver and load step
    fineness  discretisation
    level     name of the level in tables
    refined   of the discretisation of a run: parts of the error that the study refines; else empty
    """

    scene: StudiedScene
    fineness: Fineness
    level: str
    refined: tuple[str, ...] = ()

    @property
    def name(self) -> str:
        """File name of the record of this refinement level, with a digest of the level."""
        digest = hashlib.sha256(repr(self).encode()).hexdigest()[:8]
        return f"{self.scene.solver}-{self.level.split(',')[0].replace(' ', '-')}-{digest}"

    def compute(self) -> CaseRecord:
        """Solve the scene on this refinement level and record its scalar results.

        If the solver refuses the scene, the name and text of the error are recorded instead.
        """
        try:
            result, seconds = self._timed_solve()
        except SolverError as error:
            words = {"refused": f"{type(error).__name__}: {error}"}
            return CaseRecord(parameters={"level": self.level}, words=words)
        return level_record(self, result, seconds)

    def _timed_solve(self) -> tuple[Any, float]:
        """Solve the level; return the result, and the CPU time without stored operators [s]."""
        solver, seconds = self.scene.discretised(), []
        with without_cache():
            while len(seconds) < 1 or (len(seconds) < 2 and seconds[0] < SHORT_SECONDS):
                began = time.process_time()
                result = solver.solve(self.fineness)
                seconds.append(time.process_time() - began)
        return result, min(seconds)


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

        A reason why the request is not met is recorded as `stopped`, or as `refused` if no level
        has a result.
        """
        level = f"--accuracy {self.request}"
        request = read_accuracy(self.request, "--accuracy")
        solver = self.scene.discretised()
        try:
            with without_cache():
                found = refine(Levels(solver), request, self.most_seconds)
        except SolverError as error:
            return CaseRecord(parameters={"level": level}, words={"refused": str(error)})
        last = found.level
        text = f"{level}: {fineness_text(solver, last.fineness, self.scene.solver)}"
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
    of: Any = {key: getattr(kind, "func", kind) for key, (_, kind) in SOLVERS.items()}
    solver: DiscretisedSolver = of[level.scene.solver].of(result)
    steps, at = values_of(result), level.scene.step - 1
    features, largest = solver.features(result)[at], largest_so_far(steps)[-1]
    ends = list(_key_scalars(steps[at]))
    errors = _errors_besides(solver, result, level.refined)[at] if level.refined else {}
    counts = unknowns(result)
    return CaseRecord(
        parameters={"level": level.level, "side": max(solver.cell_sides(result))},
        measures={**{name: value for name, _, value in ends}, RESIDUAL: largest_residual(result)},
        units={name: KEYS[stem].unit for name, stem, _ in ends},
        counters={
            "increments": len(result.increments),
            **({} if counts is None else {"unknowns": counts}),
        },
        words={"infinite": PEAK} if features.infinite else {},
        seconds=seconds,
        parts=tuple(
            Row(
                parameters={"quantity": name, "of": stem},
                measures={
                    LARGEST: float(np.max(largest[stem])),
                    NATURAL: characteristic_size(stem, steps[at]),
                    ORDER: features.convergence_order(stem),
                    FLOOR: PER_TOLERANCE * result.tolerance + features.left.get(stem, 0.0),
                    UNREFINED: _unrefined_part(errors.get(stem), name, level.refined),
                },
                words={"small": features.unresolved(stem) or ""},
            )
            for name, stem, _ in ends
        ),
    )


def unknowns(result: Any) -> int | None:
    """Count the unknowns of a solve: tractions of cells or rings, displacements of elements.

    Those of elements are about the number of their degrees of freedom. None if there are no rings.
    """
    plan = result.plan
    if hasattr(result, "grid"):
        nx, ny = result.grid.cells
        return int(nx * ny * (3 if plan.shear else 1))
    if hasattr(result, "sections"):
        elements = sum(each.quads.shape[1] for each in result.sections if each is not None)
        return int(2 * NODES_PER_ELEMENT * elements)
    return int(3 * plan.rings * plan.angles) if plan.circle else None


def _errors_besides(
    solver: DiscretisedSolver, result: Any, refined: Sequence[str]
) -> Sequence[Mapping[str, StatedError]]:
    """Estimate the errors of all scalars at the ends of the load steps, by name.

    The parts by refined parameters may be absent, because the study finds them. If all parameters
    are refined, the coarse solves are omitted.

    solver   solver of the result, with variable discretisation
    result   result of the discretisation of a run
    refined  parts of the error that the study refines
    """
    parts = set(solver.parts)
    if any(has_increment_error(result.scene)):
        parts.add(INCREMENTS)
    if parts > set(refined) or solver.with_half_the_points() is not None:
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
    return list(run.errors())


def _unrefined_part(stated: StatedError | None, name: str, refined: Sequence[str]) -> float | None:
    """Return the part of the error of a scalar that a study does not refine, in its unit.

    The tolerance is left out, which has a part of its own in a limit. The result is None if the
    error is unknown.

    stated   error estimate of the scalar, or of the vector with this component
    name     name of the scalar, with _x or _y for a component
    refined  parts of the error that the study refines
    """
    if stated is None or stated.error is None:
        return None
    sizes = [size for part, size in stated.parts.items() if part not in (*refined, "tolerance")]
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


@dataclass(frozen=True)
class Ladder:
    """Levels of one kind of refinement, coarse to fine.

    part    part of the error that is refined, which is the key of its kind
    levels  levels, coarse to fine
    sizes   size of the parameter on each level, relative to that of a run; empty for the side of a
            cell, element or ring, which the records contain
    """

    part: str
    levels: tuple[SceneLevel, ...]
    sizes: tuple[float, ...] = ()

    @property
    def kind(self) -> Kind:
        """Texts of the kind of refinement."""
        return KINDS[self.part]

    def order(self) -> float | None:
        """Theoretical convergence order of all results; None if each result has its own."""
        return None if not self.sizes else ORDERS[self.part]


@dataclass(frozen=True)
class Plan:
    """All solves of the convergence study of a scene.

    run      discretisation of a run of the scene file
    ladders  levels of every kind of refinement
    """

    run: SceneLevel
    ladders: tuple[Ladder, ...]

    @property
    def cases(self) -> tuple[SceneLevel, ...]:
        """All levels without repetitions, that of a run first."""
        return tuple(dict.fromkeys((self.run, *(x for one in self.ladders for x in one.levels))))


@cache
def plan_of(scene: StudiedScene, names: tuple[str, ...], count: int | None) -> Plan:
    """Plan the solves of the convergence study of a scene.

    scene  scene file, solver and load step
    names  names of the kinds of refinement; empty for all that the scene and the solver have
    count  number of levels of every kind; None for the default of the kind

    Raises CannotRefine for a kind that the scene or the solver does not have, or if there are too
    few levels.
    """
    solver, own = scene.discretised(), fineness_of_run(scene)
    parts: list[str] = [*solver.parts]
    if any(has_increment_error(solver.scene)):
        parts.append(INCREMENTS)
    has = [KINDS[part].name for part in parts]
    if missing := [name for name in names if name not in has]:
        why = f"{missing[0]} has no error in this scene with this solver"
        raise CannotRefine(f"{why}; it has {', '.join(has)}")
    parts = [part for part, name in zip(parts, has, strict=True) if name in names or not names]
    run = SceneLevel(scene, own, fineness_text(solver, own, scene.solver), tuple(parts))
    ladders = tuple(
        (_increment_ladder if part == INCREMENTS else _space_ladder)(solver, run, part, count)
        for part in parts
    )
    for one in ladders:
        if len(one.levels) < FEWEST_LEVELS:
            raise CannotRefine(
                f"{len(one.levels)} levels of the {one.kind.noun} are possible, and a limit needs "
                f"{FEWEST_LEVELS}; {one.kind.remedy}"
            )
    return Plan(run, ladders)


def _space_ladder(
    solver: DiscretisedSolver, run: SceneLevel, part: str, count: int | None
) -> Ladder:
    """Refine and coarsen one parameter of the grid or mesh of a run.

    The finest level is one step finer than the run. Where coarser levels are impossible, there are
    finer ones instead.
    """
    kind, own, found = KINDS[part], run.fineness, {0: run.fineness.space}
    for step in STEPS:
        if len(found) == (count or kind.count):
            break
        space = solver.refine_space(own.space, {part: kind.ratio**step})  # type: ignore[dict-item]
        if space not in found.values() and _is_possible(solver, part, space):
            found[step] = space
    levels = tuple(
        run if step == 0
        else SceneLevel(
            run.scene, replace(own, space=found[step]), _parameter_text(solver, part, found[step])
        )
        for step in sorted(found)
    )  # fmt: skip
    if part == solver.part:
        return Ladder(part, levels)
    if part == "harmonics":
        return Ladder(
            part, levels, tuple(own.space.harmonics / x.fineness.space.harmonics for x in levels)
        )
    return Ladder(part, levels, tuple(kind.ratio**-step for step in sorted(found)))


def _is_possible(solver: DiscretisedSolver, part: str, space: Any) -> bool:
    """Determine if a grid or mesh is within the limits of the solver and of the study."""
    if part != solver.part:
        return part == "harmonics" or (
            space.overlap <= LARGEST_OVERLAP
            if part == "penalty"
            else (space.box or SMALLEST_BOX) >= SMALLEST_BOX
        )
    (size,) = solver.record_entry(space).values()
    return bool(LEAST[part] <= np.min(size) and np.max(size) <= solver.most)


def _increment_ladder(
    solver: DiscretisedSolver, run: SceneLevel, part: str, count: int | None
) -> Ladder:
    """Double the increments of the load steps with an increment error, from 4 in a step.

    The finest level has at least twice the increments of the run.
    """
    own, matters = run.fineness, has_increment_error(solver.scene)
    most = max(n for n, matter in zip(own.increments, matters, strict=True) if matter)
    first = ceil(log2(FEWEST_INCREMENTS / most))
    last = max(1, first + KINDS[part].count - 1)
    steps = range(first, last + 1)[-count if count else 0 :]
    found: dict[SceneLevel, float] = {}
    for factor in (2.0**step for step in steps):
        counts = tuple(
            max(min(FEWEST_INCREMENTS, n), round(factor * n)) if matter else n
            for n, matter in zip(own.increments, matters, strict=True)
        )
        text = f"{max(FEWEST_INCREMENTS, round(factor * most))} increments in a step"
        level = SceneLevel(run.scene, replace(own, increments=counts), text)
        found[run if factor == 1 else level] = 1 / factor
    return Ladder(part, tuple(found), tuple(found.values()))


def fineness_text(solver: DiscretisedSolver, fineness: Fineness, name: str) -> str:
    """Return the text of a discretisation, such as "64 x 64 cells, 30 increments".

    solver    solver of the scene
    fineness  discretisation
    name      name of the solver on the command line
    """
    parts = [*solver.parts]
    texts = [_parameter_text(solver, part, fineness.space) for part in parts if part != "section"]
    return ", ".join([*texts, f"{sum(fineness.increments)} increments"])


def _parameter_text(solver: DiscretisedSolver, part: str, space: Any) -> str:
    if part == "penalty":
        return f"overlap {space.overlap:.3g}"
    if part == "section":
        return f"section of {space.box:.3g} radii"
    if part == "harmonics":
        return f"{space.harmonics} harmonics"
    (size,) = solver.record_entry(space).values()
    if part == "cells":
        return f"{size[0]} x {size[1]} cells"
    return f"{size} elements per radius" if part == "elements" else f"{size:.3g} times the rings"
