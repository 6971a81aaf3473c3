"""Trial solve of a scene: a few increments on coarse cells, to estimate the CPU time of a run.

    T = n s + Σ over solves of  N t ((u + o)/(u₀ + o))^1.1

The trial solve has two increments in each of its load steps and u₀ unknowns. The shorter of its
last two increments takes the time t. Everything else than increments takes the time s: influence
coefficients, factorisations, imports. The run and the coarse solves of its error estimate have u
unknowns and N increments each. The overhead o is explained in `cost_estimate`. The set-up s is
counted once (n = 1) on cells and rings. Finite elements factorise each mesh anew. Their set-up is
therefore scaled and summed like an increment, and n is 0.
"""

import time
from dataclasses import replace
from typing import Any

from contact_errors.coarse_solves import (
    coarse_increment_counts,
    fewest_increments,
    solve_coarsest,
)
from contact_scene import Scene
from contact_scene.discretised import EXPONENT, DiscretisedSolver, Fineness
from contact_scene.stepping.increment_error import has_increment_error

# Increments of each load step: the first one of a step may include set-up, the last one does not.
INCREMENTS = 2
# Load steps: the third one of a fretting loop is the first that reverses the load. Steps are added
# until one of them shears the contact, because increments of pressing alone take less time.
STEPS = 3
MAX_STEPS = 12


def estimate_seconds(solver: DiscretisedSolver, run: Fineness) -> float:
    """Estimate the CPU time of a run with its error estimate [s] by a trial solve.

    Raises a SolverError if the trial solve fails: ContactNotResolved if no coarse discretisation
    resolves the contact.

    solver  solver of the scene with variable discretisation
    run     discretisation of the run
    """
    scene = solver.scene
    begin = scene.model_copy(update={"loading": scene.loading[: _trial_steps(scene)]})
    trial = replace(solver, scene=begin, chosen_plan=None)
    coarse = Fineness(
        trial.first_space(),
        (INCREMENTS,) * len(begin.loading),
        trial.discretisation.tolerance,
        edges=False,
    )
    ends: list[float] = []

    def solve(fineness: Fineness) -> Any:
        """Solve the first load steps, and record the CPU time at the end of each increment."""
        ends[:] = [time.process_time()]
        return trial.solve(fineness, lambda _: ends.append(time.process_time()))

    if trial.work(run).unknowns < trial.work(coarse).unknowns:
        result = solve(replace(coarse, space=run.space))
    else:
        result = solve_coarsest(trial, coarse, solve)
    coarse = trial.fineness_of(result)
    # Other work of the process only adds to a time, and one of the two may include set-up.
    increment = min(ends[-1] - ends[-2], ends[-2] - ends[-3])
    set_up = max(0.0, ends[-1] - ends[0] - increment * (len(ends) - 1))
    each = set_up if solver.factorises_each_mesh else 0.0
    seconds = set_up - each
    for solve_of_run, share in _solves_of_run(solver, run):
        work = solver.work(solve_of_run)
        ratio = work.size(share) / trial.work(coarse).size()
        seconds += (each + sum(solve_of_run.increments) * increment) * ratio**EXPONENT
    return seconds


def _trial_steps(scene: Scene) -> int:
    """Count the load steps of the trial solve, the first of the scene."""
    shears = [
        number
        for number, ramp in enumerate(scene.load_path(), start=1)
        if any(ramp.tangential.end) or ramp.twisting.end or ramp.strains
    ]
    return min(MAX_STEPS, max(STEPS, *shears[:1], 0))


def _solves_of_run(solver: DiscretisedSolver, run: Fineness) -> list[tuple[Fineness, float]]:
    """List the solve of a run and the coarse solves of its error estimate.

    Each solve has a discretisation and the fraction of its cells along a side that it uses. The
    coarse solves are those of `compare_with_coarse_solves`, as far as they are known beforehand.
    """
    matters, solves = has_increment_error(solver.scene), [(run, 1.0)]
    if any(matters):
        few = replace(run, space=solver.first_space())
        others = coarse_increment_counts(run.increments, matters)
        fewest = fewest_increments(run.increments, matters)
        solves += [
            (replace(few, increments=count), 1.0)
            for count in dict.fromkeys([run.increments, *others, fewest])
        ]
        run = replace(run, increments=fewest)
    shares = [share for _, share, _ in solver.shares_of(run.space)]
    return solves + [(run, share) for share in shares]
