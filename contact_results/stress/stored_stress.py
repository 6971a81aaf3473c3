"""A stress read back from its directory: tables and meshes, arrays with units and meaning."""

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
    cells   corners (m, corners), numbers of points
    fields  by name, the first index a point, or a cell where tractions are constant on cells
    """

    points: StoredValues
    cells: StoredValues
    fields: Mapping[str, StoredValues]


@dataclass(frozen=True)
class StoredStress:
    """What `slipstick stress` has written.

    record    what was computed, and how; its largest values
    tables    stress_maxima, stress_axis and stress_interfaces
    section   stress and displacement in the plane of the load
    surface   the tractions
    volume    the same as the section everywhere; None where it was not asked for
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
    """The stress that `slipstick stress` has left in a directory.

    Raises FileNotFoundError if there is none, and ValueError for files that are no stress's or of
    an earlier version.
    """
    place = Path(directory)
    if not (place / STRESS).is_file():
        instead = "; it is a run, which load reads" if (place / SUMMARY).is_file() else ""
        raise FileNotFoundError(f"{directory} is no stress: it has no {STRESS}{instead}")
    try:
        record = json.loads((place / STRESS).read_text(encoding="utf-8"))
    except (ValueError, RecursionError) as error:
        raise ValueError(f"{place / STRESS} is not the {STRESS} of a stress: {error}") from None
    if not isinstance(record, dict) or "convention" not in record:
        raise ValueError(
            f"{place / STRESS} has no convention: it is of an earlier version, or no stress; ask "
            "for the stress again"
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
                raise ValueError(f"{directory / name}: nothing says what {heading!r} is")
            unit = "" if unit == "1" else unit
            fields[stem] = StoredValues(array, unit, meanings[stem], indices)
    kind, corners = mesh.cells
    return StoredMesh(
        StoredValues(mesh.points, "m", "Places x, y and z.", ("point", "component")),
        StoredValues(corners, "", f"Points of every {kind}.", ("cell", "corner")),
        fields,
    )
