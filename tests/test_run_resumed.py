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
from command import outcome, signalled
from scene_texts import STEEL_ON_STEEL

ROOT = Path(__file__).resolve().parents[1]
SCENE = (
    STEEL_ON_STEEL
    + """
[[body.layers]]
thickness = "50 um"
material = { young_modulus = "70 GPa", poisson_ratio = 0.33 }
[friction]
coefficient = 0.3
[[loading]]
normal_force = 100
increments = 4
[[loading]]
tangential_force = [20, 0]
increments = 8
[[loading]]
tangential_force = [-20, 0]
increments = 8
[semi_analytical]
cells = [20, 20]
[fem_reference]
elements_per_radius = 6
"""
)
# With a checkpoint after every increment; "DYING" stands for what is done after it.
RUN = f"""
import sys
sys.path.insert(0, {str(ROOT)!r})
import contact_results.directory.checkpoint as checkpoint
checkpoint.SECONDS_BETWEEN, checkpoint.SHARE = 0.0, float("inf")
DYING
from slipstick.cli import main
main()
"""
# However busy the machine is, some increments are done then and some are not.
KILLED_AFTER_SIX = """
import os, signal
from pathlib import Path
keep = checkpoint.CheckpointDirectory.keep
def keep_and_die(self, standing):
    keep(self, standing)
    if Path(".out.checkpoint/part-000005").exists():
        os.kill(os.getpid(), signal.SIGKILL)
checkpoint.CheckpointDirectory.keep = keep_and_die
"""


ASKED = ("run", "scene.toml", "-o", "out", "--figures", "none", "--no-error")


@pytest.fixture(autouse=True)
def _no_stored_coefficients(monkeypatch: pytest.MonkeyPatch) -> None:
    """Their hits are counted in the results."""
    monkeypatch.setenv("SLIPSTICK_CACHE_DIR", os.devnull)


def started(directory: Path, *options: str, dying: str = "") -> "subprocess.Popen[str]":
    (directory / "scene.toml").write_text(SCENE, encoding="utf-8")
    return subprocess.Popen(
        [sys.executable, "-c", RUN.replace("DYING", dying), *ASKED, *options],
        cwd=directory,
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    )


def results(directory: Path) -> dict[str, bytes]:
    """All files but the one that says how long it took; nothing else is left anywhere."""
    assert {path.name for path in directory.iterdir()} == {"scene.toml", "out"}
    files = visible(directory)
    assert {"result.h5", "summary.json"} <= files.keys()
    assert len(files) + 1 == len(os.listdir(directory / "out"))
    return files


def visible(directory: Path) -> dict[str, bytes]:
    """The results, whatever else a killed run has left."""
    paths = [path for path in (directory / "out").iterdir() if path.is_file()]
    return {path.name: path.read_bytes() for path in paths if path.name != "timing.json"}


def uninterrupted(directory: Path, *options: str) -> dict[str, bytes]:
    directory.mkdir()
    (directory / "scene.toml").write_text(SCENE, encoding="utf-8")
    ended = outcome(*ASKED, *options, cwd=directory)
    assert ended.returncode == 0, ended.stderr
    return results(directory)


def parts(directory: Path, checkpoint: str) -> int:
    return len(list((directory / checkpoint).glob("part-*")))


def test_killed_run_goes_on_and_leaves_the_same_bytes(tmp_path: Path) -> None:
    expected = uninterrupted(tmp_path / "whole")
    killed = tmp_path / "killed"
    killed.mkdir()
    started(killed, dying=KILLED_AFTER_SIX).communicate()
    assert parts(killed, ".out.checkpoint") == 6
    assert not (killed / "out").exists()
    ended = outcome(*ASKED, cwd=killed)
    assert ended.returncode == 0, ended.stderr
    assert "going on after increment 6 of an interrupted run" in ended.stderr
    assert results(killed) == expected


# ---- interrupted commands


ENDLESS_SCENE = f"""{STEEL_ON_STEEL}
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


def endless_started(directory: Path, *arguments: str, by: str = "") -> "subprocess.Popen[str]":
    return subprocess.Popen(
        [sys.executable, "-c", PROGRAM.replace("INTERRUPTED", by), *arguments],
        cwd=directory,
        text=True,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
    )


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
    (tmp_path / "scene.toml").write_text(ENDLESS_SCENE, encoding="utf-8")
    command = ("run", "scene.toml", "-o", "out")
    process = endless_started(tmp_path, *command)
    wait_for(tmp_path, ".out.checkpoint/part-*", 3)
    last = interrupted(process)[-1]
    told = re.fullmatch(
        r"interrupted; the same command goes on after increment (\d+), kept in (.*)", last
    )
    assert told is not None, last
    assert sorted(os.listdir(tmp_path)) == [".out.checkpoint", "scene.toml"]
    assert Path(told[2]) == tmp_path / ".out.checkpoint"
    process = endless_started(tmp_path, *command)
    assert process.stderr is not None
    first = process.stderr.readline()
    interrupted(process)
    assert f"going on after increment {told[1]} of an interrupted run" in first


def test_interrupted_verification_counts_what_it_keeps(tmp_path: Path) -> None:
    process = endless_started(
        tmp_path,
        "verify",
        *CASES,
        "-o",
        "out",
        "--workers",
        "1",
        "--fresh",
        by=signalled("SIGINT", saved=1),
    )
    again = "the same command without --fresh"
    last = interrupted(process, by_itself=True)[-1]
    assert last == f"interrupted; 1 of 2 cases are stored in out/cases; {again} computes the others"
    assert os.listdir(tmp_path / "out") == ["cases"]


# ---- clocks


PUSHED = """[[loading]]
tangential_force = ["60 N", 0]
increments = 2
"""
TIMED_SCENE = f"""
[indenter]
shape = "sphere"
radius = "18 mm"
material = "rigid"
[body]
material = {{ young_modulus = "210 GPa", poisson_ratio = 0.3 }}
[friction]
coefficient = 0.1
[[loading]]
normal_force = "1 kN"
{PUSHED}[semi_analytical]
cells = [16, 16]
edge = "off"
"""
YEAR = 3.15e7


def jumping(*jumps: float) -> Callable[[], float]:
    """A clock that is set by so much, again and again, whenever it is looked at."""
    steps, now = itertools.cycle(jumps), [1e9]

    def clock() -> float:
        now[0] += next(steps)
        return now[0]

    return clock


CLOCKS = {
    "forward by years": jumping(YEAR),
    "back by years": jumping(-YEAR),
    "to and fro": jumping(-3 * YEAR, 0.0, 5 * YEAR, -YEAR, 1e-3),
    "standing still": jumping(0.0),
}


def set_clocks(monkeypatch: pytest.MonkeyPatch, clock: Callable[[], float]) -> None:
    for name in ("time", "monotonic", "perf_counter", "process_time"):
        monkeypatch.setattr(time, name, clock)


def files(directory: Path) -> dict[str, bytes]:
    paths = (path for path in directory.rglob("*") if path.is_file())
    return {path.name: path.read_bytes() for path in paths if path.name != "timing.json"}


@pytest.fixture(scope="module")
def expected(tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    return run(tmp_path_factory.mktemp("expected"), "--figures", "none")


def run(directory: Path, *options: str, scene: str = TIMED_SCENE) -> dict[str, bytes]:
    (directory / "scene.toml").write_text(scene, encoding="utf-8")
    ended = outcome("run", "scene.toml", "-o", "out", "--no-error", *options, cwd=directory)
    assert ended.returncode == 0, ended.stderr
    assert {path.name for path in directory.iterdir()} == {"scene.toml", "out"}
    return files(directory / "out")


@pytest.fixture(autouse=True)
def _no_cache(monkeypatch: pytest.MonkeyPatch) -> None:
    """Its hits are counted in the results."""
    monkeypatch.setenv("SLIPSTICK_CACHE_DIR", os.devnull)


@pytest.mark.parametrize("name", CLOCKS)
def test_a_run_writes_the_same_bytes_whatever_the_clocks_do(
    name: str, expected: dict[str, bytes], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    set_clocks(monkeypatch, CLOCKS[name])
    assert run(tmp_path, "--figures", "none") == expected
