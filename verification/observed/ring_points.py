"""Points of a contact surface on rings and angles: weights, motions, loads and harmonics.

Vector fields have components along r and θ. The angles are counted from the direction of the
tangential load. They are one angle for axisymmetric fields, half the circle with both ends, or the
whole circle.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from contact_scene.array_types import Field
from verification.norms import max_norm
from verification.observed.contact_state import Balance, ContactState

ABSENT = 1e-9  # below this mean square a wave is zero at all angles, up to round-off


def angle_weights(angles: Field) -> Field:
    """Return the weights (angles,) of means over a circle; both ends of half a circle are included.

    angles  angles of the points, one, half a circle or the whole circle [radian]
    """
    weights = np.ones(len(angles))
    if _is_half(angles):
        weights[[0, -1]] = 0.5
    return weights / np.sum(weights)


def displacement_per_motion(arms: Field, angles: Field, *, along: bool) -> Field:
    """Return the displacement r, θ of the points (3, 2, rings, angles) per unit motion.

    The motions are the shifts along and across the load [1], and the twist [length]. Motions that
    the symmetry of the fields excludes have zero displacement.

    arms    distance of each ring from the axis, as a mean over the ring (rings,) [length]
    angles  angles of the points [radian]
    along   True if the fields admit a shift along the load
    """
    cos, sin = np.cos(angles), np.sin(angles)
    found = np.zeros((3, 2, len(arms), len(angles)))
    if along:
        found[0] = np.stack([cos, -sin])[:, None]
    if _is_half(angles):
        return found
    if len(angles) > 1:
        found[1] = np.stack([sin, cos])[:, None]
    found[2, 1] = arms[:, None]
    if len(angles) > 1:
        found[2, :, 0] = 0.0  # the axis is one point
    return found


def loads_and_motions(increment: Any, along: tuple[float, float]) -> tuple[Field, Field | None]:
    """Return the tangential loads and the tangential motions of the indenter, each (3,).

    The loads are the forces along and across the load, and the torque. The motions are the shifts
    and the twist. They are None if one of them is undefined.

    along  unit vector of the direction of the load
    """
    x, y = along
    axes = np.array([[x, y], [-y, x]])
    forces = np.array([*axes @ (increment.tangential_force or (0.0, 0.0)), increment.torque or 0.0])
    shift, twist = increment.tangential_shift, increment.twist
    unknown = shift is None and increment.tangential_force is not None
    if unknown or (twist is None and increment.torque is not None):
        return forces, None
    return forces, np.array([*axes @ (shift or (0.0, 0.0)), twist or 0.0])


@dataclass(frozen=True)
class RingPoints:
    """Points of a contact surface on rings and angles, for the states of all increments.

    weights     area of the points (rings, angles) [length²]
    arms        mean distance of each ring from the axis (rings,) [length]
    driven      displacement r, θ of the points (3, 2, rings, angles) per unit motion
    undeformed  gap before any load (rings, angles) [length]
    """

    weights: Field
    arms: Field
    driven: Field
    undeformed: Field

    def state(
        self,
        now: Any,
        along: tuple[float, float],
        pressure: Field,
        shear: Field,
        slip: Field,
        limit: Field,
        *,
        force: float,
        turning: float,
    ) -> ContactState:
        """Create the state of an increment, whose gap and motion of the surfaces are still zero.

        now      increment of any solver
        along    unit vector of the direction of the load
        force    normal force that the pressure carries [force]
        turning  torque at gross slip, the scale of the balance of the torque [force*length]
        """
        loads, motions = loads_and_motions(now, along)
        moved = np.zeros(3) if motions is None else motions
        carried = np.sum(self.weights * self.driven * shear, axis=(1, 2, 3))
        most = float(np.sum(self.weights * limit)) or now.normal_force
        balances = [Balance(force, now.normal_force, now.normal_force)]
        if np.any(shear) or np.any(limit):
            balances.append(Balance(carried[:2], loads[:2], most))
            if now.torque is not None and turning:
                balances.append(Balance(carried[2], loads[2], turning))
        outward = float(np.sum(self.weights * self.arms[:, None] * shear[0]))
        return ContactState(
            now,
            self.weights,
            self.undeformed,
            pressure,
            np.zeros_like(pressure),
            shear,
            limit,
            slip,
            slip,
            np.array([now.normal_force, *loads, outward]),
            np.array([now.approach, *moved, -_strain(now)]),
            abs(now.approach),
            tuple(balances),
        )

    def gap(self, now: Any, normal: Field) -> Field:
        """Compute the gap from the normal displacement of the surfaces [length]."""
        return np.asarray(self.undeformed + normal - now.approach)

    def passed(self, state: ContactState, along: Field) -> Field:
        """Compute the motion of the lower surface relative to the indenter [length].

        state  state of the increment, with the motions of the indenter
        along  displacement r, θ of the surfaces by the tractions (2, rings, angles) [length]
        """
        passed = along - np.tensordot(state.motions[1:4], self.driven, axes=1)
        passed[0] += _strain(state.increment) * self.arms[:, None]
        return np.asarray(passed)


def gap_difference(pressure: Field, gap: Field, stated: Field, depth: float) -> float:
    """Compute the largest difference of a computed gap from the stated gap, over the depth [1].

    In contact the stated gap has to be zero.
    """
    return max_norm(np.where(pressure > 0, 0.0, gap) - stated) / depth


def _strain(increment: Any) -> float:
    return 0.0 if increment.bulk_strain is None else float(increment.bulk_strain[0])


def sum_over_hats(parts: Field, share: Field) -> Field:
    """Sum integrals over intervals between rings with the hat function of each ring (…, rings).

    parts  values times weights at the integration points (…, intervals, points)
    share  places of the points in an interval, from 0 at the inner to 1 at the outer ring
    """
    inner, outer = parts @ (1 - share), parts @ share
    ends = np.zeros((*inner.shape[:-1], 1))
    return np.append(inner, ends, -1) + np.append(ends, outer, -1)


def displacement_by_harmonics(
    tractions: Field, angles: Field, highest: int, respond: Callable[[int, bool, Field], Field]
) -> Field:
    """Compute the displacement r, θ, z of the points as a sum over harmonics of the tractions.

    tractions  shear r, θ and pressure at the rings and angles (3, rings, angles) [force/length²]
    angles     angles of the points [radian]
    highest    highest harmonic
    respond    function of the harmonic m, of True for its waves sin mθ, -cos mθ, sin mθ and False
               for cos mθ, sin mθ, cos mθ, and of the amplitudes of the tractions (3, rings), that
               returns the amplitudes of the displacement (3, rings) [length]
    """
    found, weights = np.zeros_like(tractions), angle_weights(angles)
    for m in range(highest + 1):
        cos, sin = np.cos(m * angles), np.sin(m * angles)
        waves = np.stack([cos, sin, cos]), np.stack([sin, -cos, sin])
        for turned, wave in enumerate(waves[:1] if _is_half(angles) else waves):
            norms = np.sum(weights * wave**2, axis=1)
            loads = np.einsum("cra,ca,a->cr", tractions, wave, weights)
            loads /= np.where(norms > ABSENT, norms, np.inf)[:, None]
            if np.any(loads):
                found += respond(m, bool(turned), loads)[:, :, None] * wave[:, None]
    return found


def _is_half(angles: Field) -> bool:
    return len(angles) > 1 and bool(angles[-1] <= np.pi)
