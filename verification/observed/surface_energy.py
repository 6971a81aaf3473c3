"""The first law on a surface grid, from tractions, gaps, slips and motions as they are returned.

u_z follows from the gap and u from the slip, both by the motion of the indenter (CONVENTIONS). That
these displacements belong to the tractions is Betti's theorem: only then does the energy stored,
½ Σ t·u Δ, change by what the tractions do, ½ Σ (t₀ + t₁)·(u₁ - u₀) Δ. A history that was lost, a
motion that is told wrong and a displacement of other tractions all break it.

The energies of an increment with corrected edges are those of its state before the correction,
which is not returned. They differ from those of the returned tractions by the error of the cells,
(h/a)²/8 for a point contact. To such increments, and those that follow one, the imbalance is
relative to `EDGES` (h/a)² over the tolerance.

Slip counts from the touch of two particles, and how far they had moved past each other before is
not told. In the first increment it follows from the slip and the part of the increment for which
they touch; where a contact with friction has grown since, stored energy and unresolved work are
taken as they are told, and where it has shrunk the unresolved work.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from contact_scene.friction import FRICTIONLESS
from semi_analytical import Coupling, Increment, Result
from verification.observed.imbalance import Imbalance, largest_of
from verification.observed.unseen import has_grown, is_corrected

Field = NDArray[np.float64]

EDGES = 0.125  # of (h/a)²: the energy error of a point contact; ten times as much is allowed


def surface_imbalance(result: Result) -> float | None:
    """The largest part of the energy that any increment cannot account for, or tells otherwise,
    relative to the largest energy so far; infinite if a number is not finite. None where shear is
    solved for without acting back on the pressure: such bodies have no energy."""
    if result.plan.coupling is Coupling.ONE_WAY:
        return None
    return largest_of(_imbalances(result))


@dataclass(frozen=True)
class _State:
    """An increment as its energy sees it.

    u        displacements (3, nx, ny), zero where nothing presses [length]
    slip     as it is told; passed with the motion before first touch (2, nx, ny) [length]
    limit    of friction (nx, ny)
    forces   W, T_x, T_y, M_x, M_y, M_z, and moments that resist a strain; motions theirs
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
    """How far particles move past each other until they touch in the first increment (2, nx, ny):
    where there is a gap (p/p₀)² of the motion is slip, as p² grows with the way of the edge."""
    if first.slip is None:
        return np.zeros((2, *undeformed.shape))
    p = first.pressure
    touching = np.where((p > 0) & (undeformed > 0), (p / np.max(p)) ** 2, 1.0)
    return np.asarray(first.slip * (1 / touching - 1))


def _told(now: Increment) -> tuple[float, float, float]:
    """Work put in, dissipated and left to the increments since the start [force length]."""
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
    """What the finite increment leaves open: loads are taken as straight lines where gaps close
    or open, and so is the shear (see `semi_analytical.increments.energy`); with what is
    dissipated."""
    p0, p1 = state.tractions[2], after.tractions[2]
    begins, ends = (p0 == 0) & (p1 > 0), (p0 > 0) & (p1 == 0)
    closing = float(np.sum(p1[begins] * state.gap[begins]))
    opening = float(np.sum(p0[ends] * after.gap[ends]))
    sheared = float(np.sum((after.tractions + state.tractions)[:2] * (after.passed - state.passed)))
    return 0.5 * (closing - opening - sheared)
