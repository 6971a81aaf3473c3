"""What friction carries of a push beside torsion, and sliding beyond it, by the radial solver."""

from __future__ import annotations

import numpy as np
import pytest
from turning_contacts import RADIUS, points, push, rough, scene, twist

from contact_scene import LoadStep
from contact_scene.solver_errors import GrossSliding
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
