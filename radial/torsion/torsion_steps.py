"""Solver of load steps with normal load and torsion in closed form.

The normal load is constant from the first torsion on.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from contact_scene import ControlKind, LoadRamp
from contact_scene.array_types import Array
from contact_scene.checks.axisymmetric import ELSEWHERE
from contact_scene.quantities.ring_increment import add_work
from contact_scene.quantities.summary import ContactStatus
from contact_scene.solver_errors import UnsupportedScene
from contact_scene.stepping.load_path import load_changes
from contact_scene.stepping.load_stepping import (
    ConvergedIncrement,
    Solver,
)
from radial.fields import Increment
from radial.normal.disc import normal_stiffness
from radial.normal.pressing import NormalContact
from radial.output_points import StepsOnRings
from radial.torsion.torsion import Torsion
from radial.torsion.twist_path import TwistPath

# Shear above the friction limit by less than this multiple of the largest limit is round-off.
NO_ANNULUS = 1e-9


@dataclass(frozen=True)
class TorsionState:
    """State of a contact under normal load and torsion at the end of an increment.

    normal_contact  frictionless contact under the normal load
    path            twist, torque and energies of torsion, with the history of load reversals
    prescribed      kind of control (force or displacement), and the prescribed torque
                    [force length] or twist [radian]
    """

    normal_contact: NormalContact
    path: TwistPath
    prescribed: tuple[ControlKind, float]

    @property
    def torque(self) -> float:
        """Torque on the indenter about the axis [force length].

        The value is the prescribed torque, or the computed torque under a prescribed twist.
        """
        kind, value = self.prescribed
        return value if kind is ControlKind.FORCE else self.path.torque

    @property
    def twist(self) -> float | None:
        """Twist of the indenter about the axis [radian].

        The value is the prescribed twist, or the computed twist under a prescribed torque. It is
        None at the friction limit under a prescribed torque.
        """
        kind, value = self.prescribed
        if self.path.slides:
            return None
        return self.path.twist if kind is ControlKind.FORCE else value


@dataclass(frozen=True)
class TorsionSteps(StepsOnRings):
    """Solver of load steps of a contact under normal load and torsion, with shear in closed form.

    pressing   solver of the frictionless normal problem, which does not depend on the twist
    friction   coefficient of friction µ
    fineness   factor on the numbers of polynomials and quadrature points, 1 by default
    tolerance  upper bound of every residual [1]
    """

    pressing: Solver[NormalContact, Increment]
    friction: float
    fineness: int
    tolerance: float

    def advance(
        self,
        ramp: LoadRamp,
        start: TorsionState | None,
        before: TorsionState | None,
        fraction: float,
    ) -> TorsionState:
        """Solve the contact under normal load and torsion at a fraction of a load step.

        If the normal load changes, the torsion starts from the virgin state.

        ramp      load step
        start     state at the start of the load step; None without contact
        before    state at the end of the previous increment; None without contact
        fraction  fraction of the linear change of the loads, 0 to 1
        raises    GrossSliding if the torque exceeds its friction limit
        """
        if before is not None and ramp.normal.start == ramp.normal.end:
            normal_contact, path = before.normal_contact, before.path
        else:
            start_contact = start.normal_contact if start else None
            normal_contact = self.pressing.advance(ramp, start_contact, None, fraction)
            contact = normal_contact.contact
            path = TwistPath(Torsion.of(self.scene, contact, self.friction, self.fineness))
        since = (start.torque, start.twist) if start else (0.0, 0.0)
        torque, twist = ramp.twisting.prescribed(fraction, since)
        if twist is None:
            assert torque is not None
            return TorsionState(
                normal_contact, path.continue_to_torque(torque), (ControlKind.FORCE, torque)
            )
        return TorsionState(
            normal_contact, path.continue_to_twist(twist), (ControlKind.DISPLACEMENT, twist)
        )

    def report(
        self, reached: ConvergedIncrement[TorsionState], last: Increment | None
    ) -> Increment:
        """Compute the output of an increment with torsion: fields, energies and residuals.

        The fields at the output rings are pressure, gap, circumferential shear and slip, and the
        stick zone. Raises UnsupportedScene if slip does not begin at the edge, and NotConverged if
        a residual exceeds the tolerance.

        reached  solved state at the end of the increment
        last     output of the previous increment, for the work of the loads
        """
        state, before = reached.state, reached.before
        normal_contact = ConvergedIncrement(
            reached.place,
            before.normal_contact if before else None,
            state.normal_contact,
            reached.halvings,
            reached.spent,
        )
        made = self.pressing.report(normal_contact, last)
        x = made.radii / state.normal_contact.contact.radius
        shear, slip = self._shear_and_slip(state.path, x, made.pressure)
        assert made.elastic_energy is not None
        stick, dissipated = state.path.stick, None
        if state.twist is None:
            stored = made.elastic_energy + state.path.branches[-1].quantity("elastic_energy")
            if last is not None and last.slip_circumferential is not None:
                slip = last.slip_circumferential
        else:
            dissipated = state.path.dissipated
            stored = made.elastic_energy + state.path.work - dissipated
        kind, prescribed = state.prescribed
        largest = self.friction * float(np.max(made.pressure)) or 1.0
        excess = float(np.max(np.abs(shear) - self.friction * made.pressure)) / largest
        if excess > NO_ANNULUS:
            at = made.radii[int(np.argmax(np.abs(shear) - self.friction * made.pressure))]
            raise UnsupportedScene(
                f"the twisted contact slips first within, {at:.4g} m from the axis, and this "
                f"solver requires slip that begins at the edge; {ELSEWHERE}"
            )
        residuals = replace(
            made.residuals,
            friction_cone=max(excess, 0.0),
            torque_equilibrium=abs(state.path.torque - prescribed)
            / (state.path.of.gross_slip_torque or 1.0)
            if kind is ControlKind.FORCE
            else None,
        )
        residuals.require(self.tolerance, "torsion", state.normal_contact.iterations)
        increment = replace(
            made,
            residuals=residuals,
            status=_contact_status(stick),
            tangential_force=(0.0, 0.0),
            tangential_shift=None if state.twist is None else (0.0, 0.0),
            torque=state.torque,
            twist=state.twist,
            stick_radius=stick * state.normal_contact.contact.radius,
            dissipated_energy=dissipated,
            elastic_energy=stored,
            shear_circumferential=shear,
            slip_circumferential=slip,
            in_stick=x < stick,
        )
        return self.add_stiffness(add_work(last, increment), reached)

    def contact_stiffness(self, reached: ConvergedIncrement[TorsionState]) -> dict[str, float]:
        """Compute the contact stiffnesses at the end of an increment, by the names of the results.

        The derivative in a branch after a load reversal is that of its equivalent first twist.

        reached  solved state at the end of the increment
        """
        path = reached.state.path
        _, changes = load_changes(self.scene.load_path(), reached.place.step)
        sticks = not changes["torsional_stiffness"]
        state = path.branches[-1].state if path.branches else None
        state = path.of.incipient_slip if sticks or state is None else state
        contact = reached.state.normal_contact.contact
        return {
            "normal_stiffness": normal_stiffness(contact, self.scene.indenter, self.fineness),
            "torsional_stiffness": 0.0 if path.slides and not sticks else state.stiffness,
        }

    def _shear_and_slip(self, path: TwistPath, x: Array, pressure: Array) -> tuple[Array, Array]:
        """Compute circumferential shear [force/length²] and slip [length] at the output rings (n,).

        Shear and slip are sums over the branches of the twist between load reversals. Both are zero
        outside the contact.

        path      state of torsion, with its branches
        x         radii of the rings over the contact radius (n,)
        pressure  pressure at the rings (n,) [force/length²]
        """
        shear, slip = np.zeros_like(x), np.zeros_like(x)
        inside = x < 1
        for branch in path.branches:
            if branch.state is not None:
                share = branch.sense * branch.weight
                limit = self.friction * pressure[inside]
                shear[inside] += share * branch.state.shear(x[inside], limit)
                if not path.slides:
                    slip[inside] += share * branch.state.slip(x[inside])
        return shear, slip


def _contact_status(stick: float) -> ContactStatus:
    """Return the contact status for a stick radius over the contact radius."""
    if stick >= 1:
        return ContactStatus.FULL_STICK
    return ContactStatus.PARTIAL_SLIP if stick else ContactStatus.GROSS_SLIDING
