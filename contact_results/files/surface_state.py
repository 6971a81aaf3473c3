"""Tractions on a grid at the end of a loading step, from a result or from a run's directory."""

from __future__ import annotations

import json
from dataclasses import dataclass, replace
from pathlib import Path

import h5py
import numpy as np
from numpy.typing import NDArray

from contact_results.directory.file_names import FIELDS
from contact_results.files.stored_values import MISREAD, refuse_other_shape, text, values
from contact_scene import Body
from semi_analytical import Result, SurfaceGrid

Field = NDArray[np.float64]

# Half a window of `with_margin` in half extents of the contact: past the contact's rim, where
# tension is largest, and past what bends a coating down there.
MARGIN = 1.6


class NoSuchState(Exception):
    """The directory holds no run, or the run has no such step."""


@dataclass(frozen=True)
class SurfaceState:
    """What loads the two bodies of a scene.

    step      loading step, from 1
    pressure  (nx, ny) [force/length^2]
    shear     (2, nx, ny), on the lower body; None without friction
    """

    title: str
    body: Body
    indenter: Body
    grid: SurfaceGrid
    step: int
    pressure: Field
    shear: Field | None

    @property
    def contact_radius(self) -> float:
        """Radius of the circle as large as the loaded cells [length]."""
        return float(np.sqrt(np.count_nonzero(self.pressure) * self.grid.cell_area / np.pi))

    def with_margin(self) -> SurfaceState:
        """The same on a window that reaches well beyond the contact; no smaller than it was."""
        widths = [self._margin(axis) for axis in (0, 1)]
        pad = [(width, width) for width in widths]
        cells = tuple(n + 2 * w for n, w in zip(self.grid.cells, widths, strict=True))
        window = tuple(n * side for n, side in zip(cells, self.grid.spacing, strict=True))
        grid = SurfaceGrid((cells[0], cells[1]), (window[0], window[1]))
        shear = None if self.shear is None else np.pad(self.shear, [(0, 0), *pad])
        return replace(self, grid=grid, pressure=np.pad(self.pressure, pad), shear=shear)

    def _margin(self, axis: int) -> int:
        """Cells to add on either side."""
        loaded = np.flatnonzero(np.any(self.pressure > 0, axis=1 - axis))
        middle = (self.grid.cells[axis] - 1) / 2
        reach = np.abs(loaded - middle).max() + 0.5 if loaded.size else 0.0
        return max(0, int(np.ceil(MARGIN * reach - self.grid.cells[axis] / 2)))


def state_of_result(result: Result, step: int | None) -> SurfaceState:
    """State at the end of a step, None for the last. Raises NoSuchState."""
    steps = {end.step: end for end in result.steps}
    end = steps[_existing(step, sorted(steps))]
    scene = result.scene
    indenter = Body(material=scene.indenter.material, layers=scene.indenter.layers)
    return SurfaceState(
        scene.title, scene.body, indenter, result.grid, end.step, end.pressure, end.shear
    )


def state_of_run(directory: Path, step: int | None) -> SurfaceState:
    """The same from the fields that `slipstick run` has written there.

    Raises NoSuchState, also for a file that is no result, and ResourceRefused.
    """
    path = directory / FIELDS
    if not path.is_file():
        raise NoSuchState(f"{directory} has no {FIELDS}; give the output of a run, or a scene file")
    try:
        with h5py.File(path) as file:
            return _read(file, step)
    except MISREAD as error:
        raise NoSuchState(f"{path} is not the {FIELDS} of a run: {error}") from None


def _read(file: h5py.File, step: int | None) -> SurfaceState:
    group = file["increments"]
    pressures, shears = group["pressure"], group.get("shear")
    shape = (*group["step"].shape, *file["x"].shape, *file["y"].shape)
    refuse_other_shape(pressures, shape)
    if shears is not None:
        refuse_other_shape(shears, (shape[0], 2, *shape[1:]))
    scene = json.loads(text(file["scene"]))
    steps = values(group["step"]).astype(int)
    chosen = _existing(step, sorted(set(steps.tolist())))
    last = int(np.flatnonzero(steps == chosen)[-1])
    x, y = values(file["x"]), values(file["y"])
    cells = (len(x), len(y))
    grid = SurfaceGrid(cells, (_window(x), _window(y)))
    return SurfaceState(
        scene["title"],
        _body(scene["body"]),
        _body(scene["indenter"]),
        grid,
        chosen,
        values(pressures, last),
        None if shears is None else values(shears, last),
    )


def _body(description: dict[str, object]) -> Body:
    return Body.model_validate({name: description[name] for name in ("material", "layers")})


def _window(centres: Field) -> float:
    """Side of the window from its cell centres, symmetric about zero."""
    return float((centres[-1] - centres[0]) * len(centres) / (len(centres) - 1))


def _existing(step: int | None, steps: list[int]) -> int:
    if step is None:
        return steps[-1]
    if step not in steps:
        raise NoSuchState(f"there is no step {step}; the run has steps {steps[0]} to {steps[-1]}")
    return step
