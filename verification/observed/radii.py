"""States of the contact surface from results of the radial solver, for the evaluation of the laws.

On a disc r = a sin φ, integrals are those of a spline in φ, because tractions fall to zero or rise
as a root at the edge. Tractions at points on rings are hat functions (piecewise linear in r), which
are integrated exactly. The angles of the points have equal weights. Between these angles the solver
interpolates: there the shear is within its limit, but opposite to the slip only approximately.

At points on rings, gap and relative motion are computed again from the tractions. On a disc without
slip during indentation, a contact has the normal displacement δ - f and a tangential displacement
of slip and rigid motion. δ is the approach and f the initial gap. Otherwise particles move relative
to each other before first contact, and the stored energy is not recomputed.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from scipy.interpolate import CubicSpline

from contact_scene.array_types import Field
from contact_scene.friction import FRICTIONLESS
from radial import Increment, Result
from verification.observed.contact_state import (
    BISECTED,
    FEW_RINGS,
    ContactState,
)
from verification.observed.ring_displacement import RingDisplacement
from verification.observed.ring_points import (
    RingPoints,
    angle_weights,
    displacement_per_motion,
    gap_difference,
    sum_over_hats,
)

# Smallest numbers of rings for integrals: inside a disc, inside its slip annulus, and inside a
# contact on hat functions.
FEWEST = 48
IN_ANNULUS = 96
FEWEST_HATS = 8
# Growth of the radius of a disc above which the solver divides the increment.
GROWTH = 1.1
GAUSS = np.polynomial.legendre.leggauss(4)


def states_on_radii(result: Result) -> list[ContactState]:
    """Collect the state of the contact surface at the end of each increment of a radial solver's
    result.
    """
    states, before, under_shear = list[ContactState](), None, False
    on_disc, coupled = result.plan.circle is None, result.plan.coupled
    elastic = None if on_disc else _elastic(result)
    for now in result.increments:
        few = _has_few_rings(now, result)
        grown = before is None or now.contact_radius > GROWTH * before.contact_radius
        # Particles move relative to the indenter before their contact.
        under_shear |= any(now.tangential_force or ()) and (
            before is None or now.contact_radius > before.contact_radius
        )
        lacking = FEW_RINGS if few or (before and _has_few_rings(before, result)) else ""
        slips = now.in_contact & ~np.asarray(False if now.in_stick is None else now.in_stick)
        annulus = FEW_RINGS if on_disc and np.count_nonzero(slips) < IN_ANNULUS else ""
        bisected = BISECTED if now.halvings else ""
        # The solver uses intermediate states, which the result does not contain.
        divided = BISECTED if on_disc and coupled and grown else bisected
        states.append(
            replace(
                _state_on_radii(now, result, elastic, few=few),
                open=lacking or divided,
                unseen=bisected or lacking or annulus,
                told=few or (on_disc and (coupled or under_shear)),
            )
        )
        before = now
    return states


def _elastic(result: Result) -> RingDisplacement:
    """Create the elastic displacement of the rings of a result."""
    last = result.increments[-1]
    highest = 0 if last.angles is None else result.plan.highest
    return RingDisplacement(result.scene, last.radii, highest)


def _state_on_radii(
    now: Increment, result: Result, elastic: RingDisplacement | None, *, few: bool
) -> ContactState:
    """Create the state of the contact surface at the end of one increment of the radial solver.

    now     increment
    result  result of the increment
    elastic displacement of points on rings by their tractions; None on discs
    few     True if the contact has too few rings for integrals; the points then have equal weights,
            and the state has no balances
    """
    r, gap = now.radii, result.scene.indenter.initial_gap
    p = now.pressure.reshape(len(r), -1)
    nothing = np.zeros_like(p)
    q, slip = (
        np.stack([nothing if v is None else v.reshape(p.shape) for v in vector])
        for vector in (
            (now.shear_radial, now.shear_circumferential),
            (now.slip_radial, now.slip_circumferential),
        )
    )
    arm, f, weights = r, gap(r, 0.0), np.ones_like(r)
    if few:
        pass
    elif result.plan.circle is None:
        ends = result.scene.indenter.rim is None
        weights = _weights_on_disc(r, now.contact_radius, ends=ends)
    else:
        weights = _over_hats(r, np.ones_like)
        arm, f = (_over_hats(r, g) / weights for g in (lambda r: r, lambda r: gap(r, 0.0)))
    angles = np.zeros(1) if now.angles is None else now.angles
    w = weights[:, None] * angle_weights(angles)
    limit = (result.scene.friction or FRICTIONLESS).at_radii(r[:, None]).limit(p)
    driven = displacement_per_motion(arm, angles, along=now.angles is not None)
    points = RingPoints(w, arm, driven, np.broadcast_to(f[:, None], p.shape))
    state = points.state(
        now,
        result.plan.direction,
        p,
        q,
        slip,
        limit,
        force=float(np.sum(w * p)),
        turning=(float(np.sum(w * limit)) or now.normal_force) * now.contact_radius,
    )
    opened = now.gap.reshape(p.shape)
    state = replace(state, gap=opened, least_work=now.dissipated_energy or 0.0)
    if few:
        return replace(state, balances=())
    if elastic is None:
        return state
    u = elastic.by(np.stack([*q, p]), angles)
    opening, passed = points.gap(now, u[2]), points.passed(state, u[:2])
    passed[:, 0] = slip[:, 0]  # the axis is one point with the mean of its angles
    return replace(
        state,
        gap=opening,
        passed=None if now.dissipated_energy is None else passed,
        stated=(gap_difference(p, opening, opened, now.approach),),
        between=now.angles is not None,
    )


def _has_few_rings(now: Increment, result: Result) -> bool:
    """Determine if the contact contains too few rings for accurate integrals of the tractions."""
    fewest = FEWEST if result.plan.circle is None else FEWEST_HATS
    return bool(np.count_nonzero(now.radii < now.contact_radius) < fewest)


def _weights_on_disc(r: Field, radius: float, *, ends: bool) -> Field:
    """Compute areas of rings for the integration of a traction over a disc by a spline [length²].

    The integral is the sum of the values at the rings times these areas.

    r       radii of the rings [length]
    radius  radius of the disc [length]
    ends    True if tractions fall to zero at the edge
    """
    inside = (r < radius) & (r > 0)
    phi = np.arcsin(r[inside] / radius)
    # The integrand vanishes on the axis, and at the edge unless tractions rise there.
    nodes = np.concatenate([[0.0], phi, [np.pi / 2] if ends else []])
    parts = CubicSpline(nodes, np.eye(len(nodes))).integrate(0.0, np.pi / 2)
    weights = np.zeros_like(r)
    weights[inside] = parts[1 : len(phi) + 1]
    weights[inside] *= 2 * np.pi * radius**2 * np.sin(phi) * np.cos(phi)
    return weights


def _over_hats(r: Field, function: Callable[[Field], Field]) -> Field:
    """Compute 2π ∫ ψ g r dr for the hat function ψ of each ring, shape (rings,).

    A hat function is 1 at its ring, 0 at all other rings, and linear in between.

    r         radii of the rings [length]
    function  function g of the radius
    """
    nodes, shares = GAUSS
    v, length = (1 + nodes) / 2, np.diff(r)[:, None]
    at = r[:-1, None] + length * v
    return sum_over_hats(np.pi * function(at) * at * length * shares, v)
