"""Stress states as VTU files for ParaView: the section y = 0, or the whole volume."""

from __future__ import annotations

from pathlib import Path

import meshio
import numpy as np
from numpy.typing import NDArray

from contact_results.directory.atomic_file import atomic_file
from contact_results.files.stress_tables import COMPONENTS
from semi_analytical.stress import SubsurfaceField

SECTION, VOLUME = "stress_section.vtu", "stress_volume.vtu"

Indices = NDArray[np.intp]


def write_mesh(field: SubsurfaceField, path: Path) -> None:
    """Write points, cells between the levels of one material, and every field at the points.

    At an interface there are two points at one place, so that the jump is not smeared. z points
    into the body.
    """
    depth, x, y = np.meshgrid(field.depths, field.x, field.y, indexing="ij")
    points = np.stack([x, y, depth], axis=-1).reshape(-1, 3)
    fields = {
        "displacement": np.moveaxis(field.displacement, 1, -1).reshape(-1, 3),
        "material": np.repeat([level.layer for level in field.levels], x[0].size),
        "von_mises": field.von_mises().ravel(),
    }
    principal = field.principal()
    fields |= {f"principal_{k + 1}": principal[:, k].ravel() for k in range(3)}
    fields |= {f"sigma_{name}": field.stress[:, k].ravel() for k, name in enumerate(COMPONENTS)}
    mesh = meshio.Mesh(points, [_cells(field)], point_data=fields)
    with atomic_file(path) as temporary:
        mesh.write(temporary, file_format="vtu", binary=True, compression="zlib")


def _cells(field: SubsurfaceField) -> tuple[str, Indices]:
    """Quadrilaterals of a section, hexahedra of a volume."""
    layers = [level.layer for level in field.levels]
    shape = (len(layers), len(field.x), len(field.y))
    index = np.arange(np.prod(shape)).reshape(shape)
    above = np.flatnonzero(np.equal(layers[:-1], layers[1:]))
    top, bottom = index[above], index[above + 1]
    if len(field.y) == 1:
        top, bottom = top[..., 0], bottom[..., 0]
        corners = [top[:, :-1], top[:, 1:], bottom[:, 1:], bottom[:, :-1]]
        return "quad", np.stack(corners, axis=-1).reshape(-1, 4)
    corners = [
        plane[:, i, j]
        for plane in (top, bottom)
        for i, j in (
            (slice(None, -1), slice(None, -1)),
            (slice(1, None), slice(None, -1)),
            (slice(1, None), slice(1, None)),
            (slice(None, -1), slice(1, None)),
        )
    ]
    return "hexahedron", np.stack(corners, axis=-1).reshape(-1, 8)
