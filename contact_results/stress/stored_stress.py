"""Reader of the output directory of a stress: tables and meshes with units and meanings."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Any

from contact_results.directory.file_names import STRESS, SUMMARY
from contact_results.files.csv_file import WITH_UNIT
from contact_results.files.mesh_file import read_mesh
from contact_results.files.stored_table import StoredTables, StoredValues, read_meanings
from contact_results.stress.files import (
    AXIS,
    INTERFACES,
    MAXIMA,
    MEANINGS,
    SECTION,
    SURFACE,
    VOLUME,
)


@dataclass(frozen=True, eq=False)
class StoredMesh:
    """Mesh read from a VTU file, with its fields.

    points  coordinates x, y and z of the points (n, 3) [m]; z points into the body
    cells   point numbers of the corners of each cell (m, corners)
    fields  arrays by name; the first index is the point, or the cell if tractions are cell-wise
    """

    points: StoredValues
    cells: StoredValues
    fields: Mapping[str, StoredValues]


@dataclass(frozen=True)
class StoredStress:
    """Stress below a contact in a directory that `slipstick stress` has written.

    record   content of `stress.json`: settings and largest stresses
    tables   stress_maxima, stress_axis and stress_interfaces
    section  stress and displacement in the plane y = 0 (cells) or in the plane of the load (rings)
    surface  tractions on the body
    volume   stress and displacement in the volume; None without --volume
    """

    record: Mapping[str, Any]
    tables: StoredTables
    section: StoredMesh
    surface: StoredMesh
    volume: StoredMesh | None

    @property
    def convention(self) -> str:
        """Text about units, axes and signs of the stored values."""
        return str(self.record["convention"])


def load_stress(directory: str | PathLike[str]) -> StoredStress:
    """Read the results of `slipstick stress` from a directory.

    Raises
    ------
    FileNotFoundError
        The directory is not the output of a stress.
    ValueError
        A file is damaged or of an earlier version.
    """
    place = Path(directory)
    if not (place / STRESS).is_file():
        instead = (
            "; it is the output of a run, which load reads" if (place / SUMMARY).is_file() else ""
        )
        raise FileNotFoundError(
            f"{directory} is not the output of a stress: it has no {STRESS}{instead}"
        )
    try:
        record = json.loads((place / STRESS).read_text(encoding="utf-8"))
    except (ValueError, RecursionError) as error:
        raise ValueError(f"{place / STRESS} is not the {STRESS} of a stress: {error}") from None
    if not isinstance(record, dict) or "convention" not in record:
        raise ValueError(
            f"{place / STRESS} has no convention: it is of an earlier version or not the output of "
            "a stress; run 'slipstick stress' again"
        )
    return StoredStress(
        record,
        StoredTables(place, (MAXIMA, AXIS, INTERFACES), MEANINGS),
        _mesh(place, SECTION),
        _mesh(place, SURFACE),
        _mesh(place, VOLUME) if (place / VOLUME).is_file() else None,
    )


def _mesh(directory: Path, name: str) -> StoredMesh:
    """Read a VTU file of a stress with the units and meanings of its fields.

    name  file name
    """
    mesh = read_mesh(directory / name)
    meanings = read_meanings(directory / MEANINGS, name)
    fields = {}
    for place, arrays in (("point", mesh.at_points), ("cell", mesh.on_cells)):
        for heading, array in arrays.items():
            split = WITH_UNIT.fullmatch(heading)
            stem, unit = (heading, "") if split is None else (split["name"], split["unit"])
            indices = (place, "component")[: array.ndim]
            if stem not in meanings:
                raise ValueError(f"{directory / name}: {heading!r} has no entry in {MEANINGS}")
            unit = "" if unit == "1" else unit
            fields[stem] = StoredValues(array, unit, meanings[stem], indices)
    kind, corners = mesh.cells
    return StoredMesh(
        StoredValues(mesh.points, "m", "Places x, y and z.", ("point", "component")),
        StoredValues(corners, "", f"Points of every {kind}.", ("cell", "corner")),
        fields,
    )
