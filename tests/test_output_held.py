"""Another process has the results open while they are made anew."""

import os
import subprocess
import sys
from pathlib import Path

import h5py
import pytest
from command import outcome

from contact_results.directory import run_directory
from contact_results.directory.file_names import FIELDS

SCENE = """
[indenter]
shape = "paraboloid"
radius = "18 mm"
material = "rigid"
[body]
material = { young_modulus = "210 GPa", poisson_ratio = 0.3 }
[[loading]]
normal_force = 1000
increments = INCREMENTS
"""
HOLDING = """
import sys
files = [open(name, "rb") for name in sys.argv[1:]]
print("held", flush=True)
sys.stdin.readline()
print(sum(len(file.read()) for file in files))
"""


@pytest.fixture(autouse=True)
def _no_pauses(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(run_directory, "PAUSES", (0.0, 0.0))


def run(directory: Path, increments: int) -> "subprocess.CompletedProcess[str]":
    text = SCENE.replace("INCREMENTS", str(increments))
    (directory / "scene.toml").write_text(text, encoding="utf-8")
    words = (
        "run",
        "scene.toml",
        "-o",
        "out",
        "--solver",
        "radial",
        "--figures",
        "none",
        "--no-error",
    )
    return outcome(*words, cwd=directory)


def increments(directory: Path) -> int:
    with h5py.File(directory / "out" / FIELDS) as file:
        return len(file["increments"]["step"])


def test_a_reader_keeps_what_it_has_opened_and_the_run_replaces_it(tmp_path: Path) -> None:
    """Also where the reader is the HDF5 library, which locks what it reads."""
    assert run(tmp_path, 2).returncode == 0
    files = sorted(str(path) for path in (tmp_path / "out").iterdir())
    size = sum(os.path.getsize(name) for name in files)
    reader = subprocess.Popen(
        [sys.executable, "-c", HOLDING, *files],
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
    )  # fmt: skip
    assert reader.stdout is not None
    assert reader.stdout.readline() == "held\n"
    with h5py.File(tmp_path / "out" / FIELDS) as before:
        ended = run(tmp_path, 3)
        assert ended.returncode == 0, ended.stderr
        assert len(before["increments"]["step"]) == 2
    assert increments(tmp_path) == 3
    told, _ = reader.communicate("go\n")
    assert int(told) == size
