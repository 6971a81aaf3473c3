"""Tests of load histories of 100 and 10 000 increments: the memory does not grow with their number.

Every increment is reported once, and the final state is that of a few increments.
"""

import gc
import sys
from pathlib import Path

import numpy as np
import pytest
from contact_scenes import PRESS, push, scene

import slipstick
from contact_scene.quantities import stored_fields

EARLY = 0.3  # of the increments: all is allocated, and fields go into the file


def resident_bytes() -> int:
    """Memory of the process."""
    gc.collect()
    status = Path("/proc/self/status").read_text(encoding="utf-8")
    return 1024 * int(status.partition("VmRSS:")[2].split()[0])


FINENESS = {
    "semi-analytical": slipstick.SurfaceDiscretisation(cells=(16, 16), edge="off"),
    "radial": slipstick.RadialDiscretisation(rings=16),
}

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="memory is read from /proc")


def pushed(solver: str, count: int) -> slipstick.Scene:
    """To the half of the friction limit, or where that is of no use pressed further."""
    if solver == "radial":
        return scene(PRESS, {"normal_force": 2e3, "increments": count}, friction=None)
    return scene(PRESS, push(0.5, increments=count))


MANY = pytest.param(10_000, marks=[pytest.mark.slow, pytest.mark.timeout(3600)])


@pytest.mark.parametrize("count", [100, MANY])
@pytest.mark.parametrize("solver", FINENESS)
def test_memory_is_flat_and_the_end_that_of_a_few(solver, count, monkeypatch):
    monkeypatch.setattr(stored_fields, "MAX_IN_MEMORY", 1 << 20)
    seen = []
    memory = []

    def watch(increment):
        if increment.step == 2:
            seen.append(increment.index)
            if increment.index in (round(EARLY * count), count):
                memory.append(resident_bytes())

    solve = slipstick.solve
    result = solve(pushed(solver, count), solver, FINENESS[solver], progress=watch)
    assert seen == [*range(1, count + 1)]
    assert memory[1] <= 1.01 * memory[0]
    few = solve(pushed(solver, 10), solver, FINENESS[solver]).steps[-1]
    end = result.steps[-1]
    assert np.max(np.abs(end.pressure - few.pressure)) <= 1e-6 * np.max(few.pressure)
    # Slip of ten increments goes by chords: 2.4e-3 of the largest shear apart.
    if solver == "semi-analytical":
        apart = np.max(np.abs(end.shear - few.shear))
        assert apart <= 1e-2 * np.max(np.abs(few.shear))
    del result
    gc.collect()
