"""Tests of contact and stick areas on cells, which end within cells."""

import numpy as np
import pytest

from semi_analytical.edge.contact_area import (
    covered_cells,
    stuck_cells,
)
from semi_analytical.edge_correction.stick_area import stick_area
from semi_analytical.operator.domain import QUARTER, ReducedDomain

CELLS = 64
PARTS = 12
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


def test_a_mirrored_or_turned_zone_is_as_large():
    zone = contact(9.3, 0.5, (0.2, -0.4))
    area = pytest.approx(stick_area(*zone), rel=1e-12)
    assert stick_area(*(np.rot90(field, 1, (-2, -1)) for field in zone)) == area
    assert stick_area(*(field[..., ::-1] for field in zone)) == area
    for end in (contact(18.4, 1.5), contact(9.3, 0.5, turning=np.radians(5))):
        for domain in (ReducedDomain((True, True), (-1, 1)), ReducedDomain((False, True))):
            even = [domain.extend(domain.restrict(field)) for field in end]
            assert stick_area(*even, domain=domain) == pytest.approx(stick_area(*even), rel=1e-12)


# Semi-axes in cells, and how well the area is found: a small contact has few cells for the fits.
ELLIPSES = {
    "circle": ((20.0, 20.0), 1e-3),
    "ellipse": ((28.0, 11.0), 2e-3),
    "small": ((6.3, 6.3), 3e-2),
}


def dome(semi_axes, centre=(0.0, 0.0), cells=72):
    """The values of an elliptical Hertz pressure at cell centres."""
    x, y = np.indices((cells, cells)) - 0.5 * (cells - 1)
    inside = 1 - ((x - centre[0]) / semi_axes[0]) ** 2 - ((y - centre[1]) / semi_axes[1]) ** 2
    return np.sqrt(np.maximum(inside, 0))


@pytest.mark.parametrize("centre", [(0.0, 0.0), (0.3, -0.2), (0.5, 0.5)])
@pytest.mark.parametrize(("semi_axes", "accuracy"), ELLIPSES.values(), ids=ELLIPSES)
def test_area_under_a_square_root_is_exact_to_a_small_part_of_a_cell(semi_axes, accuracy, centre):
    values = dome(semi_axes, centre)
    # p^2 is a quadratic: only taking the edge as straight within a cell is an approximation.
    assert covered_cells(values, values > 0) == pytest.approx(
        np.pi * semi_axes[0] * semi_axes[1], rel=accuracy
    )


@pytest.mark.parametrize("cells", [2, 6, 40, 72])
def test_a_quarter_tells_the_area(cells):
    values = dome((17.0, 11.0), cells=cells)
    quarter = QUARTER
    part = covered_cells(quarter.restrict(values), quarter.restrict(values > 0), quarter)
    assert 4 * part == pytest.approx(covered_cells(values, values > 0), rel=1e-12)


@pytest.mark.parametrize("turned_back", [False, True], ids=["pushed", "turned back"])
@pytest.mark.parametrize("degrees", [0.0, 35.0, 250.0])
def test_stick_area_is_that_of_cattaneo_and_mindlin(degrees, turned_back):
    """Shear is µp less a second dome within the stick zone; less twice that after a reversal, so
    that the shear in the middle still points the old way."""
    a = 28.0
    c = 13.0
    friction = 0.3
    bound, inner = friction * dome((a, a)), friction * c / a * dome((c, c))
    along = np.array([np.cos(np.radians(degrees)), np.sin(np.radians(degrees))])[:, None, None]
    shear = (bound - (2 if turned_back else 1) * inner) * along
    assert stuck_cells(shear, bound, inner > 0) == pytest.approx(np.pi * c**2, rel=3e-3)
