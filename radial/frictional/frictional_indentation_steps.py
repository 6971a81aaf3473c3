"""Load stepping of a contact with friction under normal load. Each increment needs the previous
one."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import ceil, exp, log

import numpy as np
from scipy.interpolate import CubicSpline

from contact_scene import CoulombFriction, LoadRamp, RadialDiscretisation, Scene
from contact_scene.array_types import Array
from contact_scene.bulk_strain import UNSTRAINED
from contact_scene.quantities.residuals import Residuals
from contact_scene.quantities.summary import ContactStatus
from contact_scene.rig import of_contact
from contact_scene.stepping.load_stepping import Reached
from radial.fields import Increment
from radial.frictional.coupling import Coupling
from radial.frictional.frictional_increment import (
    FrictionalState,
    finite_pressure,
    frictional_state,
    stick_share,
)
from radial.frictional.rings import (
    Rings,
    place_of,
    rings_about,
)
from radial.frictional.stick_slip import (
    FrictionalContact,
    Signs,
    frictional_contact,
)
from radial.normal.pressing import (
    ROUND_OFF,
    NormalContact,
    Target,
    contact_at_target,
    normal_contact,
)
from radial.normal.surface import (
    displacement,
    pressure,
)
from radial.output_points import (
    StepsOnRings,
    largest_targets,
    output_radii,
    refuse_no_disc,
    refuse_round_off,
)
from radial.output_points import target as target_of

COUNT = 64  # rings, apart from those at the front and at the ends
# Largest ratio of the contact radii of two solves, and first radius over that of the first
# increment.
GROWTH, FIRST = 1.1, 0.03
MAX_LAID = 3  # layouts of rings for a front that moves
REST = 1e-11  # slip over the approach that is round-off
MIDDLE = 0.5  # first guess of the front over the contact radius


@dataclass(frozen=True)
class FrictionalSteps(StepsOnRings):
    """Solver of the increments of normal loading with friction.

    largest  contacts without friction, solved to place the output rings
    """

    coupling: Coupling
    friction: CoulombFriction
    tolerance: float
    fineness: float
    radii: Array
    largest: tuple[NormalContact, ...]

    @classmethod
    def of(
        cls, scene: Scene, discretisation: RadialDiscretisation, fineness: float
    ) -> FrictionalSteps:
        """Return the solver of a scene.

        fineness  multiple of the number of rings, and of the solves within an increment
        """
        coupling = Coupling.of(scene)
        largest = tuple(
            normal_contact(coupling.bodies, scene.indenter, target)
            for target in largest_targets(scene)
        )
        radii = output_radii(discretisation.rings, largest, scene.indenter.rim)
        assert scene.friction is not None
        return cls(
            scene, coupling, scene.friction, discretisation.tolerance, fineness, radii, largest
        )

    def advance(
        self,
        ramp: LoadRamp,
        start: FrictionalState | None,
        before: FrictionalState | None,
        fraction: float,
    ) -> FrictionalState:
        """Return the contact at a fraction of the ramp; raise NotConverged."""
        reached = (start.normal_force, start.approach) if start else (0.0, 0.0)
        target = target_of(self.scene, *ramp.normal.prescribed(fraction, reached))
        radius, iterations = self._first_radius(target, before)
        start_radius = before.end.radius if before else FIRST * radius
        last, strain = before.strain if before else 0.0, (ramp.strain(fraction) or UNSTRAINED)[0]
        for passed in _intermediate_radii(start_radius, radius, GROWTH ** (1 / self.fineness)):
            part = (passed - start_radius) / (radius - start_radius)
            before = self._intermediate(passed, before, last + part * (strain - last))
            iterations += 1
        share = before.mid_stick_radius / before.end.radius if before else MIDDLE
        for _ in range(MAX_LAID):
            rings = rings_about(share, self._count)
            end, more, power = self._reach(target, radius, rings, before, strain)
            iterations, radius = iterations + more, end.radius
            previous, share = share, stick_share(end)
            if abs(place_of(share) - place_of(previous)) <= 1:
                break
        return frictional_state(
            self.friction, end, target, self.radii, before, power, iterations, strain
        )

    @property
    def _count(self) -> int:
        return round(COUNT * self.fineness)

    def _intermediate(
        self, radius: float, before: FrictionalState | None, strain: float
    ) -> FrictionalState:
        """Solve an intermediate contact of an increment, at this radius."""
        share = before.mid_stick_radius / before.end.radius if before else MIDDLE
        like = before.end if before else None
        end = self._at(
            radius, rings_about(share, self._count), _reference_displacement(before, strain), like
        )
        target = Target(None, None)
        power = self._power(target, before)
        return frictional_state(self.friction, end, target, self.radii, before, power, 0, strain)

    def _at(
        self,
        radius: float,
        rings: Rings,
        radial_displacement: Callable[[Array], Array],
        like: FrictionalContact | None,
    ) -> FrictionalContact:
        """Solve the contact of this radius.

        radial_displacement  u_r of the preceding state, as a function of the radius
        like                 contact with a similar slip zone, as an initial guess
        """
        return frictional_contact(
            self.coupling, self.scene.indenter, radius, rings, self.friction,
            radial_displacement(radius * rings.places), _sliding(like, rings),
        )  # fmt: skip

    def _first_radius(self, target: Target, before: FrictionalState | None) -> tuple[float, int]:
        """Estimate the radius of the target, and return the number of radii tried.

        The estimate is extrapolated from the previous contact, or it is the radius without
        friction.
        """
        if before is None:
            found = normal_contact(self.coupling.bodies, self.scene.indenter, target)
            return found.contact.radius, found.iterations
        further = -target.residual(before.end) / self._power(target, before)
        return before.end.radius * exp(further), 0

    @staticmethod
    def _power(target: Target, before: FrictionalState | None) -> float:
        """Return the exponent of force or approach as a power of the radius."""
        if before is not None and (before.target.force is None) == (target.force is None):
            return before.power
        return 3.0 if target.approach is None else 2.0

    def _reach(
        self,
        target: Target,
        radius: float,
        rings: Rings,
        before: FrictionalState | None,
        strain: float,
    ) -> tuple[FrictionalContact, int, float]:
        """Find the contact at the target by the secant method for the radius.

        Return the contact, the number of radii tried, and the exponent of the power law in the
        radius.
        """
        radial_displacement = _reference_displacement(before, strain)
        like = before.end if before else None

        def solve(a: float) -> FrictionalContact:
            """Solve the contact of a radius, from the slip zone of the last one."""
            nonlocal like
            like = self._at(a, rings, radial_displacement, like)
            return like

        power = self._power(target, before)
        return contact_at_target(solve, target, radius, power, 10 * ROUND_OFF)

    def report(self, reached: Reached[FrictionalState], last: Increment | None) -> Increment:
        """Return the increment with its fields at the rings.

        Raises UnsupportedScene if the contact area is no disc, NotConverged above the tolerance.
        """
        state = reached.state
        end, indenter, r = state.end, self.scene.indenter, self.radii
        refuse_round_off(end.contact, self.tolerance)
        places = end.radius * end.rings.places
        n = end.rings.count
        bare = indenter.initial_gap(places, 0.0)
        clear = bare[n + 1 :] + displacement(end.contact, end.rings.places[n + 1 :])
        clear += end.normal_displacement[n + 1 :] - end.approach
        refuse_no_disc(places[1 : n + 1], end.pressure[1:], np.zeros(n))
        refuse_no_disc(places[n + 1 :], np.ones_like(clear), clear / end.approach)
        force = state.target.force
        limit, q = self.friction.limit(end.pressure[1:]), np.abs(end.shear[1:])
        residuals = Residuals(
            complementarity=max(end.contact.residual, end.residual),
            penetration=max(end.contact.residual, end.residual),
            normal_equilibrium=None if force is None else abs(end.load / force - 1),
            friction_cone=max(0.0, float(np.max(q - limit) / np.max(limit))),
            slip_direction=_against(end, self.friction),
        )
        residuals.require(self.tolerance, "the contact radius", state.iterations)
        x = r / end.radius
        p = pressure(end.contact, x) + end.rings.at(end.pressure_change, x)
        gap = np.zeros_like(r)
        apart = x > 1
        normal_displacement = _beyond(
            places, end.normal_displacement - end.approach_change, -end.approach_change
        )
        gap[apart] = indenter.initial_gap(r[apart], 0.0) - end.contact.approach
        gap[apart] += displacement(end.contact, x[apart]) + normal_displacement(r[apart])
        sticks = np.asarray(state.at(np.abs(end.sliding), r) == 0) & (x < 1)
        stored = end.elastic_energy(bare[: n + 1])
        increment = Increment(
            step=reached.place.step,
            index=reached.place.index,
            increments_in_step=reached.place.increments_in_step,
            residuals=residuals,
            iterations=state.iterations,
            halvings=reached.halvings,
            normal_force=state.normal_force,
            approach=state.approach,
            contact_radius=end.radius,
            peak_pressure=float(np.max(p)),
            status=_status(state),
            stick_radius=state.front,
            tangential_force=(0.0, 0.0),
            tangential_shift=(0.0, 0.0),
            dissipated_energy=state.dissipated,
            dissipation_uncertainty=state.uncertainty,
            elastic_energy=stored,
            input_work=stored + state.dissipated,
            unresolved_work=state.work - stored - state.dissipated,
            radii=r,
            pressure=p,
            gap=np.maximum(gap, 0.0),
            shear_radial=self._shear(state, p, r),
            slip_radial=state.slip,
            in_stick=sticks,
        )
        return of_contact(increment, self.scene.rig)

    def _shear(self, state: FrictionalState, p: Array, r: Array) -> Array:
        """Return the shear at the rings. In the slip zone it is the limit of the pressure there.

        Interpolation of the shear itself would be less accurate.
        """
        end = state.end
        share = end.shear[1:-1] / self.friction.limit(end.pressure[1:-1])
        share = np.concatenate([[0.0], share, share[-1:]])
        return np.asarray(self.friction.limit(p) * state.at(share, r))


def _reference_displacement(
    before: FrictionalState | None, strain: float
) -> Callable[[Array], Array]:
    """Return u_r without slip, as a function of the radius: that of the state before, minus the
    strain."""
    if before is None:
        return lambda radii: -strain * radii
    end, more = before.end, strain - before.strain
    known = _beyond(end.radius * end.rings.places, end.radial_displacement, 0.0)
    return lambda radii: known(radii) - more * radii


def _beyond(r: Array, field: Array, limit: float) -> Callable[[Array], Array]:
    """Return a function of the radius for a field of the rows. It decays to `limit` as 1/r."""
    spline, last = CubicSpline(r, field), r[-1]

    def at(radii: Array) -> Array:
        near = spline(np.minimum(radii, last))
        return np.asarray(limit + (near - limit) * last / np.maximum(radii, last))

    return at


def _intermediate_radii(start_radius: float, end: float, growth: float) -> Array:
    """Return radii between the start and the end of an increment. The stick zone depends on them.

    growth  largest ratio of adjacent radii
    """
    steps = max(ceil(abs(log(end / start_radius)) / log(growth)), 1)
    return np.geomspace(start_radius, end, steps + 1)[1:-1]


def _sliding(was: FrictionalContact | None, rings: Rings) -> Signs:
    """Return the signs of slip at the same fractions of the radius."""
    if was is None:
        return np.zeros(len(rings.x), dtype=np.int64)
    return np.rint(np.interp(rings.x, was.rings.x, was.sliding)).astype(np.int64)


def _against(end: FrictionalContact, friction: CoulombFriction) -> float:
    """Return ∫(b|Δs| + q Δs) dA / ∫b|Δs| dA, b the limit, for slip above round-off."""
    slip_increment = (
        end.slip_increment * (end.sliding != 0) * (np.abs(end.slip_increment) > REST * end.approach)
    )
    most = end.over(friction.limit(finite_pressure(end)) * np.abs(slip_increment))
    return abs(most + end.over(end.shear * slip_increment)) / most if most > 0 else 0.0


def _status(state: FrictionalState) -> ContactStatus:
    sticks = state.end.sliding[1:-1] == 0
    if np.all(sticks):
        return ContactStatus.FULL_STICK
    return ContactStatus.PARTIAL_SLIP if np.any(sticks) else ContactStatus.NO_STICK_AREA_LEFT
