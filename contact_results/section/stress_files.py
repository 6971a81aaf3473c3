"""What `slipstick stress` writes for a result on a section: VTU, tables and a summary, in SI."""

from __future__ import annotations

import csv
import json
from collections.abc import Iterable, Sequence
from pathlib import Path

import meshio
import numpy as np

from contact_results.directory.atomic_file import atomic_file
from contact_results.files.stress_extremes import MEASURES, layer_name
from contact_results.files.stress_mesh import SECTION
from contact_results.files.stress_tables import AXIS, MAXIMA, SUMMARY
from contact_results.section.stress_planes import (
    Extreme,
    StressPlane,
    interface_sides,
    on_side,
)
from contact_results.section.stress_state import SectionState
from contact_scene import Body

INTERFACES = "stress_interfaces.csv"
COMPONENTS = ("rr", "tt", "zz", "tz", "rz", "rt")
RECOVERY = (
    "stress at the 2 x 2 Gauss points, extrapolated bilinearly to the nodes and averaged over the "
    "elements of one material"
)
SHOWN = 10.0  # loaded radii that the tables reach

COLUMNS = (
    *("x [m]", "depth [m]", "material", "u_x [m]", "u_y [m]", "u_z [m]"),
    *(f"sigma_{name} [Pa]" for name in COMPONENTS),
    *("von_mises [Pa]", "principal_1 [Pa]", "principal_2 [Pa]", "principal_3 [Pa]"),
)

Rows = Iterable[Sequence[object]]


def write_section_stress(
    plane: StressPlane, state: SectionState, body: Body, which: str, found: tuple[Extreme, ...],
    directory: Path,
) -> None:  # fmt: skip
    """Write everything; the summary comes last, so that a directory that has it is complete."""
    (directory / SUMMARY).unlink(missing_ok=True)
    directory.mkdir(parents=True, exist_ok=True)
    reach = SHOWN * state.tractions.loaded_radius
    _write_vtu(plane, directory / SECTION)
    columns = ("region", "measure", "value [Pa]", "x [m]", "depth [m]")
    maxima = ((e.region, e.measure, e.value, e.x, e.depth) for e in found)
    _write_table(directory / MAXIMA, columns, maxima)
    axis = np.flatnonzero((plane.x == 0.0) & (plane.z <= reach))
    axis = axis[np.lexsort((plane.material[axis], plane.z[axis]))]
    # Both halves have the axis.
    axis = axis[np.unique(plane.z[axis] + 1j * plane.material[axis], return_index=True)[1]]
    _write_table(directory / AXIS, COLUMNS, _rows(plane, body, axis))
    _write_table(
        directory / INTERFACES, ("interface", "side", *COLUMNS), _sides(plane, body, reach)
    )
    _write_summary(state, which, found, directory / SUMMARY)


def _write_vtu(plane: StressPlane, path: Path) -> None:
    """Points (x, 0, z), z into the body; two points at one place on an interface."""
    fields = {
        "displacement": plane.displacement.T,
        "material": plane.material,
        "von_mises": plane.von_mises,
    }
    fields |= {f"principal_{k + 1}": values for k, values in enumerate(plane.principal)}
    named = zip(COMPONENTS, plane.stress, strict=True)
    fields |= {f"sigma_{name}": values for name, values in named}
    points = np.stack([plane.x, np.zeros_like(plane.x), plane.z], axis=1)
    mesh = meshio.Mesh(points, [("quad9", plane.cells)], point_data=fields)
    with atomic_file(path) as temporary:
        mesh.write(temporary, file_format="vtu", binary=True, compression="zlib")


def _sides(plane: StressPlane, body: Body, reach: float) -> Iterable[Sequence[object]]:
    for number, side, depth, material in interface_sides(body):
        chosen = np.flatnonzero(on_side(plane, depth, material) & (np.abs(plane.x) <= reach))
        chosen = chosen[np.argsort(plane.x[chosen], kind="stable")]
        for row in _rows(plane, body, chosen):
            yield (number, side, *row)


def _rows(plane: StressPlane, body: Body, chosen: Iterable[int]) -> Rows:
    for k in chosen:
        yield (
            float(plane.x[k]),
            float(plane.z[k]),
            layer_name(int(plane.material[k]), len(body.layers)),
            *plane.displacement[:, k].tolist(),
            *plane.stress[:, k].tolist(),
            float(plane.von_mises[k]),
            *plane.principal[:, k].tolist(),
        )


def _write_table(path: Path, columns: Sequence[str], rows: Rows) -> None:
    with atomic_file(path) as temporary, open(temporary, "w", newline="", encoding="utf-8") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(columns)
        table.writerows(rows)


def _write_summary(state: SectionState, which: str, found: tuple[Extreme, ...], path: Path) -> None:
    record = {
        "title": state.title,
        "body": which,
        "step": state.step,
        "loaded_radius": state.tractions.loaded_radius,
        "peak_pressure": float(np.max(state.tractions.pressure)),
        "elements_per_radius": state.discretisation.elements_per_radius,
        "recovery": RECOVERY,
        "measures": MEASURES,
        "maxima": [
            {
                "region": e.region,
                "measure": e.measure,
                "value": e.value,
                "x": e.x,
                "depth": e.depth,
            }
            for e in found
        ],
    }
    with atomic_file(path) as temporary:
        text = json.dumps(record, indent=2, allow_nan=False, ensure_ascii=False) + "\n"
        temporary.write_text(text, encoding="utf-8")
