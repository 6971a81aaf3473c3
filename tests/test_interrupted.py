"""Whoever interrupts a command is told what is kept and how to go on."""

import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from command import signalled
from scene_texts import STEEL_ON_STEEL

ROOT = Path(__file__).resolve().parents[1]
SCENE = f"""{STEEL_ON_STEEL}
[friction]
coefficient = 0.3
[[loading]]
normal_force = 100
[[loading]]
tangential_force = [20, 0]
increments = 50000
[semi_analytical]
cells = [16, 16]
"""
# With a checkpoint after every increment; "INTERRUPTED" stands for what interrupts it.
PROGRAM = f"""
import signal, sys
signal.signal(signal.SIGINT, signal.default_int_handler)  # a job in the background ignores it
sys.path.insert(0, {str(ROOT)!r})
import contact_results.directory.checkpoint as checkpoint
checkpoint.SECONDS_BETWEEN, checkpoint.SHARE = 0.0, float("inf")
INTERRUPTED
from slipstick.cli import main
main()
"""
CASES = ("layered_identities", "cattaneo_mindlin")


def started(directory: Path, *arguments: str, by: str = "") -> "subprocess.Popen[str]":
    return subprocess.Popen(
        [sys.executable, "-c", PROGRAM.replace("INTERRUPTED", by), *arguments],
        cwd=directory, text=True, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
    )  # fmt: skip


def wait_for(directory: Path, pattern: str, count: int) -> None:
    deadline = time.monotonic() + 600
    while len(list(directory.glob(pattern))) < count and time.monotonic() < deadline:
        time.sleep(0.01)


def interrupted(process: "subprocess.Popen[str]", *, by_itself: bool = False) -> list[str]:
    """What it says on the terminal."""
    if not by_itself:
        process.send_signal(signal.SIGINT)
    _, said = process.communicate(timeout=600)
    assert process.returncode == 130, said
    return said.splitlines()


def test_interrupted_run_says_from_where_it_goes_on(tmp_path: Path) -> None:
    (tmp_path / "scene.toml").write_text(SCENE, encoding="utf-8")
    command = ("run", "scene.toml", "-o", "out")
    process = started(tmp_path, *command)
    wait_for(tmp_path, ".out.checkpoint/part-*", 3)
    last = interrupted(process)[-1]
    told = re.fullmatch(
        r"interrupted; the same command goes on after increment (\d+), kept in (.*)", last
    )
    assert told is not None, last
    assert sorted(os.listdir(tmp_path)) == [".out.checkpoint", "scene.toml"]
    assert Path(told[2]) == tmp_path / ".out.checkpoint"
    process = started(tmp_path, *command)
    assert process.stderr is not None
    first = process.stderr.readline()
    interrupted(process)
    assert f"going on after increment {told[1]} of an interrupted run" in first


@pytest.mark.parametrize("fresh", [False, True], ids=["", "fresh"])
def test_interrupted_verification_counts_what_it_keeps(fresh: bool, tmp_path: Path) -> None:
    options = ("--fresh",) if fresh else ()
    process = started(
        tmp_path, "verify", *CASES, "-o", "out", "--workers", "1", *options,
        by=signalled("SIGINT", saved=1),
    )  # fmt: skip
    again = "the same command without --fresh" if fresh else "the same command"
    last = interrupted(process, by_itself=True)[-1]
    assert last == f"interrupted; 1 of 2 cases are kept in out/cases; {again} computes the others"
    assert os.listdir(tmp_path / "out") == ["cases"]
