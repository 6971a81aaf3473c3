"""Solver of load steps of a contact with friction under normal load.

Friction is path-dependent, so each increment starts from the state of the previous one.
"""

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
from contact_scene.rig import add_contact_displacements
from contact_scene.stepping.load_stepping import ConvergedIncrement
from radial.fields import Increment
from radial.frictional.coupling import Coupling
from radial.frictional.frictional_increment import (
    FrictionalState,
    finite_pressure,
    frictional_state,
    stick_radius_ratio,
)
from radial.frictional.rings import (
    Rings,
    layout_number,
    rings_for_stick_radius,
)
from radial.frictional.stick_slip import (
    FrictionalContact,
    Signs,
    frictional_contact,
)
from radial.normal.pressing import (
    ROUND_OFF,
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

COUNT = 64  # rings, without those of the dense regions at the stick border, axis and edge
# GROWTH: largest ratio of the contact radii of two successive solves. FIRST: radius of the first
# solve over that at the end of the first increment.
GROWTH = 1.1
FIRST = 0.03
MAX_LAID = 3  # largest number of layouts of rings that follow the stick radius
REST = 1e-11  # slip below this multiple of the approach is round-off
MIDDLE = 0.5  # initial guess of the stick radius over the contact radius


@dataclass(frozen=True)
class FrictionalSteps(StepsOnRings):
    """Solver of load steps of a contact with friction under a normal load.

    coupling   elastic response of both bodies
    friction   friction law
    tolerance  upper bound of every residual [1]
    fineness   factor on the number of rings, and on the number of solves within an increment
    radii      radii of the output rings (n,) [length]
    """

    coupling: Coupling
    friction: CoulombFriction
    tolerance: float
    fineness: float
    radii: Array

    @classmethod
    def of(
        cls, scene: Scene, discretisation: RadialDiscretisation, fineness: float
    ) -> FrictionalSteps:
        """Create the solver of load steps with friction under a normal load, for a scene.

        The output rings are placed over the largest contact of the load history.

        scene           contact problem
        discretisation  number of output rings, and tolerance of the residuals
        fineness        factor on the number of rings, and on the number of solves within an
                        increment
        """
        coupling = Coupling.of(scene)
        largest = [
            normal_contact(coupling.bodies, scene.indenter, target)
            for target in largest_targets(scene)
        ]
        radii = output_radii(discretisation.rings, largest, scene.indenter.rim)
        assert scene.friction is not None
        return cls(scene, coupling, scene.friction, discretisation.tolerance, fineness, radii)

    def advance(
        self,
        ramp: LoadRamp,
        start: FrictionalState | None,
        before: FrictionalState | None,
        fraction: float,
    ) -> FrictionalState:
        """Solve the contact with friction under a normal load at a fraction of a load step.

        A large increment passes through contacts of intermediate radii, because the stick zone
        depends on the path.

        ramp      load step
        start     state at the start of the load step; None without contact
        before    state at the end of the previous increment; None without contact
        fraction  fraction of the linear change of the load, 0 to 1
        raises    NotConverged
        """
        reached = (start.normal_force, start.approach) if start else (0.0, 0.0)
        target = target_of(self.scene, *ramp.normal.prescribed(fraction, reached))
        radius, iterations = self._first_radius(target, before)
        start_radius = before.end.radius if before else FIRST * radius
        count = round(COUNT * self.fineness)
        last, strain = before.strain if before else 0.0, (ramp.strain(fraction) or UNSTRAINED)[0]
        # The stick zone depends on the sequence of contact radii, so large increments pass through
        # intermediate radii.
        passing = Target(None, None)
        for passed in _intermediate_radii(start_radius, radius, GROWTH ** (1 / self.fineness)):
            part = (passed - start_radius) / (radius - start_radius)
            between = last + part * (strain - last)
            share = before.mid_stick_radius / before.end.radius if before else MIDDLE
            end = self._contact_solver(rings_for_stick_radius(share, count), before, between)(
                passed
            )
            power = self._load_exponent(passing, before)
            before = frictional_state(
                self.friction, end, passing, self.radii, before, power, 0, between
            )
            iterations += 1
        share = before.mid_stick_radius / before.end.radius if before else MIDDLE
        for _ in range(MAX_LAID):
            solve = self._contact_solver(rings_for_stick_radius(share, count), before, strain)
            power = self._load_exponent(target, before)
            end, more, power = contact_at_target(solve, target, radius, power, 10 * ROUND_OFF)
            iterations, radius = iterations + more, end.radius
            previous, share = share, stick_radius_ratio(end)
            if abs(layout_number(share) - layout_number(previous)) <= 1:
                break
        return frictional_state(
            self.friction, end, target, self.radii, before, power, iterations, strain
        )

    def _contact_solver(
        self, rings: Rings, before: FrictionalState | None, strain: float
    ) -> Callable[[float], FrictionalContact]:
        """Return a function that solves pressure and shear of a contact for a given radius.

        The function is used in the search for the contact radius. The slip zone of its last solve
        is the initial guess of the next one.

        rings   nodes along the radius of the contact
        before  state at the start of the increment; None before first contact
        strain  bulk strain of the lower body, equal in all directions [1]
        """
        radial_displacement = _reference_displacement(before, strain)
        like = before.end if before else None

        def solve(radius: float) -> FrictionalContact:
            """Solve pressure, shear and slip zone of a contact with friction and given radius.

            radius  contact radius [length]
            """
            nonlocal like
            like = frictional_contact(
                self.coupling,
                self.scene.indenter,
                radius,
                rings,
                self.friction,
                radial_displacement(radius * rings.places),
                _guess_slip_signs(like, rings),
            )
            return like

        return solve

    def _first_radius(self, target: Target, before: FrictionalState | None) -> tuple[float, int]:
        """Estimate the contact radius [length] by a power law from the preceding state,
        or without friction before first contact; also return the number of radii tried."""
        if before is None:
            found = normal_contact(self.coupling.bodies, self.scene.indenter, target)
            return found.contact.radius, found.iterations
        further = -target.residual(before.end) / self._load_exponent(target, before)
        return before.end.radius * exp(further), 0

    @staticmethod
    def _load_exponent(target: Target, before: FrictionalState | None) -> float:
        """Estimate b in force (or approach) ∝ aᵇ:
        that of the preceding state if it prescribed the same quantity, else of Hertz contact."""
        if before is not None and (before.target.force is None) == (target.force is None):
            return before.power
        return 3.0 if target.approach is None else 2.0

    def report(
        self, reached: ConvergedIncrement[FrictionalState], last: Increment | None
    ) -> Increment:
        """Compute the output of an increment with friction: fields, energies and residuals.

        The fields at the output rings are pressure, gap, radial shear, radial slip and the stick
        zone. Raises UnsupportedScene if the contact area is not a disc, and NotConverged if a
        residual exceeds the tolerance.

        reached  solved state at the end of the increment
        last     output of the previous increment (not used)
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
            slip_direction=_slip_direction_residual(end, self.friction),
        )
        residuals.require(self.tolerance, "the contact radius", state.iterations)
        x = r / end.radius
        p = pressure(end.contact, x) + end.rings.interpolate_traction(end.pressure_change, x)
        gap = np.zeros_like(r)
        apart = x > 1
        normal_displacement = _decaying_interpolant(
            places, end.normal_displacement - end.approach_change, -end.approach_change
        )
        gap[apart] = indenter.initial_gap(r[apart], 0.0) - end.contact.approach
        gap[apart] += displacement(end.contact, x[apart]) + normal_displacement(r[apart])
        sticks = np.asarray(state.interpolate_nodes(np.abs(end.sliding), r) == 0) & (x < 1)
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
            status=_contact_status(state),
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
            shear_radial=self._shear_at_rings(state, p, r),
            slip_radial=state.slip,
            in_stick=sticks,
        )
        return add_contact_displacements(increment, self.scene.rig)

    def _shear_at_rings(self, state: FrictionalState, p: Array, r: Array) -> Array:
        """Interpolate the shear [force/length²] to the output rings of radii r and pressure p (n,):
        as a share of the friction limit, which is more accurate than the shear itself."""
        end = state.end
        share = end.shear[1:-1] / self.friction.limit(end.pressure[1:-1])
        share = np.concatenate([[0.0], share, share[-1:]])
        return np.asarray(self.friction.limit(p) * state.interpolate_nodes(share, r))


def _reference_displacement(
    before: FrictionalState | None, strain: float
) -> Callable[[Array], Array]:
    """Return the radial displacement that stick requires, as a function of the radius [length]:
    that of the preceding state, less the change of the bulk strain of the lower body."""
    if before is None:
        return lambda radii: -strain * radii
    end, more = before.end, strain - before.strain
    known = _decaying_interpolant(end.radius * end.rings.places, end.radial_displacement, 0.0)
    return lambda radii: known(radii) - more * radii


def _decaying_interpolant(r: Array, field: Array, limit: float) -> Callable[[Array], Array]:
    """Return a function that interpolates a surface displacement and continues it to all radii.

    The displacement is known at positions in the contact and near it. Beyond the last position the
    function decays as 1/r to the value `limit`.

    r      positions, from the axis to outside the contact [length]
    field  values at these positions
    limit  value of the field at infinite radius
    """
    spline, last = CubicSpline(r, field), r[-1]

    def evaluate(radii: Array) -> Array:
        """Evaluate a surface displacement at given radii, interpolated or continued (…).

        The displacement is interpolated up to the last known position and continued as 1/r beyond
        it.

        radii  radii, inside or outside the contact (…) [length]
        """
        near = spline(np.minimum(radii, last))
        return np.asarray(limit + (near - limit) * last / np.maximum(radii, last))

    return evaluate


def _intermediate_radii(start_radius: float, end: float, growth: float) -> Array:
    """Return contact radii between start and end, exclusive,
    in equal ratios [length], because the stick zone depends on the path."""
    steps = max(ceil(abs(log(end / start_radius)) / log(growth)), 1)
    return np.geomspace(start_radius, end, steps + 1)[1:-1]


def _guess_slip_signs(was: FrictionalContact | None, rings: Rings) -> Signs:
    """Return the slip signs of another contact at equal r/a (n + 1,), or full stick."""
    if was is None:
        return np.zeros(len(rings.x), dtype=np.int64)
    return np.rint(np.interp(rings.x, was.rings.x, was.sliding)).astype(np.int64)


def _slip_direction_residual(end: FrictionalContact, friction: CoulombFriction) -> float:
    """Compute the residual of slip opposing the shear: |∫ (b|Δs| + q Δs) dA| / ∫ b|Δs| dA,
    with the friction limit b. Slip increments Δs below round-off are omitted."""
    slip_increment = (
        end.slip_increment * (end.sliding != 0) * (np.abs(end.slip_increment) > REST * end.approach)
    )
    most = end.integrate_over_contact(friction.limit(finite_pressure(end)) * np.abs(slip_increment))
    return (
        abs(most + end.integrate_over_contact(end.shear * slip_increment)) / most
        if most > 0
        else 0.0
    )


def _contact_status(state: FrictionalState) -> ContactStatus:
    sticks = state.end.sliding[1:-1] == 0
    if np.all(sticks):
        return ContactStatus.FULL_STICK
    return ContactStatus.PARTIAL_SLIP if np.any(sticks) else ContactStatus.NO_STICK_AREA_LEFT
