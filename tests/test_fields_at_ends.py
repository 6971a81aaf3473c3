"""Tests of stored fields: at the ends of load steps, or at every increment on request.

Every reader finds the fields, or names the option that stores them.
"""

import numpy as np
import pytest
from contact_scenes import LOAD, PRESS, push, scene

import slipstick
from contact_results.result_files import write_result
from contact_scene.quantities.increment import (
    SCALARS,
)

# The pressure rests while the load turns, and is packed once.
LIGHTER = {"normal_force": 0.5 * LOAD, "increments": 2}
LOOP = (push(part, increments=12) for part in (-0.2, 0.2))
SCENE = scene(PRESS, push(0.2, increments=12), LIGHTER, *LOOP)
COUNTS = (1, 12, 2, 12, 12)
ENDS = np.cumsum(COUNTS) - 1


@pytest.fixture(scope="module")
def result():
    return slipstick.solve(SCENE, discretisation=slipstick.SurfaceDiscretisation(cells=(16, 16)))


@pytest.fixture(scope="module")
def directories(result, tmp_path_factory):
    """The same result with the fields of every increment, and by default."""
    every, ends = (tmp_path_factory.mktemp(name) for name in ("every", "ends"))
    write_result(result, every, figures="none", all_fields=True)
    write_result(result, ends, figures="none")
    return every, ends


def test_fields_are_those_at_the_ends_and_scalars_all(result, directories):
    every, ends = map(slipstick.load, directories)
    for name in ("pressure", "in_contact", "gap", "shear", "slip"):
        fields = [getattr(increment, name) for increment in result.increments]
        np.testing.assert_array_equal(every.increments[name].array, fields)
    assert ends.last_cycle
    assert set(ends.increments) == set(every.increments)
    for name in every.increments:
        whole, kept = every.increments[name], ends.increments[name]
        if name in SCALARS or name in ("step", "increment"):
            assert np.array_equal(kept.array, whole.array, equal_nan=True)
            continue
        assert whole.indices[0] == "increment"
        assert kept.indices == ("step", *whole.indices[1:])
        assert np.array_equal(kept.array, whole.array[ENDS])
    for name in every.last_cycle:
        assert np.array_equal(ends.last_cycle[name].array, every.last_cycle[name].array)


def test_one_increment_is_found_or_refused(directories):
    every, ends = map(slipstick.load, directories)
    for row in ENDS.tolist():
        one, other = ends.increment(row), every.increment(row)
        assert np.array_equal(one.shear, other.shear)
        assert one.approach == other.approach
    with pytest.raises(KeyError, match=r"increment 12 is not one of them.*--all-fields"):
        ends.increment(int(ENDS[1]) - 1)
