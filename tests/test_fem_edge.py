"""Radii of contact and of stick from values at the rings."""

from math import pi

import numpy as np
import pytest
from contact_scenes import LOAD, MU, NU, RADIUS, RIGID_BALL, YOUNG, A, paraboloid, scene, steel
from fem_scenes import end, solved
from scipy.linalg import toeplitz

from fem_reference.contact.box_program import BoxProgram, Total, solve_box
from fem_reference.contact.ring_edge import HatEdge, stick_area
from verification.closed_forms.hertz import PointContact
from verification.closed_forms.moduli import contact_modulus
from verification.references import load_reference

CENTRE = 200


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
    load = Total(np.ones(len(n)), pi * half_width**2 / 2)
    endless = np.full(len(n), np.inf)
    program = BoxProgram(matrix, -gap, np.zeros(len(n)), endless, load)
    return solve_box(program, np.zeros(len(n), np.int8)).values[CENTRE:]


@pytest.mark.parametrize("beyond", [0.05, 0.3, 0.5, 0.8, 0.99])
def test_edge_of_plane_contact_is_found_within_its_element(beyond: float) -> None:
    a = 150 + beyond
    p = plane_contact(a)
    last = int(np.flatnonzero(p > 0)[-1])
    # So far out a circle is as good as straight.
    assert HatEdge().radius(np.arange(len(p)) + 1e6, p, last) == pytest.approx(1e6 + a, abs=3e-3)
    assert last + 0.5 != pytest.approx(a, abs=3e-3) or beyond == 0.5


@pytest.mark.parametrize(
    ("lower", "upper", "softer"),
    [(0.0, 0.0, 1.0), (0.15, 0.15, 1.0), (0.45, 0.45, 1.0), (0.5, 0.5, 1.0), (0.0, 0.49, 5.0)],
)
@pytest.mark.parametrize("beyond", [0.1, 0.5, 0.9])
def test_edge_is_found_whatever_elements_next_to_it_are_of(
    lower: float, upper: float, softer: float, beyond: float
) -> None:
    """Up to the curvature of the contact, of 0.11 h/a of an element where the edge is in its
    middle, and 0.0012 of an element; at ν = 0 half-planes would be off by 0.016."""
    per_radius, soft = 32, YOUNG / softer
    modulus = contact_modulus((YOUNG, lower), (soft, upper))
    a = PointContact.under_load(LOAD, RADIUS, modulus).contact_radius
    pressed = scene(
        {"normal_force": LOAD},
        friction=None,
        body=steel(lower),
        indenter=paraboloid(steel(upper, soft)),
    )
    element = a / (per_radius + beyond)
    found = end(pressed, per_radius, contact_radius=per_radius * element)
    curvature = {0.1: -0.03, 0.5: -0.11, 0.9: 0.14}[beyond] / per_radius
    assert (found.contact_radius - a) / element == pytest.approx(curvature, abs=1.2e-3)


@pytest.mark.parametrize("elements", [16, 32])
def test_radius_of_a_ball_is_known_to_a_small_part_of_an_element(elements: int) -> None:
    for part in np.linspace(0.6, 1.0, 9):
        load = LOAD * part**3
        found = end(scene({"normal_force": load}, friction=None), elements, contact_radius=A)
        assert found.contact_radius == pytest.approx(part * A, abs=0.03 * A / elements)


def test_values_that_fall_inwards_have_their_edge_inside() -> None:
    """The same values in reverse order: what was the distance to one end is that to the other."""
    p = plane_contact(150.4)
    last = int(np.flatnonzero(p > 0)[-1])
    radii = np.arange(len(p)) + 1e6
    outward = HatEdge().radius(radii, p, last) - radii[0]
    first = len(p) - 1 - last
    inward = radii[-1] - HatEdge().radius(radii, p[::-1].copy(), first, -1)
    assert inward == pytest.approx(outward, abs=1e-5)


def test_advancing_front_is_told_from_a_standing_one() -> None:
    """While a rigid ball is pressed on, stick gains ground at a constant part of the contact
    radius, and what is missing from full slip falls with the power 3/2 towards its edge."""
    (row,) = [r for r in load_reference("frictional_indentation_homogeneous")["rows"]
              if (r["nu"], r["mu"]) == (NU, MU)]  # fmt: skip
    pressing = scene({"normal_force": LOAD, "increments": 60}, indenter=RIGID_BALL)
    increments = solved(pressing, 32).increments
    element = increments[0].radii[1]
    for found in increments[40:]:
        exact = row["c_over_a"] * found.contact_radius
        assert found.stick_radius == pytest.approx(exact, abs=0.25 * element)


def test_area_of_a_stuck_ring() -> None:
    """Slip inside and outside of it; edges between the rings."""
    radii = np.arange(40.0)
    sides = np.zeros(40, np.int8)
    sides[:11], sides[30:36] = 1, 1
    bound = np.where(radii < 36, 1.0, 0.0)
    area = stick_area(
        radii, bound, np.where(sides != 0, bound, 0.0)[None], sides != 0, 35.5, HatEdge()
    )
    assert area == pytest.approx(pi * (29.5**2 - 10.5**2), rel=0.06)


def test_single_ring_in_contact_counts_half_its_element() -> None:
    assert HatEdge().radius(np.arange(5.0), np.array([1.0, 0, 0, 0, 0]), 0) == 0.5


def test_elastic_constants_do_not_move_the_edge() -> None:
    """What is read off the ratio of two pressures is geometry."""
    one = end(scene({"normal_force": LOAD}, friction=None), contact_radius=0.95 * A)
    stiff = steel(NU, 3 * YOUNG)
    other = end(
        scene(
            {"normal_force": 3 * LOAD}, friction=None, body=stiff,
            indenter=type(scene({"normal_force": 1.0}).indenter)(radius=RADIUS, material=stiff),
        ),
        contact_radius=0.95 * A,
    )  # fmt: skip
    assert other.contact_radius == pytest.approx(one.contact_radius, rel=1e-12)


def test_two_rings_tell_an_edge_and_one_does_not() -> None:
    radii = np.arange(6.0)
    near, far = (
        HatEdge().radius(radii, np.sqrt(np.maximum(a**2 - radii**2, 0)), 1) for a in (1.2, 1.8)
    )
    assert 1 < near < far < 2.05
    alone = np.array([0.0, 0, 0, 0, 0, 1])
    assert HatEdge().radius(radii, alone, 5, -1) == 4.5
    assert 3 < HatEdge().radius(radii, np.array([0.0, 0, 0, 0, 1, 2]), 4, -1) < 4


@pytest.mark.parametrize("side", [1, -1])
def test_slip_within_stick_has_its_edge_where_nothing_is_missing_from_the_limit(side: int) -> None:
    """Whichever way it slips; outside, stick reaches the edge of the contact."""
    radii, inner, outer = np.arange(60.0), 20.4, 50.3
    bound = np.sqrt(np.maximum(outer**2 - radii**2, 0))
    missing = np.minimum(np.sqrt(np.maximum(radii**2 - inner**2, 0)), bound)
    sides = np.where(radii < inner, side, 0).astype(np.int8)
    whole = stick_area(radii, bound, np.zeros((1, 60)), np.zeros(60, bool), outer, HatEdge())
    assert whole == pytest.approx(pi * outer**2, rel=1e-2)
    area = stick_area(radii, bound, side * (bound - missing)[None], sides != 0, outer, HatEdge())
    assert whole - area == pytest.approx(pi * inner**2, rel=1e-2)


@pytest.mark.parametrize("step", [1, -1])
def test_three_rings_tell_an_advancing_front(step: int) -> None:
    """What is further in does not move the edge; with two rings alone it would seem to stand."""
    radii = 10 + np.arange(8.0)
    values = np.maximum(4.5 - np.arange(8.0), 0) ** 1.5
    if step < 0:
        values = values[::-1].copy()

    def edge_of_last(count: int) -> float:
        first = 4 if step > 0 else 3
        rings = slice(5 - count, None) if step > 0 else slice(0, first + count)
        return HatEdge().radius(radii[rings], values[rings], count - 1 if step > 0 else first, step)

    assert edge_of_last(3) == edge_of_last(5)
    assert step * edge_of_last(3) > step * edge_of_last(2) + 0.1


@pytest.mark.parametrize("way", [1, -1])
def test_slip_narrower_than_an_element_is_found_by_what_is_missing_from_the_limit(way: int) -> None:
    """All rings stick, but stick ends before contact does."""
    stick, contact = 150.3, 150.8
    missing, bound = plane_contact(stick), plane_contact(contact)
    radii = np.arange(len(bound)) + 1e6
    nothing = np.zeros(len(bound), bool)
    area = stick_area(
        radii, bound, way * (bound - missing)[None], nothing, 1e6 + contact, HatEdge()
    )
    assert np.sqrt(area / pi) - 1e6 == pytest.approx(stick, abs=3e-3)
