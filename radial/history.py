"""Entry point of the solver: the solve of all increments of a load history.

The module also contains the solver of load steps without friction.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from contact_scene import LoadRamp, RadialDiscretisation, Scene
from contact_scene.array_types import Array
from contact_scene.machine import one_thread
from contact_scene.normal_form import normal_form
from contact_scene.quantities.residuals import Residuals
from contact_scene.quantities.ring_increment import add_work
from contact_scene.rig import add_contact_displacements
from contact_scene.stepping.checkpoint import (
    CheckpointStore,
    store_checkpoints,
)
from contact_scene.stepping.load_stepping import (
    ConvergedIncrement,
    resumable_increments,
)
from radial.fields import Increment, Result
from radial.memory import refuse_if_too_large
from radial.normal.disc import normal_stiffness
from radial.normal.pressing import (
    NormalContact,
    normal_contact,
)
from radial.normal.surface import (
    displacement,
    largest_pressure,
    pressure,
)
from radial.output_points import (
    StepsOnRings,
    largest_targets,
    output_radii,
    refuse_no_disc,
    refuse_round_off,
    target,
)
from radial.plan import Plan
from radial.plan import plan as plan_of
from radial.response.bodies import Bodies

Progress = Callable[[Increment], None]


@one_thread()
def solve(
    scene: Scene,
    discretisation: RadialDiscretisation | None = None,
    progress: Progress | None = None,
    plan: Plan | None = None,
    store: CheckpointStore | None = None,
) -> Result:
    """Solve the contact of a scene of revolution for all increments of its load history.

    Parameters
    ----------
    scene
        The contact problem.
    discretisation
        Number of output rings and tolerance of every residual. Default: `RadialDiscretisation()`.
    progress
        Called with each increment after its solve.
    plan
        Result of `plan(scene)`, which is computed if absent.
    store
        Checkpoints of an earlier run of the same solve. The solve resumes after the last one.

    Raises
    ------
    UnsupportedScene
        The scene is not of revolution or has an effect that this solver lacks, or the surfaces
        separate within the contact.
    ResourceRefused
        The estimated memory exceeds the available memory.
    NotConverged
        An increment did not reach the tolerance. `last_state` is the last converged increment.
    """
    discretisation = discretisation or RadialDiscretisation()
    scene = normal_form(scene)
    decided = plan_of(scene) if plan is None else plan
    refuse_if_too_large(scene, decided)
    solver = replace(_create_solver(scene, discretisation, decided), stiffness=decided.stiffness)
    last = store.last() if store else None
    history = resumable_increments(scene, decided.increments, solver, last)
    increments = store_checkpoints(history, last, store, progress, None)
    return Result(scene, discretisation, decided, tuple(increments))


def _create_solver(scene: Scene, discretisation: RadialDiscretisation, plan: Plan) -> Any:
    """Create the solver of load steps for the physical effects that a scene has.

    The solvers are: tangential load or torsion at points (rings × angles), normal load with
    friction, normal load without friction, and torsion in closed form.

    scene           contact problem
    discretisation  number of output rings, and tolerance of the residuals
    plan            physical effects of the scene, such as friction and torsion
    """
    if plan.circle:
        from radial.tangential.tangential_steps import TangentialSteps

        return TangentialSteps.of(scene, discretisation, plan)
    if plan.coupled:
        from radial.frictional.frictional_indentation_steps import FrictionalSteps

        return FrictionalSteps.of(scene, discretisation, plan.fineness)
    pressing = _FrictionlessSteps.of(scene, discretisation, round(plan.fineness))
    if not plan.twists:
        return pressing
    from radial.torsion.torsion_steps import TorsionSteps

    assert scene.friction is not None
    assert scene.friction.uniform is not None
    return TorsionSteps(
        scene, pressing, scene.friction.uniform, pressing.fineness, discretisation.tolerance
    )


@dataclass(frozen=True)
class _FrictionlessSteps(StepsOnRings):
    """Solver of load steps of a contact without friction under a normal load.

    The contact of an increment does not depend on the previous increment.

    scene      the contact problem
    bodies     normal response of both bodies
    tolerance  upper bound of every residual [1]
    fineness   factor on the numbers of polynomials and quadrature points, 1 by default
    radii      radii of the output rings (n,) [length]
    largest    contacts at the largest prescribed force and approach, solved to place the rings
    """

    bodies: Bodies
    tolerance: float
    fineness: int
    radii: Array
    largest: tuple[NormalContact, ...]

    @classmethod
    def of(
        cls, scene: Scene, discretisation: RadialDiscretisation, fineness: int
    ) -> _FrictionlessSteps:
        """Create the solver of load steps of a contact without friction, for a scene.

        The output rings are placed over the largest contact of the load history.

        scene           contact problem
        discretisation  number of output rings, and tolerance of the residuals
        fineness        factor on the numbers of polynomials and quadrature points, 1 by default
        """
        bodies = Bodies.of(scene)
        largest = tuple(
            normal_contact(bodies, scene.indenter, prescribed, fineness)
            for prescribed in largest_targets(scene)
        )
        rings = output_radii(discretisation.rings, largest, scene.indenter.rim)
        return cls(scene, bodies, discretisation.tolerance, fineness, rings, largest)

    @property
    def _largest_radius(self) -> float:
        """Radius of the largest contact of the load history, over which the rings lie [length]."""
        return max(found.contact.radius for found in self.largest)

    def advance(
        self,
        ramp: LoadRamp,
        start: NormalContact | None,
        before: NormalContact | None,
        fraction: float,
    ) -> NormalContact:
        """Solve the contact without friction at a fraction of a load step.

        ramp      load step
        start     contact at the start of the load step; None without contact
        before    not used, because the contact does not depend on the previous increment
        fraction  fraction of the linear change of the load, 0 to 1
        """
        reached = (start.normal_force, start.approach) if start else (0.0, 0.0)
        prescribed = target(self.scene, *ramp.normal.prescribed(fraction, reached))
        for found in self.largest:
            if found.target == prescribed:
                return found
        return normal_contact(self.bodies, self.scene.indenter, prescribed, self.fineness)

    def report(
        self, reached: ConvergedIncrement[NormalContact], last: Increment | None
    ) -> Increment:
        """Compute the output of a frictionless increment: pressure, gap, energies and residuals.

        Pressure and gap are given at the output rings. Raises UnsupportedScene if the contact area
        is not a disc, and NotConverged if a residual exceeds the tolerance.

        reached  solved contact at the end of the increment
        last     output of the previous increment, for the work of the loads
        """
        state = reached.state
        contact, x = state.contact, self.radii / state.contact.radius
        refuse_round_off(contact, self.tolerance)
        p = pressure(contact, x)
        gap = np.zeros_like(x)
        apart = x > 1
        undeformed = self.scene.indenter.initial_gap(self.radii[apart], 0.0)
        gap[apart] = undeformed + displacement(contact, x[apart]) - contact.approach
        refuse_no_disc(self.radii, p, gap / contact.approach)
        force = state.target.force
        residuals = Residuals(
            complementarity=contact.residual,
            penetration=max(contact.residual, -float(np.min(gap)) / contact.approach),
            normal_equilibrium=None if force is None else abs(contact.load / force - 1),
        )
        residuals.require(self.tolerance, "the contact radius", state.iterations)
        increment = Increment(
            step=reached.place.step,
            index=reached.place.index,
            increments_in_step=reached.place.increments_in_step,
            residuals=residuals,
            iterations=state.iterations,
            halvings=reached.halvings,
            normal_force=state.normal_force,
            approach=state.approach,
            contact_radius=contact.radius,
            peak_pressure=largest_pressure(contact, self.radii / self._largest_radius),
            elastic_energy=contact.elastic_energy,
            radii=self.radii,
            pressure=p,
            gap=gap,
        )
        increment = add_work(last, add_contact_displacements(increment, self.scene.rig))
        return self.add_stiffness(increment, reached)

    def contact_stiffness(self, reached: ConvergedIncrement[NormalContact]) -> dict[str, float]:
        """Compute the normal contact stiffness at the end of an increment, by its name.

        reached  solved contact at the end of the increment
        """
        contact = reached.state.contact
        return {"normal_stiffness": normal_stiffness(contact, self.scene.indenter, self.fineness)}
