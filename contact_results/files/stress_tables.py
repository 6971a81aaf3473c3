"""`stress_maxima.csv`, `stress_axis.csv` and `stress.json`: numbers of a stress state, in SI."""

from __future__ import annotations

import csv
import json
from collections.abc import Iterable, Sequence
from pathlib import Path

from contact_results.directory.atomic_file import atomic_file
from contact_results.files.stress_extremes import MEASURES, RegionalExtreme, layer_name
from contact_results.files.surface_state import SurfaceState
from semi_analytical.stress import SubsurfaceField
from semi_analytical.stress.invariants import principal_stresses, von_mises

MAXIMA, AXIS, SUMMARY = "stress_maxima.csv", "stress_axis.csv", "stress.json"
COMPONENTS = ("xx", "yy", "zz", "yz", "xz", "xy")


def write_maxima(found: Iterable[RegionalExtreme], directory: Path) -> None:
    """Write one row per region and measure."""
    columns = ("region", "measure", "value [Pa]", "x [m]", "y [m]", "depth [m]")
    rows = (
        (e.region, e.measure, e.at.value, e.at.x, e.at.y, float(e.at.level.depth)) for e in found
    )
    _write(directory / MAXIMA, columns, rows)


def write_axis(section: SubsurfaceField, layers: int, directory: Path) -> None:
    """Write one row per level on the line x = y = 0; interfaces have two."""
    displacement, stress = section.below()
    equivalent, principal = von_mises(stress, axis=1), principal_stresses(stress, axis=1)
    columns = [
        *("depth [m]", "material", "u_x [m]", "u_y [m]", "u_z [m]"),
        *(f"sigma_{name} [Pa]" for name in COMPONENTS),
        *("von_mises [Pa]", "principal_1 [Pa]", "principal_2 [Pa]", "principal_3 [Pa]"),
    ]
    rows = (
        (float(level.depth), layer_name(level.layer, layers), *u, *s, vm, *p)
        for level, u, s, vm, p in zip(
            section.levels,
            displacement.tolist(),
            stress.tolist(),
            equivalent.tolist(),
            principal.tolist(),
            strict=True,
        )
    )
    _write(directory / AXIS, columns, rows)


def write_stress_summary(
    state: SurfaceState,
    which: str,
    field: SubsurfaceField,
    found: Sequence[RegionalExtreme],
    directory: Path,
) -> None:
    """Write what was computed and its extremes; the last file of a stress state."""
    record = {
        "title": state.title,
        "body": which,
        "step": state.step,
        "contact_radius": state.contact_radius,
        "peak_pressure": float(state.pressure.max()),
        "cells": list(state.grid.cells),
        "window": list(state.grid.window),
        "levels": [{"depth": float(s.depth), "layer": s.layer} for s in field.levels],
        "measures": MEASURES,
        "maxima": [
            {
                "region": e.region,
                "measure": e.measure,
                "value": e.at.value,
                "x": e.at.x,
                "y": e.at.y,
                "depth": float(e.at.level.depth),
                # Then there may be more beyond it.
                "at_window_edge": _at_edge(field, e),
            }
            for e in found
        ],
    }
    text = json.dumps(record, indent=2, allow_nan=False, ensure_ascii=False) + "\n"
    with atomic_file(directory / SUMMARY) as path:
        path.write_text(text, encoding="utf-8")


def _at_edge(field: SubsurfaceField, e: RegionalExtreme) -> bool:
    x, y = field.x, field.y
    return e.at.x in (x[0], x[-1]) or e.at.y in (y[0], y[-1])


def _write(path: Path, columns: Sequence[str], rows: Iterable[Sequence[object]]) -> None:
    with atomic_file(path) as temporary, open(temporary, "w", newline="", encoding="utf-8") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(columns)
        table.writerows(rows)
