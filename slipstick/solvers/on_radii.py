"""Adapter of the radial solver, for bodies of revolution, to the interface of the commands."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import radial
from contact_scene import RadialDiscretisation, Scene
from contact_scene.stepping.checkpoint import CheckpointStore
from radial import Plan, Result
from radial.angular_grid import RingAngles
from slipstick.solvers.solver import Pairs, Progress, Solver, increments_text

if TYPE_CHECKING:
    from contact_errors.on_radii import RingSolver


class OnRadii(Solver):
    """Radial solver of bodies of revolution, with the interface `solver.Solver`."""

    table = "radial"
    discretisation = RadialDiscretisation

    def plan(self, scene: Scene, fineness: RadialDiscretisation) -> Plan:
        return radial.plan(scene)

    def solve(
        self,
        scene: Scene,
        fineness: RadialDiscretisation,
        plan: Plan,
        progress: Progress | None = None,
        store: CheckpointStore | None = None,
    ) -> Result:
        return radial.solve(scene, fineness, progress, plan, store)

    @property
    def refinable(self) -> type[RingSolver]:
        from contact_errors.on_radii import RingSolver

        return RingSolver

    def refined(self, scene: Scene, fineness: Any, stress: bool = False) -> RingSolver:
        return self.refinable(scene, fineness)

    def work(self, scene: Scene, fineness: RadialDiscretisation, plan: Plan) -> Pairs:
        """Yield names and texts of rings, tolerance, increments, time and memory of a solve."""
        from radial.memory import estimated_bytes

        yield "rings", _rings_text(fineness, plan)
        yield "tolerance", f"{fineness.tolerance:.3g}"
        yield "increments", increments_text(plan.increments)
        yield self.time(scene, fineness)
        yield "memory", f"about {estimated_bytes(scene, plan) / 2**20:.0f} MiB"

    def layout(self, result: Result) -> Pairs:
        yield "rings", _rings_text(result.fineness, result.plan)


def _rings_text(fineness: RadialDiscretisation, plan: Plan) -> str:
    """Return the text of the numbers of rings and angles of the radial solver.

    Without friction, the rings are only points of output.
    """
    if plan.circle:
        angles = "" if plan.circle is RingAngles.ONE else f", times {plan.angles} angles"
        return f"{plan.rings} over the contact, denser at its edge{angles}"
    return f"{fineness.rings} over the largest contact, for output only"
