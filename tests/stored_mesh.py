"""Reader of the mesh files that slipstick writes for ParaView, for tests."""

from pathlib import Path

import meshio

from contact_results.files.mesh_file import Mesh


def read_mesh(path: Path) -> Mesh:
    found = meshio.vtu.read(path)
    (block,) = found.cells
    on_cells = {name: values for name, (values,) in found.cell_data.items()}
    return Mesh(found.points, (block.type, block.data), dict(found.point_data), on_cells)
