"""`stress_maxima.csv`, `stress_axis.csv`, `stress_interfaces.csv` and `stress.json`, in SI."""

from __future__ import annotations

import csv
import json
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

import numpy as np

from contact_results.directory.atomic_file import atomic_file
from contact_results.stress.extremes import Extreme, interface_sides, layer_name
from contact_results.stress.loaded_bodies import LoadedBodies
from contact_results.stress.points import MEASURES, StressField, StressPoints
from contact_scene import Body
from contact_scene.accuracy_reached import AccuracyReached
from contact_scene.stated_error import StatedError

MAXIMA, AXIS, INTERFACES = "stress_maxima.csv", "stress_axis.csv", "stress_interfaces.csv"
SUMMARY = "stress.json"

PLACE = ("x [m]", "y [m]", "depth [m]")


def write_maxima(
    found: Sequence[Extreme], errors: Sequence[StatedError] | None, directory: Path
) -> None:
    """Write one row per region and measure; no error where none is known."""
    sizes = ["" if e.error is None else e.error for e in errors] if errors else [""] * len(found)
    rows = (
        (e.region, e.measure, e.value, size, e.x, e.y, e.depth)
        for e, size in zip(found, sizes, strict=True)
    )
    _write(directory / MAXIMA, ("region", "measure", "value [Pa]", "error [Pa]", *PLACE), rows)


def write_axis(field: StressField, body: Body, directory: Path) -> None:
    """Write one row per point on the z axis; interfaces have two."""
    _write(directory / AXIS, _columns(field.axis), _rows(field.axis, body))


def write_interfaces(field: StressField, body: Body, directory: Path) -> None:
    """Write one row per point of the section on either side of an interface."""
    columns = ("interface", "side", *_columns(field.section))
    rows = (
        (number, name, *row)
        for number, name, points in sides(field, body)
        for row in _rows(points, body)
    )
    _write(directory / INTERFACES, columns, rows)


def sides(field: StressField, body: Body) -> Iterator[tuple[int, str, StressPoints]]:
    """Number and side of every interface with its points in the section, along x."""
    for number, name, depth, material in interface_sides(body):
        points = field.section
        on_it = np.flatnonzero(points.on_side(depth, material) & (np.abs(points.x) <= field.listed))
        yield number, name, points.chosen(on_it[np.argsort(points.x.flat[on_it], kind="stable")])


def write_stress_summary(
    state: LoadedBodies,
    which: str,
    field: StressField,
    found: Sequence[Extreme],
    errors: Sequence[StatedError] | None,
    accuracy: AccuracyReached | None,
    directory: Path,
) -> None:
    """Write what was computed and its extremes; the last file of a stress state."""
    stated = [None] * len(found) if errors is None else [e.model_dump(mode="json") for e in errors]
    record = {
        "title": state.title,
        "body": which,
        "step": state.step,
        "peak_pressure": float(np.max(state.tractions["pressure"])),
        "accuracy": None if accuracy is None else accuracy.model_dump(mode="json"),
        **field.how,
        "measures": MEASURES,
        "maxima": [
            {**vars(extreme), "error": error} for extreme, error in zip(found, stated, strict=True)
        ],
    }
    text = json.dumps(record, indent=2, allow_nan=False, ensure_ascii=False) + "\n"
    with atomic_file(directory / SUMMARY) as path:
        path.write_text(text, encoding="utf-8")


def _columns(points: StressPoints) -> tuple[str, ...]:
    return (
        *(*PLACE, "material", "u_x [m]", "u_y [m]", "u_z [m]"),
        *(f"sigma_{name} [Pa]" for name in points.components),
        *("von_mises [Pa]", "principal_1 [Pa]", "principal_2 [Pa]", "principal_3 [Pa]"),
    )


def _rows(points: StressPoints, body: Body) -> Iterator[tuple[object, ...]]:
    numbers = np.vstack([points.displacement, points.stress, points.von_mises, points.principal])
    materials = [layer_name(material, len(body.layers)) for material in points.material.tolist()]
    places = zip(points.x.tolist(), points.y.tolist(), points.depth.tolist(), strict=True)
    for place, material, row in zip(places, materials, numbers.T.tolist(), strict=True):
        yield (*place, material, *row)


def _write(path: Path, columns: Sequence[str], rows: Iterable[Sequence[object]]) -> None:
    with atomic_file(path) as temporary, open(temporary, "w", newline="", encoding="utf-8") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(columns)
        table.writerows(rows)
