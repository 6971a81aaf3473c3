"""Contact of bodies of revolution: axisymmetric geometry, fields over rings, no mesh.

The only numerics shared with another solver are the responses of layers to one wavenumber
(`semi_analytical.frf`). The package imports numpy and scipy with the first solve, not with a plan.
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
    if name == "solve":
        from radial.history import solve

        return solve
    raise AttributeError(f"module 'radial' has no attribute {name!r}")
