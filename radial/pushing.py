"""Pressing with friction and pushing along one line as the march sees it."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import pi, sqrt

import numpy as np
from numpy.typing import NDArray

from contact_scene import LoadRamp, RadialDiscretisation, Scene
from contact_scene.friction import sliding_friction
from contact_scene.march import Reached
from contact_scene.pair import coupling
from contact_scene.residuals import Residuals
from contact_scene.solver_errors import NotConverged, UnsupportedScene
from contact_scene.summary import ContactStatus
from radial.coupling import Coupling
from radial.fields import Increment
from radial.plan import ANGLES, ELSEWHERE, RINGS
from radial.pressing import pressed
from radial.ring_friction import MOST_STEPS, Held, Loads, held
from radial.ring_layout import laid
from radial.ring_points import Points
from radial.shown import largest_targets

Array = NDArray[np.float64]
Pair = tuple[float, float]

SETTLING, SETTLED = 8, 2  # increments, and layouts, after which the radius of the contact is known
EXACT = 0.1  # of the tolerance: what Newton's method is to reach
REST = 1e-11  # of the approach: less slip is round-off


@dataclass(frozen=True)
class Pushed:
    """A contact at the end of an increment.

    held    tractions and motion
    turned  whether anything depends on the angle
    asked   loads as they were prescribed
    radius  of the circle of the contact area [length]
    begun   the same at the start of the increment [length]
    through  of the circle of what sticks through the increment [length]
    stuck   of the circle of the stick area at its end [length]
    slip    since particles touched (2, points) [length]
    force   W [force]
    drag    T along the line [force]
    worked  work of the loads since the start of the history [force length]
    lost    energy dissipated since the start of the history [force length]
    uncertain  by how much finite increments leave that uncertain [force length]
    """

    held: Held
    turned: bool
    asked: Loads
    radius: float
    begun: float
    through: float
    stuck: float
    slip: Array
    force: float
    drag: float
    worked: float
    lost: float
    uncertain: float

    @property
    def approach(self) -> float:
        """As it was asked for, or what came out [length]."""
        return self.held.approach if self.asked.approach is None else self.asked.approach

    @property
    def shift(self) -> float:
        """As it was asked for, or what came out, along the line [length]."""
        return self.held.shift if self.asked.shift is None else self.asked.shift


@dataclass(frozen=True)
class Pushing:
    """See `contact_scene.march.Solver`.

    direction  of the tangential load, unit vector
    points     laid out for the largest contact of the history
    taken      steps of Newton's method, solve by solve
    """

    scene: Scene
    friction: float
    direction: Pair
    tolerance: float
    points: Points
    taken: list[int] = field(default_factory=list)
    most_spent: float = 4.0 * MOST_STEPS

    @classmethod
    def of(
        cls, scene: Scene, asked: RadialDiscretisation, direction: Pair, fineness: float
    ) -> Pushing:
        """That of a scene.

        fineness  how many times as many rings and angles as it takes
        """
        assert scene.friction is not None
        assert scene.friction.uniform is not None
        friction = scene.friction.uniform
        count, angles = round(RINGS * fineness), round(ANGLES * fineness)
        both = Coupling.of(scene)
        edges = [
            max(
                pressed(both.bodies, scene.indenter, target).contact.radius
                for target in largest_targets(scene)
            )
        ]

        def at(angles: int) -> Pushing:
            points = laid(both, scene.indenter, edges, count, angles, friction)
            return cls(scene, friction, direction, asked.tolerance, points)

        for _ in range(SETTLED):
            edges = at(1)._radii()
        return at(angles)

    def _radii(self) -> list[float]:
        """Of the contact that is only pressed, with few increments, at the ends of the steps."""
        state: Pushed | None = None
        found = []
        for ramp in self.scene.load_path():
            start = state
            if start and ramp.normal.start == ramp.normal.end:
                continue
            for index in range(1, SETTLING + 1):
                state = self._at(self._normal(ramp, start, index / SETTLING), state)
            assert state is not None
            found.append(state.radius)
        return found

    @staticmethod
    def _normal(ramp: LoadRamp, start: Pushed | None, fraction: float) -> Loads:
        """Of a ramp, without what pushes."""
        reached = (start.force, start.approach) if start else (0.0, 0.0)
        force, approach = ramp.normal.led(fraction, reached)
        return Loads(force, approach, 0.0, None)

    def spent(self) -> float:
        """Steps of Newton's method."""
        return float(sum(self.taken))

    def advance(
        self, ramp: LoadRamp, start: Pushed | None, before: Pushed | None, fraction: float
    ) -> Pushed:
        """The contact at a fraction of the ramp; raises NotConverged, GrossSliding and
        ContactAtZoneEdge."""
        normal = self._normal(ramp, start, fraction)
        since = (start.drag, start.shift) if start else (0.0, 0.0)
        vectors = self._vector(since[0]), self._vector(since[1])
        drag, shift = (
            None if vector is None else float(np.dot(vector, self.direction))
            for vector in ramp.tangential.led(fraction, vectors)
        )
        return self._at(Loads(normal.force, normal.approach, drag, shift), before)

    def _vector(self, along: float) -> Pair:
        return along * self.direction[0], along * self.direction[1]

    def _at(self, loads: Loads, before: Pushed | None) -> Pushed:
        """The contact under loads."""
        if before is not None and before.asked == loads:
            return before
        turned = bool(loads.drag or loads.shift) or (before is not None and before.turned)
        points = self.points if turned else self.points.around
        if not turned:
            loads_there = Loads(loads.force, loads.approach, 0.0, None)
        else:
            loads_there = loads
        last = before.held if before else None
        slip = before.slip if before else np.zeros((2, len(points.areas)))
        if last is not None and before is not None and turned and not before.turned:
            last, slip = last.every_angle(points), points.every_angle(slip)
        try:
            end = held(points, self.friction, loads_there, last, EXACT * self.tolerance)
        except NotConverged as error:
            self.taken.append(error.iterations)
            raise
        self.taken.append(end.steps)
        return self._ended(points, end, last, before, slip, turned, loads)

    def _ended(
        self, points: Points, end: Held, last: Held | None, before: Pushed | None, slip: Array,
        turned: bool, loads: Loads,
    ) -> Pushed:  # fmt: skip
        areas, nothing = points.areas, np.zeros(len(points.areas))
        radius = sqrt(points.contact_area(end.pressure) / pi)
        begun = before.radius if before else 0.0
        passed = -end.slipped.reshape(2, -1) / areas * self._touched(points, end, begun, radius)
        start = last.shear if last else np.zeros((2, len(nothing)))
        limits = [
            self.friction * (last.pressure if last else nothing),
            self.friction * end.pressure,
        ]
        rubbing = sliding_friction(start, end.shear, passed, *limits)
        W, T = float(areas @ end.pressure), float(points.along @ end.shear.ravel())
        drags = (before.drag if before else 0.0) + T
        force = W if loads.force is None else loads.force
        drag = T if loads.drag is None else loads.drag
        depth, shift = (last.approach, last.shift) if last else (0.0, 0.0)
        work = (before.force if before else 0.0) + W
        work = 0.5 * (work * (end.approach - depth) + drags * (end.shift - shift))
        distance = np.hypot(*end.slipped.reshape(2, -1)) / areas
        through = sqrt(min(points.stick_area(end.share, distance) / pi, radius**2))
        open_ = np.hypot(*(end.shear - start)) * np.hypot(*passed)
        return Pushed(
            end, turned, loads, radius, begun, through,
            through if turned else _front(radius, begun, through, before),
            slip - passed, force, drag,
            (before.worked if before else 0.0) + work,
            (before.lost if before else 0.0) + float(np.sum(rubbing * passed, axis=0) @ areas),
            (before.uncertain if before else 0.0) + float(open_ @ areas),
        )  # fmt: skip

    @staticmethod
    def _touched(points: Points, end: Held, begun: float, radius: float) -> Array:
        """Share of the increment through which points touched: what the contact has grown over has
        rubbed since the edge went by."""
        r = np.repeat(points.radii, points.count)
        share = np.ones_like(r)
        if radius > begun:
            share = np.clip((radius - r) / (radius - begun), 0.0, 1.0)
            share[r <= begun] = 1.0
        return share * (end.pressure > 0)

    def report(self, reached: Reached[Pushed], last: Increment | None) -> Increment:
        """The contact on rings and angles; raises NotConverged above the tolerance."""
        state, end = reached.state, reached.state.held
        points = self.points if state.turned else self.points.around
        if reached.place.index == reached.place.increments_in_step:
            self._refuse_narrow(state, reached.place.step)
        residuals = self._residuals(points, state)
        residuals.require(self.tolerance, "contact and friction on rings", end.steps)
        p = self._scalar(points, end.pressure)
        q_r, q_t = self._vectors(points, end.shear)
        s_r, s_t = self._vectors(points, state.slip)
        depth = end.approach * points.areas
        u_z = (points.compliance @ end.tractions)[2 * len(points.areas) :]
        gap = np.where(end.pressure > 0, 0.0, (u_z + points.bare - depth) / points.areas)
        share = np.where(np.isfinite(end.share), end.share, 2.0)
        p, gap = np.maximum(p, 0.0), np.maximum(self._scalar(points, gap), 0.0)
        return Increment(
            step=reached.place.step,
            index=reached.place.index,
            increments_in_step=reached.place.increments_in_step,
            residuals=residuals,
            iterations=end.steps,
            halvings=reached.halvings,
            normal_force=state.force,
            approach=state.approach,
            contact_radius=state.radius,
            peak_pressure=float(np.max(p)),
            status=self._status(state),
            stick_radius=state.stuck,
            tangential_force=self._vector(state.drag),
            tangential_shift=self._vector(state.shift),
            dissipated_energy=state.lost,
            dissipation_uncertainty=state.uncertain,
            elastic_energy=end.energy,
            input_work=state.worked,
            unresolved_work=state.worked - end.energy - state.lost,
            radii=points.radii,
            angles=points.shown_angles if state.turned else None,
            pressure=p,
            gap=np.where(p > 0, 0.0, gap),
            shear_radial=q_r,
            shear_circumferential=q_t if state.turned else None,
            slip_radial=s_r,
            slip_circumferential=s_t if state.turned else None,
            in_stick=(self._scalar(points, share) < 1) & (p > 0),
        )

    def _refuse_narrow(self, state: Pushed, step: int) -> None:
        """Raises UnsupportedScene where pressing leaves an annulus of slip that rings do not see:
        next to it tractions rise beyond what they carry, and the edge with them."""
        sticks = self._status(state) is ContactStatus.FULL_STICK
        if sticks and step == 1 and not state.turned and coupling(self.scene)[0]:
            raise UnsupportedScene(
                f"with a coefficient of friction of {self.friction:g} the annulus that slips at "
                "the edge is narrower than a ring, and this solver does not tell the edge beside "
                f"it; give a smaller coefficient, or {ELSEWHERE}"
            )

    @staticmethod
    def _scalar(points: Points, field: Array) -> Array:
        """At the angles that are shown; the axis has one value."""
        if points.count == 1:
            return field
        shown = points.shown(field, 1.0)
        shown[0] = np.mean(field[: points.count])
        return shown

    @staticmethod
    def _vectors(points: Points, vector: Array) -> tuple[Array, Array]:
        """Outward and around the axis at the angles that are shown."""
        if points.count == 1:
            return vector[0], vector[1]
        outward, around = points.shown(vector[0], 1.0), points.shown(vector[1], -1.0)
        cos, sin = np.cos(points.angles), np.sin(points.angles)
        along = np.mean(vector[0, : points.count] * cos - vector[1, : points.count] * sin)
        outward[0] = along * np.cos(points.shown_angles)
        around[0] = -along * np.sin(points.shown_angles)
        return outward, around

    def _residuals(self, points: Points, state: Pushed) -> Residuals:
        end, asked = state.held, state.asked
        W, T = float(points.areas @ end.pressure), float(points.along @ end.shear.ravel())
        limit = self.friction * end.pressure
        size = np.max(limit) or 1.0
        slipped = np.hypot(*end.slipped.reshape(2, -1))
        slips = (slipped > REST * end.approach * points.areas) & (end.pressure > 0)
        most = float(np.sum(limit * slipped, where=slips))
        against = float(np.sum(np.sum(end.shear * end.slipped.reshape(2, -1), axis=0), where=slips))
        return Residuals(
            complementarity=end.missed,
            penetration=end.missed,
            normal_equilibrium=None if asked.force is None else abs(W / asked.force - 1),
            friction_cone=max(0.0, float(np.max(np.hypot(*end.shear) - limit)) / size),
            slip_direction=(most + against) / most if most > 0 else 0.0,
            tangential_equilibrium=None
            if asked.drag is None
            else abs(T - asked.drag) / (self.friction * W),
        )

    @staticmethod
    def _status(state: Pushed) -> ContactStatus:
        share = state.held.share[np.isfinite(state.held.share)]
        if np.all(share <= 1):
            return ContactStatus.FULL_STICK
        if np.any(share <= 1) or state.stuck > 0:
            return ContactStatus.PARTIAL_SLIP
        slides = state.asked.shift is not None
        return ContactStatus.GROSS_SLIDING if slides else ContactStatus.NO_STICK_AREA_LEFT


def _front(radius: float, begun: float, through: float, before: Pushed | None) -> float:
    """Stick radius at the end of an increment of pressing: what sticks through it is the disc half
    way, so that half an increment more is on the line through this one and the one before, unless
    the load has turned between them [length]."""
    if before is None:
        return through
    half, last = 0.5 * (radius - begun), 0.5 * (begun - before.begun)
    if half * last <= 0:
        return through
    return min(max(through + (through - before.through) * half / (half + last), 0.0), radius)
