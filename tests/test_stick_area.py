"""The border of stick is found to a part of a cell, whether slip or stick spreads there, and though
the shear turns across it."""

import numpy as np
import pytest

from semi_analytical.contact_area import stuck_cells
from semi_analytical.edge_correction.stick_area import stick_area

CELLS, PARTS = 64, 12
CONTACT = 28.0  # radius in cells


def points(centre):
    """Places within the cells, x and y from the centre."""
    at = np.arange(CELLS) - (CELLS - 1) / 2
    within = (np.arange(PARTS) + 0.5) / PARTS - 0.5
    x = (at[:, None] + within).ravel()
    return (x - centre[0])[:, None], (x - centre[1])[None, :]


def means(values):
    """Over the cells, of values at the places."""
    return values.reshape(CELLS, PARTS, CELLS, PARTS).mean(axis=(1, 3))


def contact(radius, exponent, centre=(0.0, 0.0), turning=0.0):
    """Shear, its limit and the cells that stick; a disc of a radius sticks.

    exponent  of the fall of what is missing from full slip, a number or of places
    turning   of the shear, in radians per cell along x
    """
    x, y = points(centre)
    squared = x**2 + y**2
    bound = np.sqrt(np.maximum(1 - squared / CONTACT**2, 0))
    inside = np.maximum(1 - squared / radius**2, 0)
    missing = np.where(inside > 0, (radius / CONTACT) * inside**exponent, 0)
    angle = turning * (x + 0 * y)
    shear = (bound - 0.8 * missing) * np.stack([np.cos(angle), np.sin(angle)])
    middle = PARTS // 2
    stick = inside[middle::PARTS, middle::PARTS] > 0
    limit = means(bound)
    return np.stack([means(part) for part in shear]), limit, stick


def radius_of(area):
    return np.sqrt(area / np.pi)


@pytest.mark.parametrize("exponent", [0.5, 1.5], ids=["slip spreads", "stick spreads"])
@pytest.mark.parametrize("radius", [4.3, 8.1, 18.4])
def test_a_disc_that_sticks_is_found_to_a_fiftieth_of_a_cell(exponent, radius):
    """By the root alone up to 0.6 of one where stick spreads, by 3/2 alone a whole one where slip
    does."""
    for centre in ((0.0, 0.0), (0.31, -0.17)):
        area = stick_area(*contact(radius, exponent, centre))
        assert radius_of(area) == pytest.approx(radius, abs=0.02)


def test_each_part_of_the_border_has_its_own_law():
    x, _ = points((0.0, 0.0))
    exponent = 1.0 + 0.5 * np.tanh(x / 2) + np.zeros((CELLS * PARTS,) * 2)
    area = stick_area(*contact(15.2, exponent))
    assert radius_of(area) == pytest.approx(15.2, abs=0.05)


@pytest.mark.parametrize("exponent", [0.5, 1.5])
def test_shear_that_turns_across_the_border_does_not_move_it(exponent):
    """Five degrees a cell, as behind a pushed ball."""
    end = contact(14.2, exponent, turning=np.radians(5))
    assert radius_of(stick_area(*end)) == pytest.approx(14.2, abs=0.05)


def test_a_mirrored_or_turned_zone_is_as_large():
    shear, bound, stick = contact(9.3, 0.5, (0.2, -0.4))
    area = stick_area(shear, bound, stick)
    for turn in range(1, 4):
        turned = (np.rot90(shear, turn, (1, 2)), np.rot90(bound, turn), np.rot90(stick, turn))
        assert stick_area(*turned) == pytest.approx(area, rel=1e-12)
    mirrored = stick_area(shear[:, :, ::-1], bound[:, ::-1], stick[:, ::-1])
    assert mirrored == pytest.approx(area, rel=1e-12)


@pytest.mark.parametrize("unit", [1e-60, 1e60])
def test_it_does_not_depend_on_the_unit_of_the_shear(unit):
    shear, bound, stick = contact(9.3, 1.5)
    area = stick_area(unit * shear, unit * bound, stick)
    assert area == pytest.approx(stick_area(shear, bound, stick), rel=1e-9)


def test_without_a_border_cells_count():
    """A stick zone of two cells radius, stick all over, and none at all."""
    assert stick_area(*contact(2.2, 0.5)) == stuck_cells(*contact(2.2, 0.5))
    shear, bound, stick = contact(9.3, 0.5)
    held = 0.1 * shear, bound, bound > 0
    assert stick_area(*held) == stuck_cells(*held)
    assert stick_area(shear, bound, stick & False) == 0
