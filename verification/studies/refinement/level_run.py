"""One level of refinement, solved by the semi-analytical method."""

from __future__ import annotations

import hashlib
import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import ClassVar

import numpy as np

from contact_scene import SceneFile, read_scene_file
from contact_scene.description import Description
from semi_analytical import Plan, Result, SurfaceGrid, plan, solve
from verification.path_error import friction_limit
from verification.quantities import largest_residual, named_values
from verification.studies.refinement.level_record import LevelRecord, StoredField


class CannotRefine(ValueError):
    """The scene has no such step, or its finest level has too few cells."""


@dataclass(frozen=True)
class StudiedScene:
    """A scene file with overrides, and the loading step at whose end quantities are read.

    content  digest of what the file says, so that a record of another content is not taken
    step     number of the loading step, from 1
    """

    file: str
    overrides: tuple[str, ...]
    content: str
    step: int

    @classmethod
    def of(cls, path: Path, overrides: Sequence[str], step: int | None) -> StudiedScene:
        """The scene of a file; the last step if none is named.

        Raises SceneError for mistakes in the file and CannotRefine for a step that is not there.
        """
        contents = read_scene_file(path, overrides)
        steps = len(contents.scene.loading)
        if step is not None and not 1 <= step <= steps:
            raise CannotRefine(f"step {step} was asked for, and the scene has {steps}")
        digest = hashlib.sha256(repr(contents).encode()).hexdigest()[:16]
        return cls(str(path.resolve()), tuple(overrides), digest, step or steps)

    def read(self) -> SceneFile:
        """What the file says, without the steps after the studied one."""
        contents = read_scene_file(self.file, self.overrides)
        loading = contents.scene.loading[: self.step]
        return replace(contents, scene=contents.scene.model_copy(update={"loading": loading}))

    def plan(self) -> Plan:
        """What is computed for it, and into how many increments its steps are cut by default."""
        contents = self.read()
        return plan(contents.scene, contents.semi_analytical.path_accuracy)


@dataclass(frozen=True)
class LevelRun:
    """A grid and an increment count for every step up to the studied one.

    size  h of the level
    """

    record_type: ClassVar[type[Description]] = LevelRecord
    scene: StudiedScene
    cells: tuple[int, int]
    window: tuple[float, float]
    increments: tuple[int, ...]
    size: float

    @property
    def name(self) -> str:
        return f"{self.cells[0]}x{self.cells[1]}-{sum(self.increments)}"

    def compute(self) -> LevelRecord:
        started = time.perf_counter()
        contents = self.scene.read()
        grid = SurfaceGrid(self.cells, self.window)
        cut = plan(contents.scene).cut_into(self.increments)
        result = solve(contents.scene, grid, contents.semi_analytical.tolerance, plan=cut)
        return recorded(result, self, time.perf_counter() - started)


def recorded(result: Result, run: LevelRun, seconds: float) -> LevelRecord:
    """What is kept of a result."""
    end = result.steps[-1]
    return LevelRecord(
        size=run.size,
        cells=run.cells,
        increments=run.increments,
        values=named_values(end),
        shear=None if end.shear is None else StoredField.of(end.shear),
        limit=float(np.mean(friction_limit(result.scene, end.pressure))),
        largest_residual=largest_residual(result),
        iterations=sum(increment.iterations for increment in result.increments),
        convolutions=sum(increment.convolutions for increment in result.increments),
        seconds=seconds,
    )
