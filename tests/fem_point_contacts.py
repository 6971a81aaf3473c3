"""Contacts on points without finite elements: ball and contact of radius 1, shear modulus 1."""

from dataclasses import replace

import numpy as np
from hankel_responses import Coating
from ring_responses import half_space, rings

from contact_scene import CoulombFriction
from fem_reference.contact.angular_grid import AngularGrid, axisymmetric_grid, end_grid
from fem_reference.contact.augmented_lagrangian import Penalty
from fem_reference.contact.increment import advance
from fem_reference.contact.point_compliance import PointCompliance
from fem_reference.contact.point_contact import PointContact
from fem_reference.contact.point_state import PointState
from fem_reference.loads import Loads, NormalTarget, TangentialTarget

RINGS = 16  # on the contact radius
HIGHEST = 8
TOLERANCE = 1e-8
SPRINGS_ALONE = Penalty(augmentations=0, overlap=np.inf)


def contact(
    *bodies: Coating,
    mu: float = 0.1,
    per_radius: int = RINGS,
    grid: AngularGrid | None = None,
    springs: float = 0.0,
    reach: float = 1.25,
    power: int = 2,
) -> PointContact:
    """Ball of radius 1 on bodies, the lower one first; the upper one rigid if there is none.

    power  gap r^power / 2; 0: a flat punch
    """
    grid = grid or end_grid(HIGHEST)
    known = rings(per_radius, reach, HIGHEST, *bodies)
    # ∫ r² φ r dr / ∫ φ r dr on rings of equal distance
    radii, h = known.radii, 1 / per_radius
    inner, outer = np.maximum(radii - h, 0.0), np.minimum(radii + h, radii[-1])
    gap = np.array([_mean_gap(*edges, power) for edges in zip(inner, radii, outer, strict=True)])
    compliance = PointCompliance(replace(known, gap=gap), grid, springs)
    law = SPRINGS_ALONE if springs else None
    return PointContact(compliance, CoulombFriction(coefficient=mu), law)


def _mean_gap(inner, peak, outer, power):
    x, w = np.polynomial.legendre.leggauss(6)
    total = weight = 0.0
    for left, right, hat in ((inner, peak, (1 + x) / 2), (peak, outer, (1 - x) / 2)):
        r = left + (right - left) * (1 + x) / 2
        share = w * (right - left) * hat * r
        total += np.sum(share * r**power / 2) if power else 0.0
        weight += np.sum(share)
    return total / weight


def hertz_force(nu: float, bodies: int = 1) -> float:
    """Force that makes a contact of radius 1."""
    return 4 / 3 * 2 / (1 - nu) / bodies


def pressed(of: PointContact, force: float, increments: int) -> PointState:
    """Pressed by the force in increments of equal contact radius, and set on the points of `of`."""
    ring = replace(of, compliance=replace(of.compliance, grid=axisymmetric_grid()))
    state = None
    for k in range(1, increments + 1):
        target = NormalTarget(force=force * (k / increments) ** 3)
        state = advance(ring, state, Loads(target), TOLERANCE)
    assert state is not None
    return of.lifted(state)


def sheared(of: PointContact, state: PointState, *forces: float) -> PointState:
    """Sheared by forces, one increment each, under the normal force of the state."""
    normal = NormalTarget(force=state.normal_force)
    for force in forces:
        state = advance(of, state, Loads(normal, TangentialTarget(load=force)), TOLERANCE)
    return state


def along_load(of: PointContact, state: PointState):
    """q_x and q_y (rings, angles)."""
    return cartesian(of.compliance.grid, of.compliance.vector_on_grid(state.shear))


def cartesian(grid, vector):
    """x and y components of r and θ components (2, rings, angles)."""
    cos, sin = np.cos(grid.angles), np.sin(grid.angles)
    return vector[0] * cos - vector[1] * sin, vector[0] * sin + vector[1] * cos


STEEL = half_space(0.3)
NU_ZERO = half_space(0.0)
