"""Memory of a run, estimated before anything is allocated."""

from contact_scene.free_memory import available_bytes
from contact_scene.solver_errors import ResourceRefused
from contact_scene.stored_fields import MOST_HELD
from semi_analytical.grid import SurfaceGrid
from semi_analytical.plan import Coupling, Plan

DOUBLE = 8
# Arrays of the size of the window held at once: coefficients, spectra of the padded grid (two cells
# each) for the window and the box around the contact, one work space, solver vectors. Measured of
# whole runs on fitted windows, of which the contact takes nine tenths along each side.
PRESSURE_ARRAYS = 30
HISTORY_ARRAYS = 4
SHEAR_ARRAYS = 58
# Arms and unit motions, and what they are multiplied with.
TILT_ARRAYS = 10
TORSION_ARRAYS = 36
# Spectra of the coupling, and the Krylov vectors of a Newton step with their displacements.
COUPLING_ARRAYS = {Coupling.NONE: 0, Coupling.ONE_WAY: 33, Coupling.FULL: 125}
# Spectra of what tractions do within the cells, and that along the edge, in about as many cells as
# a side has.
EDGE_ARRAYS = 28
EDGE_SHEAR_ARRAYS = 84
EDGE_RIM = 200_000  # bytes per cell of the longer side
# Arrays that every increment leaves behind: pressure and gap; shear, slip, its distance and
# dissipation, and masks.
PRESSURE_RESULT = 2
SHEAR_RESULT = 7
LIGHT = 4500  # bytes of an increment without its fields
LIBRARIES = 80 << 20  # of the process that solves and writes
DRAWING = 90 << 20  # libraries of the figures and of the stress in them, and arrays
DRAWING_ARRAYS = 20


def estimated_bytes(grid: SurfaceGrid, plan: Plan) -> int:
    """Largest memory of a process that runs, libraries and figures included [byte]."""
    cells = grid.cells[0] * grid.cells[1]
    increments = sum(plan.increments)
    work = PRESSURE_ARRAYS + (SHEAR_ARRAYS if plan.shear else 0)
    work += (TILT_ARRAYS if plan.tilt else 0) + (TORSION_ARRAYS if plan.torsion else 0)
    work += COUPLING_ARRAYS[plan.coupling]
    rim = 0
    if plan.edge != "off":
        work += EDGE_ARRAYS + (EDGE_SHEAR_ARRAYS if plan.shear else 0)
        rim = EDGE_RIM * max(grid.cells)
    work += HISTORY_ARRAYS if increments > 1 else 0
    kept = PRESSURE_RESULT + (SHEAR_RESULT if plan.shear else 0)
    held = min(cells * DOUBLE * kept * increments, MOST_HELD) + LIGHT * increments
    held *= 2 if plan.shear else 1  # a companion on the same grid is held beside the result
    drawing = DRAWING + cells * DOUBLE * DRAWING_ARRAYS
    return LIBRARIES + held + max(cells * DOUBLE * work + rim, drawing)


def refuse_if_too_large(grid: SurfaceGrid, plan: Plan) -> None:
    """Raise ResourceRefused if the solve would not fit."""
    needed, available = estimated_bytes(grid, plan), available_bytes()
    if needed > available:
        raise ResourceRefused(
            f"{grid.cells[0]} x {grid.cells[1]} cells and {sum(plan.increments)} increments need "
            f"about {needed / 2**30:.1f} GiB, {available / 2**30:.1f} GiB are available; choose "
            f"fewer cells or increments"
        )
