"""Memory of a solve, estimated before anything is allocated."""

from contact_scene.free_memory import available_bytes
from contact_scene.solver_errors import ResourceRefused
from semi_analytical.grid import SurfaceGrid
from semi_analytical.plan import Coupling, Plan

DOUBLE = 8
# Arrays of the size of the window held at once: coefficients, spectra of the padded grid (four
# cells each) with their work space, solver vectors. Measured where the contact fills the window,
# as it does when the window is fitted; a contact of half the window takes a third less.
PRESSURE_ARRAYS = 40
HISTORY_ARRAYS = 4
SHEAR_ARRAYS = 82
# Arms and unit motions, and what they are multiplied with.
TILT_ARRAYS = 10
TORSION_ARRAYS = 36
# Spectra of the coupling, and the pressures that the alternation remembers: more of them, and two
# per cent more memory, where coupling is strong.
COUPLING_ARRAYS = {Coupling.NONE: 0, Coupling.ONE_WAY: 33, Coupling.FULL: 80}
# Arrays that every increment leaves behind: pressure and gap; shear, slip, its distance and
# dissipation, and masks.
PRESSURE_RESULT = 2
SHEAR_RESULT = 7
FIXED = 4 << 20  # what does not grow with the window: work space of the transforms, small objects


def estimated_bytes(grid: SurfaceGrid, plan: Plan) -> int:
    """Largest memory that a solve holds at once [byte]."""
    cells = grid.cells[0] * grid.cells[1]
    increments = sum(plan.increments)
    work = PRESSURE_ARRAYS + (SHEAR_ARRAYS if plan.shear else 0)
    work += (TILT_ARRAYS if plan.tilt else 0) + (TORSION_ARRAYS if plan.torsion else 0)
    work += COUPLING_ARRAYS[plan.coupling]
    work += HISTORY_ARRAYS if increments > 1 else 0
    kept = PRESSURE_RESULT + (SHEAR_RESULT if plan.shear else 0)
    return cells * DOUBLE * (work + kept * increments) + FIXED


def refuse_if_too_large(grid: SurfaceGrid, plan: Plan) -> None:
    """Raise ResourceRefused if the solve would not fit."""
    needed, available = estimated_bytes(grid, plan), available_bytes()
    if needed > available:
        raise ResourceRefused(
            f"{grid.cells[0]} x {grid.cells[1]} cells and {sum(plan.increments)} increments need "
            f"about {needed / 2**30:.1f} GiB, {available / 2**30:.1f} GiB are available; choose "
            f"fewer cells or increments"
        )
