"""Tests of contact and stick radii that are determined from values at the rings of elements, and
at the points of rings."""

from functools import partial
from math import pi

import numpy as np
import pytest
from random_compliance import as_map, pressed
from scipy.linalg import toeplitz

from contact_scene import Body, IsotropicMaterial
from contact_solver.dense_inverse import inverse_on
from contact_solver.pressure import PressureProblem, solve_pressure
from fem_reference.compliance.gauss_points import loading_part
from fem_reference.compliance.ring_edge import (
    GaussEdge,
    HatEdge,
    area_of_holes,
    beyond_pressure,
    stick_area,
)
from radial.tangential.stick_border import stick_area as point_stick_area

CENTRE = 200


def test_the_softer_body_decides_where_the_edge_lies():
    soft, hard = (
        Body(material=IsotropicMaterial(young_modulus=E, poisson_ratio=nu))
        for E, nu in ((1e9, 0.1), (1e15, 0.4))
    )
    assert beyond_pressure(soft, hard) == pytest.approx(beyond_pressure(soft), abs=1e-5)


def plane_contact(half_width: float) -> np.ndarray:
    """Pressure of a parabola on a half-plane, on hats at the integers -200 ... 200.

    p = √(a² - x²) solves -∫ ln|x - s| p ds + π x²/2 = constant. The products of two hats with the
    kernel are fourth differences of the fourth integral of ln|x|, x⁴ (ln|x| - 25/12) / 24.
    """
    n = np.arange(2 * CENTRE + 1)

    def integral(x):
        size = np.maximum(np.abs(x), 1e-300)
        return size**4 * (np.log(size) - 25 / 12) / 24

    steps = ((-2, 1), (-1, -4), (0, 6), (1, -4), (2, 1))
    kernel = -sum(factor * integral(n.astype(float) + step) for step, factor in steps)
    # Under a given load the constant is free, so any may be added for the matrix to be positive.
    matrix = toeplitz(kernel) + 20.0
    gap = pi * ((n - CENTRE) ** 2 / 2 + 1 / 12)
    load = pressed(pi * half_width**2 / 2)
    problem = PressureProblem(as_map(matrix), partial(inverse_on, matrix), gap, load)
    return solve_pressure(problem, np.ones(len(n)), 1e-9).pressure[CENTRE:]


@pytest.mark.parametrize("beyond", [0.05, 0.3, 0.5, 0.8, 0.99])
def test_edge_of_plane_contact_is_found_within_its_element(beyond):
    a = 150 + beyond
    p = plane_contact(a)
    last = int(np.flatnonzero(p > 0)[-1])
    # So far out a circle is as good as straight.
    assert HatEdge().radius(np.arange(len(p)) + 1e6, p, last) == pytest.approx(1e6 + a, abs=3e-3)
    assert last + 0.5 != pytest.approx(a, abs=3e-3) or beyond == 0.5


@pytest.mark.parametrize("step", [1, -1])
def test_a_square_root_at_gauss_points_ends_where_its_parabola_does(step):
    r = (np.arange(40)[:, None] + 0.5 + np.array([-0.387, 0.0, 0.387])).ravel()
    p = np.sqrt(np.maximum(step * (20.3**4 - r**4), 0.0))
    last = int(np.flatnonzero(p)[-1 if step > 0 else 0])
    edge = GaussEdge(1.0).radius(r, p, last, step)
    assert edge == pytest.approx(20.3, abs=0.03)
    anything = np.random.default_rng(1).normal(size=r.shape)
    loading_no_node = anything - loading_part(r, anything)
    assert GaussEdge(1.0).radius(r, p + 0.1 * loading_no_node, last, step) == pytest.approx(edge)


@pytest.mark.parametrize("side", [1, -1])
def test_slip_within_stick_has_its_edge_where_nothing_is_missing_from_the_limit(side):
    """Whichever way it slips; outside, stick reaches the edge of the contact."""
    radii, inner, outer = np.arange(60.0), 20.4, 50.3
    bound = np.sqrt(np.maximum(outer**2 - radii**2, 0))
    missing = np.minimum(np.sqrt(np.maximum(radii**2 - inner**2, 0)), bound)
    sides = np.where(radii < inner, side, 0).astype(np.int8)
    whole = stick_area(radii, bound, np.zeros((1, 60)), np.zeros(60, bool), outer, HatEdge())
    assert whole == pytest.approx(pi * outer**2, rel=1e-2)
    shear, slips = np.zeros((1, 60)), np.zeros(60, bool)
    assert stick_area(radii, bound, shear, slips, outer - 0.5, HatEdge()) <= pi * (outer - 0.5) ** 2
    area = stick_area(radii, bound, side * (bound - missing)[None], sides != 0, outer, HatEdge())
    assert whole - area == pytest.approx(pi * inner**2, rel=1e-2)


@pytest.mark.parametrize("way", [1, -1])
def test_slip_narrower_than_an_element_is_found_by_what_is_missing_from_the_limit(way):
    """All rings stick, but stick ends before contact does."""
    stick, contact = 150.3, 150.8
    missing, bound = plane_contact(stick), plane_contact(contact)
    radii = np.arange(len(bound)) + 1e6
    nothing = np.zeros(len(bound), bool)
    area = stick_area(
        radii, bound, way * (bound - missing)[None], nothing, 1e6 + contact, HatEdge()
    )
    assert np.sqrt(area / pi) - 1e6 == pytest.approx(stick, abs=3e-3)


@pytest.mark.parametrize("edge", [HatEdge(), GaussEdge(1.0)])
@pytest.mark.parametrize("inner", [0.0, 12.4])
def test_a_hole_in_the_contact_is_no_part_of_contact_and_stick(edge, inner):
    """A disc, and a ring around it. The pressure of a single Gauss point is not determined."""
    hole, outer = 30.3, 50.6
    gauss = isinstance(edge, GaussEdge)
    points = np.array([-0.387, 0.0, 0.387]) if gauss else np.zeros(1)
    radii = (np.arange(60.0)[:, None] + 0.5 * gauss + points).ravel()
    disc = np.maximum(inner**2 - radii**2, 0)
    p = np.sqrt(disc + np.maximum((outer**2 - radii**2) * (radii**2 - hole**2) / outer**2, 0))
    if gauss:
        p[120] = 0.0
    assert area_of_holes(radii, p, edge, plane=False) == pytest.approx(
        pi * (hole**2 - inner**2), rel=0.02
    )
    nothing = np.zeros(len(p), bool)
    sticks = stick_area(radii, p, np.zeros((1, len(p))), nothing, outer, edge)
    assert sticks == pytest.approx(pi * (outer**2 - hole**2 + inner**2), rel=0.02)


@pytest.mark.parametrize("excess", [0.0, 1e-9])
def test_a_stuck_ring_at_its_limit_ends_the_stick_zone(excess):
    """By round-off the shear of a stuck ring may exceed its friction limit."""
    radii = np.arange(6.0)
    bound = np.array([8.0, 7.0, 6.0, 4.0, 1.0, 0.0])
    shear = np.array([[1.0, 2.0, 3.0, 4.0 - 1e-9, 1.0 + excess, 0.0]])
    area = stick_area(radii, bound, shear, np.zeros(6, dtype=bool), 4.5, HatEdge())
    assert np.sqrt(area / np.pi) == pytest.approx(4.0, abs=1e-5)


def test_a_stuck_ring_beyond_the_contact_edge_has_no_area():
    """The fitted contact edge may lie inside the outermost ring in contact, if this ring sticks."""
    radii = np.arange(6.0)
    bound = np.array([5.0, 4.0, 3.0, 2.0, 1.0, 0.0])
    slips = bound > 1.0
    shear = np.where(slips, bound, 0.0)[None]
    assert stick_area(radii, bound, shear, slips, 3.4, HatEdge()) == 0.0
    assert stick_area(radii, bound, shear, slips, 4.2, HatEdge()) == pytest.approx(
        pi * (4.2**2 - 3.5**2)
    )


@pytest.mark.parametrize("beyond", [0.05, 0.3, 0.5, 0.8, 0.99])
@pytest.mark.parametrize("count", [6, 7])
def test_a_disc_that_sticks_is_as_wide_as_the_plane_contact_on_hats(beyond, count):
    missing = plane_contact(150 + beyond)
    radii, sticks = np.arange(len(missing)) * 1.0, missing > 0
    size = np.tile(200.0 - missing, (count, 1)).T
    angles = 2 * np.pi * np.arange(count) / count
    shear = np.stack([size * np.cos(angles), -size * np.sin(angles)])
    whole = np.tile(sticks, (count, 1)).T
    area = point_stick_area(radii, shear, np.full(size.shape, 200.0), whole)
    assert np.sqrt(area / np.pi) == pytest.approx(150 + beyond, abs=6e-3)
