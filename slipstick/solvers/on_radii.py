"""Adapter of the radial solver, for bodies of revolution, to the interface of the commands."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import radial
from contact_errors.cost_estimate import MAX_STEPS, coarse_increments, work_on_rings
from contact_errors.on_radii import RingSolver
from contact_scene import RadialDiscretisation, Scene
from contact_scene.stepping.checkpoint import CheckpointStore
from radial import Plan, Result
from radial.angular_grid import Circle
from slipstick.solvers.solver import Pairs, Progress, Solver, increments_text, time_of_run


class OnRadii(Solver):
    """Radial solver of bodies of revolution, with the interface `solver.Solver`."""

    table = "radial"
    discretisation = RadialDiscretisation
    refinable = RingSolver

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

    def refined(self, scene: Scene, fineness: Any, stress: bool = False) -> RingSolver:
        return RingSolver(scene, fineness)

    def work(self, scene: Scene, fineness: RadialDiscretisation, plan: Plan) -> Pairs:
        """Yield names and texts of rings, tolerance, increments, time and memory of a solve.

        The time is estimated by a solve of the first load steps.
        """
        from radial.memory import estimated_bytes

        yield "rings", _rings_text(fineness, plan)
        yield "tolerance", f"{fineness.tolerance:.3g}"
        yield "increments", increments_text(plan.increments)
        yield self._time(scene, fineness, plan)
        yield "memory", f"about {estimated_bytes(scene, plan) / 2**20:.0f} MiB"

    def _time(self, scene: Scene, fineness: RadialDiscretisation, plan: Plan) -> tuple[str, str]:
        """Estimate the CPU time of a run from a solve of its first load steps.

        That solve has equal rings and fewer increments. Returns the word "time" and the text of the
        estimate.
        """
        begin = scene.model_copy(update={"loading": scene.loading[:MAX_STEPS]})
        cut = replace(plan, increments=coarse_increments(plan.increments[:MAX_STEPS]))
        return time_of_run(
            lambda: radial.solve(begin, fineness, plan=cut),
            self.errors,
            work_on_rings(cut.increments),
            work_on_rings(plan.increments),
        )

    def layout(self, result: Result) -> Pairs:
        yield "rings", _rings_text(result.fineness, result.plan)


def _rings_text(fineness: RadialDiscretisation, plan: Plan) -> str:
    """Return the text of the numbers of rings and angles of the radial solver.

    Without friction, the rings are only points of output.
    """
    if plan.circle:
        angles = "" if plan.circle is Circle.ONE else f", times {plan.angles} angles"
        return f"{plan.rings} over the contact, denser at its edge{angles}"
    return f"{fineness.rings} over the largest contact, for output only"
