"""Estimate of the peak memory of a semi-analytical solution."""

from contact_scene.machine import require_memory
from contact_scene.quantities.stored_fields import MAX_IN_MEMORY
from semi_analytical.grid import SurfaceGrid
from semi_analytical.plan import Coupling, Plan

DOUBLE = 8
# Simultaneous arrays of the size of the window: coefficients, spectra, work space, solver vectors,
# results of an increment. The second of two numbers counts arrays of the size of the reduced
# domain. Measured in complete runs on fitted windows (contact 90 % of each side).
PRESSURE_ARRAYS = 9, 20
HISTORY_ARRAYS = 4
SHEAR_ARRAYS = 31, 54
# Arms, unit motions and their products.
TILT_ARRAYS = 10
TORSION_ARRAYS = 6
# Coupled bodies, by the number of mirror images: for the first and for later increments, largest
# number of arrays during an increment (that are written to) and between increments, counted by
# tracemalloc on 256 x 256 cells.
COUPLED_ARRAYS = {
    1: ((122, 44), (182, 72)),
    2: ((81, 50), (141, 85)),
    4: ((60, 37), (120, 54)),
}
# Edge correction: spectra of subcell responses, and data of the edge cells, about one per cell of
# a side; more where loads change direction, as earlier edges are stored. Spectra for shear are on
# the window, in the work space of shear. Those of coupled bodies are counted as above, in addition
# to the arrays between increments.
EDGE_ARRAYS = 25
EDGE_RIM = 74_000  # bytes per cell of a side, in the mean
EDGE_SHEAR = 23 << 20
EDGE_SHEAR_ARRAYS = 100
EDGE_COUPLED = 30 << 20
EDGE_COUPLED_ARRAYS = 96
EDGE_COUPLED_RIM = 34_000
EDGE_SHEAR_RIM = 49_000
EDGE_TURNED_RIM = 150_000
# Arrays stored per increment: pressure and gap; shear, slip, its path length, dissipation, masks.
PRESSURE_RESULT = 2
SHEAR_RESULT = 7
LIGHT = 500  # bytes of an increment whose attributes are in a file
LIBRARIES = 42 << 20  # bytes of libraries for the solution, without SciPy
SCIPY = 27 << 20  # bytes of SciPy, for the solution or its errors: 19 to 44 MiB by modules
REFERENCE = 4 << 20  # bytes of the radial solver, with which errors of uncoupled bodies compare
# Output: libraries, arrays, and memory of the solver that is not returned to the system, more of
# coupled bodies. Measured with the overview picture on 32 to 1024 cells per side.
DRAWING = 75 << 20
DRAWING_ARRAYS = 18
DRAWING_COUPLED = 9 << 20


def estimated_bytes(grid: SurfaceGrid, plan: Plan) -> int:
    """Estimate the peak memory of a semi-analytical solution [byte].

    Libraries, stored increments, figures and stated errors are included.

    grid  cells of the full window
    plan  physical effects to compute, and number of increments
    """
    array = grid.cells[0] * grid.cells[1] * DOUBLE
    increments = sum(plan.increments)
    kept = PRESSURE_RESULT + (SHEAR_RESULT if plan.shear else 0)
    held = min(array * kept * increments, MAX_IN_MEMORY) + LIGHT * increments
    if plan.coupling is Coupling.FULL:
        solving = _coupled_bytes(grid, plan)
    else:
        solving = array * _count_arrays(grid, plan) + _edge_bytes(grid, plan)
    coupled = plan.coupling is not Coupling.NONE
    drawing = DRAWING + DRAWING_ARRAYS * array + DRAWING_COUPLED * coupled
    libraries = LIBRARIES + SCIPY + (0 if coupled else REFERENCE)
    return int(libraries + held + max(solving, drawing))


def _domain_share(grid: SurfaceGrid, plan: Plan) -> float:
    """Return the cells of the solved domain over those of the window."""
    return 1 / plan.symmetry.images if grid.even else 1.0


def _count_arrays(grid: SurfaceGrid, plan: Plan) -> float:
    """Count the arrays of the size of the window that are in memory at the peak of a solution.

    The count applies to uncoupled bodies. The edge correction is excluded.
    """
    share = _domain_share(grid, plan)
    arrays = PRESSURE_ARRAYS[0] + PRESSURE_ARRAYS[1] * share
    if plan.shear:
        arrays += SHEAR_ARRAYS[0] + SHEAR_ARRAYS[1] * share
    arrays += TILT_ARRAYS * plan.tilt + TORSION_ARRAYS * plan.torsion
    return arrays + HISTORY_ARRAYS * (sum(plan.increments) > 1)


def _coupled_bytes(grid: SurfaceGrid, plan: Plan) -> float:
    """Estimate the peak memory of coupled bodies during the solution or the edge correction [byte].

    Libraries and stored increments are excluded.
    """
    array, side = grid.cells[0] * grid.cells[1] * DOUBLE, sum(grid.cells) / 2
    by_increment = COUPLED_ARRAYS[plan.symmetry.images if grid.even else 1]
    during, between = by_increment[sum(plan.increments) > 1]
    more = TILT_ARRAYS * plan.tilt + TORSION_ARRAYS * plan.torsion
    if plan.edge == "off":
        return array * (during + more)
    most = max(during, between + EDGE_COUPLED_ARRAYS)
    return array * (most + more) + EDGE_COUPLED + EDGE_COUPLED_RIM * side


def _edge_bytes(grid: SurfaceGrid, plan: Plan) -> float:
    """Estimate the memory that the edge correction adds for uncoupled bodies [byte].

    The edge correction accounts for contact edges inside cells. The result is 0 without it.
    """
    if plan.edge == "off":
        return 0
    array, side = grid.cells[0] * grid.cells[1] * DOUBLE, sum(grid.cells) / 2
    share = _domain_share(grid, plan)
    alone = EDGE_ARRAYS * array + EDGE_RIM * side
    if not plan.shear:
        return alone * share
    # The stick border of path-dependent steps of several increments is corrected only with "all".
    steps = sum(plan.edge == "all" or not s.path_matters or s.count == 1 for s in plan.path[1:])
    if not steps:
        return alone
    arrays = EDGE_SHEAR_ARRAYS - SHEAR_ARRAYS[1] * share
    rim = EDGE_SHEAR_RIM + (EDGE_TURNED_RIM if steps > 1 else 0)
    return alone + EDGE_SHEAR + arrays * array + rim * side


def refuse_if_too_large(grid: SurfaceGrid, plan: Plan) -> None:
    """Raise ResourceRefused if a solution needs more memory than is available.

    grid  cells of the full window
    plan  physical effects to compute, and number of increments
    """
    (nx, ny), increments = grid.cells, sum(plan.increments)
    require_memory(
        estimated_bytes(grid, plan),
        f"{nx} x {ny} cells and {increments} increments",
        "Use fewer cells or increments",
    )
