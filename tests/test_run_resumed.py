"""A run that is killed loses an increment at most, and its files are those of one that is not."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from command import outcome
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
        cwd=directory, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
    )  # fmt: skip


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
