"""Laws of contact, evaluated from the fields of the radial solver.

On a disc r = a sin φ integrals are those of a spline in φ, because tractions fall to zero or rise
as a root at the edge. Tractions at points on rings are hat functions (piecewise linear in r), which
are integrated exactly. The angles of the points have equal weights. Between these angles the solver
interpolates: there the shear is within its limit, but opposite to the slip only approximately.

Without friction during indentation a contact has the normal displacement δ - f, and a tangential
displacement of slip and rigid motion. Otherwise particles move relative to each other before first
contact, and the stored energy is not recomputed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from contact_scene.friction import FRICTIONLESS
from radial import Increment, Result
from verification.observed.prescribed import Imbalance, largest_of, missed

Field = NDArray[np.float64]

# Rings inside a disc, inside its slip annulus, and inside a contact on hats; over fewer nothing is
# integrated.
FEWEST, IN_ANNULUS, FEWEST_HATS = 48, 96, 8
LEAST_SLIP = 1e-3  # of the approach: less slip has no direction
GROWTH = 1.1  # of the radius of a disc; where it grows more the solver divides the increment
GAUSS = np.polynomial.legendre.leggauss(4)


def ring_laws(result: Result) -> tuple[float, float]:
    """Return the largest violation of a law and the largest energy difference of any increment.

    The energy difference is that of the fields from the stated energies. Both are dimensionless,
    and infinite if a number is not finite.
    """
    nows = [_Surface.of(increment, result) for increment in result.increments]
    befores: list[_Surface | None] = [None, *nows]
    pairs = list(zip(befores, nows, strict=False))
    violations = [v for before, now in pairs for v in _violations(before, now)]
    violations += missed(result.scene, result.steps)
    imbalances, largest = list[Imbalance](), 0.0
    for number, (before, now) in enumerate(pairs, start=1):
        largest = max(
            largest, now.increment.elastic_energy or 0.0, abs(now.increment.input_work or 0.0)
        )
        for name, energy, stated in _energies(before, now):
            terms = {name: energy, "stated": stated}
            imbalances.append(Imbalance(number, largest, energy - stated, **terms))
    return largest_of(violations), largest_of(imbalances)


@dataclass(frozen=True)
class _Surface:
    """Fields of an increment at positions (rings, angles).

    arm                 distance from the axis, on hat functions its mean [length]
    weights             area of the positions [length^2]; None for contacts with too few rings
    f                   undeformed gap, on hat functions its mean; zero without pressure [length]
    q, s                shear and slip, radial and circumferential (2, rings, angles)
    limit               of friction [force/length^2]
    along               unit vector at angle zero
    on_disc             true for fields on a disc, false for hat functions
    slips_when_pressed  true if particles slip during indentation
    """

    increment: Increment
    arm: Field
    weights: Field | None
    f: Field
    p: Field
    q: Field
    s: Field
    limit: Field
    along: tuple[float, float]
    on_disc: bool
    slips_when_pressed: bool

    @classmethod
    def of(cls, now: Increment, result: Result) -> _Surface:
        r, shape = now.radii, (len(now.radii), -1)
        p = now.pressure.reshape(shape)
        q, s = (
            np.stack([np.zeros_like(p) if v is None else v.reshape(shape) for v in vector])
            for vector in (
                (now.shear_radial, now.shear_circumferential),
                (now.slip_radial, now.slip_circumferential),
            )
        )
        gap = result.scene.indenter.initial_gap
        ends = result.scene.indenter.rim is None
        arm, f = r, gap(r, 0.0)
        weights = None
        if is_small(now, result):
            pass
        elif result.plan.circle is None:
            weights = _weights_on_disc(r, now.contact_radius, ends=ends)
        else:
            weights = _over_hats(r, np.ones_like)
            arm, f = (_over_hats(r, g) / weights for g in (lambda r: r, lambda r: gap(r, 0.0)))
        return cls(
            increment=now,
            arm=arm[:, None],
            weights=None if weights is None else weights[:, None] * _shares(now.angles),
            f=np.where(p > 0, f[:, None], 0.0),
            p=p,
            q=q,
            s=s,
            limit=(result.scene.friction or FRICTIONLESS).limit(p),
            along=result.plan.direction,
            on_disc=result.plan.circle is None,
            slips_when_pressed=result.plan.coupled,
        )

    def over(self, field: Field) -> float:
        """Compute ∫ f dA."""
        assert self.weights is not None
        return float(np.sum(self.weights * field))

    def resisted(self, strained: Increment) -> float:
        """Compute ∫ q_r r dA times the strain of an increment [force length]."""
        strain = 0.0 if strained.bulk_strain is None else strained.bulk_strain[0]
        return strain * self.over(self.arm * self.q[0]) if strain else 0.0

    def divided(self, before: _Surface | None) -> bool:
        """Return true if the solver used intermediate states, which the result does not contain."""
        last = None if before is None else before.increment
        grown = last is None or self.increment.contact_radius > GROWTH * last.contact_radius
        return self.increment.halvings > 0 or (self.on_disc and self.slips_when_pressed and grown)

    @property
    def carried(self) -> Field:
        """Forces in x and y and moment about the axis, of the shear (3,)."""
        outward, around = self.q
        if self.increment.angles is None:
            return np.array([0.0, 0.0, self.over(self.arm * around)])
        cos, sin = np.cos(self.increment.angles), np.sin(self.increment.angles)
        ahead = self.over(outward * cos - around * sin)
        x, y = self.along
        if self.increment.angles[-1] <= np.pi:  # the other half is the mirror image
            return np.array([x * ahead, y * ahead, 0.0])
        aside = self.over(outward * sin + around * cos)
        return np.array(
            [x * ahead - y * aside, y * ahead + x * aside, self.over(self.arm * around)]
        )


def is_small(now: Increment, result: Result) -> bool:
    """Return true if the contact has too few rings for integrals."""
    fewest = FEWEST if result.plan.circle is None else FEWEST_HATS
    return bool(np.count_nonzero(now.radii < now.contact_radius) < fewest)


def _weights_on_disc(r: Field, radius: float, *, ends: bool) -> Field:
    """Compute the weights of rings in the integral over a disc.

    ends  true if tractions fall to zero at the edge
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
    """Compute 2π ∫ ψ g r dr for the hat functions ψ of the rings."""
    nodes, shares = GAUSS
    v, length = (1 + nodes) / 2, np.diff(r)[:, None]
    at = r[:-1, None] + length * v
    part = np.pi * function(at) * at * length * shares
    return np.append(part @ (1 - v), 0.0) + np.append(0.0, part @ v)


def _shares(angles: Field | None) -> Field:
    """Return the weights of the angles, of a full circle or of a half circle with both ends."""
    if angles is None:
        return np.ones(1)
    shares = np.ones(len(angles))
    if angles[-1] <= np.pi:
        shares[[0, -1]] = 0.5
    return shares / np.sum(shares)


def _violations(before: _Surface | None, now: _Surface) -> Iterator[float]:
    increment, p, gap = now.increment, now.p, now.increment.gap.reshape(now.p.shape)
    open_gap = np.where(np.isposinf(gap), 0.0, gap)
    yield float(np.max(-p) / np.max(p))
    yield float(np.max(-open_gap) / increment.approach)
    yield float(np.max(p * np.abs(open_gap)) / (np.max(p) * increment.approach))
    if now.weights is None:
        return
    yield abs(now.over(p) / increment.normal_force - 1)
    if not (np.any(now.q) or np.any(now.limit)):
        return
    # The arm of an empty limit is no scale: without friction any shear is too much.
    most = now.over(now.limit) or increment.normal_force
    yield float(np.max(np.hypot(*now.q) - now.limit)) / (np.max(now.limit) or np.max(p))
    due = np.array([*(increment.tangential_force or (0.0, 0.0)), increment.torque or 0.0])
    missing = np.abs(now.carried - due) / most
    yield from missing[:2]
    if increment.torque is not None:
        yield float(missing[2]) / increment.contact_radius
    if increment.angles is None and before is not None and not now.divided(before):
        passed = np.hypot(*(now.s - before.s)).ravel()
        sticks = np.asarray(increment.in_stick) & np.asarray(before.increment.in_stick)
        most_passed = max(float(np.max(passed)), LEAST_SLIP * increment.approach)
        yield float(np.max(passed, where=sticks, initial=0.0)) / most_passed
    if (
        now.on_disc
        and np.count_nonzero(increment.in_contact & ~np.asarray(increment.in_stick)) < IN_ANNULUS
    ):
        return
    way, start = now.s, 0.0 if before is None else before.limit
    so_far = increment.dissipated_energy or 0.0
    lost = so_far
    if before is not None:
        way, lost = way - before.s, so_far - (before.increment.dissipated_energy or 0.0)
    length = np.hypot(*way)
    least = LEAST_SLIP * most * increment.approach * most / increment.normal_force
    scale = max(now.over(now.limit * length), so_far, least)
    if not increment.halvings:  # else slip may have turned
        yield abs(now.over(now.limit * length + np.sum(now.q * way, axis=0))) / scale
    if not now.divided(before):
        yield abs(now.over(0.5 * (start + now.limit) * length) - lost) / scale


def _energies(before: _Surface | None, now: _Surface) -> Iterator[tuple[str, float, float]]:
    """Yield energies and work of the fields, and as the solver states them [force length]."""
    increment, last = now.increment, None if before is None else before.increment
    if now.weights is None or (before is not None and before.weights is None):
        return
    if now.divided(before):
        return
    stored, lost, work = (
        increment.elastic_energy,
        increment.dissipated_energy,
        increment.trapezoidal_work,
    )
    if stored is not None and not now.slips_when_pressed:
        by_motion = now.over(now.p * (increment.approach - now.f)) + _power(increment, increment)
        by_motion -= now.resisted(increment)
        yield "stored", 0.5 * (by_motion + now.over(np.sum(now.q * now.s, axis=0))), stored
    if work is not None:
        done = increment.normal_force * increment.approach + _power(increment, increment)
        if last is not None:
            force, depth = (
                increment.normal_force + last.normal_force,
                increment.approach - last.approach,
            )
            done = force * depth + 2 * (last.trapezoidal_work or 0.0)
            done += _power(increment, increment) - _power(increment, last) + _power(last, increment)
            done -= _power(last, last)
            if before is not None:
                resisted = [one.resisted(increment) - one.resisted(last) for one in (before, now)]
                done -= sum(resisted)
        yield "work", 0.5 * done, work
        if increment.unresolved_work is not None:
            yield (
                "stored and dissipated",
                (stored or 0.0) + (lost or 0.0),
                increment.input_work or 0.0,
            )


def _power(of: Increment, moved: Increment) -> float:
    """Compute the work of tangential force and torque of an increment on the motions of another."""
    force, shift = of.tangential_force or (0.0, 0.0), moved.tangential_shift or (0.0, 0.0)
    turned = (of.torque or 0.0) * (moved.twist or 0.0)
    return force[0] * shift[0] + force[1] * shift[1] + turned
