"""VTU files of fields on a mesh, for ParaView, written by meshio.

The name of an array contains its unit, `stress [Pa]`. Vectors have three components. Tensors have
nine, the rows of the matrix xx, xy, xz, yx, ..., because VTK and Voigt order six components
differently.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

Values = NDArray[Any]

# Index of each component of a full tensor, by rows, in the order xx, yy, zz, yz, xz, xy.
VOIGT = (0, 5, 4, 5, 1, 3, 4, 3, 2)
HEAD = b"<UnstructuredGrid>"


@dataclass(frozen=True, eq=False)
class Mesh:
    """Mesh with fields at its points or on its cells.

    points     coordinates x, y and z of the points (n, 3) [length]; z points into the body
    cells      cell type of meshio, such as "quad", and point numbers of the corners (m, corners)
    at_points  fields at the points, (n,) or (n, components), by name with unit
    on_cells   fields on the cells, (m,) or (m, components), by name with unit
    """

    points: Values
    cells: tuple[str, Values]
    at_points: Mapping[str, Values] = field(default_factory=dict)
    on_cells: Mapping[str, Values] = field(default_factory=dict)


def tensor(voigt: Values) -> Values:
    """Convert symmetric tensors from Voigt order to the nine components of a VTU file.

    voigt  components xx, yy, zz, yz, xz, xy (6, n)

    Returns the rows xx, xy, xz, yx, yy, yz, zx, zy, zz of the full tensors (n, 9).
    """
    return np.asarray(voigt[list(VOIGT)].T)


def write_mesh(mesh: Mesh, path: Path, convention: str) -> None:
    """Write a mesh with its fields to a VTU file.

    Infinite values become NaN, which ParaView excludes from its colour scale.

    path        path of the file
    convention  text about units, axes and signs, written as a comment
    """
    import meshio

    whole = meshio.Mesh(
        mesh.points,
        [mesh.cells],
        point_data={name: _finite_values(values) for name, values in mesh.at_points.items()},
        cell_data={name: [_finite_values(values)] for name, values in mesh.on_cells.items()},
    )
    whole.write(path, file_format="vtu", binary=True, compression="zlib")
    comment = HEAD + f"\n<!-- {convention} -->".encode("ascii")
    path.write_bytes(path.read_bytes().replace(HEAD, comment, 1))


def _finite_values(values: Values) -> Values:
    """Convert the values of a field for a VTU file: infinity to NaN, True and False to 1 and 0."""
    if values.dtype == bool:
        return values.astype(np.int8)
    return np.where(np.isinf(values), np.nan, values) if values.dtype.kind == "f" else values
