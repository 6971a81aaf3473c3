"""Whoever allows two threads of linear algebra gets the same bytes."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from processes import results, run
from scene_texts import STEEL_ON_STEEL

SCENE = (Path(__file__).resolve().parents[1] / "scenes" / "coated_ball.toml").read_text("utf-8")
QUICK = ("--figures", "none", "--no-error")


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    scene = re.sub(r"cells = .*", "cells = [64, 64]", SCENE)
    assert scene != SCENE
    (tmp_path / "scene.toml").write_text(scene, encoding="utf-8")
    return tmp_path


@pytest.mark.parametrize(
    "solver",
    ["semi-analytical", *(pytest.param(s, marks=pytest.mark.slow) for s in ("radial", "fem"))],
)
def test_stress_of_a_run_has_the_same_bytes_by_two_threads(folder: Path, solver: str) -> None:
    """Of a run that is read back: the libraries are loaded by the stress itself."""
    run(folder, "run", "scene.toml", "--solver", solver, "-o", "run", *QUICK)
    found = []
    for threads in (1, 2):
        out = f"stress-{threads}"
        ended = run(folder, "stress", "run", "-o", out, *QUICK, threads=threads)
        assert ended.code == 0, ended.said
        found.append(results(folder / out))
    assert found[0]
    assert found[0] == found[1]


def test_a_table_has_the_same_bytes_by_two_threads(folder: Path) -> None:
    words = ("table", "ball", "--over", "E1_over_E2=0.5,2", "--over", "h_over_aH=0.1,1")
    one, two = (run(folder, *words, threads=threads).out for threads in (1, 2))
    assert one.count("\n") > 4
    assert one == two


# ---- A system without locks, hangups and limits, as Windows is, runs the same commands.


ROOT = Path(__file__).resolve().parents[1]
# What Python lacks on Windows or on macOS, taken away before the program is imported.
WITHOUT = """
import os, pathlib, shutil, signal, sys
import numpy, scipy.sparse, typer
shutil._use_fd_functions = False
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
OTHER_SCENE = f"""{STEEL_ON_STEEL}
[[loading]]
normal_force = 100
"""


RUN_TWICE = """
for _ in range(2):
    try:
        slipstick.cli.main(['run', 'scene.toml', '-o', 'out', '--solver=radial', '--figures=none'])
    except SystemExit as ending:
        assert not ending.code
from verification.running.case_pool import cores
assert cores() >= 1
"""


def test_results_appear_and_are_replaced_without_locks(tmp_path: Path) -> None:
    (tmp_path / "scene.toml").write_text(OTHER_SCENE, encoding="utf-8")
    ended = subprocess.run(
        [sys.executable, "-c", WITHOUT + RUN_TWICE], cwd=tmp_path, text=True, capture_output=True,
        timeout=600, check=False, env=os.environ | {"PYTHONPATH": str(ROOT)},
    )  # fmt: skip
    assert ended.returncode == 0, ended.stderr
    assert sorted(os.listdir(tmp_path)) == ["out", "scene.toml"]
    assert not [name for name in os.listdir(tmp_path / "out") if name.startswith(".")]
    timing = json.loads((tmp_path / "out" / "timing.json").read_text(encoding="utf-8"))
    assert timing["peak_memory_bytes"] is None
