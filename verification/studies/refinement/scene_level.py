"""One refinement level of a scene file, solved as `slipstick run` solves the file."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

import fem_reference
import semi_analytical
from contact_errors.adaptive_refinement import Levels, refine
from contact_errors.coarse_solves import DiscretisedSolver
from contact_errors.error_formula import (
    LIMITS,
    PEAK,
    PER_TOLERANCE,
    Features,
    Values,
    scale,
    values_of,
)
from contact_errors.on_cells import CellSolver
from contact_errors.on_elements import ElementSolver
from contact_scene import Scene, SceneFile, read_scene_file
from contact_scene.quantities.increment import SCALARS
from contact_scene.quantities.summary import OF_CYCLES
from contact_scene.solver_errors import SolverError
from fem_reference import Method
from verification.quantities import largest_residual
from verification.running.study import RESIDUAL, CaseRecord, Row, Value

# Solvers by their names on the command line, and the law of contact of the finite elements.
CELLS = "semi-analytical"
METHODS = {"fem": Method.PENALTY, "fem-complementarity": Method.COMPLEMENTARITY}
KEYS = {name: mark for name, mark in SCALARS.items() if mark.key} | OF_CYCLES
SMALL = {
    "contact": "the contact", "wave": "the mean wavelength of the height map",
    "layer": "the thinnest layer", "stick": "the stick zone",
    "annulus": "the slip zone around the stick zone",
}  # fmt: skip
ORDER, LARGEST, NATURAL, FLOOR = "order", "largest", "natural", "floor"


class CannotRefine(ValueError):
    """The scene lacks the requested load step, or has nothing that can be refined as requested."""


@dataclass(frozen=True)
class StudiedScene:
    """A scene file with overrides, the solver, and the load step at whose end results are compared.

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
        """Read a scene file and return the studied scene.

        step  number of the load step, from 1; None for the last one

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
        """Title of the scene, or the name of its file if it has none."""
        return self.read().scene.title or Path(self.file).name

    @property
    def on_cells(self) -> bool:
        """Determine if the scene is solved by the semi-analytical solver, with
        tractions on cells."""
        return self.solver == CELLS

    def read(self) -> SceneFile:
        """Read the scene file and drop the load steps after the studied one."""
        contents = read_scene_file(self.file, self.overrides)
        return contents.model_copy(update={"loading": contents.loading[: self.step]})

    def asked(self, contents: SceneFile) -> Any:
        """Return the discretisation table of the scene file, of the semi-analytical or
        finite-element solver.

        contents  contents of the scene file
        """
        return contents.semi_analytical if self.on_cells else contents.fem_reference


def _plan(scene: Scene, asked: Any) -> Any:
    if hasattr(asked, "path_accuracy"):
        return semi_analytical.plan(scene, asked.path_accuracy, asked.edge)
    return fem_reference.plan(scene)


@dataclass(frozen=True)
class SceneLevel:
    """One refinement level of a scene: its discretisation and its increments.

    scene       scene file, solver and load step
    changed     entries of the discretisation table that differ from the file, with their values
    increments  number of increments of each load step
    level       name of the level in tables
    size        abscissa of the convergence fit: relative size of an increment, or inverse size of
                the section; None for the side of a cell or element, which the solver chooses
    """

    scene: StudiedScene
    changed: tuple[tuple[str, Any], ...]
    increments: tuple[int, ...]
    level: str
    size: float | None = None

    @property
    def name(self) -> str:
        """File name of the record of this refinement level.

        It includes a digest of the level, the contents of the scene and the solver.
        """
        digest = hashlib.sha256(repr(self).encode()).hexdigest()[:8]
        return f"{self.scene.solver}-{sum(self.increments)}-{digest}"

    def compute(self) -> CaseRecord:
        """Solve the scene on this level and record its scalar results, or the name and text of an
        error.
        """
        parameters: dict[str, Value] = {"level": self.level}
        try:
            result = self.solved()
        except SolverError as error:
            words = {"refused": f"{type(error).__name__}: {error}"}
            return CaseRecord(parameters=parameters, words=words)
        return self._record(result, parameters)

    def solved(self) -> Any:
        """Solve the scene on this level and return the result of the solver."""
        contents = self.scene.read()
        scene, asked = contents.scene, self.scene.asked(contents)
        asked = asked.model_copy(update=dict(self.changed))
        if self.scene.on_cells:
            plan = _plan(scene, asked).cut_into(self.increments)
            return semi_analytical.solve_discretised(scene, asked, plan=plan)
        method = METHODS[self.scene.solver]
        return fem_reference.solve(scene.with_increments(self.increments), asked, method)

    def _record(self, result: Any, parameters: dict[str, Value]) -> CaseRecord:
        steps = values_of(result)
        of: type[DiscretisedSolver] = CellSolver if self.scene.on_cells else ElementSolver
        solver = of.of(result)
        work = "convolutions" if self.scene.on_cells else "iterations"
        features, side = solver.features(result)[-1], max(solver.sides(result))
        ends = list(_scalars(steps[-1]))
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
                        NATURAL: scale(stem, steps[-1]),
                        ORDER: features.order(stem),
                        FLOOR: PER_TOLERANCE * result.tolerance + features.left.get(stem, 0.0),
                    },
                    words={"small": unresolved(features, stem)},
                )
                for name, stem, _ in ends
            ),
        )


def _scalars(values: Values) -> Iterator[tuple[str, str, float]]:
    """Yield the key results of a load step as (name, name of the vector, value).

    The name of a component ends in _x or _y. For a scalar both names are equal.
    """
    for stem, numbers in values.items():
        if stem in KEYS:
            names = (f"{stem}_x", f"{stem}_y") if numbers.size > 1 else (stem,)
            for name, value in zip(names, numbers.tolist(), strict=True):
                yield name, stem, value


def unresolved(features: Features, name: str) -> str:
    """Describe the features that a result depends on and that the discretisation does not resolve.

    The text is empty if all are resolved.

    features  sizes of contact, layer, stick zone and others, in cells or half elements
    name      name of the result
    """
    if features.resolve(name):
        return ""
    sizes = [(text, getattr(features, feature), LIMITS[feature]) for feature, text in SMALL.items()]
    return ", ".join(
        f"{text} spans {size:.2g} cells or half elements, fewer than {least:g}"
        for text, size, least in sizes
        if size is not None and size < least
    )


@cache
def of_run(
    scene: StudiedScene, requested: bool
) -> tuple[tuple[tuple[str, Any], ...], tuple[int, ...]]:
    """Return the discretisation entries and the increments per load step that a run would choose.

    requested  if True, refine first until the accuracy requested in the scene is met

    The entries are empty if nothing is refined. Raises the errors of a solve.
    """
    contents = scene.read()
    problem, asked = contents.scene, scene.asked(contents)
    if contents.accuracy is None or not requested:
        return (), _plan(problem, asked).increments
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


@cache
def section_size(scene: StudiedScene) -> tuple[float, float]:
    """Compute the size of the finite-element section, and the largest contact radius [length].

    The size is in units of contact radii. The scene is solved on a coarse mesh of 16 elements per
    radius. Raises the errors of `fem_reference.solve`.
    """
    contents = scene.read()
    coarse = contents.fem_reference.model_copy(update={"elements_per_radius": 16})
    result = fem_reference.solve(contents.scene, coarse, METHODS[scene.solver])
    boxes = [section.outline.box for section in result.sections if section is not None]
    return max(boxes), max(increment.contact_radius for increment in result.increments)
