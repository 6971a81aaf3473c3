"""VTU files of the surface fields of a run, for ParaView, and their collection over load steps."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from contact_results.directory.run_directory import files_at_once
from contact_results.files.csv_file import Column
from contact_results.files.mesh_file import Mesh, write_mesh
from contact_results.files.stored_run import StoredRun
from contact_results.files.stored_values import ends_of_steps
from contact_results.surface import Rings, Surface, surface_on

VECTORS = {
    "shear": Column("shear", "Pa", "Tangential traction, vector (x, y, 0)."),
    "slip": Column("slip", "m", "Slip since the start of the history, vector (x, y, 0)."),
}
SCALARS = {
    "pressure": Column("pressure", "Pa", "Normal traction, positive in compression."),
    "gap": Column("gap", "m", "Distance of the deformed surfaces; NaN where they never touch."),
    "in_stick": Column("in_stick", "", "1 in contact and sticking, else 0."),
    "dissipation": Column("dissipation", "J/m^2", "Energy per area lost to friction since then."),
}
AROUND = 48  # points on a ring if the fields depend on the radius alone
# Components of vectors on rings; the last one is odd in the angle.
POLAR = ("radial", "along_load", "circumferential")

Fields = Mapping[str, NDArray[Any] | None]
Places = NDArray[np.float64]


def write_surface(
    surface: Surface, fields: Fields, path: Path, convention: str, sense: float = 1.0
) -> None:
    """Write the surface fields of one state to a VTU file.

    Fields are constant on cells. On rings, they are linear on a mesh of the disc.

    fields      arrays by the names of the attributes of an increment; None and missing names are
                omitted
    path        path of the file
    convention  text about units, axes and signs
    sense       sign of shear and slip: 1 for the lower body, −1 for the indenter
    """
    if isinstance(surface, Rings):
        surface, fields = _all_around(surface, fields)
    arrays: dict[str, NDArray[Any]] = {}
    state = cast(Any, _state(fields))
    for name, column in VECTORS.items():
        vector = surface.vector(state, name)
        if vector is not None:
            x, y = sense * vector.reshape(2, -1) + 0.0
            arrays[column.header] = np.stack([x, y, np.zeros_like(x)], axis=-1)
    for name, column in SCALARS.items():
        field = surface.scalar(state, name)
        if field is not None:
            arrays[column.header] = field.ravel()
    if isinstance(surface, Rings):
        mesh = Mesh(*_disc(surface), at_points=arrays)
    else:
        mesh = Mesh(*_rectangles(surface), on_cells=arrays)
    write_mesh(mesh, path, convention)


def columns(fields: Fields) -> tuple[Column, ...]:
    """Return names, units and meanings of the arrays that `write_surface` writes for these fields.

    fields  arrays by the names of the attributes of an increment; None for missing ones
    """
    there = {name for name, field in fields.items() if field is not None}
    stems = {stem for stem in VECTORS for name in there if name.startswith(stem)}
    return tuple(c for name, c in (VECTORS | SCALARS).items() if name in stems | there)


def _state(fields: Fields) -> SimpleNamespace:
    """Create an object with all surface fields as attributes, as in an increment.

    Fields that are not given are None.
    """
    names = [f"{stem}_{part}" for stem in VECTORS for part in POLAR]
    return SimpleNamespace(**dict.fromkeys((*names, *VECTORS, *SCALARS)) | dict(fields))


def _rectangles(cells: Surface) -> tuple[Places, tuple[str, NDArray[np.int64]]]:
    """Create the mesh of the cells of a surface grid.

    Returns the corners of the cells (n, 3) [length], the cell type, and the corner numbers of each
    cell (m, 4).
    """
    x, y = (_between(centres) for centres in cells.axes.values())
    places = np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1).reshape(-1, 2)
    index = np.arange(len(places)).reshape(len(x), len(y))
    around = (index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:])
    return _flat(places), ("quad", np.stack(around, axis=-1).reshape(-1, 4))


def _between(centres: Places) -> Places:
    """Return the boundaries of cells along one axis (n + 1,) from the centres (n,) [length]."""
    half = (centres[-1] - centres[0]) / (len(centres) - 1) / 2
    return np.append(centres - half, centres[-1] + half)


def _disc(rings: Rings) -> tuple[Places, tuple[str, NDArray[np.int64]]]:
    """Create the mesh of quadrilaterals between adjacent rings, closed around the axis.

    rings  rings with angles over the full circle

    Returns the points (n, 3) [length], the cell type, and the corner numbers of each quadrilateral
    (m, 4).
    """
    places = np.moveaxis(rings.positions, 0, -1)
    index = np.arange(places[..., 0].size).reshape(places.shape[:2])
    ahead = np.roll(index, -1, axis=1)
    quads = np.stack([index[:-1], index[1:], ahead[1:], ahead[:-1]], axis=-1)
    return _flat(places.reshape(-1, 2)), ("quad", quads.reshape(-1, 4))


def _all_around(rings: Rings, fields: Fields) -> tuple[Rings, Fields]:
    """Extend rings and their fields to angles over the full circle.

    A half circle is reflected about the direction of the load. Rings without angles get AROUND
    angles, and their fields stay functions of the radius.
    """
    if rings.whole:
        return rings, fields
    if rings.angles is None:
        return replace(rings, angles=np.linspace(0.0, 2 * np.pi, AROUND, endpoint=False)), fields
    angles = np.append(rings.angles, 2 * np.pi - rings.angles[-2:0:-1])
    whole = {name: _mirrored(name, field) for name, field in fields.items()}
    return replace(rings, angles=angles), whole


def _mirrored(name: str, field: NDArray[Any] | None) -> NDArray[Any] | None:
    """Extend a field on rings from the half circle to the full circle by reflection.

    name   name of the field; circumferential components are odd in the angle, all others even
    field  values (rings, angles) on the half circle

    A field that depends on the radius alone, and None, are returned unchanged.
    """
    if field is None or field.ndim == 1:
        return field
    image = field[:, -2:0:-1]
    return np.concatenate([field, -image if name.endswith(POLAR[-1]) else image], axis=1)


def _flat(places: Places) -> Places:
    """Append the depth coordinate z = 0 to points on the surface.

    places  coordinates x and y (n, 2) [length]

    Returns x, y and z (n, 3).
    """
    return np.column_stack([places, np.zeros(len(places))]) + 0.0


COLLECTION = "surface.pvd"
NAMES = (*SCALARS, *VECTORS, *(f"{stem}_{part}" for stem in VECTORS for part in POLAR))


def write_paraview(run: StoredRun, directory: Path) -> None:
    """Write the surface fields of a stored run as VTU files for ParaView.

    Each load step N gets a file `surface_step_N.vtu`. The file `surface.pvd` collects them, with N
    as the time.

    directory  output directory
    """
    places = {name: values.array for name, values in run.coordinates.items()}
    surface, steps = surface_on(places, run.direction), run.increments["step"].array
    ends = ends_of_steps(steps)
    there = [name for name in NAMES if name in run.increments]
    entries = []
    with files_at_once(directory, COLLECTION, ()) as staging:
        for row in ends.tolist():
            step = int(steps[row])
            file = f"surface_step_{step}.vtu"
            fields = {name: run.increments.at(name, row) for name in there}
            write_surface(surface, fields, staging / file, run.convention)
            entries.append(f'<DataSet timestep="{step}" file="{file}"/>\n')
        (staging / COLLECTION).write_text(
            '<VTKFile type="Collection" version="0.1">\n<Collection>\n'
            f"{''.join(entries)}</Collection>\n</VTKFile>\n",
            encoding="ascii",
        )
