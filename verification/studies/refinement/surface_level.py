"""One level of refinement, solved by the semi-analytical method."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from contact_scene import SceneFile
from contact_scene.friction import FRICTIONLESS
from semi_analytical import Result, SurfaceGrid, plan, solve
from verification.convergence.stored_field import PRESSURE, SHEAR, Field, StoredField
from verification.running.row import CaseRecord
from verification.studies.refinement.level_row import level_row
from verification.studies.refinement.studied_scene import StudiedScene


@dataclass(frozen=True)
class SurfaceLevel:
    """A grid and an increment count for every step up to the studied one.

    size   h of the level
    level  in words
    kept   cells about the centre whose tractions are recorded, without those outside the window;
           None: all of the window
    """

    scene: StudiedScene
    cells: tuple[int, int]
    window: tuple[float, float]
    increments: tuple[int, ...]
    size: float
    level: str
    kept: tuple[int, int] | None = None

    @property
    def name(self) -> str:
        return f"{self.cells[0]}x{self.cells[1]}-{sum(self.increments)}"

    @property
    def grid(self) -> SurfaceGrid:
        """Cells over the window."""
        return SurfaceGrid(self.cells, self.window)

    def compute(self) -> CaseRecord:
        result = self.solve(self.scene.read())
        return recorded(result, self)

    def solve(self, contents: SceneFile) -> Result:
        """The solution; raises what `semi_analytical.solve` raises."""
        cut = plan(contents.scene).cut_into(self.increments)
        return solve(contents.scene, self.grid, contents.semi_analytical.tolerance, plan=cut)


def recorded(result: Result, level: SurfaceLevel) -> CaseRecord:
    """What is kept of a result."""
    end = result.steps[-1]
    limit = (result.scene.friction or FRICTIONLESS).limit(end.pressure)
    kept = level.kept or level.cells
    fields = {PRESSURE: _stored(end.pressure[None], end.pressure, kept)}
    if end.shear is not None:
        fields[SHEAR] = _stored(end.shear, limit, kept)
    work = {"convolutions": sum(increment.convolutions for increment in result.increments)}
    return level_row(level, result, fields, work)


def _stored(field: Field, scale: Field, kept: tuple[int, int]) -> StoredField:
    """The middle of a field, zero outside its window."""
    middle = np.zeros((len(field), *kept))
    cells = zip(field.shape[1:], kept, strict=True)
    pairs = [(_middle(of, min(of, to)), _middle(to, min(of, to))) for of, to in cells]
    (from_x, to_x), (from_y, to_y) = pairs
    middle[:, to_x, to_y] = field[:, from_x, from_y]
    return StoredField.of(middle, float(np.sum(scale)) / (kept[0] * kept[1]))


def _middle(count: int, part: int) -> slice:
    start = (count - part) // 2
    return slice(start, start + part)
