"""Laws of contact and friction for the fields of the semi-analytical method."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from contact_scene.friction import FRICTIONLESS, CoulombFriction
from semi_analytical import Coupling, Increment, Result
from verification.observed.prescribed import Imbalance, largest_of, missed
from verification.observed.unseen import has_grown, is_corrected

Field = NDArray[np.float64]

EDGES = 0.125  # of (h/a)²: the energy error of a point contact; ten times as much is allowed


def surface_imbalance(result: Result) -> float | None:
    """Return the largest energy imbalance of any increment, over the largest energy so far.

    The imbalance includes differences from the stated energies. It is infinite if a number is not
    finite, and None for one-way coupling, for which the bodies have no energy.
    """
    if result.plan.coupling is Coupling.ONE_WAY:
        return None
    return largest_of(_imbalances(result))


@dataclass(frozen=True)
class _State:
    """Increment for the energy balance.

    u        displacements (3, nx, ny), zero without pressure [length]
    slip     as stated; passed includes the motion before first contact (2, nx, ny) [length]
    limit    of friction (nx, ny)
    forces   W, T_x, T_y, M_x, M_y, M_z, and moments against a strain; motions are conjugate
    """

    tractions: Field
    u: Field
    gap: Field
    slip: Field
    passed: Field
    limit: Field
    forces: Field
    motions: Field

    @classmethod
    def at_rest(cls, gap: Field) -> _State:
        nothing = np.zeros((3, *gap.shape))
        return cls(nothing, nothing, gap, *(nothing[:2],) * 2, nothing[0], np.zeros(9), np.zeros(9))

    @classmethod
    def of(cls, now: Increment, result: Result, undeformed: Field, before_touch: Field) -> _State:
        x, y = result.grid.coordinates()
        p, nothing = now.pressure, np.zeros((2, *now.pressure.shape))
        q = nothing if now.shear is None else now.shear
        s = nothing if now.slip is None else now.slip
        passed = s + before_touch
        tilt = np.zeros(2) if now.tilt is None else now.tilt
        shift = np.zeros(2) if now.tangential_shift is None else now.tangential_shift
        twist = now.twist or 0.0
        touching = p > 0
        gap, first = (np.where(touching, g, 0.0) for g in (now.gap, undeformed))
        u_z = gap - first + now.approach + tilt[0] * y + tilt[1] * x
        xx, yy = (0.0, 0.0) if now.bulk_strain is None else now.bulk_strain
        xy = now.bulk_shear or 0.0
        u_x = passed[0] + shift[0] - twist * y - xx * x - xy * y
        u_y = passed[1] + shift[1] + twist * x - xy * x - yy * y
        u = np.stack([u_x, u_y, u_z])
        M_x, M_y, M_z = np.sum(p * y), np.sum(p * x), np.sum(q[1] * x - q[0] * y)
        strained = np.sum(q[0] * x), np.sum(q[1] * y), np.sum(q[0] * y + q[1] * x)
        forces = np.array([np.sum(p), np.sum(q[0]), np.sum(q[1]), M_x, M_y, M_z, *strained])
        return cls(
            tractions=np.stack([*q, p]),
            u=u * touching,
            gap=now.gap,
            slip=s,
            passed=passed,
            limit=(result.scene.friction or FRICTIONLESS).limit(p),
            forces=forces * result.grid.cell_area,
            motions=np.array([now.approach, *shift, *tilt, twist, -xx, -yy, -xy]),
        )


def _imbalances(result: Result) -> Iterator[Imbalance]:
    cell = result.grid.cell_area
    undeformed = result.scene.indenter.initial_gap(*result.grid.coordinates())
    before, state = None, _State.at_rest(undeformed)
    before_touch = _before_touch(result.increments[0], undeformed)
    largest = 0.0
    pairs = zip(result.increments, has_grown(result.increments), strict=True)
    for number, (now, grown) in enumerate(pairs, start=1):
        if now.shear is not None and now.dissipated_energy is None:
            return  # the motion is undefined, and with it all that follows
        after = _State.of(now, result, undeformed, before_touch)
        largest = max(largest, *(abs(e) for e in (now.elastic_energy, *_told(now))))
        scale = largest
        if is_corrected(now) or (before is not None and is_corrected(before)):
            side = max(result.grid.spacing) / now.contact_radius if now.contact_radius else 1.0
            scale *= max(1.0, EDGES * side**2 / result.tolerance)
        elastic = 0.5 * float(np.sum(after.tractions * after.u)) * cell
        told, lost, work = now.elastic_energy, now.dissipated_energy or 0.0, now.input_work or 0.0
        if not grown:
            yield Imbalance(number, scale, elastic - told, stored=elastic, stated=told)
        stated = now.energy_imbalance or 0.0
        yield Imbalance(number, 1.0, stated, stated_imbalance=stated)
        yield Imbalance(
            number, largest, work - told - lost, stated_work=work, stored=told, dissipated=lost
        )
        if now.halvings == 0:  # else there are states in between
            for difference, terms in _missing(state, after, before, now, cell, grown=grown):
                yield Imbalance(number, scale, difference, **terms)
        before, state = now, after


def _before_touch(first: Increment, undeformed: Field) -> Field:
    """Compute the relative motion of particles before first contact in the first increment (2, nx,
    ny).

    Where there is a gap, the slip is (p/p₀)² of the motion, as p² grows with the motion of the
    edge.
    """
    if first.slip is None:
        return np.zeros((2, *undeformed.shape))
    p = first.pressure
    touching = np.where((p > 0) & (undeformed > 0), (p / np.max(p)) ** 2, 1.0)
    return np.asarray(first.slip * (1 / touching - 1))


def _told(now: Increment) -> tuple[float, float, float]:
    """Return the input, dissipated and unresolved work since the start [force length]."""
    return now.trapezoidal_work or 0.0, now.dissipated_energy or 0.0, now.unresolved_work or 0.0


def _missing(
    state: _State,
    after: _State,
    before: Increment | None,
    now: Increment,
    cell: float,
    *,
    grown: bool,
) -> Iterator[tuple[float, dict[str, float]]]:
    """Yield differences from the first law and from the stated energies, each with its terms
    [force length]."""
    slipped = after.slip - state.slip
    forces, motions = 0.5 * (state.forces + after.forces), after.motions - state.motions
    last = (0.0, 0.0, 0.0) if before is None else _told(before)
    told = tuple(end - start for end, start in zip(_told(now), last, strict=True))
    work = float(np.sum(forces * motions))
    # Slip opposes the shear (`surfaces`), so that friction takes its limit times the way; what
    # parts may have stuck until then, and loses half its shear at the start.
    parts = (state.tractions[2] > 0) & (after.tractions[2] == 0)
    friction = 0.5 * np.where(parts, np.hypot(*state.tractions[:2]), state.limit + after.limit)
    dissipated = float(np.sum(friction * np.hypot(*slipped))) * cell
    stored = now.elastic_energy - (0.0 if before is None else before.elastic_energy)
    shrunk = np.any(state.tractions[:2] * (after.tractions[2] == 0))
    unresolved = told[2] if grown or shrunk else _unresolved(state, after) * cell - dissipated
    terms = {"work": work, "stored": stored, "dissipated": dissipated, "unresolved": unresolved}
    yield work - stored - dissipated - unresolved, terms
    for name, stated in zip(("work", "dissipated", "unresolved"), told, strict=True):
        yield terms[name] - stated, {name: terms[name], "stated": stated}


def _unresolved(state: _State, after: _State) -> float:
    """Compute the work that a finite increment does not resolve, including dissipation.

    Loads are linear in time where gaps close or open, and so is the shear (see
    `semi_analytical.increments.energy`).
    """
    p0, p1 = state.tractions[2], after.tractions[2]
    begins, ends = (p0 == 0) & (p1 > 0), (p0 > 0) & (p1 == 0)
    closing = float(np.sum(p1[begins] * state.gap[begins]))
    opening = float(np.sum(p0[ends] * after.gap[ends]))
    sheared = float(np.sum((after.tractions + state.tractions)[:2] * (after.passed - state.passed)))
    return 0.5 * (closing - opening - sheared)


# Fraction of the approach that is the smallest scale for violations of slip.
LEAST_SLIP = 1e-3
# Where the border of stick is not fitted, the shear follows the corrected pressure in the cells
# along the edge, about a tenth of the contact, and carries the force to the change in these.
BORDER = 10.0
INNER = 0.1  # of the change, to which the solves of the correction end


def surface_violation(result: Result) -> float:
    """Return the largest violation of a law in any increment [1]; infinite if a number is not
    finite.

    With the edge correction, complementarity and the tangential force hold to the last change of
    the correction: these violations are relative to that change over the tolerance. The slip is
    that before the correction and is not compared.
    """
    place = _Place.of(result)
    befores: list[Increment | None] = [None, *result.increments]
    pairs = zip(befores, result.increments, strict=False)
    found = [v for before, now in pairs for v in _violations(before, now, place)]
    found += missed(result.scene, result.steps)
    return largest_of(found)


@dataclass(frozen=True)
class _Place:
    """Positions and material data of the fields.

    friction   friction law on the cells
    tolerance  of the solve
    """

    x: Field
    y: Field
    cell_area: float
    friction: CoulombFriction
    tolerance: float

    def eased(self, now: Increment, times: float = 1.0) -> float:
        """Return the tolerance over that of corrected fields."""
        return self.tolerance / max(self.tolerance, times * (now.edge_change or 0.0))

    @classmethod
    def of(cls, result: Result) -> _Place:
        grid, friction = result.grid, result.scene.friction or FRICTIONLESS
        x, y = grid.coordinates()
        on_cells = friction.on(grid.cells, grid.spacing)
        return cls(x, y, grid.cell_area, on_cells, result.tolerance)


def _violations(before: Increment | None, now: Increment, place: _Place) -> Iterator[float]:
    p, delta = now.pressure, now.approach
    open_gap = np.where(np.isposinf(now.gap), 0.0, now.gap)
    # A tilted indenter may touch while its axis stands higher than at first touch.
    scale = float(np.max(np.abs(_tilted(now, place)), initial=abs(delta)))
    yield float(np.max(-p) / np.max(p))
    yield float(np.max(-open_gap) / scale)
    yield place.eased(now) * float(np.sum(p * np.abs(open_gap)) / (np.sum(p) * scale))
    missing = abs(np.sum(p) * place.cell_area / now.normal_force - 1)
    yield float(missing)
    yield from _moments(now, place)
    limit = place.friction.limit(p)
    if now.shear is None:
        return
    q = now.shear
    if not np.any(limit):
        yield float(np.max(np.hypot(*q)) / np.max(p))
        return
    yield float(np.max(np.hypot(*q) - limit) / np.max(limit))
    assert now.tangential_force is not None
    carried = np.sum(q, axis=(1, 2)) * place.cell_area
    missing = np.hypot(*(carried - now.tangential_force)) / (np.sum(limit) * place.cell_area)
    fitted = now.edge_report is None or now.edge_report.stick is not None
    yield float(missing) * place.eased(now, INNER if fitted else BORDER)
    if now.slip is not None and now.dissipated_energy is not None:
        yield from _traces(before, now, place)
        # In an increment that was halved slip may have turned on the way.
        if now.halvings == 0 and not is_corrected(now):
            yield from _slip_violations(before, now, limit)


def _tilted(now: Increment, place: _Place) -> Field:
    """Compute the approach of the indenter at each cell in contact [length]."""
    phi_x, phi_y = (0.0, 0.0) if now.tilt is None else now.tilt
    return np.asarray((now.approach + phi_x * place.y + phi_y * place.x)[now.pressure > 0])


def _moments(now: Increment, place: _Place) -> Iterator[float]:
    """Check Σ p (y, x) = M and Σ (q_y x - q_x y) = M_z."""
    p, arm = now.pressure, np.hypot(place.x, place.y)
    if now.moment is not None:
        carried = np.array([np.sum(p * place.y), np.sum(p * place.x)]) * place.cell_area
        yield float(np.hypot(*(carried - now.moment)) / (np.sum(p * arm) * place.cell_area))
    limit = place.friction.limit(p)
    if now.torque is not None and now.shear is not None and np.any(limit):
        turned = np.sum(now.shear[1] * place.x - now.shear[0] * place.y) * place.cell_area
        yield float(abs(turned - now.torque) / (np.sum(limit * arm) * place.cell_area))


def _traces(before: Increment | None, now: Increment, place: _Place) -> Iterator[float]:
    """Compare the sums of the fields of dissipation and slip with the stated numbers."""
    assert now.dissipated_energy is not None
    if now.dissipation is None or now.slip_distance is None or now.slip is None:
        return
    most = max(now.dissipated_energy, float(np.finfo(float).tiny))
    yield abs(float(np.sum(now.dissipation)) * place.cell_area - now.dissipated_energy) / most
    way, slip = now.slip_distance, now.slip
    if before is not None and before.slip_distance is not None and before.slip is not None:
        way, slip = way - before.slip_distance, slip - before.slip
    longest = max(float(np.max(now.slip_distance)), float(np.finfo(float).tiny))
    direct = np.hypot(*slip)
    yield float(np.max(direct - way) / longest)  # no way is shorter
    if now.halvings == 0:
        yield float(np.max(np.abs(direct - way)) / longest)


def _slip_violations(before: Increment | None, now: Increment, limit: Field) -> Iterator[float]:
    """Check that slip opposes the shear at its limit and dissipates energy."""
    assert now.slip is not None
    assert now.shear is not None
    assert now.dissipated_energy is not None
    slip, lost = now.slip, now.dissipated_energy
    if before is not None and before.slip is not None and before.dissipated_energy is not None:
        slip, lost = slip - before.slip, lost - before.dissipated_energy
    work = limit * np.hypot(*slip)
    least = LEAST_SLIP * np.sum(limit) * abs(now.approach) * np.max(limit) / np.max(now.pressure)
    scale = max(float(np.sum(work)), float(least))
    yield float(np.sum(work + now.shear[0] * slip[0] + now.shear[1] * slip[1]) / scale)
    yield float(-lost / max(now.dissipated_energy, np.finfo(float).tiny))
