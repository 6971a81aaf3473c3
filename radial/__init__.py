"""Contact of bodies of revolution in one dimension: functions of the radius, without grid or mesh.

It shares `semi_analytical.frf`, the response of layers to one wavenumber, with the semi-analytical
solver, and no other numerics with either solver. A plan needs neither, so they are imported by the
first solve.
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
