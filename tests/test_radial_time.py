"""What the radial solver says of its time, against the time that it takes."""

from __future__ import annotations

import re
from functools import partial

import pytest
from turning_contacts import push, rough, scene, twist

import radial
from contact_scene import LoadStep, RadialDiscretisation
from slipstick.solvers.on_radii import OnRadii
from verification.running.calibration import in_loops

LOOP = 0.007  # seconds that a calibration loop takes where those of an increment were measured


@pytest.mark.parametrize(
    "steps",
    [(twist(0.4, 60),), (push(0.8, 0.0, 16),), (push(0.5, 0.0, 10), twist(0.3, 10))],
    ids=["rings", "half a circle", "a whole circle"],
)
def test_a_run_takes_half_to_twice_the_time_that_is_said(steps: tuple[LoadStep, ...]) -> None:
    asked, fineness = scene(*steps), RadialDiscretisation()
    plan = radial.plan(asked)
    said = dict(OnRadii().work(asked, fineness, plan))["time"]
    told = re.match(r"about ([\d.]+) s of one core", said)
    assert told
    rough(scene(push(0.1, 0.0, 1)))  # what is imported by the first solve
    _, loops = in_loops(partial(radial.solve, asked, fineness, plan=plan))
    assert 0.5 < loops * LOOP / float(told[1]) < 2.0
