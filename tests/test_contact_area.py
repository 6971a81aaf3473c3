"""Areas are found to a fraction of a cell where pressure falls like a square root."""

import numpy as np
import pytest

from semi_analytical.contact_area import covered_cells, stuck_cells
from semi_analytical.operator.domain import QUARTER

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


def test_area_does_not_depend_on_the_unit_of_the_values():
    values = dome((20, 20))
    area = covered_cells(values, values > 0)
    for unit in (1e-30, 1e12):
        assert covered_cells(unit * values, values > 0) == pytest.approx(area, rel=1e-9)


def test_region_too_small_for_a_fit_counts_its_cells():
    values = dome((2.2, 2.2))
    assert covered_cells(values, values > 0) == np.count_nonzero(values)


def test_values_that_rise_to_the_edge_count_whole_cells():
    """Below a flat punch the pressure grows to infinity: nothing tells where in a cell it ends."""
    disc = dome((20, 20)) > 0
    x, y = np.indices(disc.shape) - 35.5
    values = np.where(disc, 1 / np.sqrt(np.where(disc, 401 - x**2 - y**2, 1.0)), 0.0)
    assert covered_cells(values, disc) == pytest.approx(np.count_nonzero(disc), rel=2e-3)


@pytest.mark.parametrize("inside", [False, True], ids=["nothing", "everything"])
def test_extremes(inside):
    mask = np.full((12, 12), inside)
    expected = mask.size if inside else 0
    assert covered_cells(mask.astype(float), mask) == expected


@pytest.mark.parametrize("turned_back", [False, True], ids=["pushed", "turned back"])
@pytest.mark.parametrize("degrees", [0.0, 35.0, 250.0])
def test_stick_area_is_that_of_cattaneo_and_mindlin(degrees, turned_back):
    """Shear is µp less a second dome within the stick zone; less twice that after a reversal, so
    that the shear in the middle still points the old way."""
    a, c, friction = 28.0, 13.0, 0.3
    bound, inner = friction * dome((a, a)), friction * c / a * dome((c, c))
    along = np.array([np.cos(np.radians(degrees)), np.sin(np.radians(degrees))])[:, None, None]
    shear = (bound - (2 if turned_back else 1) * inner) * along
    assert stuck_cells(shear, bound, inner > 0) == pytest.approx(np.pi * c**2, rel=3e-3)


def test_where_nothing_slips_all_that_touches_sticks():
    bound = dome((20, 20))
    area = stuck_cells(0.1 * np.stack([bound, bound]), bound, bound > 0)
    assert area == covered_cells(bound, bound > 0)


def swollen(centre=(0.0, 0.0), lean=0.0):
    """Values whose square is no quadratic: e³ - 1 in the middle, and leaning to one side."""
    x, y = np.indices((72, 72)) - 35.5
    x, y = x - centre[0], y - centre[1]
    rise = np.exp(3 * (1 - (x**2 + y**2) / 20.3**2)) - 1
    return np.sqrt(np.maximum(rise * (1 + lean * (x - 0.4 * y) / 20.3), 0))


def test_a_turned_or_mirrored_region_has_the_same_area():
    """Also where no quadratic fits, and weights decide."""
    values = swollen((0.3, -0.2), lean=0.5)
    area = covered_cells(values, values > 0)
    for other in (values[::-1], values[:, ::-1], values.T, np.rot90(values)):
        assert covered_cells(other, other > 0) == pytest.approx(area, rel=1e-9)
