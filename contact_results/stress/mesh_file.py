"""Stress as VTU files for ParaView: the section y = 0, or the whole volume."""

from __future__ import annotations

from pathlib import Path

import meshio
import numpy as np

from contact_results.directory.atomic_file import atomic_file
from contact_results.stress.points import StressPoints

SECTION, VOLUME = "stress_section.vtu", "stress_volume.vtu"


def write_mesh(points: StressPoints, path: Path) -> None:
    """Write points, their cells, and every field at the points.

    At an interface there are two points at one place, so that the jump is not smeared. z points
    into the body.
    """
    fields = {
        "displacement": np.moveaxis(points.displacement, 0, -1).reshape(-1, 3),
        "material": points.material.ravel(),
        "von_mises": points.von_mises.ravel(),
    }
    fields |= {f"principal_{k}": values.ravel() for k, values in enumerate(points.principal, 1)}
    fields |= {f"sigma_{name}": values.ravel() for name, values in points.components.items()}
    places = np.stack([points.x, points.y, points.depth], axis=-1).reshape(-1, 3)
    mesh = meshio.Mesh(places, [points.cells], point_data=fields)
    with atomic_file(path) as temporary:
        mesh.write(temporary, file_format="vtu", binary=True, compression="zlib")
