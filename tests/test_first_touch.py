"""Slip counts from the touch of two surfaces until they part, not over the whole increment."""

import numpy as np
import pytest
from contact_scenes import grid
from coupled_scenes import bulk, press, scene

from semi_analytical import solve
from semi_analytical.increments.tangential_state import touching_share

X = np.linspace(-1.2, 1.2, 49)
SQUARED = X[:, None] ** 2 + X**2


def hertz(a, squared=SQUARED):
    """Pressure below a paraboloid in contact up to a, over its largest at a = 1."""
    return np.sqrt(np.maximum(a**2 - squared, 0.0))


@pytest.mark.parametrize("a", [0.0, 0.52, 0.88])
def test_below_a_paraboloid_the_share_is_that_of_the_area(a):
    share = touching_share(hertz(a), hertz(1.0), SQUARED)
    meets = (a**2 < SQUARED) & (SQUARED < 1)
    np.testing.assert_allclose(share[meets], (1 - SQUARED[meets]) / (1 - a**2), atol=1e-9)
    assert np.all(share[~meets] == 1)


def test_a_lower_summit_touches_later():
    """Of alike summits each has p² in proportion to how far it is pressed in."""
    nearer, farther = (SQUARED + 1.2 * X[:, None] * side + 0.36 for side in (1, -1))
    before, after = hertz(0.3, nearer), hertz(0.5, nearer) + hertz(0.2, farther)
    share = touching_share(before, after, SQUARED)
    assert share[farther < 0.04].max() == pytest.approx(0.04 / 0.16)


def test_the_mirror_of_a_contact_has_the_mirror_of_its_share():
    """Also where p² has not grown alike in cells that are equally near."""
    before, after = hertz(0.52), hertz(1.0) * (1 + 0.2 * X[:, None] + 0.1 * X)
    share = touching_share(before, after, SQUARED)
    for mirror in (np.flipud, np.fliplr, np.transpose):
        seen = touching_share(mirror(before), mirror(after), SQUARED)
        np.testing.assert_allclose(seen, mirror(share), rtol=1e-12)


def test_parting_is_meeting_backwards():
    meets = touching_share(hertz(0.8), hertz(1.0), SQUARED)
    np.testing.assert_array_equal(touching_share(hertz(1.0), hertz(0.8), SQUARED), meets)
    assert np.any(meets < 1)


def test_slip_and_its_energy_count_from_touch():
    """Against many increments; charged for all motion they are off by 0.58 and 0.08."""

    def pressed(increments):
        return solve(
            scene(press(increments=increments), body=bulk(0.3)), grid(40, 1.25), 1e-7
        ).increments[-1]

    few, many = pressed(10), pressed(40)
    assert np.max(np.hypot(*few.slip)) == pytest.approx(np.max(np.hypot(*many.slip)), rel=0.06)
    assert few.dissipated_energy == pytest.approx(many.dissipated_energy, rel=0.03)
