"""One refinement level of a scene file, solved as `slipstick run` solves it."""

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
    """The scene has no such load step, or nothing that can be refined as requested."""


@dataclass(frozen=True)
class StudiedScene:
    """A scene file with overrides, its solver, and the load step at whose end numbers are read.

    content  digest of the file, so that a record of another content is not used
    step     number of the load step, from 1
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
        """Read a scene file; the last load step counts where none is named.

        Raises SceneError for mistakes in the file and CannotRefine for a step that is absent.
        """
        contents = read_scene_file(path, overrides)
        steps = len(contents.scene.loading)
        if step is not None and not 1 <= step <= steps:
            raise CannotRefine(f"step {step} was asked for, and the scene has {steps}")
        digest = hashlib.sha256(repr(contents).encode()).hexdigest()[:16]
        return cls(str(path.resolve()), tuple(overrides), digest, step or steps, solver)

    @property
    def title(self) -> str:
        """Title of the scene, or name of its file."""
        return self.read().scene.title or Path(self.file).name

    @property
    def on_cells(self) -> bool:
        """Return True if cells carry the tractions."""
        return self.solver == CELLS

    def read(self) -> SceneFile:
        """Return the contents of the file up to the studied step."""
        contents = read_scene_file(self.file, self.overrides)
        return contents.model_copy(update={"loading": contents.loading[: self.step]})

    def asked(self, contents: SceneFile) -> Any:
        """Return the table of the discretisation."""
        return contents.semi_analytical if self.on_cells else contents.fem_reference


def _plan(scene: Scene, asked: Any) -> Any:
    if hasattr(asked, "path_accuracy"):
        return semi_analytical.plan(scene, asked.path_accuracy, asked.edge)
    return fem_reference.plan(scene)


@dataclass(frozen=True)
class SceneLevel:
    """A discretisation of a scene: entries of its table that are changed, and increments.

    size  of what is refined: relative size of an increment, inverse size of the section; None for
          the side of a cell or of an element, which the solver chooses
    """

    scene: StudiedScene
    changed: tuple[tuple[str, Any], ...]
    increments: tuple[int, ...]
    level: str
    size: float | None = None

    @property
    def name(self) -> str:
        """Distinguishes the level, the content of the scene and the solver."""
        digest = hashlib.sha256(repr(self).encode()).hexdigest()[:8]
        return f"{self.scene.solver}-{sum(self.increments)}-{digest}"

    def compute(self) -> CaseRecord:
        """Solve; a refusal is recorded by its name and text."""
        parameters: dict[str, Value] = {"level": self.level}
        try:
            result = self.solved()
        except SolverError as error:
            words = {"refused": f"{type(error).__name__}: {error}"}
            return CaseRecord(parameters=parameters, words=words)
        return self._record(result, parameters)

    def solved(self) -> Any:
        """Return the result of the level."""
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
    """Yield the key numbers: name, with _x or _y for a component; name of the vector; value."""
    for stem, numbers in values.items():
        if stem in KEYS:
            names = (f"{stem}_x", f"{stem}_y") if numbers.size > 1 else (stem,)
            for name, value in zip(names, numbers.tolist(), strict=True):
                yield name, stem, value


def unresolved(features: Features, name: str) -> str:
    """Describe the features on which a number depends and that the cells do not resolve."""
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
    """Entries of the table that a run would choose, and its increments in every load step.

    requested  whether a requested accuracy is met by refinement first

    Raises the errors of a solve.
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
    """Size of the section of a run, and its largest contact radius [length].

    Raises the errors of `fem_reference.solve`.
    """
    contents = scene.read()
    coarse = contents.fem_reference.model_copy(update={"elements_per_radius": 16})
    result = fem_reference.solve(contents.scene, coarse, METHODS[scene.solver])
    boxes = [section.outline.box for section in result.sections if section is not None]
    return max(boxes), max(increment.contact_radius for increment in result.increments)
