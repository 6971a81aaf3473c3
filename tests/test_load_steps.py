"""Tests of load steps: prescribed quantities, ramps, and the limits of force control."""

from contextlib import nullcontext

import numpy as np
import pytest
from contact_scenes import scene, steel

from contact_scene import (
    Body,
    HeightMap,
    LoadStep,
    Scene,
    SceneError,
)
from contact_scene.stepping.load_path import along_one_line, first_direction


@pytest.mark.parametrize(
    ("last", "straight"),
    [((-6.0, -8.0), True), ((0.0, 0.0), True), ((4.0, 4.0), False), ((3.0, -4.0), False)],
)
def test_the_direction_is_that_of_the_first_push_and_a_line_goes_both_ways(last, straight):
    ramps = scene(
        {"normal_force": 200.0}, {"tangential_force": (3.0, 4.0)}, {"tangential_force": last}
    ).load_path()
    assert (first_direction(ramps), along_one_line(ramps)) == ((0.6, 0.8), straight)


def test_a_moment_tips_a_map_over_its_shorter_side_alone():
    narrow = HeightMap.model_validate(
        {"file": np.zeros((8, 4)), "spacing": 1e-3, "material": steel()}
    )
    for moment, tips in (((0.0, 3e-3), False), ((3e-3, 0.0), True)):
        step = LoadStep(normal_force=1.0, moment=moment)
        with pytest.raises(SceneError, match="tips over") if tips else nullcontext():
            posed = Scene(indenter=narrow, body=Body(material=steel()), loading=(step,))
    assert posed.loading[0].moment == (0.0, 3e-3)
