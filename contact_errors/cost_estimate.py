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

from contact_scene.discretised import Work

# Fractions of the cells along a side in the two coarse solves of an error estimate.
COARSE = 1 / 2, 2 / 5


def estimated_run_seconds(solved: float, judged: float, coarse: Work, run: Work) -> float:
    """Estimate the CPU time of a run with its error estimate [s], from a measured coarse solve.

    The estimate is accurate within a factor of two.

    solved       measured CPU time of the coarse solve [s]
    judged       measured CPU time of the error estimate of the coarse solve [s]
    coarse, run  unknowns and repetitions of the coarse solve and of the run
    """
    solves = sum(run.cost(share) for share in (1.0, *COARSE))
    return solved * solves / coarse.cost() + judged * run.repetitions / coarse.repetitions
