"""Memory of a run, estimated before anything is allocated."""

from contact_scene.free_memory import available_bytes
from contact_scene.solver_errors import ResourceRefused
from contact_scene.stored_fields import MOST_HELD
from semi_analytical.grid import SurfaceGrid
from semi_analytical.part import WHOLE
from semi_analytical.plan import Coupling, Plan

DOUBLE = 8
# Arrays of the size of the window held at once: coefficients, spectra, work space, solver vectors,
# results of an increment. Measured of whole runs on fitted windows, of which the contact takes nine
# tenths along each side.
PRESSURE_ARRAYS = 32
# Fewer where a quarter of the window tells the pressure and no shear comes after it.
QUARTER_SAVES = 8
HISTORY_ARRAYS = 4
SHEAR_ARRAYS = 57
# Fewer where a quarter tells the shear, too; edges inside the cells ask for the window.
QUARTER_SHEAR_SAVES = 22
# Arms and unit motions, and what they are multiplied with.
TILT_ARRAYS = 10
TORSION_ARRAYS = 6
# Spectra of the coupling, and the Krylov vectors of a Newton step with their displacements.
COUPLING_ARRAYS = {Coupling.NONE: 0, Coupling.ONE_WAY: 33, Coupling.FULL: 69}
# Fewer by its images where a part of the window tells them; edges ask for the window here, too.
PART_COUPLING_SAVES = {1: 0, 2: 31, 4: 82}
# Spectra of what tractions do within the cells, and that along the edge, in about as many cells as
# a side has; more of it where loads turn, whose edges stay inside the cells.
EDGE_ARRAYS = 25
# Fewer where a quarter of the window tells them, and a quarter of the cells along the edge.
QUARTER_EDGE_SAVES = 19
EDGE_SHEAR, EDGE_SHEAR_ARRAYS = 31 << 20, 46
EDGE_RIM = 41_000  # bytes per cell of the longer side
EDGE_SHEAR_RIM = 86_000
EDGE_TURNED_RIM = 150_000
PUSHED_ONCE = 2  # steps: pressed, then pushed
# Arrays that every increment leaves behind: pressure and gap; shear, slip, its distance and
# dissipation, and masks.
PRESSURE_RESULT = 2
SHEAR_RESULT = 7
LIGHT = 4500  # bytes of an increment without its fields
LIBRARIES = 73 << 20  # of the process that solves
# Libraries that write and draw, arrays, and what the solver leaves that has not gone back to the
# system; the stress that is drawn takes no more. Shear has more maps, and bodies that couple leave
# more, while they are solved, too.
DRAWING, DRAWING_ARRAYS = 77 << 20, 20
DRAWING_SHEAR, COUPLED = 11 << 20, 30 << 20


def estimated_bytes(grid: SurfaceGrid, plan: Plan) -> int:
    """Largest memory of a process that runs, libraries and figures included [byte]."""
    cells = grid.cells[0] * grid.cells[1]
    increments = sum(plan.increments)
    quarter = plan.quarter and not (grid.cells[0] % 2 or grid.cells[1] % 2)
    work = PRESSURE_ARRAYS + (SHEAR_ARRAYS if plan.shear else 0)
    work -= QUARTER_SAVES if quarter and not plan.shear else 0
    told = plan.told if quarter and plan.edge == "off" else WHOLE
    coupled = plan.coupling is not Coupling.NONE
    if coupled:
        work -= PART_COUPLING_SAVES[told.images]
    elif told.quarter:
        work -= QUARTER_SHEAR_SAVES
    work += (TILT_ARRAYS if plan.tilt else 0) + (TORSION_ARRAYS if plan.torsion else 0)
    work += COUPLING_ARRAYS[plan.coupling]
    rim = 0
    if plan.edge != "off":
        pressed_alone = quarter and not plan.shear
        work += EDGE_ARRAYS + (EDGE_SHEAR_ARRAYS if plan.shear else 0)
        work -= QUARTER_EDGE_SAVES if pressed_alone else 0
        along = EDGE_RIM // (4 if pressed_alone else 1) + (EDGE_SHEAR_RIM if plan.shear else 0)
        along += EDGE_TURNED_RIM if plan.shear and len(plan.path) > PUSHED_ONCE else 0
        rim = along * max(grid.cells) + (EDGE_SHEAR if plan.shear else 0)
    work += HISTORY_ARRAYS if increments > 1 else 0
    kept = PRESSURE_RESULT + (SHEAR_RESULT if plan.shear else 0)
    held = min(cells * DOUBLE * kept * increments, MOST_HELD) + LIGHT * increments
    drawing = DRAWING + cells * DOUBLE * DRAWING_ARRAYS + (DRAWING_SHEAR if plan.shear else 0)
    libraries = LIBRARIES + (COUPLED if coupled else 0)
    return libraries + held + max(cells * DOUBLE * work + rim, drawing)


def refuse_if_too_large(grid: SurfaceGrid, plan: Plan) -> None:
    """Raise ResourceRefused if the solve would not fit."""
    needed, available = estimated_bytes(grid, plan), available_bytes()
    if needed > available:
        raise ResourceRefused(
            f"{grid.cells[0]} x {grid.cells[1]} cells and {sum(plan.increments)} increments need "
            f"about {needed / 2**30:.1f} GiB, {available / 2**30:.1f} GiB are available; choose "
            f"fewer cells or increments"
        )
