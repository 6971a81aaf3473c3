"""CPU time of a contact solve, from a power law through a measured coarse solve.

    t = t₀ w/w₀ ((u + o)/(u₀ + o))^1.1

A solve with u unknowns and w repetitions takes the time t. The time t₀ of a coarse solve of the
same scene (u₀, w₀) is measured. The exponent is 1 for the transforms of the fields, plus 0.1
because the number of iterations doubles with 1000 times the cells. The overhead of each operation
is equal to the work of o unknowns.

The error estimate of a run adds two solves, with 1/4 and 4/25 of its unknowns, and the solves for
the increment error. These last solves have the same small number of cells in the run and in the
coarse solve, so that their time is proportional to the repetitions.
"""

from typing import NamedTuple

EXPONENT = 1.1
# Unknowns whose work equals the overhead of an operation. Measured on the scenes of
# `tests/test_cost_estimate.py`: 9000 to 27 000 on cells, 600 to 2900 by elements. On rings, an
# increment of `coated_fretting` and of `fretting_loop` takes 7.5 and 8.5 ms at half the default
# numbers, 25 and 18 ms at the default and 550 and 130 ms at twice these numbers.
CELL_OVERHEAD = 128.0**2
ELEMENT_OVERHEAD = 32.0**2
RING_OVERHEAD = 1.0
# The factorisations of a finite-element solve take as long as this number of increments.
SET_UP_INCREMENTS = 50
# Fractions of the cells along a side in the two coarse solves of an error estimate.
COARSE = 1 / 2, 2 / 5


class Work(NamedTuple):
    """Numbers of unknowns and repetitions of a solve, from which its CPU time is estimated.

    unknowns     number of traction components in all cells; of a finite-element solve, square of
                 the number of elements over the contact radius; of a radial solve, fourth power of
                 the factor of the default numbers of rings and angles
    repetitions  number of increments; of a finite-element solve, increments and set-up times the
                 number of angular harmonics
    overhead     number of unknowns whose work equals the overhead of an operation
    """

    unknowns: float
    repetitions: float
    overhead: float

    def size(self, share: float = 1.0) -> float:
        """Count the unknowns and the overhead of a solve.

        share  fraction of the cells along a side, for a coarser solve of an error estimate
        """
        return share**2 * self.unknowns + self.overhead

    def cost(self, share: float = 1.0) -> float:
        """Compute a number proportional to the CPU time of a solve.

        The ratio of the numbers of two solves is the ratio of their CPU times, if scene and solver
        are equal.

        share  fraction of the cells along a side, for the cost of a coarser solve of an error
               estimate
        """
        return self.repetitions * self.size(share) ** EXPONENT


def estimated_run_seconds(solved: float, judged: float, coarse: Work, run: Work) -> float:
    """Estimate the CPU time of a run with its error estimate [s], from a measured coarse solve.

    The estimate is accurate within a factor of two.

    solved       measured CPU time of the coarse solve [s]
    judged       measured CPU time of the error estimate of the coarse solve [s]
    coarse, run  unknowns and repetitions of the coarse solve and of the run
    """
    solves = sum(run.cost(share) for share in (1.0, *COARSE))
    return solved * solves / coarse.cost() + judged * run.repetitions / coarse.repetitions
