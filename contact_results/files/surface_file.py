"""VTU files of the surface fields of a run, for ParaView, and their collection over load steps."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from contact_results.directory.run_directory import files_at_once
from contact_results.files.mesh_file import Mesh, write_mesh
from contact_results.files.stored_run import StoredRun
from contact_results.surface import Rings, Surface

# Names of the arrays with their units, by the name of the field.
VECTORS = {"shear": "shear [Pa]", "slip": "slip [m]"}
SCALARS = {
    "pressure": "pressure [Pa]",
    "gap": "gap [m]",
    "in_stick": "in_stick [1]",
    "dissipation": "dissipation [J/m^2]",
}

Places = NDArray[np.float64]


def write_surface(surface: Surface, increment: Any, path: Path, convention: str) -> None:
    """Write the surface fields of an increment to a VTU file.

    Fields are constant on cells. On rings, they are linear on a mesh of the disc, in a line contact
    on a rectangle, 1 m long. Fields that are None are omitted.

    path        path of the file
    convention  text about units, axes and signs
    """
    if isinstance(surface, Rings) and not surface.of_strips:
        surface, increment = surface.full_circle(increment)
    arrays: dict[str, NDArray[Any]] = {}
    for name, heading in VECTORS.items():
        vector = surface.vector(increment, name)
        if vector is not None:
            x, y = vector.reshape(2, -1) + 0.0
            arrays[heading] = np.stack([x, y, np.zeros_like(x)], axis=-1)
    for name, heading in SCALARS.items():
        field = surface.scalar(increment, name)
        if field is not None:
            arrays[heading] = field.ravel()
    if isinstance(surface, Rings):
        if surface.of_strips:  # both sides, at both ends of the lines
            sides = np.tile([*range(len(surface.radii))[::-1], *range(len(surface.radii))], 2)
            arrays = {name: values[sides] for name, values in arrays.items()}
        mesh = Mesh(*_ring_mesh(surface), at_points=arrays)
    else:
        mesh = Mesh(*_cell_mesh(surface), on_cells=arrays)
    write_mesh(mesh, path, convention)


def _cell_mesh(cells: Surface) -> tuple[Places, tuple[str, NDArray[np.int64]]]:
    x, y = (_cell_boundaries(centres) for centres in cells.axes.values())
    places = np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1).reshape(-1, 2)
    index = np.arange(len(places)).reshape(len(x), len(y))
    around = (index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:])
    return _add_zero_depth(places), ("quad", np.stack(around, axis=-1).reshape(-1, 4))


def _cell_boundaries(centres: Places) -> Places:
    """Return the boundaries of cells along one axis. A single cell is a strip, 1 m long."""
    if len(centres) == 1:
        return np.array([centres[0] - 0.5, centres[0] + 0.5])
    half = (centres[-1] - centres[0]) / (len(centres) - 1) / 2
    return np.append(centres - half, centres[-1] + half)


def _ring_mesh(rings: Rings) -> tuple[Places, tuple[str, NDArray[np.int64]]]:
    if rings.of_strips:
        x, ends = np.concatenate([-rings.radii[::-1], rings.radii]), np.array([-0.5, 0.5])
        first = np.arange(len(x) - 1)
        strips = np.stack([first, first + 1, first + len(x) + 1, first + len(x)], axis=-1)
        places = np.stack([np.tile(x, 2), np.repeat(ends, len(x))], axis=-1)
        return _add_zero_depth(places), ("quad", strips)
    places = np.moveaxis(rings.positions, 0, -1)
    index = np.arange(places[..., 0].size).reshape(places.shape[:2])
    ahead = np.roll(index, -1, axis=1)
    quads = np.stack([index[:-1], index[1:], ahead[1:], ahead[:-1]], axis=-1)
    return _add_zero_depth(places.reshape(-1, 2)), ("quad", quads.reshape(-1, 4))


def _add_zero_depth(places: Places) -> Places:
    return np.column_stack([places, np.zeros(len(places))]) + 0.0


COLLECTION = "surface.pvd"


def write_paraview(run: StoredRun, directory: Path) -> None:
    """Write the surface fields of a stored run as VTU files for ParaView.

    Each load step N gets a file `surface_step_N.vtu`. The file `surface.pvd` collects them, with N
    as the time.

    directory  output directory
    """
    entries = []
    with files_at_once(directory, COLLECTION, ()) as staging:
        for number in range(len(run.summary.steps)):
            end = run.end_of_step(number)
            file = f"surface_step_{int(end.step)}.vtu"
            write_surface(run.surface, end, staging / file, run.summary.convention)
            entries.append(f'<DataSet timestep="{int(end.step)}" file="{file}"/>\n')
        (staging / COLLECTION).write_text(
            '<VTKFile type="Collection" version="0.1">\n<Collection>\n'
            f"{''.join(entries)}</Collection>\n</VTKFile>\n",
            encoding="ascii",
        )
