"""What friction carries of a push beside torsion, and sliding beyond it, by the radial solver."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose
from turning_contacts import FRICTION, LIMIT, RADIUS, points, push, rough, scene, twist

from contact_results.surface import surface_of
from contact_scene import LoadStep
from contact_scene.solver_errors import GrossSliding
from contact_scene.summary import ContactStatus
from radial.circle import Circle
from radial.sliding import carried_times


def test_friction_carries_less_of_a_push_beside_torsion() -> None:
    ring = points(Circle.WHOLE)
    r = np.repeat(ring.radii, ring.count)
    limit = np.sqrt(np.maximum(1 - (r / RADIUS) ** 2, 0.0))
    both = np.array([True, True, True])
    force, torque = limit @ ring.areas, limit @ ring.levers
    assert carried_times(ring, limit, np.array([0.6 * force, 0, 0]), both) == pytest.approx(
        1 / 0.6, rel=1e-6
    )
    assert carried_times(ring, limit, np.array([0, 0, torque]), both) == pytest.approx(1, rel=1e-6)
    given = np.array([0, 0.7 * force, 0.7 * torque])
    ways = np.linspace(0, np.pi / 2, 2001)
    slips = np.stack([0 * ways, np.cos(ways), np.sin(ways) / RADIUS], axis=1)
    sliding = (slips @ ring.ways).reshape(len(ways), 2, -1)
    least = np.min((np.hypot(sliding[:, 0], sliding[:, 1]) @ limit) / (slips @ given))
    assert 1 / 1.4 < least < 1 / 0.7  # convex, and within the box of both
    assert carried_times(ring, limit, given, both) == pytest.approx(least, rel=1e-5)
    held = carried_times(ring, limit, np.array([0.7 * force, 0, 0]), np.array([True, True, False]))
    assert held == pytest.approx(1 / 0.7, rel=1e-6)


@pytest.mark.parametrize(
    ("steps", "words"),
    [
        ((twist(1.2, 2),), "prescribe the twist"),
        ((twist(0.8), push(0.8, 0.0)), "slides and turns"),
        (
            (push(0.6, 0.0), push(0.6, 0.6), LoadStep(approach=0.5 * RADIUS**2, increments=1)),
            "not below the friction limit",
        ),
    ],
)
def test_more_than_friction_carries_is_refused(steps: tuple[LoadStep, ...], words: str) -> None:
    with pytest.raises(GrossSliding, match=words):
        rough(scene(*steps))


def test_far_motions_slide_under_what_friction_carries_of_both() -> None:
    far = LoadStep(twist=0.01, tangential_shift=(5e-5, 3e-5), increments=6)
    result = rough(scene(far))
    *_, before, end = result.increments
    assert end.status is ContactStatus.GROSS_SLIDING
    assert end.stick_radius == 0
    assert math.hypot(*end.tangential_force) < 0.9 * LIMIT
    # What loads do along their motions friction takes at every point along its own.
    (v, w), turn = (
        np.subtract(end.tangential_shift, before.tangential_shift), end.twist - before.twist,
    )  # fmt: skip
    surface = surface_of(result)
    x, y = surface.positions
    lost = FRICTION * end.pressure * np.hypot(v - turn * y, w + turn * x)
    work = end.tangential_force @ np.array([v, w]) + end.torque * turn
    assert_allclose(np.sum(lost * surface.weights), work, rtol=5e-3)
