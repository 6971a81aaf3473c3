"""Files of the stress below a contact: `stress.json`, tables, and meshes for ParaView."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from math import isnan
from pathlib import Path

import numpy as np

from contact_results.directory.file_names import STRESS
from contact_results.files.csv_file import Column, write_meanings, write_table
from contact_results.files.mesh_file import Mesh, tensor, write_mesh
from contact_results.stress.loaded_bodies import LoadedBodies
from contact_results.stress.points import (
    COMPONENTS,
    MEASURES,
    StressField,
    StressPoints,
    layer_name,
)
from contact_results.stress.stress_maxima import (
    Extreme,
    interface_sides,
)
from contact_scene import Body
from contact_scene.quantities.field_metadata import (
    CONVENTION,
    OF_THE_INDENTER,
)
from contact_scene.quantities.stated_error import AccuracyReached, StatedError

SECTION = "stress_section.vtu"
VOLUME = "stress_volume.vtu"

INVARIANTS = (
    Column("von_mises", "Pa", "Equivalent stress of von Mises."),
    *(
        Column(f"principal_{k}", "Pa", f"Principal stress, number {k} from the most tensile.")
        for k in (1, 2, 3)
    ),
)
POINT_ARRAYS = (
    Column("displacement", "m", "Vector (x, y, z)."),
    Column("stress", "Pa", "Tensor by rows xx, xy, xz, yx, yy, yz, zx, zy, zz; tension positive."),
    *INVARIANTS,
    Column("material", None, "0 is the outermost layer, the highest number the base."),
)
MAXIMA = "stress_maxima.csv"
AXIS = "stress_axis.csv"
INTERFACES = "stress_interfaces.csv"
MEANINGS = "stress_columns.csv"

PLACE = (
    Column("x", "m", "Coordinate in the plane of contact."),
    Column("y", "m", "Coordinate in the plane of contact."),
    Column("depth", "m", "Distance below the surface, z."),
)
LARGEST_COLUMNS = (
    Column("region", None, "Whole body, surface, a layer, the base, or a side of an interface."),
    Column("measure", None, "; ".join(f"{name}: {meaning}" for name, meaning in MEASURES.items())),
    Column("value", "Pa", "Largest value of the measure at any point of the region."),
    Column("error", "Pa", "Stated error of the value; empty if unknown."),
    *PLACE,
)
POINT_COLUMNS = (
    *PLACE,
    Column("material", None, "layer 1 is the outermost; base is below all layers."),
    *(Column(f"u_{axis}", "m", f"Displacement along {axis}.") for axis in "xyz"),
    *(Column(f"sigma_{k}", "Pa", "Component of stress, tension positive.") for k in COMPONENTS),
    *INVARIANTS,
)
SIDE_COLUMNS = (
    Column("interface", None, "Number of the interface, from 1 for the outermost."),
    Column("side", None, "Side of the interface; above is nearer to the contact surface."),
    *POINT_COLUMNS,
)


def write_files(
    state: LoadedBodies,
    which: str,
    field: StressField,
    found: Sequence[Extreme],
    directory: Path,
    errors: Sequence[StatedError] | None,
    accuracy: AccuracyReached | None,
) -> None:
    """Write tables, column descriptions, meshes and summary of the stress in one body.

    state      bodies and tractions that cause the stress
    which      "body" for the lower body, or "indenter"
    field      computed stress
    found      largest stresses
    directory  output directory
    errors     stated errors of `found`; None if they were not computed
    accuracy   requested and reached accuracy; None if none was requested
    """
    convention = OF_THE_INDENTER if which == "indenter" else CONVENTION
    body = field.body
    sizes = [e.error for e in errors] if errors else [None] * len(found)
    maxima = (
        (e.region, e.measure, e.value, size, e.x, e.y, e.depth)
        for e, size in zip(found, sizes, strict=True)
    )
    write_table(directory / MAXIMA, LARGEST_COLUMNS, maxima)
    axis = _point_rows(field.axis.rotate_to_scene(field.direction), body)
    write_table(directory / AXIS, POINT_COLUMNS, axis)
    interfaces = (
        (number, name, *row)
        for number, name, points in interface_points(field)
        for row in _point_rows(points.rotate_to_scene(field.direction), body)
    )
    write_table(directory / INTERFACES, SIDE_COLUMNS, interfaces)
    write_points(field.section.rotate_to_scene(field.direction), directory / SECTION, convention)
    files = {
        MAXIMA: LARGEST_COLUMNS,
        AXIS: POINT_COLUMNS,
        INTERFACES: SIDE_COLUMNS,
        SECTION: POINT_ARRAYS,
    }
    if field.volume is not None:
        write_points(field.volume.rotate_to_scene(field.direction), directory / VOLUME, convention)
        files[VOLUME] = POINT_ARRAYS
    write_meanings(directory / MEANINGS, files, convention)
    stated = [None] * len(found) if errors is None else [e.model_dump(mode="json") for e in errors]
    record = {
        "convention": convention,
        "title": state.title,
        "body": which,
        "step": state.step,
        "peak_pressure": state.peak_pressure,
        "accuracy": None if accuracy is None else accuracy.model_dump(mode="json"),
        **field.how,
        "measures": MEASURES,
        "maxima": [
            {**vars(extreme), "error": error} for extreme, error in zip(found, stated, strict=True)
        ],
    }
    text = json.dumps(record, indent=2, allow_nan=False, ensure_ascii=False) + "\n"
    (directory / STRESS).write_text(text, encoding="utf-8")


def write_points(points: StressPoints, path: Path, convention: str) -> None:
    """Write points, the cells between them, and the stress at the points to a VTU file.

    An interface has two points at each place, because the stress jumps there.

    points      points with cells
    path        path of the file
    convention  text about units, axes and signs
    """
    assert points.cells is not None
    places = np.stack([points.x, points.y, points.depth], axis=-1).reshape(-1, 3)
    values = (
        points.displacement.reshape(3, -1).T,
        tensor(points.stress.reshape(6, -1)),
        points.von_mises.ravel(),
        *points.principal.reshape(3, -1),
        points.material.ravel(),
    )
    arrays = {column.header: array for column, array in zip(POINT_ARRAYS, values, strict=True)}
    write_mesh(Mesh(places, points.cells, arrays), path, convention)


def interface_points(field: StressField) -> Iterator[tuple[int, str, StressPoints]]:
    """Yield number, side and points of every interface, in the section along x.

    Interfaces count from 1 for the outermost. The side is "above", nearer to the contact surface,
    or "below".
    """
    for number, name, depth, material in interface_sides(field.body):
        points = field.section
        on_it = np.flatnonzero(points.is_on_side(depth, material))
        yield number, name, points.select(on_it[np.argsort(points.x.flat[on_it], kind="stable")])


def _point_rows(points: StressPoints, body: Body) -> Iterator[tuple[object, ...]]:
    """Yield the table rows. The displacement below a line contact is unknown: None."""
    numbers = np.vstack([points.displacement, points.stress, points.von_mises, points.principal])
    materials = [layer_name(material, len(body.layers)) for material in points.material.tolist()]
    # The addition of 0.0 removes the sign of negative zeros.
    places = (np.stack([points.x, points.y, points.depth], axis=-1) + 0.0).tolist()
    for place, material, row in zip(places, materials, (numbers.T + 0.0).tolist(), strict=True):
        yield (*place, material, *(None if isnan(number) else number for number in row))
