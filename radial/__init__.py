"""Solver for frictional contact of layered bodies of revolution, with fields on rings.

Pressure and shear are functions of the radius, and harmonics of the angle under a tangential load.
No mesh is necessary. `plan` determines the effects of a scene, and `solve` computes all increments
of its load history.

The package shares with the solver `semi_analytical` only the responses of layers to one wavenumber
(`semi_analytical.frf`). scipy is imported by the first solve, not by the import of the package.
"""

from typing import TYPE_CHECKING, Any

from contact_scene.effect import Effect
from contact_scene.quantities.residuals import Residuals
from radial.fields import Increment, Result
from radial.plan import Plan, plan

if TYPE_CHECKING:
    from radial.history import solve

__all__ = ["Effect", "Increment", "Plan", "Residuals", "Result", "plan", "solve"]


def __getattr__(name: str) -> Any:
    """Import the function `solve` when it is first read from the package.

    The late import keeps scipy out of programs that only make a plan.
    """
    if name == "solve":
        from radial.history import solve

        return solve
    raise AttributeError(f"module 'radial' has no attribute {name!r}")
