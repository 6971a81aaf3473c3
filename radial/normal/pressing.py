"""Frictionless contact under a prescribed force or approach, by a search for the radius."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from math import exp, inf, isfinite, log
from typing import TYPE_CHECKING, Protocol, TypeVar

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
LARGEST_STEP = 0.7  # largest change of the logarithm of the radius in a step
LEAST_RADIUS = 1e-12  # least initial guess of the radius [m]
LEAST_POWER = 0.5  # least exponent of the power law of force or approach in the radius


class LoadedContact(Protocol):
    """Protocol of a solved contact of given radius, in the search for the contact radius of a load.

    radius    contact radius [length]
    load      normal force [force]
    approach  approach of the indenter since first contact [length]
    """

    @property
    def radius(self) -> float: ...

    @property
    def load(self) -> float: ...

    @property
    def approach(self) -> float: ...


C = TypeVar("C", bound=LoadedContact)


@dataclass(frozen=True)
class Target:
    """Prescribed normal load of a contact: a normal force, or an approach with an optional spring.

    Either `force` or `approach` is None. The search for the contact radius compares solved contacts
    with this load.

    force     prescribed normal force [force]
    approach  prescribed approach of the far end of the spring [length]
    spring    compliance of the normal spring of a rig (test machine); 0 without a spring
              [length/force]
    """

    force: float | None
    approach: float | None
    spring: float = 0.0

    @property
    def prescribed_value(self) -> float:
        """Prescribed value: the normal force [force], or the approach [length].

        The approach is that of the far end of the rig's spring.
        """
        value = self.approach if self.force is None else self.force
        assert value is not None
        return value

    def controlled_value(self, contact: LoadedContact) -> float:
        """Return the normal force or approach of a solved contact: the one that is prescribed.

        The approach includes the shortening of the rig's spring.

        contact  solved contact of a trial radius
        """
        return self.actuator_approach(contact) if self.force is None else contact.load

    def residual(self, contact: LoadedContact) -> float:
        """Return log(computed/prescribed) of the normal force or approach of a solved contact [1].

        The search for the contact radius finds the zero of this residual. Raises UnsupportedScene
        if the computed value is not positive. The contact radius is then beyond the end of the
        shape (the equator of a sphere), or within a flat on the axis.

        contact  solved contact of a trial radius
        """
        value = self.controlled_value(contact)
        if not (value > 0 and isfinite(value)):
            raise UnsupportedScene(
                f"no contact of radius {contact.radius:.3g} m carries the load: the shape is flat "
                "there, or ends (the equator of a sphere). Use a smaller force or approach, or the "
                "semi-analytical solver"
            )
        return log(value / self.prescribed_value)

    def actuator_approach(self, contact: LoadedContact) -> float:
        """Return the approach of the far end of the rig's spring for a solved contact [length].

        The value is the approach of the contact plus the shortening of the spring by the normal
        force.

        contact  solved contact
        """
        return contact.approach + self.spring * contact.load


@dataclass(frozen=True)
class NormalContact:
    """Solution of the frictionless contact under a prescribed normal force or approach.

    contact     solved contact, with its radius and pressure
    target      prescribed normal force or approach
    iterations  number of contact radii tried in the search for the contact radius
    """

    contact: Disc
    target: Target
    iterations: int

    @property
    def normal_force(self) -> float:
        """Normal force on the indenter [force].

        The value is the prescribed force, or the computed force under a prescribed approach.
        """
        return self.contact.load if self.target.force is None else self.target.force

    @property
    def approach(self) -> float:
        """Approach of the indenter [length].

        With a spring in the rig (test machine) the value is the approach of the far end of the
        spring. It is the prescribed approach, or the computed one under a prescribed force.
        """
        prescribed = self.target.approach
        return self.target.actuator_approach(self.contact) if prescribed is None else prescribed


def normal_contact(
    bodies: Bodies,
    indenter: ShapedBody,
    target: Target,
    fineness: int = 1,
    most: int | None = None,
    tolerance: float = ROUND_OFF,
) -> NormalContact:
    """Solve the frictionless contact of bodies of revolution under a prescribed force or approach.

    The contact radius is found by a secant method. If the contact reaches the rim of the indenter,
    the contact radius is that of the rim.

    bodies     normal response of both bodies
    indenter   shape of the indenter
    target     prescribed normal force or approach
    fineness   factor on the numbers of polynomials and quadrature points, 1 by default
    most       largest number of polynomials, for estimates; None without a limit
    tolerance  bound of the relative error of force or approach
    raises     NotConverged, and UnsupportedScene for a gap that is not smooth
    """
    solve = partial(disc, bodies, indenter, fineness=fineness, most=most)
    if indenter.rim is not None:
        whole = solve(indenter.rim)
        if target.prescribed_value > target.controlled_value(whole):
            return NormalContact(_contact_at_rim(solve, target, whole), target, 1)
    radius = lower_radius_estimate(bodies, indenter, target)
    contact, iterations, _ = contact_at_target(solve, target, radius, 2.0, tolerance)
    return NormalContact(contact, target, iterations)


def contact_at_target(
    solve: Callable[[float], C],
    target: Target,
    radius: float,
    power: float,
    tolerance: float = ROUND_OFF,
) -> tuple[C, int, float]:
    """Find the contact radius at which a contact has the prescribed normal force or approach.

    The unknown is the logarithm of the contact radius, and the method is the secant method. The
    function returns the solved contact, the number of radii tried, and the exponent b of the local
    power law: force (or approach) proportional to the radius to the power b.

    solve      function that solves the contact of a given radius [length]
    target     prescribed normal force or approach
    radius     initial guess of the contact radius [length]
    power      expected exponent b, for the first secant step
    tolerance  bound of the relative error of force or approach
    raises     NotConverged, and the errors of `solve`
    """
    best, nearest, last, x = None, inf, inf, log(radius)
    last_x = x
    for iterations in range(1, MAX_ITERATIONS + 1):
        contact = solve(exp(x))
        if x < last_x and not target.controlled_value(contact) > 0:  # within a flat on the axis
            x = 0.5 * (x + last_x)
            continue
        residual = target.residual(contact)
        if best is not None and nearest <= NEAR and abs(residual) >= nearest:
            return best, iterations, power
        if abs(residual) < nearest:
            best, nearest = contact, abs(residual)
        if best is not None and nearest <= tolerance:
            return best, iterations, power
        if last < inf and x != last_x:
            power = max((residual - last) / (x - last_x), LEAST_POWER)
        last_x, last = x, residual
        x -= min(max(residual / power, -LARGEST_STEP), LARGEST_STEP)
    raise NotConverged("the contact radius", MAX_ITERATIONS, nearest, ROUND_OFF)


def _contact_at_rim(solve: Callable[..., Disc], target: Target, whole: Disc) -> Disc:
    """Solve the contact over the whole face of an indenter with a rim.

    Force and pressure are linear in the approach, so that two contacts determine the solution:
    `whole`, which just reaches the rim, and a second one.
    """
    missing = further = target.prescribed_value - target.controlled_value(whole)
    if target.force is not None:
        further = missing / (2 * whole.bodies.modulus * whole.radius)
    probe = solve(whole.radius, whole.approach + further)
    further *= missing / (target.controlled_value(probe) - target.controlled_value(whole))
    return solve(whole.radius, whole.approach + further)


def lower_radius_estimate(bodies: Bodies, indenter: ShapedBody, target: Target) -> float:
    """Estimate the contact radius from below under a prescribed load, as an initial guess [length].

    Under a prescribed approach the estimate is about the radius r at which the undeformed gap f(r)
    equals the approach. Under a prescribed force, E r f(r) equals the force, with the upper bound E
    of all moduli. An estimate from below saves time, because larger radii are more expensive with
    layers.

    bodies    normal response of both bodies
    indenter  shape of the indenter
    target    prescribed normal force or approach
    """
    modulus = bodies.stiffest

    def short(r: float) -> bool:
        """Return true if a trial radius is smaller than the lower estimate of the contact radius.

        The trial radius is doubled or halved until the answer changes.

        r  trial radius [length]
        """
        gap = float(indenter.initial_gap(r, 0.0))
        if target.force is None:
            return gap < (target.approach or 0.0)
        return modulus * r * gap < target.force

    r, factor = 1.0, 2.0 if short(1.0) else 0.5
    while short(r) == (factor > 1) and LEAST_RADIUS < r < 1 / LEAST_RADIUS:
        r *= factor
    # Within a flat on the axis there is no load.
    return r if float(indenter.initial_gap(r, 0.0)) > 0 else 2.0 * r
