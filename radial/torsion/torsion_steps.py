"""Load stepping of normal load and torsion. The normal load is constant during torsion."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from contact_scene import ControlKind, LoadRamp
from contact_scene.array_types import Array
from contact_scene.quantities.summary import ContactStatus
from contact_scene.solver_errors import UnsupportedScene
from contact_scene.stepping.load_stepping import (
    Reached,
    Solver,
)
from radial.fields import Increment
from radial.normal.pressing import NormalContact
from radial.output_points import StepsOnRings
from radial.plan import ELSEWHERE
from radial.torsion.torsion import Torsion
from radial.torsion.twist_path import TwistPath

# Largest excess of the friction limit by round-off, over the largest limit.
NO_ANNULUS = 1e-9


@dataclass(frozen=True)
class TorsionState:
    """Contact at the end of an increment.

    normal_contact  frictionless contact
    path            state of torsion
    prescribed      kind of control, with the prescribed torque [force length] or twist [radian]
    """

    normal_contact: NormalContact
    path: TwistPath
    prescribed: tuple[ControlKind, float]

    @property
    def torque(self) -> float:
        """Prescribed or computed torque [force length]."""
        kind, value = self.prescribed
        return value if kind is ControlKind.FORCE else self.path.torque

    @property
    def twist(self) -> float:
        """Prescribed or computed twist [radian]."""
        kind, value = self.prescribed
        return self.path.twist if kind is ControlKind.FORCE else value


@dataclass(frozen=True)
class TorsionSteps(StepsOnRings):
    """Solver of the increments of normal load and torsion.

    pressing   solver of the normal problem, which does not depend on the twist
    friction   µ
    fineness   multiple of the numbers of orders and points
    tolerance  of every residual
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
        """Return the contact at a fraction of the ramp; raise GrossSliding."""
        start_contact = start.normal_contact if start else None
        constant = before is not None and ramp.normal.start == ramp.normal.end
        if constant and before is not None:
            normal_contact = before.normal_contact
        else:
            normal_contact = self.pressing.advance(ramp, start_contact, None, fraction)
        since = (start.torque, start.twist) if start else (0.0, 0.0)
        torque, twist = ramp.twisting.prescribed(fraction, since)
        if constant and before is not None:
            path = before.path
        else:
            torsion = Torsion.of(self.scene, normal_contact.contact, self.friction, self.fineness)
            path = TwistPath(torsion)
        if twist is None:
            assert torque is not None
            return TorsionState(normal_contact, path.to_torque(torque), (ControlKind.FORCE, torque))
        return TorsionState(normal_contact, path.to_twist(twist), (ControlKind.DISPLACEMENT, twist))

    def report(self, reached: Reached[TorsionState], last: Increment | None) -> Increment:
        """Return the increment with its fields at the rings.

        Raises UnsupportedScene if slip does not begin at the edge, NotConverged above the
        tolerance.
        """
        state, before = reached.state, reached.before
        normal_contact = Reached(
            reached.place,
            before.normal_contact if before else None,
            state.normal_contact,
            reached.halvings,
            reached.spent,
        )
        made = self.pressing.report(normal_contact, last)
        x = made.radii / state.normal_contact.contact.radius
        shear, slip = self._fields(state.path, x, made.pressure)
        torque, twist = (last.torque or 0.0, last.twist or 0.0) if last else (0.0, 0.0)
        assert made.trapezoidal_work is not None
        assert made.elastic_energy is not None
        work = made.trapezoidal_work + 0.5 * (torque + state.torque) * (state.twist - twist)
        stored = made.elastic_energy + state.path.work - state.path.dissipated
        dissipated = state.path.dissipated
        stick = state.path.stick
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
            torque_equilibrium=abs(state.path.torque - prescribed) / (state.path.of.largest or 1.0)
            if kind is ControlKind.FORCE
            else None,
        )
        residuals.require(self.tolerance, "torsion", state.normal_contact.iterations)
        return replace(
            made,
            residuals=residuals,
            status=_status(stick),
            torque=state.torque,
            twist=state.twist,
            stick_radius=stick * state.normal_contact.contact.radius,
            dissipated_energy=dissipated,
            elastic_energy=stored,
            input_work=stored + dissipated,
            unresolved_work=work - stored - dissipated,
            shear_circumferential=shear,
            slip_circumferential=slip,
            in_stick=x < stick,
        )

    def _fields(self, path: TwistPath, x: Array, pressure: Array) -> tuple[Array, Array]:
        """Return q_θ [force/length²] and slip [length] at r = a x."""
        shear, slip = np.zeros_like(x), np.zeros_like(x)
        inside = x < 1
        for branch in path.branches:
            if branch.state is not None:
                share = branch.sense * branch.weight
                limit = self.friction * pressure[inside]
                shear[inside] += share * branch.state.shear(x[inside], limit)
                slip[inside] += share * branch.state.slip(x[inside])
        return shear, slip


def _status(stick: float) -> ContactStatus:
    if stick >= 1:
        return ContactStatus.FULL_STICK
    return ContactStatus.PARTIAL_SLIP if stick else ContactStatus.GROSS_SLIDING
