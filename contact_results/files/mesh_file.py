"""Fields on a mesh as VTU files for ParaView; the one module that knows the format and meshio.

An array has its unit in its name, `stress [Pa]`. Vectors have three components and tensors nine,
the rows of the matrix xx, xy, xz, yx, ... one after the other: about the order of six, VTK and
Voigt's notation disagree.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import meshio
import numpy as np
from numpy.typing import NDArray

from contact_results.directory.atomic_file import atomic_file

Values = NDArray[Any]

# Place of each component of (3, 3) in xx, yy, zz, yz, xz, xy.
VOIGT = (0, 5, 4, 5, 1, 3, 4, 3, 2)
HEAD = b"<UnstructuredGrid>"


@dataclass(frozen=True, eq=False)
class Mesh:
    """Fields at points or on cells.

    points    x, y and z into the body (n, 3) [length]
    cells     kind and corners (m, corners)
    at_points arrays (n,) or (n, components) by name with unit
    on_cells  the same of cells (m, ...)
    """

    points: Values
    cells: tuple[str, Values]
    at_points: Mapping[str, Values] = field(default_factory=dict)
    on_cells: Mapping[str, Values] = field(default_factory=dict)


def tensor(voigt: Values) -> Values:
    """(n, 9) of a symmetric tensor (6, n)."""
    return np.asarray(voigt[list(VOIGT)].T)


def write_mesh(mesh: Mesh, path: Path, convention: str) -> None:
    """Write a mesh with the convention of its axes and signs; what is infinite becomes NaN, which
    ParaView leaves out of its scale."""
    whole = meshio.Mesh(
        mesh.points,
        [mesh.cells],
        point_data={name: _finite(values) for name, values in mesh.at_points.items()},
        cell_data={name: [_finite(values)] for name, values in mesh.on_cells.items()},
    )
    with atomic_file(path) as temporary:
        whole.write(temporary, file_format="vtu", binary=True, compression="zlib")
        told = HEAD + f"\n<!-- {convention} -->".encode("ascii")
        temporary.write_bytes(temporary.read_bytes().replace(HEAD, told, 1))


def read_mesh(path: Path) -> Mesh:
    """The mesh of a file of ours; raises ValueError for any other."""
    try:
        if path.exists() and not path.is_file():
            raise OSError("it is not a regular file")
        found = meshio.vtu.read(path)  # `meshio.read` would leave the process
        (block,) = found.cells
    except (meshio.ReadError, OSError, ValueError, KeyError, SyntaxError, AssertionError) as error:
        raise ValueError(f"{path} is not a mesh that slipstick has written: {error}") from None
    on_cells = {name: values for name, (values,) in found.cell_data.items()}
    return Mesh(found.points, (block.type, block.data), dict(found.point_data), on_cells)


def _finite(values: Values) -> Values:
    if values.dtype == bool:
        return values.astype(np.int8)
    return np.where(np.isinf(values), np.nan, values) if values.dtype.kind == "f" else values
