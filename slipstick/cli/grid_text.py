"""A surface grid in the units of a person."""

from contact_scene.engineering_units import engineering_unit
from semi_analytical import SurfaceGrid


def grid_text(grid: SurfaceGrid) -> str:
    """Cells and window of a grid."""
    (nx, ny), (Lx, Ly) = grid.cells, grid.window
    length = engineering_unit(max(Lx, Ly), "m")
    return f"{nx} x {ny} cells on {Lx / length.size:.4g} x {length.text(Ly)}"
