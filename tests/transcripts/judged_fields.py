"""Norms of the errors of fields that are wrong by different amounts along x and y."""

from types import SimpleNamespace as Record

import numpy as np

from semi_analytical.grid import SurfaceGrid
from verification.judging import field_errors
from verification.problems.cattaneo_mindlin import TWISTED, sheared
from verification.problems.indentation import WEAK
from verification.problems.problem import HERTZ

PUSHED = sheared("pushed", (0.5,))
PRESSED = WEAK.problem(4)
TABULATED = ("tabulated_pressure_error", "radial_shear_error")
CASES = (  # problem, load step, norms on cells, norms on rings
    (PUSHED, 0, ("pressure_l1", "pressure_l2"), ("pressure_l2",)),
    (PUSHED, 1, ("shear_error",), ("shear_error",)),
    (PRESSED, 0, (*TABULATED, "stick_edge_error"), ("largest_pressure_error", *TABULATED)),
    (TWISTED, -1, (), ("shear_around_error",)),
)


def on_cells(problem, edge_report):
    """Fields on oblong cells, 3 % too large along x and 2 % too small along y."""
    grid, end = SurfaceGrid((42, 36), (1e-3, 0.9e-3)), problem.ends[-1]
    x, y = grid.coordinates()
    wrong, r = 1 + (0.03 * x - 0.02 * y) / problem.radius, np.hypot(x, y)
    pressure = getattr(end, "pressure", HERTZ.pressure)(r) * wrong
    along = np.stack([x, y]) / r if problem is PRESSED else np.stack([x**0, 0.1 * y**0])
    step = Record(pressure=pressure, shear=along * end.shear(r) * wrong, edge_report=edge_report)
    return Record(grid=grid, steps=[step, step])


def on_rings(problem):
    """Fields on rings, too large by 1 % (pressure) and by 2, 3 and 4 % (shear)."""
    end, r = problem.ends[-1], np.linspace(0, 1.2, 61) * problem.radius
    parts = ("shear_along_load", "shear_radial", "shear_circumferential")
    shear = {name: end.shear(r) * (1.02 + 0.01 * n) for n, name in enumerate(parts)}
    step = Record(radii=r, pressure=getattr(end, "pressure", HERTZ.pressure)(r) * 1.01, **shear)
    return Record(discretisation=Record(elements_per_radius=12), steps=[step, step])


for problem, step, *names in CASES:
    made = on_cells(problem, None), on_cells(problem, Record(cause=None)), on_rings(problem)
    for place, found in zip(("cells", "means", "rings"), made, strict=True):
        for name in names[place == "rings"]:
            print(place, name, f"{getattr(field_errors, name)(found, step, problem):.9g}")
