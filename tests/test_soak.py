"""Fretting for a long time: every cycle after the first is the same, and nothing piles up."""

import gc
import re
from pathlib import Path

import numpy as np
import pytest
from contact_scenes import grid, push, scene

from semi_analytical import plan
from semi_analytical.history import march
from semi_analytical.model import ContactModel

TOLERANCE = 1e-8
SHAKEN_DOWN = 0.1  # of the cycles
STEPS = 2  # of a cycle


def resident_bytes() -> int:
    gc.collect()
    status = Path("/proc/self/status").read_text(encoding="utf-8")
    found = re.search(r"^VmRSS:\s+(\d+)", status, re.MULTILINE)
    assert found is not None
    return 1024 * int(found[1])


@pytest.mark.parametrize(
    "cycles",
    [20, pytest.param(1000, marks=[pytest.mark.slow, pytest.mark.timeout(1800)])],
)
def test_cycles_repeat_and_leave_nothing_behind(cycles: int) -> None:
    """Loss of energy drifts by no more than 1e-6 per cycle, memory grows by no more than 1 %."""
    there, back = push(0.6, increments=2), push(-0.6, increments=2)
    fretting = scene({"normal_force": 1e3}, *[there, back] * cycles)
    decided = plan(fretting)
    ends = np.cumsum(decided.increments)[::STEPS]  # of the pressing, and of every cycle
    early, lost, memory = round(SHAKEN_DOWN * cycles), [], []
    model = ContactModel.of(fretting, grid(16))
    for number, increment in enumerate(march(model, decided, TOLERANCE), 1):
        if number in ends:
            lost.append(increment.dissipated_energy)
            if len(lost) - 1 in (early, cycles):
                memory.append(resident_bytes())
    per_cycle = np.diff(lost)[early:]
    assert len(per_cycle) == cycles - early
    assert np.all(per_cycle > 0)
    assert np.max(np.abs(np.diff(per_cycle))) <= 1e-6 * per_cycle[0]
    assert abs(per_cycle[-1] - per_cycle[0]) <= 1e-6 * per_cycle[0] * len(per_cycle)
    assert memory[1] <= 1.01 * memory[0]
