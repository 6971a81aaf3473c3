"""Reader of the directory of a stress: tables and meshes with units and meanings."""

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
    """A mesh with its fields.

    points  x, y and z into the body (n, 3) [m]
    cells   point numbers of the corners (m, corners)
    fields  arrays by name; the first index is the point, or the cell of cell-wise tractions
    """

    points: StoredValues
    cells: StoredValues
    fields: Mapping[str, StoredValues]


@dataclass(frozen=True)
class StoredStress:
    """Results of a stress, as `slipstick stress` wrote them.

    record    content of `stress.json`: settings and largest values
    tables    stress_maxima, stress_axis and stress_interfaces
    section   stress and displacement in the plane of the load
    surface   tractions
    volume    stress and displacement in the volume; None without --volume
    """

    record: Mapping[str, Any]
    tables: StoredTables
    section: StoredMesh
    surface: StoredMesh
    volume: StoredMesh | None

    @property
    def convention(self) -> str:
        """Units, axes and signs."""
        return str(self.record["convention"])


def load_stress(directory: str | PathLike[str]) -> StoredStress:
    """Read the results of `slipstick stress` from a directory.

    Raises
    ------
    FileNotFoundError
        The directory has no stress.
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
