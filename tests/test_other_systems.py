"""A system without locks, hangups and limits, as Windows is, runs the same commands."""

import json
import os
import subprocess
import sys
from pathlib import Path

from scene_texts import STEEL_ON_STEEL

ROOT = Path(__file__).resolve().parents[1]
# What Python lacks on Windows or on macOS, taken away before the program is imported.
WITHOUT = """
import os, pathlib, signal, sys
import numpy, scipy.sparse, typer
sys.modules |= dict.fromkeys(("fcntl", "resource"))
del signal.SIGHUP
for name in ("O_DIRECTORY", "O_NOFOLLOW", "O_NONBLOCK", "pread", "pwrite", "sysconf",
             "sched_getaffinity"):
    delattr(os, name)
read = pathlib.Path.read_text
def elsewhere(path, *options, **more):
    if path.parts[:2] == ("/", "proc"):
        raise FileNotFoundError(path)
    return read(path, *options, **more)
pathlib.Path.read_text = elsewhere
import slipstick.cli
"""
SCENE = f"""{STEEL_ON_STEEL}
[[loading]]
normal_force = 100
"""


RUN_TWICE = """
for _ in range(2):
    try:
        slipstick.cli.main(['run', 'scene.toml', '-o', 'out', '--solver=radial', '--figures=none'])
    except SystemExit as ending:
        assert not ending.code
from verification.running.local_workers import cores
assert cores() >= 1
"""


def test_results_appear_and_are_replaced_without_locks(tmp_path: Path) -> None:
    (tmp_path / "scene.toml").write_text(SCENE, encoding="utf-8")
    ended = subprocess.run(
        [sys.executable, "-c", WITHOUT + RUN_TWICE], cwd=tmp_path, text=True, capture_output=True,
        timeout=600, check=False, env=os.environ | {"PYTHONPATH": str(ROOT)},
    )  # fmt: skip
    assert ended.returncode == 0, ended.stderr
    assert sorted(os.listdir(tmp_path)) == ["out", "scene.toml"]
    assert not [name for name in os.listdir(tmp_path / "out") if name.startswith(".")]
    timing = json.loads((tmp_path / "out" / "timing.json").read_text(encoding="utf-8"))
    assert timing["peak_memory_bytes"] is None
