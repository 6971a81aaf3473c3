"""Coulomb's law on rings and angles: Cattaneo and Mindlin, Masing, and a coated reference."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from contact_scene import (
    Body,
    CoulombFriction,
    IsotropicMaterial,
    LoadStep,
    Paraboloid,
    Scene,
)
from contact_scene.solver_errors import ContactAtZoneEdge
from radial.angular_grid import Circle
from radial.frictional.coupling import Coupling
from radial.tangential.ring_compliance import ring_compliance
from radial.tangential.ring_friction import held
from radial.tangential.ring_laws import Laws
from radial.tangential.ring_newton import aimed
from radial.tangential.ring_points import Points
from radial.tangential.ring_state import (
    Held,
    Loads,
)

Array = np.ndarray
TOLERANCE = 1e-9
LOAD, FRICTION = 4 / 3, 0.3  # of a ball with R = 1 on E* = 1: a = 1
LAW = CoulombFriction(coefficient=FRICTION)
LIMIT = LOAD * FRICTION


def points_on(
    indenter: Any, body: Body, radii: Array, count: int, circle: Circle = Circle.HALF
) -> Points:
    """Below a paraboloid with R = 1."""
    ball = Paraboloid(radius=1.0, material=indenter)
    scene = Scene(indenter=ball, body=body, loading=(LoadStep(normal_force=1.0),))
    largest = float(radii[-1])
    nodes = tuple(radii / largest)
    energies = ring_compliance(Coupling.of(scene), nodes, largest, count)
    rule, weights = np.polynomial.legendre.leggauss(4)
    length = np.diff(radii)[:, None]
    r = radii[:-1, None] + length * (1 + rule) / 2
    areas = []
    for field in (r, r**2, r**3 / 2):
        part = field * length * weights / 2
        inner, outer = part @ ((1 - rule) / 2), part @ ((1 + rule) / 2)
        areas.append(np.append(inner, 0.0) + np.append(0.0, outer))
    return Points(radii, energies, *areas, circle)


def rings(count: int, radius: float) -> Array:
    """Evenly to the edge of the contact, graded there, and three beyond."""
    inside = np.arange(count) / count
    graded = 1 - 0.5 ** np.arange(1, 5) / count
    return radius * np.concatenate([inside, graded, 1 + np.arange(4) / count])


COUNT = 32
RADII = rings(COUNT, 1.0)


@cache
def alike() -> Points:
    """Two bodies of one material without lateral contraction: uncoupled, and slip along shear."""
    material = IsotropicMaterial(young_modulus=2.0, poisson_ratio=0.0)
    return points_on(material, Body(material=material), RADII, 4)


def pushed(share: float) -> Loads:
    """By a share of µW."""
    return loaded(LOAD, share * LIMIT)


def loaded(force: float, drag: float) -> Loads:
    return Loads((drag, None, None, force), (None, 0.0, 0.0, None))


def led(approach: float | None, shift: float, force: float | None = None) -> Loads:
    return Loads((None, None, None, force), (shift, 0.0, 0.0, approach))


@cache
def after(*shares: float) -> Held:
    """Pressed at once, then pushed to shares of µW, one after another."""
    if not shares:
        return held(alike(), LAW, pushed(0.0), None, TOLERANCE)
    return held(alike(), LAW, pushed(shares[-1]), after(*shares[:-1]), TOLERANCE)


@pytest.mark.parametrize(("harmonic", "way"), [(0, 2), (1, 0), (3, 2), (4, 1)])
def test_points_move_as_the_harmonics_of_their_tractions(harmonic: int, way: int) -> None:
    points, nodes = alike(), len(RADII)
    count = points.count
    cos, sin = np.cos(harmonic * points.angles), np.sin(harmonic * points.angles)
    ways = np.array([cos, sin, cos])
    tractions = np.zeros((3, nodes, count))
    tractions[way] = RADII[:, None] * ways[way]
    moved = (points.compliance @ tractions.ravel()).reshape(3, nodes, count)
    exact = points.energies[harmonic, :, way] @ RADII
    exact = 2 * math.pi / count * exact[..., None] * ways[:, None]
    assert_allclose(moved, exact, atol=1e-14)


@pytest.mark.parametrize("circle", Circle)
@pytest.mark.parametrize("rings", [1, 4, len(RADII)])
def test_tractions_of_rings_are_those_that_move_them_so(circle: Circle, rings: int) -> None:
    points = replace(alike().round if circle is Circle.ONE else alike(), circle=circle)
    size, m = len(points.areas), rings * points.count
    some = np.concatenate([way * size + np.arange(m) for way in range(3)])
    known = points.compliance[np.ix_(some, some)]
    units = np.sqrt(points.softness[some])
    by_tractions = known / units / units[:, None]
    assert_allclose(points.tractions(rings) @ by_tractions, np.eye(3 * m), atol=1e-9)


def test_newtons_method_aims_at_where_the_laws_would_hold() -> None:
    """Towards its aim what is left of the laws shrinks as what is left of the way."""
    laws = Laws.of(alike(), LAW, pushed(0.7), after(0.3))
    state = after(0.6)
    x = np.concatenate([state.tractions, state.motion * [1.02, 1, 1, 1.01]])
    at, step = laws.at(x, alike().compliance @ x[:-4]), 1e-7
    aim = aimed(laws, at)
    assert aim is not None
    x = x + step * (aim - x)
    nearer = laws.at(x, alike().compliance @ x[:-4])
    left = (at.missed - nearer.missed) / step
    assert_allclose(left, at.missed, atol=1e-5 * np.abs(at.missed).max())


def test_a_contact_beyond_the_rings_is_refused() -> None:
    with pytest.raises(ContactAtZoneEdge, match="last ring"):
        held(alike(), LAW, loaded(2 * LOAD, 0.0), None, TOLERANCE)


def test_a_prescribed_motion_is_that_of_the_loads() -> None:
    by_force = after(0.6)
    motions = led(by_force.approach, float(by_force.motion[0]))
    by_motion = held(alike(), LAW, motions, after(), TOLERANCE)
    assert_allclose(by_motion.tractions, by_force.tractions, atol=1e-7)


def test_one_angle_says_all_of_what_is_the_same_all_around() -> None:
    points = alike()
    still = Loads((None, None, None, LOAD), (0.0, 0.0, 0.0, None))
    turned = held(points.round, LAW, still, None, TOLERANCE).every_angle(points)
    assert_allclose(turned.tractions, after().tractions, atol=1e-7)
    assert_allclose(turned.moved, after().moved, atol=1e-9)
