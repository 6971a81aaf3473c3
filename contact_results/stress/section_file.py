"""Stress as VTU files for ParaView: the section y = 0 near the contact, or the whole volume."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from contact_results.files.csv_file import Column
from contact_results.files.mesh_file import Mesh, tensor, write_mesh
from contact_results.stress.points import StressPoints

SECTION, VOLUME = "stress_section.vtu", "stress_volume.vtu"
SURFACE = "stress_surface.vtu"  # the tractions

POINT_ARRAYS = (
    Column("displacement", "m", "Vector (x, y, z)."),
    Column("stress", "Pa", "Tensor by rows xx, xy, xz, yx, yy, yz, zx, zy, zz; tension positive."),
    Column("von_mises", "Pa", "Equivalent stress of von Mises."),
    *(
        Column(f"principal_{k}", "Pa", f"Principal stress, number {k} from the most tensile.")
        for k in (1, 2, 3)
    ),
    Column("material", None, "0 is the outermost layer, the highest number the base."),
)


def write_points(points: StressPoints, path: Path, convention: str) -> None:
    """Write points, their cells, and every field at the points.

    At an interface there are two points at one place, so that the jump is not smeared.
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
