"""Section meshes in files that gmsh and ParaView read: `.msh` and `.vtu`, through meshio."""

from os import PathLike
from pathlib import Path

import meshio
import numpy as np

from contact_scene.solver_errors import SolverError
from fem_reference.mesh.section_mesh import SectionMesh
from fem_reference.mesh.section_outline import SectionOutline

LAYER = "layer"
_FORMATS = {".msh": "gmsh", ".vtu": "vtu"}


def write_section(section: SectionMesh, path: str | PathLike[str]) -> None:
    """Write a mesh in contact radii, r along x and z along y; cell data `layer` counts from 0.

    Raises ValueError for an ending other than `.msh` and `.vtu`.
    """
    points = np.zeros((section.points.shape[1], 3))
    points[:, :2] = section.points.T
    cells = [("quad", section.quads.T)]
    mesh = meshio.Mesh(points, cells, cell_data={LAYER: [section.layer.astype(float)]})
    mesh.write(path, file_format=_format(path))


def read_section(path: str | PathLike[str], outline: SectionOutline) -> SectionMesh:
    """Read a mesh that fits an outline.

    Raises SolverError where the file has elements other than quadrilaterals, or the mesh or its
    layers do not fit.
    """
    mesh = meshio.read(path, file_format=_format(path))
    cells = {block.type: len(block.data) for block in mesh.cells if block.dim == 2}
    if set(cells) != {"quad"}:
        raise SolverError(f"{path}: expected quadrilaterals alone, found {cells}")
    quads = np.concatenate([block.data for block in mesh.cells if block.type == "quad"])
    section = SectionMesh(
        np.ascontiguousarray(mesh.points[:, :2].T),
        np.ascontiguousarray(quads.T.astype(np.int64)),
        outline,
    )
    if LAYER in mesh.cell_data:
        layer = np.concatenate(
            [
                values
                for block, values in zip(mesh.cells, mesh.cell_data[LAYER], strict=True)
                if block.type == "quad"
            ]
        )
        if not np.array_equal(layer.ravel(), section.layer):
            raise SolverError(f"{path}: its layers are not between the interfaces of the body")
    return section


def _format(path: str | PathLike[str]) -> str:
    suffix = Path(path).suffix
    if suffix not in _FORMATS:
        raise ValueError(f"{path}: a mesh file ends in {' or '.join(_FORMATS)}")
    return _FORMATS[suffix]
