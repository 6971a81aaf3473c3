"""Radii of the rings of a contact with tangential load or torsion, and creation of its points.

The rings serve all increments of a load history, whose contact edge is nearly constant.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from contact_scene.array_types import Array
from contact_scene.geometry import ShapedBody
from contact_scene.rig import Rig, compliances
from radial.angular_grid import RingAngles
from radial.frictional.coupling import Coupling
from radial.response.quadrature import unit_gauss
from radial.tangential.ring_compliance import ring_compliance
from radial.tangential.ring_points import ContactPoints

GRADED = 4  # rings on each side of an edge, each with half the width of the previous one
LEAST = 0.75  # least distance of an evenly spaced ring from an edge, in widths of a ring
GROWTH = 1.4  # ratio of the widths of adjacent rings outside the largest contact
# Outermost radius over the contact radius without friction, and its increase per unit of µ, because
# friction shifts the contact edge.
REACH = 1.15
BY_FRICTION = 0.5
POINTS = 6  # Gauss points of an element


def relative_ring_radii(count: int, reach: float, edges: Sequence[float]) -> tuple[float, ...]:
    """Return the radii of rings over the radius of the largest contact, increasing from 0.

    The rings are evenly spaced inside the largest contact and dense at the edges of contacts.
    Outside the largest contact their distance grows.

    count  number of rings inside the largest contact, without the dense rings at edges
    reach  least radius of the last ring over the radius of the largest contact
    edges  radii of all contacts whose edges need dense rings, over the radius of the largest
           contact
    """
    near = 0.5 ** np.arange(1, GRADED + 1) / count
    outside = [1 / count]
    while outside[-1] < reach - 1:
        outside.append(GROWTH * outside[-1] + 1 / count)
    dense: list[float] = []
    for edge in (1.0, *edges):
        # An edge within a dense region needs no further nodes.
        if all(abs(edge - other) > min(1 / count, edge, other) for other in dense):
            dense.append(edge)
    # Within the first ring the distances are relative to the radius of the edge itself.
    about = [edge + off * min(1.0, edge * count) for edge in dense for off in (*-near, 0.0, *near)]
    even = [*np.arange(1, count) / count, *(1 + np.array(outside))]
    outside_dense = [x for x in even if all(abs(x - edge) > LEAST / count for edge in dense)]
    found = sorted(
        [*about, *(x for x in outside_dense if min(abs(x - y) for y in about) > near[-1])]
    )
    return (0.0, *(float(x) for x in found if x > near[-1] * min(1.0, min(dense) * count)))


def create_points(
    coupling: Coupling,
    indenter: ShapedBody,
    edges: Sequence[float],
    count: int,
    highest: int,
    circle: RingAngles,
    friction: float,
    rig: Rig | None = None,
) -> ContactPoints:
    """Create the points of a contact (rings × angles), with the compliance of bodies and rig.

    coupling  elastic response of both bodies
    indenter  shape of the indenter
    edges     contact radii at which rings are dense; the largest determines the layout [length]
    count     number of rings inside the largest contact, without the dense rings at edges
    highest   highest angular harmonic of the tractions, which is the number of angles of a half
              circle
    circle    angles of the points on a ring: one angle, half a circle or the full circle
    friction  coefficient of friction µ; friction shifts the contact edge, so the rings reach
              further
    rig       springs of the test machine, which displace all points equally; None without springs
    """
    edge = max(edges)
    over = relative_ring_radii(
        count, REACH + BY_FRICTION * friction, [other / edge for other in edges]
    )
    radii = edge * np.array(over)
    scaled = tuple(x / over[-1] for x in over)
    compliance = ring_compliance(coupling, scaled, radii[-1], highest)
    v, weights = unit_gauss(POINTS)
    length = np.diff(radii)[:, None]
    r = radii[:-1, None] + length * v

    def integral(field: Array) -> Array:
        """Integrate a field of the radius with the hat function φ of every node, ∫ φ field dr (n,).

        field  values at the Gauss points of the elements between the n nodes (n - 1, points)
        """
        part = field * length * weights
        return np.append(part @ (1 - v), 0.0) + np.append(0.0, part @ v)

    gap, areas = integral(r * indenter.initial_gap(r, 0.0)), integral(r)
    down, along = compliances(rig)
    by_all = np.pi * np.multiply.outer(areas, areas)
    compliance[0, 2, 2] += 2 * down * by_all
    if highest:
        signs = np.array([[1.0, -1.0], [-1.0, 1.0]])  # u_r = cos θ and u_θ = -sin θ of a shift
        compliance[1, :2, :2] += along * np.multiply.outer(signs, by_all)
    return ContactPoints(radii, compliance, areas, integral(r * r), gap, circle)
