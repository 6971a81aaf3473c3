"""The memory of a solve is known before it is taken: never too low, and seldom far too high."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

TESTS = Path(__file__).resolve().parent
MEASURED = """
import ctypes, gc, json, os, re, sys
from pathlib import Path
sys.path[:0] = {paths!r}
os.environ["SLIPSTICK_CACHE_DIR"] = os.devnull
import contact_scenes, coupled_scenes
from contact_scene import SurfaceDiscretisation
from semi_analytical import SurfaceGrid, plan, solve
from semi_analytical.discretise import discretise
from semi_analytical.memory import estimated_bytes

FILLED = 2.3  # contact radii: the widest contact that its window holds
scene = eval({scene!r}, vars(contact_scenes) | {{"coupled": coupled_scenes}})

def resident(line):
    status = Path("/proc/self/status").read_text()
    return 1024 * int(re.search(rf"^{{line}}:\\s+(\\d+)", status, re.M)[1])

def fitted(cells):
    return discretise(scene, SurfaceDiscretisation(cells=(cells, cells)))

def peak(grid):
    gc.collect()
    ctypes.CDLL(None).malloc_trim(0)
    Path("/proc/self/clear_refs").write_text("5")  # the peak starts here
    before = resident("VmRSS")
    solve(scene, grid, 1e-8)
    return resident("VmHWM") - before

first = solve(scene, fitted(24), 1e-8)  # all modules are loaded now
width = FILLED * max(i.contact_radius for i in first.increments)
grids = fitted({cells}), SurfaceGrid(({cells}, {cells}), (width, width))
print(json.dumps(estimated_bytes(grids[0], plan(scene)) / max(map(peak, grids))))
"""
PRESS = "dict(normal_force=LOAD, increments=2)"
PUSH = "dict(tangential_force=(0.6 * LIMIT, 0.0), increments=6)"
SCENES = {
    "pressed once": "scene(dict(normal_force=LOAD, increments=1), friction=None)",
    "pressed": f"scene({PRESS}, friction=None)",
    "sheared": f"scene({PRESS}, {PUSH})",
    "turned": f"scene({PRESS}, dict(torque=0.3 * LIMIT * A, increments=2))",
    "coupled": f"coupled.scene({PRESS}, {PUSH}, body=coupled.bulk())",
    "coupled strongly": f"coupled.scene({PRESS}, {PUSH}, body=coupled.bulk(0.1), friction=0.8)",
    "coated": f"coupled.scene({PRESS}, {PUSH}, body=coupled.coated())",
}


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="the peak is read from /proc")
@pytest.mark.parametrize("scene", SCENES.values(), ids=SCENES)
def test_estimated_memory_is_the_peak_or_a_little_more(scene: str) -> None:
    """The peak of 256 x 256 cells in a process of its own: the larger one of a fitted window and of
    one that the contact fills."""
    code = MEASURED.format(paths=[str(TESTS), str(TESTS.parent)], scene=scene, cells=256)
    outcome = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=False, timeout=900
    )
    assert outcome.returncode == 0, outcome.stderr
    assert 1.0 <= json.loads(outcome.stdout) <= 1.15
