"""Radii of the edges of the contact and of the stick zone, resolved below the element size.

The pressure at the edge of a smooth contact is proportional to the square root of the distance from
the edge. For hat functions of equal width, the nodal values near the edge depend only on the
position of the edge in its element. The first ring without pressure is one element beyond the last
ring with pressure. The ratio of the last two positive values determines the position of the edge.

This relation is that of the plane contact of a parabola, solved with equal hat functions and the
kernel -ln|x| of a half-plane. Every smooth contact has this form close to its edge. Finite elements
at the edge deviate from a half-plane by a correction that depends on Poisson's ratio. The
difference between friction limit and shear has the same form at the edge of the stick zone
(Cattaneo 1938), without this correction.

With shear q p towards the edge, coupled bodies have a pressure proportional to the distance to the
power ½ + arctan(κ)/π with κ = β q (β: Dundurs' constant; Johnson 1985, section 5.5).

At Gauss points the squares of the values are fitted by a parabola in r², without the last element.
The part of the values that loads no node is removed before. The error of the radii is below 0.1 h
(h: element size) for any position of the edge in an element, and for penalties between 1 and
10 000.
"""

from dataclasses import dataclass
from itertools import pairwise
from math import atan, pi, sqrt
from typing import Protocol

import numpy as np

from contact_scene.array_types import Field, Mask
from contact_scene.body import Body
from fem_reference.compliance.gauss_points import POINTS_PER_EDGE, loading_part
from fem_reference.mesh.element_order import ELEMENTS

Beyond = tuple[float, ...]

# Distance of the edge from the last ring with pressure, in elements: coefficients of a cubic in the
# ratio of the last two values, fitted to plane contact with an error of 2e-5. A ring that the edge
# has just passed has no pressure yet. The distance is therefore limited by `FURTHEST`.
BEYOND = (0.02807, 1.00215, 0.12215, 0.01960)

FURTHEST = 1.05

# Increase of the distance x by shear towards the edge, over κ x². Sliding plane contacts of a
# parabola on hat functions have 0.49 to 0.63 for 0.05 < |κ| < 0.2 and any position of the edge.
BY_SHEAR = 0.55

# Values may decrease to zero like the distance to the power 1/2 or 3/2. The ratio of the preceding
# two values distinguishes the powers: it is at most 0.54 for 3/2 and at least 0.77 for 1/2.
# For 3/2, the ratio of the last two values is AT_NEXT_RING if the edge is at the next ring.
GAINING = 0.66
AT_NEXT_RING = 0.3

# Fit at Gauss points: least and largest distance of fitted points from the last point with a
# positive value, in elements, and least number of points.
FITTED = (1.2, 5.9)
FEWEST = 5
# Elements on both sides of the edge on which tractions that load no node are removed: more than
# are fitted, because a cut affects the adjacent elements.
SMOOTHED = 9


def beyond_pressure(*bodies: Body) -> Beyond:
    """Compute the polynomial that locates the contact edge beyond the last ring with pressure.

    The argument of the polynomial is the pressure at the last ring with pressure over that at the
    ring before. The value is the distance of the edge from the last ring with pressure, in
    elements. The coefficients depend on Poisson's ratio of the outermost materials, because finite
    elements deviate from a half-plane at the edge.

    bodies   the bodies in contact, at least one of them deformable; their corrections are averaged
             with weights proportional to 1/E' = (1 - ν²)/E of the outermost materials
    returns  coefficients of the cubic (4,), lowest power first
    """
    outermost = [body.elastic_materials[0] for body in bodies if body.deforms]
    gives = np.array([1.0 / m.plane_strain_modulus for m in outermost])
    ratios = np.polynomial.polynomial.polyvander([m.poisson_ratio for m in outermost], 2)
    return tuple((BEYOND + np.array(ELEMENTS.beyond) @ (gives @ ratios) / gives.sum()).tolist())


class Edge(Protocol):
    """Interface of rules that locate an edge of the contact or of the stick zone between two rings.

    At such an edge a traction decreases to zero like the square root of the distance from the edge.
    `HatEdge` is the rule for tractions at corner nodes, `GaussEdge` the rule for Gauss points.
    """

    @property
    def narrowest_hole(self) -> int:
        """Least number of adjacent rings without pressure that form a hole in the contact.

        The displacements of an element do not determine the pressure of each of its Gauss points.
        """

    @property
    def stick_rule(self) -> "Edge":
        """Rule that locates the edge of the stick zone, for use with this rule of the contact edge.

        The rule applies to the difference between the friction limit and the shear. This difference
        decreases to zero at the edge of the stick zone.
        """

    def radius(
        self, radii: Field, values: Field, last: int, step: int = 1, coupled: float = 0.0
    ) -> float:
        """Compute the radius between two rings at which a traction decreases to zero [length].

        The traction is the pressure, or the difference between friction limit and shear.

        radii    radii of the rings (n,) [length]
        values   traction at the rings (n,), positive at the ring `last` and before it, zero at the
                 next ring
        last     index of the last ring with a positive value
        step     +1 if the values decrease outwards, -1 if they decrease inwards
        coupled  κ: Dundurs' constant times shear towards the edge over pressure at the edge
        """


@dataclass(frozen=True)
class HatEdge:
    """Rule that locates the edge of contact or stick for tractions given at corner nodes.

    The tractions are linear between the nodes and zero beyond the edge. The distance of the edge
    from the last ring with a positive traction follows from the ratio of the last two positive
    tractions.

    beyond  coefficients of the polynomial from this ratio to the distance in elements, lowest power
            first
    """

    beyond: Beyond = BEYOND

    @property
    def narrowest_hole(self) -> int:
        """Least number of adjacent nodes without pressure that form a hole in the contact."""
        return 1

    @property
    def stick_rule(self) -> "HatEdge":
        """Rule that locates the edge of the stick zone: the polynomial of a half-plane.

        The correction for finite elements at the contact edge does not apply to the stick zone.
        """
        return HatEdge()

    def radius(
        self, radii: Field, values: Field, last: int, step: int = 1, coupled: float = 0.0
    ) -> float:
        """Compute the radius between two nodes at which a traction decreases to zero [length].

        The distance from the last node with a positive value follows from the ratio of the last two
        positive values.

        radii    radii of the corner nodes (n,) [length]
        values   traction at the nodes (n,), positive at the node `last` and before it, zero at the
                 next one
        last     index of the last node with a positive value
        step     +1 if the values decrease outwards, -1 if they decrease inwards
        coupled  κ: Dundurs' constant times shear towards the edge over pressure at the edge
        """
        before, after = last - step, last + step
        width = radii[after] - radii[last]
        if not 0 <= before < len(radii) or values[before] <= 0:
            return float(radii[last] + 0.5 * width)
        middle = radii[last] + 0.5 * width
        # On a circle √(a² - r²) = √(a - r) √(a + r): the second factor does not belong to the edge.
        circle = sqrt((middle + radii[before]) / (middle + radii[last]))
        ratio = min(1.0, values[last] / values[before] * circle)
        if 0 <= before - step < len(radii) and values[before] < GAINING * values[before - step]:
            beyond = (ratio / AT_NEXT_RING) ** (2 / 3)
        else:
            beyond = float(np.polynomial.polynomial.polyval(ratio, self.beyond))
            beyond += BY_SHEAR * coupled * beyond**2
        return float(radii[last] + width * min(FURTHEST, beyond))


@dataclass(frozen=True)
class GaussEdge:
    """Rule that locates the edge of contact or stick for tractions given at Gauss points.

    The Gauss points are those of the element edges on the surface. The squares of the tractions
    near the edge are fitted by a parabola in r², the square of the radius. The zero of the parabola
    is the edge.

    element         length of an element edge on the surface [length]
    whole_elements  True if the rings are all points of adjacent edges, so that tractions that load
                    no node can be removed
    power           power of r in the integrals of the tractions: 1, and 0 in plane strain
    """

    element: float
    whole_elements: bool = True
    power: int = 1

    @property
    def narrowest_hole(self) -> int:
        """Least number of adjacent Gauss points without pressure that form a hole: an element."""
        return POINTS_PER_EDGE

    @property
    def stick_rule(self) -> "GaussEdge":
        """Rule that locates the edge of the stick zone, equal to the rule for the contact edge.

        The tractions are given at Gauss points.
        """
        return self

    def radius(
        self, radii: Field, values: Field, last: int, step: int = 1, coupled: float = 0.0
    ) -> float:
        """Compute the radius between Gauss points at which a traction decreases to zero [length].

        Tractions that load no node are removed. The squares of the values near the edge (with
        shear, their powers 1/(½ + arctan(κ)/π)) are fitted by a parabola in r², whose zero is the
        result. If there are too few values or no zero nearby, the result is the middle between the
        last point and the next.

        radii    radii of the Gauss points (n,) [length]
        values   traction at the points (n,), positive at the point `last` and before it, zero at
                 the next one
        last     index of the last point with a positive value
        step     +1 if the values decrease outwards, -1 if they decrease inwards
        coupled  κ: Dundurs' constant times shear towards the edge over pressure at the edge
        """
        beyond = last + step
        middle, edge = radii[last], radii[last]
        if 0 <= beyond < len(radii):
            middle = 0.5 * (radii[last] + radii[beyond])
        at = last // POINTS_PER_EDGE
        near = slice(POINTS_PER_EDGE * max(0, at - SMOOTHED), POINTS_PER_EDGE * (at + SMOOTHED + 1))
        radii, values = radii[near], values[near]
        if self.whole_elements:
            values = loading_part(radii, values, self.power)
        behind = step * (edge - radii) / self.element
        fitted = (behind > FITTED[0]) & (behind < FITTED[1]) & (values > 0)
        if np.count_nonzero(fitted) < FEWEST:
            return float(middle)
        power = 1 / (0.5 + atan(coupled) / pi)
        parabola = np.polynomial.Polynomial.fit(radii[fitted] ** 2, values[fitted] ** power, 2)
        zeros = parabola.roots()
        real = np.sqrt(np.maximum(zeros.real[np.abs(zeros.imag) == 0], 0.0))
        found = real[np.abs(real - middle) < self.element]
        return float(found[np.argmin(np.abs(found - middle))] if len(found) else middle)


def contact_edge(
    radii: Field,
    pressure: Field,
    edge: Edge,
    reach: float | None = None,
    coupled: Field | None = None,
) -> float:
    """Compute the radius of the contact edge, at which the pressure decreases to zero [length].

    If the last ring carries pressure, the result is the outer end of the last element, as for a
    flat punch. Without pressure the result is 0.

    radii     radii of the rings (n,) [length]
    pressure  pressure at the rings (n,), not negative
    edge      rule for the radius between two rings
    reach     outer end of the last element [length]; None for the radius of the last ring
    coupled   Dundurs' constant times the outward shear at the rings (n,); None without coupling
    """
    carrying = np.flatnonzero(pressure > 0)
    if len(carrying) == 0:
        return 0.0
    last = int(carrying[-1])
    if last == len(radii) - 1:
        return float(radii[last] if reach is None else reach)
    at_edge = 0.0 if coupled is None else float(coupled[last] / pressure[last])
    return edge.radius(radii, pressure, last, coupled=at_edge)


def area_within(radius: float, *, plane: bool) -> float:
    """Return the area of a circle, or twice its radius for a strip of a line contact.

    radius  radius, or half width of the strip [length]
    plane   True in plane strain, in which areas are per unit length
    """
    return 2 * radius if plane else pi * radius**2


def holes(pressure: Field, edge: Edge) -> list[tuple[int, int]]:
    """Find the parts inside the contact edge in which the surfaces are separated.

    A stiff coating below a flat punch bends away from it between its middle and its rim.

    pressure  pressure at the rings (n,), not negative
    edge      rule for the radius between two rings
    returns   first ring of every hole, and first ring with pressure beyond the hole
    """
    carrying = [-1, *np.flatnonzero(pressure > 0).tolist()]
    return [(at + 1, after) for at, after in pairwise(carrying) if after - at > edge.narrowest_hole]


def area_of_holes(radii: Field, pressure: Field, edge: Edge, *, plane: bool) -> float:
    """Compute the area inside the contact edge in which the surfaces are separated [length^2].

    radii     radii of the rings (n,) [length]
    pressure  pressure at the rings (n,), not negative
    edge      rule for the radius between two rings
    plane     True in plane strain, in which the area is a width [length]
    """
    area = 0.0
    for first, after in holes(pressure, edge):
        inner = edge.radius(radii, pressure, first - 1) if first else 0.0
        outer = max(inner, edge.radius(radii, pressure, after, -1))
        area += area_within(outer, plane=plane) - area_within(inner, plane=plane)
    return area


def stick_area(
    radii: Field,
    bound: Field,
    shear: Field,
    slips: Mask,
    contact_radius: float,
    edge: Edge,
    *,
    plane: bool = False,
) -> float:
    """Compute the area of the stick zone, whose edges are resolved between the rings [length^2].

    The fields are those of an axisymmetric contact, or those along one ray.

    radii           radii of the rings (n,) [length]
    bound           friction limit µp at the rings (n,), zero where no shear is possible
    shear           one or two components of the shear at the rings (c, n)
    slips           True for rings that are in contact and slip (n,)
    contact_radius  radius of the contact edge [length]
    edge            rule for the radius of an edge between two rings
    plane           True in plane strain, in which the area is a width [length]
    """
    if not np.any(bound > 0):
        return 0.0
    last = int(np.flatnonzero(bound > 0)[-1])
    stuck = ~slips[: last + 1]
    for first, after in holes(bound, edge):
        stuck[first:after] = False
    if bound[0] == 0:
        stuck[0] = stuck[1]
    at_stick = edge.stick_rule

    def radius_between(at: int, beside: int) -> float:
        """Compute the radius of the edge between a stuck ring and the slipping ring beside it."""
        # Difference from the friction limit in the direction of the shear of the adjacent slipping
        # ring. After a load reversal the limit in the opposite direction may be nearer. A ring at
        # its limit may exceed it by round-off.
        direction = shear[:, beside] / (np.hypot.reduce(shear[:, beside]) or 1.0)
        missing = np.maximum(bound - direction @ shear, 0.0)
        return at_stick.radius(radii, missing, at, beside - at)

    def outermost() -> float:
        """Compute the outer radius of a stick zone that reaches the last ring in contact."""
        if last == len(radii) - 1:
            return contact_radius
        left = np.maximum(bound - np.sqrt(np.sum(shear**2, axis=0)), 0.0)
        return min(at_stick.radius(radii, left, last), contact_radius)

    area = 0.0
    changes = np.flatnonzero(np.diff(stuck, prepend=False, append=False)).tolist()
    for first, after in zip(changes[::2], changes[1::2], strict=True):
        inner = radius_between(first, first - 1) if first else 0.0
        outer = radius_between(after - 1, after) if after <= last else outermost()
        # The contact edge of a single stuck ring at the end may lie within the edge of its stick.
        rest = area_within(outer, plane=plane) - area_within(inner, plane=plane)
        area += max(0.0, rest)
    return area
