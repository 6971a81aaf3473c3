"""CPU time of a solve, from a power law through one coarse solve of the same scene.

    t = t₀ w/w₀ ((u + o)/(u₀ + o))^1.1

A solve with u unknowns and w repetitions takes the time t. The time t₀ of the coarse solve (u₀, w₀)
is measured. The exponent is 1 for the transforms of the fields, plus 0.1 because the number of
iterations doubles with 1000 times the cells. The overhead of each operation is equal to the work of
o unknowns.

The error estimate of a run adds two solves, with 1/4 and 4/25 of its unknowns, and solves for the
increment error. The latter have equally few cells in the run and in the coarse solve, so their time
is proportional to the repetitions.
"""

import time
from collections.abc import Callable, Sequence
from math import ceil
from typing import NamedTuple, TypeVar

from contact_scene.disk_cache import without_cache

T = TypeVar("T")

EXPONENT = 1.1
# Unknowns whose work equals the overhead of an operation. The scenes of `tests/cost_record.json`
# fit 9000 to 27 000 on cells, and 600 to 2900 by elements.
CELL_OVERHEAD, ELEMENT_OVERHEAD = 128.0**2, 32.0**2
# Factorisations of a history by elements take as long as this number of increments.
SET_UP_INCREMENTS = 50
# Shares of the cells along a side in the two coarse solves of an error estimate.
COARSE = 1 / 2, 2 / 5
# Limits of the coarse solve: cells along the longer side, elements over the contact radius, load
# steps from the first, and increments of these together.
MAX_CELLS, MAX_ELEMENTS, MAX_STEPS, MAX_INCREMENTS = 32, 8, 12, 48


class Work(NamedTuple):
    """Size of a solve.

    unknowns     components of traction in all cells, or the squared elements over the radius
    repetitions  increments, or a multiple of them
    overhead     unknowns whose work equals the overhead of an operation
    """

    unknowns: float
    repetitions: float
    overhead: float

    def cost(self, share: float = 1.0) -> float:
        """Return the cost with a fraction of the cells along a side, in a unit of the scene."""
        return self.repetitions * (share**2 * self.unknowns + self.overhead) ** EXPONENT


def work_on_cells(cells: tuple[int, int], increments: Sequence[int], shear: bool) -> Work:
    """Determine the size of a solve on cells.

    shear  true for three components of traction, false for one
    """
    return Work(cells[0] * cells[1] * (3 if shear else 1), sum(increments), CELL_OVERHEAD)


def work_on_elements(per_radius: int, increments: Sequence[int], harmonics: int) -> Work:
    """Determine the size of a solve by elements with a number of angular harmonics."""
    repetitions = harmonics * (SET_UP_INCREMENTS + sum(increments))
    return Work(per_radius**2, repetitions, ELEMENT_OVERHEAD)


def work_on_rings(increments: Sequence[int], fineness: float = 1.0) -> Work:
    """Determine the size of a radial solve with a multiple of its rings and angles."""
    return Work(fineness**4, sum(increments), 0.0)


def estimated_seconds(measured: float, coarse: Work, solve: Work) -> float:
    """Estimate the CPU seconds of a solve, within a factor of two.

    measured  CPU seconds of the coarse solve
    """
    return measured * solve.cost() / coarse.cost()


def estimated_run_seconds(solved: float, judged: float, coarse: Work, run: Work) -> float:
    """Estimate the CPU seconds of a solve and its error estimate, within a factor of two.

    solved  CPU seconds of the coarse solve
    judged  CPU seconds of the error estimate of the coarse solve
    """
    solves = sum(run.cost(share) for share in (1.0, *COARSE))
    return solved * solves / coarse.cost() + judged * run.repetitions / coarse.repetitions


def coarse_increments(increments: Sequence[int]) -> tuple[int, ...]:
    """Reduce the increments of all load steps by one factor to the limit of the coarse solve."""
    share = min(1.0, MAX_INCREMENTS / sum(increments))
    return tuple(ceil(share * count) for count in increments)


def cpu_seconds(call: Callable[[], T]) -> tuple[T, float]:
    """Measure the CPU time of a call without the disk cache, and return its result and time [s]."""
    with without_cache():
        began = time.process_time()
        result = call()
        return result, time.process_time() - began
