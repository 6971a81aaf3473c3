"""Estimate of the CPU time of a run by a trial solve, as text."""

from contact_errors.trial_solve import estimate_seconds
from contact_scene.discretised import DiscretisedSolver
from contact_scene.disk_cache import without_cache
from contact_scene.solver_errors import ContactNotResolved, SolverError


def estimated_time(solver: DiscretisedSolver) -> str:
    """Return the text of the estimated CPU time of a run with its error estimate.

    The text is the reason if there is no estimate. Raises ContactNotResolved if no coarse
    discretisation resolves the contact.
    """
    try:
        with without_cache():
            seconds = estimate_seconds(solver, solver.run_fineness())
    except ContactNotResolved:
        raise
    except SolverError as error:
        return f"not estimated, since a trial solve failed: {error}"
    return f"{time_text(seconds)} of one core, error estimates included"


def time_text(seconds: float) -> str:
    """Return the text of a time in seconds, minutes or hours."""
    if seconds < 1:
        return "less than 1 s"
    if seconds < 120:
        return f"about {float(f'{seconds:.2g}'):g} s"
    if seconds < 7200:
        return f"about {seconds / 60:.2g} min"
    return f"about {seconds / 3600:.2g} h"
