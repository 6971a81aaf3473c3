"""Frictionless contact under a prescribed force or approach. The contact radius is the unknown."""

from __future__ import annotations

from dataclasses import dataclass
from math import exp, inf, isfinite, log
from typing import TYPE_CHECKING, Protocol

from contact_scene.solver_errors import NotConverged, UnsupportedScene
from radial.normal.disc import (
    Disc,
    disc,
)
from radial.response.bodies import Bodies

if TYPE_CHECKING:
    from contact_scene.geometry import ShapedBody

MAX_ITERATIONS = 60
# Smallest relative error of the force or approach that the iteration can reach.
ROUND_OFF = 1e-13
# Relative error at which the iteration may stop without progress, due to round-off with unlike
# materials.
NEAR = 1e-9
LARGEST_STEP = 0.7  # of the logarithm of the radius
LEAST_RADIUS = 1e-12  # [m]
LEAST_POWER = 0.5  # least exponent of the power law of force or approach in the radius


class Loaded(Protocol):
    """Contact with its radius [length], load [force] and approach [length]."""

    @property
    def radius(self) -> float: ...

    @property
    def load(self) -> float: ...

    @property
    def approach(self) -> float: ...


@dataclass(frozen=True)
class Target:
    """Prescribed normal force [force] or approach [length].

    spring  compliance of the normal spring of a rig [length/force]; the approach is that of its far
            end
    """

    force: float | None
    approach: float | None
    spring: float = 0.0

    def residual(self, contact: Loaded) -> float:
        """Return log(value of the contact / prescribed value).

        Raises UnsupportedScene for a contact beyond the end of the shape, whose load is not
        positive.
        """
        has, prescribed = contact.load, self.force
        if prescribed is None:
            assert self.approach is not None
            has, prescribed = self.actuator_approach(contact), self.approach
        if not (has > 0 and isfinite(has)):
            raise UnsupportedScene(
                f"no contact of radius {contact.radius:.3g} m carries the load: the contact "
                "reaches the end of the shape (the equator of a sphere). Use "
                "a smaller force or approach"
            )
        return log(has / prescribed)

    def is_beyond(self, contact: Disc) -> bool:
        """Return true if the prescribed value exceeds that of the contact."""
        if self.force is not None:
            return self.force > contact.load
        assert self.approach is not None
        return self.approach > self.actuator_approach(contact)

    def actuator_approach(self, contact: Loaded) -> float:
        """Return the approach of the far end of the spring [length]."""
        return contact.approach + self.spring * contact.load


@dataclass(frozen=True)
class NormalContact:
    """Contact at a target, and the number of contact radii tried."""

    contact: Disc
    target: Target
    iterations: int

    @property
    def normal_force(self) -> float:
        """Return the prescribed or computed normal force [force]."""
        return self.contact.load if self.target.force is None else self.target.force

    @property
    def approach(self) -> float:
        """Return the prescribed or computed approach [length]."""
        prescribed = self.target.approach
        return self.target.actuator_approach(self.contact) if prescribed is None else prescribed


def normal_contact(
    bodies: Bodies, indenter: ShapedBody, target: Target, fineness: int = 1
) -> NormalContact:
    """Solve the contact at a target by the secant method for the radius.

    Raises NotConverged, and UnsupportedScene for a gap that is not smooth.

    fineness  multiple of the numbers of orders and points
    """
    if indenter.rim is not None:
        whole = disc(bodies, indenter, indenter.rim, fineness=fineness)
        if target.is_beyond(whole):
            return NormalContact(
                _contact_at_rim(bodies, indenter, target, whole, fineness), target, 1
            )
    x, power = log(first_radius(bodies, indenter, target)), 2.0
    best, nearest = None, inf
    last_x, last = x, inf
    for iterations in range(1, MAX_ITERATIONS + 1):
        contact = disc(bodies, indenter, exp(x), fineness=fineness)
        residual = target.residual(contact)
        if best is not None and nearest <= NEAR and abs(residual) >= nearest:
            return NormalContact(best, target, iterations)
        if abs(residual) < nearest:
            best, nearest = contact, abs(residual)
        if best is not None and nearest <= ROUND_OFF:
            return NormalContact(best, target, iterations)
        if last < inf:
            power = max((residual - last) / (x - last_x), LEAST_POWER)
        last_x, last = x, residual
        x -= min(max(residual / power, -LARGEST_STEP), LARGEST_STEP)
    raise NotConverged("the contact radius", MAX_ITERATIONS, nearest, ROUND_OFF)


def _contact_at_rim(
    bodies: Bodies, indenter: ShapedBody, target: Target, whole: Disc, fineness: int
) -> Disc:
    """Return the contact bounded by a rim. Its load is linear in the approach.

    whole  contact that just reaches the rim
    """
    if target.force is not None:
        missing = target.force - whole.load
        further = missing / (2 * bodies.modulus * whole.radius)
    else:
        assert target.approach is not None
        missing = further = target.approach - target.actuator_approach(whole)
    probe = disc(bodies, indenter, whole.radius, whole.approach + further, fineness)
    by_force = target.force is not None
    has = (
        probe.load - whole.load
        if by_force
        else target.actuator_approach(probe) - target.actuator_approach(whole)
    )
    further *= missing / has
    return disc(bodies, indenter, whole.radius, whole.approach + further, fineness)


def first_radius(bodies: Bodies, indenter: ShapedBody, target: Target) -> float:
    """Return a lower estimate of the contact radius as a starting value [length].

    It is the radius at which the gap equals the approach, or at which E* r f(r) equals the force
    with the largest modulus. Larger radii are more expensive with layers.
    """
    modulus = bodies.stiffest

    def short(r: float) -> bool:
        gap = float(indenter.initial_gap(r, 0.0))
        if target.force is None:
            return gap < (target.approach or 0.0)
        return modulus * r * gap < target.force

    r, factor = 1.0, 2.0 if short(1.0) else 0.5
    while short(r) == (factor > 1) and LEAST_RADIUS < r < 1 / LEAST_RADIUS:
        r *= factor
    return r
