"""Tests of interrupted runs: at most one increment is lost, and the files are the same."""

import itertools
import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest
from command import signalled, succeeded
from scene_texts import STEEL_ON_STEEL

ROOT = Path(__file__).resolve().parents[1]
FRICTION = """
[friction]
coefficient = 0.3
[[loading]]
normal_force = 100
increments = 4
[[loading]]
tangential_force = [20, 0]
"""
COATED = """
[[body.layers]]
thickness = "50 um"
material = { young_modulus = "70 GPa", poisson_ratio = 0.33 }
"""
REVERSED = """
increments = 8
[[loading]]
tangential_force = [-20, 0]
increments = 8
"""
CELLS = """
[semi_analytical]
cells = [20, 20]
edge = "off"
"""
SCENE = STEEL_ON_STEEL + COATED + FRICTION + REVERSED + CELLS
ENDLESS_SCENE = STEEL_ON_STEEL + FRICTION + "increments = 50000\n" + CELLS
# With a checkpoint after every increment; "INTERRUPTED" stands for what interrupts the command.
PROGRAM = f"""
import os, signal, sys
from pathlib import Path
signal.signal(signal.SIGINT, signal.default_int_handler)  # a job in the background ignores it
sys.path.insert(0, {str(ROOT)!r})
import contact_results.directory.checkpoint as checkpoint
checkpoint.SECONDS_BETWEEN, checkpoint.SHARE = 0.0, float("inf")
INTERRUPTED
from slipstick.cli import main
main()
"""
# However busy the machine is, some increments are done then and some are not.
KILLED_AFTER_SIX = """
keep = checkpoint.CheckpointDirectory.keep
def keep_and_die(self, standing):
    keep(self, standing)
    if Path(".out.checkpoint/part-000005").exists():
        os.kill(os.getpid(), signal.SIGKILL)
checkpoint.CheckpointDirectory.keep = keep_and_die
"""
RUN = ("run", "scene.toml", "-o", "out", "--figures", "none", "--no-error")


@pytest.fixture(autouse=True)
def _no_stored_coefficients(monkeypatch):
    """Their hits are counted in the results."""
    monkeypatch.setenv("SLIPSTICK_CACHE_DIR", os.devnull)


def started(directory: Path, *words: str, by: str = "") -> "subprocess.Popen[str]":
    return subprocess.Popen(
        [sys.executable, "-c", PROGRAM.replace("INTERRUPTED", by), *words],
        cwd=directory,
        text=True,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
    )


def completed(directory: Path) -> tuple[str, dict[str, bytes]]:
    """Messages of a run, and its files but the one with times; nothing else is left anywhere."""
    ended = succeeded(*RUN, cwd=directory)
    assert {path.name for path in directory.iterdir()} == {"scene.toml", "out"}
    files = {path.name: path.read_bytes() for path in (directory / "out").iterdir()}
    assert {"result.h5", "summary.json"} <= files.keys()
    del files["timing.json"]
    return ended.stderr, files


def folder_with(path: Path, scene: str) -> Path:
    path.mkdir()
    (path / "scene.toml").write_text(scene, encoding="utf-8")
    return path


def test_killed_run_goes_on_and_leaves_the_same_bytes(tmp_path):
    _, expected = completed(folder_with(tmp_path / "whole", SCENE))
    killed = folder_with(tmp_path / "killed", SCENE)
    started(killed, *RUN, by=KILLED_AFTER_SIX).communicate()
    assert len(list((killed / ".out.checkpoint").glob("part-*"))) == 6
    assert not (killed / "out").exists()
    told, files = completed(killed)
    assert "going on after increment 6 of an interrupted run" in told
    assert files == expected


def interrupted(process: "subprocess.Popen[str]", *, by_itself: bool = False) -> list[str]:
    """What it says on the terminal."""
    if not by_itself:
        process.send_signal(signal.SIGINT)
    _, said = process.communicate(timeout=600)
    assert process.returncode == 130, said
    return said.splitlines()


def test_interrupted_run_says_from_where_it_goes_on(tmp_path):
    folder = folder_with(tmp_path / "run", ENDLESS_SCENE)
    process = started(folder, *RUN)
    deadline = time.monotonic() + 600
    while len([*folder.glob(".out.checkpoint/part-*")]) < 3 and time.monotonic() < deadline:
        time.sleep(0.01)
    last = interrupted(process)[-1]
    told = re.fullmatch(
        r"interrupted; the same command goes on after increment (\d+), kept in (.*)", last
    )
    assert told is not None, last
    assert sorted(os.listdir(folder)) == [".out.checkpoint", "scene.toml"]
    assert Path(told[2]) == folder / ".out.checkpoint"
    process = started(folder, *RUN)
    first = process.stderr.readline()
    interrupted(process)
    assert f"going on after increment {told[1]} of an interrupted run" in first


def test_interrupted_verification_counts_what_it_keeps(tmp_path):
    verify = ("verify", "hertz_approach_control", "layered_reference", "-o", "out")
    by = signalled("SIGINT", saved=1)
    process = started(tmp_path, *verify, "--workers", "1", "--fresh", by=by)
    again = "the same command without --fresh"
    last = interrupted(process, by_itself=True)[-1]
    assert last == f"interrupted; 1 of 2 cases are stored in out/cases; {again} computes the others"
    assert os.listdir(tmp_path / "out") == ["cases"]


# ---- clocks


YEAR = 3.15e7


def jumping(*jumps: float) -> Callable[[], float]:
    """A clock that is set by so much, again and again, whenever it is looked at."""
    steps, now = itertools.cycle(jumps), [1e9]

    def clock() -> float:
        now[0] += next(steps)
        return now[0]

    return clock


@pytest.mark.parametrize(
    "clock",
    [jumping(-3 * YEAR, 0.0, 5 * YEAR, -YEAR, 1e-3), jumping(0.0)],
    ids=["to and fro", "standing still"],
)
def test_a_run_writes_the_same_bytes_whatever_the_clocks_do(clock, tmp_path, monkeypatch):
    _, expected = completed(folder_with(tmp_path / "usual", SCENE))
    for name in ("time", "monotonic", "perf_counter", "process_time"):
        monkeypatch.setattr(time, name, clock)
    assert completed(folder_with(tmp_path / "odd", SCENE))[1] == expected
