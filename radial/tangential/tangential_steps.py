"""Solver of load steps under normal load, tangential load and torsion, at points of rings.

The points lie at several angles on each ring. Every increment is solved by `solve_increment` of
`ring_friction`, a semismooth Newton method.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from contact_scene import CoulombFriction, LoadRamp, RadialDiscretisation, Scene
from contact_scene.array_types import Array
from contact_scene.body_pair import coupling
from contact_scene.checks.axisymmetric import ELSEWHERE, friction_at_radii
from contact_scene.quantities.ring_increment import add_work
from contact_scene.quantities.summary import ContactStatus
from contact_scene.rig import add_contact_displacements, compliances
from contact_scene.solver_errors import UnsupportedScene
from contact_scene.stepping.load_path import load_changes
from contact_scene.stepping.load_stepping import ConvergedIncrement
from radial.angular_grid import RingAngles
from radial.fields import Increment
from radial.frictional.coupling import Coupling
from radial.normal.pressing import (
    NormalContact,
    Target,
    normal_contact,
)
from radial.normal.surface import pressure
from radial.output_points import (
    StepsOnRings,
    largest_targets,
    target,
    targets,
)
from radial.plan import Plan
from radial.response.bodies import Bodies
from radial.tangential.free_motion import growth_without_slip
from radial.tangential.ring_friction import solve_increment
from radial.tangential.ring_layout import create_points
from radial.tangential.ring_points import ContactPoints
from radial.tangential.ring_problem import RingProblem
from radial.tangential.ring_state import (
    NORMAL,
    TORSION,
    Loads,
    PointState,
)
from radial.tangential.tangential_increment import (
    TangentialState,
    residuals_of,
    tangential_state,
)

Pair = tuple[float, float]

# The contact radii at the ends of the load steps are found with this number of increments per load
# step, and with this number of layouts of rings.
SETTLING = 8
SETTLED = 2
NARROW = 2.0  # contacts with fewer rings get dense rings at their edge
# Number of projections of the output shear onto its friction limit. They change the force by 2e-6
# of the friction limit.
PROJECTIONS = 30
EXACT = 0.1  # bound of the residual of Newton's method over the tolerance
NOTHING = (0.0, 0.0, 0.0, 0.0)


@dataclass(frozen=True)
class TangentialSteps(StepsOnRings):
    """Solver of load steps of a contact with tangential load or torsion, at points on rings.

    friction   friction law
    direction  unit vector of the angle θ = 0 in the axes of the scene: the first tangential load
    twists     true if torque and twist are output
    tolerance  upper bound of every residual [1]
    points     points (rings × angles) for the largest contact of the load history
    """

    friction: CoulombFriction
    direction: Pair
    twists: bool
    tolerance: float
    points: ContactPoints

    @classmethod
    def of(
        cls,
        scene: Scene,
        discretisation: RadialDiscretisation,
        plan: Plan,
    ) -> TangentialSteps:
        """Create the solver of load steps with tangential load or torsion for a scene.

        The contact radii at the ends of the load steps are solved first, because the rings of
        points are dense at these radii.

        scene           contact problem
        discretisation  settings, of which only the tolerance of the residuals is used
        plan            effects of the scene, and numbers of rings and angles
        """
        assert scene.friction is not None
        assert plan.circle is not None
        friction, circle = scene.friction, plan.circle
        count = plan.rings
        both = Coupling.of(scene)

        def frictionless_radius(prescribed: Target) -> float:
            """Return the contact radius without friction under a prescribed normal load [length].

            Used to place the rings of the contact with friction.

            prescribed  normal force or approach
            """
            return normal_contact(both.bodies, scene.indenter, prescribed).contact.radius

        largest = max(map(frictionless_radius, largest_targets(scene)))
        # Contacts within the first ring would not be resolved.
        ends = {frictionless_radius(prescribed) for prescribed in set(targets(scene))}
        edges = [largest, *(edge for edge in sorted(ends) if edge * count < NARROW * largest)]

        def create_solver(circle: RingAngles) -> TangentialSteps:
            """Create the solver of load steps, with rings that are dense at given contact edges.

            The edges are those found so far. Called first for axisymmetric contacts, to find the
            edges, and then for the load history.

            circle  angles of the points on a ring: one angle, half a circle or the full circle
            """
            harmonics = 0 if circle is RingAngles.ONE else plan.highest
            points = create_points(
                both, scene.indenter, edges, count, harmonics, circle, friction.largest, scene.rig
            )
            return cls(
                scene, friction, plan.direction, plan.twists, discretisation.tolerance, points
            )

        for _ in range(SETTLED):
            edges = create_solver(RingAngles.ONE)._contact_radii()
        return create_solver(circle)

    def _contact_radii(self) -> list[float]:
        """Solve the contact radii at the ends of the load steps, without tangential load [length].

        Rings are made dense at these radii. Friction under the normal load is included. Load steps
        that end without contact, or with unchanged normal load, are skipped.
        """
        state: TangentialState | None = None
        found = []
        for ramp in self.scene.load_path():
            start = state
            if ramp.normal.end == 0:
                state = None
                continue
            if start and ramp.normal.start == ramp.normal.end:
                continue
            for index in range(1, SETTLING + 1):
                force, approach = self._normal_load(ramp, start, index / SETTLING)
                still = None, None, None
                state = self._solve_loads(Loads((*still, force), (0.0, 0.0, 0.0, approach)), state)
            assert state is not None
            found.append(state.radius)
        return found

    @staticmethod
    def _normal_load(
        ramp: LoadRamp, start: TangentialState | None, fraction: float
    ) -> tuple[float | None, float | None]:
        """Return the prescribed normal force and approach, one of which is None."""
        reached = (start.forces[NORMAL], start.motions[NORMAL]) if start else (0.0, 0.0)
        return ramp.normal.prescribed(fraction, reached)

    def advance(
        self,
        ramp: LoadRamp,
        start: TangentialState | None,
        before: TangentialState | None,
        fraction: float,
    ) -> TangentialState:
        """Solve the contact with friction at points on rings at a fraction of a load step.

        ramp      load step
        start     state at the start of the load step; None without contact
        before    state at the end of the previous increment; None without contact
        fraction  fraction of the linear change of the loads, 0 to 1
        raises    NotConverged, GrossSliding and ContactAtZoneEdge
        """
        start_loads = (start.forces, start.motions) if start else (NOTHING, NOTHING)
        shift = self._scene_components(start_loads[1])
        undefined = start is not None and start.end.slides
        since = self._scene_components(start_loads[0]), None if undefined else shift
        tangential = [
            self._load_components(vector) for vector in ramp.tangential.prescribed(fraction, since)
        ]
        about = ramp.twisting.prescribed(
            fraction, (start_loads[0][TORSION], start_loads[1][TORSION])
        )
        down = self._normal_load(ramp, start, fraction)
        forces, motions = (
            (*pair, turn, press) for pair, turn, press in zip(tangential, about, down, strict=True)
        )
        loads = Loads(forces, motions)
        return self._solve_loads(loads, before)

    def _scene_components(self, parts: tuple[float, ...]) -> Pair:
        """Rotate components along and across the load,
        the first two of `parts`, to the axes x and y."""
        (x, y), (along, across, *_) = self.direction, parts
        return along * x - across * y, along * y + across * x

    def _load_components(self, vector: Pair | None) -> tuple[float | None, float | None]:
        """Rotate x and y components to those along and across the load; None without a vector."""
        if vector is None:
            return None, None
        (x, y), (of_x, of_y) = self.direction, vector
        return of_x * x + of_y * y, of_y * x - of_x * y

    def _solve_loads(self, loads: Loads, before: TangentialState | None) -> TangentialState:
        """Solve contact and friction under prescribed loads, starting from a previous state.

        Loads without tangential component are solved with one angle per ring, as long as no
        preceding load had a tangential component. If the loads are those of the previous increment,
        its state is returned.

        loads   prescribed loads and rigid motions of the indenter
        before  state at the end of the previous increment; None without contact
        """
        if before is not None and before.prescribed == loads:
            return before
        tangential = (*loads.forces[:TORSION], *loads.motions[:TORSION])
        angular = any(tangential) or (before is not None and before.circle is not RingAngles.ONE)
        points = self.points if angular else self.points.axisymmetric
        self._refuse_within_first(points, loads.motions[NORMAL])
        last = before.end if before else None
        slip = before.slip if before else np.zeros((2, len(points.areas)))
        if last is not None and before is not None and before.circle is not points.circle:
            last, slip = last.repeat_angles(points), points.repeat_angles(slip)
        guess = None if last else self._frictionless_guess(points, loads)
        friction = self._friction_at(points)
        end = self._solve_at_points(points, loads, last, guess)
        if not coupling(self.scene)[0]:
            springs = compliances(self.scene.rig)
            growth = growth_without_slip(points, friction, loads, last, end, springs)
            if growth is not None:
                free, guess = growth
                end = self._solve_at_points(points, loads, last, guess, free)
        resolved = points.is_resolved(end.pressure)
        smooth = None if resolved else self._solve_frictionless(loads).contact.radius
        return tangential_state(points, friction, end, last, slip, loads, before, smooth)

    def _solve_at_points(
        self,
        points: ContactPoints,
        loads: Loads,
        last: PointState | None,
        guess: Array | None,
        free: Array | None = None,
    ) -> PointState:
        """Solve from `last`, with tractions and rigid motion (3 N + 4,) as the guess,
        or those of `last`, and the free motion of points until contact, times areas (2 N,)."""
        held, tolerance = _fix_excluded_motions(points, loads), EXACT * self.tolerance
        friction = self._friction_at(points)
        return solve_increment(points, friction, held, last, tolerance, guess, free)

    def _friction_at(self, points: ContactPoints) -> CoulombFriction:
        """Return the friction law with the coefficients of all points on the rings."""
        return friction_at_radii(self.friction, np.repeat(points.radii, points.count))

    def _solve_frictionless(self, loads: Loads) -> NormalContact:
        prescribed = target(self.scene, loads.forces[NORMAL], loads.motions[NORMAL])
        return normal_contact(Bodies.of(self.scene), self.scene.indenter, prescribed)

    def _frictionless_guess(self, points: ContactPoints, loads: Loads) -> Array:
        """Return q_r, q_θ, p, two shifts, twist and approach of the frictionless contact
        (3 N + 4,). Newton's method needs far fewer steps from them than from a uniform pressure."""
        found = self._solve_frictionless(loads)
        p = pressure(found.contact, points.radii / found.contact.radius)
        p[~np.isfinite(p)] = p[1]
        tangential = np.zeros(2 * len(points.areas))
        return np.concatenate(
            [tangential, np.repeat(p, points.count), [0.0, 0.0, 0.0, found.approach]]
        )

    def _refuse_within_first(self, points: ContactPoints, approach: float | None) -> None:
        """Raise UnsupportedScene unless an approach exceeds
        the mean gap over the hat of at least one ring."""
        depth = float(np.min(points.gap_areas / points.areas))
        if approach is not None and approach <= depth:
            raise UnsupportedScene(
                f"an approach of {approach:.3g} m is too small for the rings, which are laid out "
                f"for the largest contact and require more than {depth:.3g} m. Use fewer "
                "increments, or prescribe the normal force"
            )

    def report(
        self, reached: ConvergedIncrement[TangentialState], last: Increment | None
    ) -> Increment:
        """Compute the output of an increment: fields at rings and angles, energies and residuals.

        Raises NotConverged if a residual exceeds the tolerance, and UnsupportedScene if the rings
        do not resolve the slip annulus.

        reached  solved state at the end of the increment
        last     output of the previous increment, whose work is continued
        """
        state, end = reached.state, reached.state.end
        angular = state.circle is not RingAngles.ONE
        points = self.points if angular else self.points.axisymmetric
        if reached.place.index == reached.place.increments_in_step:
            self._refuse_narrow(state, reached.place.step)
        residuals = residuals_of(points, self._friction_at(points), state)
        residuals.require(self.tolerance, "contact and friction on rings", end.steps)
        p = self._interpolate_scalar(points, end.pressure)
        q_r, q_t = self._interpolate_vector(points, end.shear)
        s_r, s_t = self._interpolate_vector(points, state.slip)
        gap = np.where(end.pressure > 0, 0.0, end.gap)
        force = self._scene_components(state.forces)
        down, along = compliances(self.scene.rig)
        in_springs = down * state.forces[NORMAL] ** 2 + along * float(np.dot(force, force))
        free = end.slides and state.prescribed.forces[TORSION] is not None
        twist = None if free else state.motions[TORSION]
        lost = state.dissipated
        share = np.where(np.isfinite(end.share), end.share, 2.0)
        p, gap = np.maximum(p, 0.0), np.maximum(self._interpolate_scalar(points, gap), 0.0)
        if angular:
            limit = self.friction.at_radii(points.radii[:, None]).limit(p)
            q_r, q_t = self._limit_shear(points, np.stack([q_r, q_t]), limit)
        increment = Increment(
            step=reached.place.step,
            index=reached.place.index,
            increments_in_step=reached.place.increments_in_step,
            residuals=residuals,
            iterations=end.steps,
            halvings=reached.halvings,
            normal_force=state.forces[NORMAL],
            approach=state.motions[NORMAL],
            contact_radius=state.radius,
            peak_pressure=float(np.max(p)),
            status=state.status,
            stick_radius=state.stick_radius,
            tangential_force=self._scene_components(state.forces),
            tangential_shift=None if end.slides else self._scene_components(state.motions),
            torque=state.forces[TORSION] if self.twists else None,
            twist=twist if self.twists else None,
            dissipated_energy=lost,
            dissipation_uncertainty=None if lost is None else state.uncertainty,
            elastic_energy=end.energy - 0.5 * in_springs,
            radii=points.radii,
            angles=points.output_angles if angular else None,
            pressure=p,
            gap=np.where(p > 0, 0.0, gap),
            shear_radial=q_r,
            shear_circumferential=q_t if angular or self.twists else None,
            slip_radial=s_r,
            slip_circumferential=s_t if angular or self.twists else None,
            in_stick=(self._interpolate_scalar(points, share) < 1) & (p > 0),
        )
        increment = add_work(last, add_contact_displacements(increment, self.scene.rig))
        return self.add_stiffness(increment, reached)

    def contact_stiffness(self, reached: ConvergedIncrement[TangentialState]) -> dict[str, float]:
        """Compute the contact stiffnesses at the end of an increment, by the names of the results.

        reached  solved state at the end of the increment
        """
        from radial.tangential.stiffness import contact_stiffness

        points, state, before = self.points, reached.state, reached.before
        friction = self._friction_at(points)
        end, last = state.end, before.end if before else None
        if state.circle is not points.circle:
            end = end.repeat_angles(points)
        if last is not None and before is not None and before.circle is not points.circle:
            last = last.repeat_angles(points)
        loads, free = _fix_excluded_motions(points, state.prescribed), None
        if not coupling(self.scene)[0]:
            springs = compliances(self.scene.rig)
            growth = growth_without_slip(points, friction, loads, last, end, springs)
            free = growth[0] if growth else None
        direction, changes = load_changes(self.scene.load_path(), reached.place.step)
        (x, y), (a, b) = self.direction, direction
        turned = x * a + y * b, x * b - y * a
        problem = RingProblem.of(points, friction, loads, last, free)
        found = contact_stiffness(problem, end, turned, changes, compliances(self.scene.rig))
        if not self.twists:
            found.pop("torsional_stiffness", None)
        return found

    def _refuse_narrow(self, state: TangentialState, step: int) -> None:
        """Raise UnsupportedScene if the slip annulus of coupled bodies is narrower
        than a ring after step 1; tractions at its border would be inaccurate."""
        sticks = state.status is ContactStatus.FULL_STICK
        if sticks and step == 1 and state.circle is RingAngles.ONE and coupling(self.scene)[0]:
            raise UnsupportedScene(
                f"with a coefficient of friction of {self.friction.largest:g} the slip annulus at "
                "the contact edge is narrower than a ring and cannot be resolved. Use a smaller "
                f"coefficient, or {ELSEWHERE}"
            )

    @staticmethod
    def _limit_shear(points: ContactPoints, shear: Array, limit: Array) -> Array:
        """Reduce interpolated shear to the friction limit, at equal force and torque of each ring.

        Interpolation from the points to the output angles exceeds the limit near the border of the
        stick zone. Alternating projections remove the excess.

        points  points of the contact (rings × angles), with the output angles
        shear   interpolated q_r and q_θ at n rings and the output angles (2, n, angles)
                [force/length²]
        limit   friction limit µp (n, angles) [force/length²]
        """
        angles = points.output_angles
        cos, sin, one = np.cos(angles), np.sin(angles), np.ones_like(angles)
        resultants = np.stack([[cos, -sin], [sin, cos], [0 * one, one]])
        shares = one / (2 * points.highest)
        if points.circle is RingAngles.HALF:
            resultants, shares = (
                resultants[:1],
                np.append(1.0, np.append(2 * one[2:], 1.0)) * shares,
            )
        within = shear
        for _ in range(PROJECTIONS):
            missing = np.einsum("kcj,cnj,j->kn", resultants, shear - within, shares)
            moved = within + np.einsum("kcj,kn->cnj", resultants, missing)
            size = np.hypot(*moved)
            within = moved * (limit / np.maximum(np.maximum(size, limit), np.finfo(float).tiny))
        return within

    @staticmethod
    def _interpolate_scalar(points: ContactPoints, field: Array) -> Array:
        """Interpolate a field (n count,) to the output angles (n, angles);
        unchanged (n,) with one angle."""
        if points.count == 1:
            return field
        shown = points.interpolate_angles(field, 1.0)
        shown[0] = np.mean(field[: points.count])
        return shown

    @staticmethod
    def _interpolate_vector(points: ContactPoints, vector: Array) -> tuple[Array, Array]:
        """Interpolate a vector field from the points to the output angles of each ring.

        The results are the components r and θ, each (n, angles). At the axis all angles have the
        same vector. With one angle per ring the vector is zero at the axis, and each result has the
        shape (n,).

        points  points of the contact: n rings with `count` angles each
        vector  components r and θ at the points (2, n count)
        """
        if points.count == 1:
            # The axis has no direction.
            outward, around = vector * (points.radii > 0)
            return outward, around
        outward, around = (
            points.interpolate_angles(vector[0], 1.0),
            points.interpolate_angles(vector[1], -1.0),
        )
        q_r, q_t = vector[:, : points.count]
        cos, sin = np.cos(points.angles), np.sin(points.angles)
        along = np.mean(q_r * cos - q_t * sin)
        # On a half circle the component across is zero by symmetry.
        across = np.mean(q_r * sin + q_t * cos) if points.circle is RingAngles.WHOLE else 0.0
        cos, sin = np.cos(points.output_angles), np.sin(points.output_angles)
        outward[0], around[0] = along * cos + across * sin, across * cos - along * sin
        return outward, around


def _fix_excluded_motions(points: ContactPoints, loads: Loads) -> Loads:
    """Prescribe zero for motions that symmetry excludes:
    shifts with one angle per ring, and the twist and the shift across θ = 0 on half a circle."""
    has = [*np.any(points.rigid_motions, axis=1), True]
    forces, motions = (
        tuple(value if moves else rest for moves, value in zip(has, prescribed, strict=True))
        for prescribed, rest in ((loads.forces, None), (loads.motions, 0.0))
    )
    return Loads(forces, motions)
