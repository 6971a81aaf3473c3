"""Tests of `slipstick run` from end to end with a real solver, including interruption."""

import json
import os
import subprocess
import sys
from pathlib import Path

import jsonschema
import pytest
from command import outcome
from conftest import leave_figures_undrawn
from scene_texts import COARSE, STEEL_BALL_PRESSED

from contact_results.directory.file_names import SUMMARY
from contact_scene.quantities.summary import summary_schema

ROOT = Path(__file__).resolve().parents[1]

SCENE = (
    STEEL_BALL_PRESSED
    + """
[[loading]]
tangential_force = ["90 N", 0]
increments = 2
[[loading]]
tangential_force = ["-90 N", 0]
increments = 3
"""
    + COARSE
)
FILES = {
    "summary.json", "timing.json", "result.h5", "profiles.csv", "increments.csv",
    "columns.csv",
    "pressure.png", "shear.png", "profiles.png", "stick_slip.png",
    "dissipation.png", "slip.png", "overview.png", "index.html",
}  # fmt: skip


@pytest.fixture
def scene(tmp_path: Path) -> Path:
    path = tmp_path / "scene.toml"
    path.write_text(SCENE, encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The results of the scene with everything in them, their figures undrawn."""
    scene = tmp_path_factory.mktemp("whole") / "scene.toml"
    scene.write_text(SCENE, encoding="utf-8")
    with pytest.MonkeyPatch.context() as patch:
        leave_figures_undrawn(patch)
        ended = run(scene, "--figures", "all")
    assert ended.returncode == 0, ended.stderr
    return scene.parent / "out"


def command(scene: Path, *options: str) -> list[str]:
    output = str(scene.parent / "out")
    return [sys.executable, "-m", "slipstick", "run", str(scene), "--output", output, *options]


def run(scene: Path, *options: str) -> subprocess.CompletedProcess[str]:
    return outcome("run", scene, "--output", scene.parent / "out", *options, cwd=ROOT)


def summary(scene: Path) -> dict[str, list[dict[str, object]]]:
    text = (scene.parent / "out" / SUMMARY).read_text(encoding="utf-8")
    record: dict[str, list[dict[str, object]]] = json.loads(text)
    return record


def test_run_writes_every_file_and_the_same_bytes_in_another_process(
    whole: Path, scene: Path
) -> None:
    """Figures of equal results are equal: see test_run_output."""
    assert set(os.listdir(whole)) == FILES
    subprocess.run(command(scene, "--figures", "none"), cwd=ROOT, capture_output=True, check=True)
    jsonschema.validate(summary(scene), summary_schema())
    figures = {name for name in FILES if name.endswith(".png")}
    assert set(os.listdir(scene.parent / "out")) == FILES - figures - {"index.html"}
    for name in FILES - figures - {"index.html", "timing.json"}:
        assert (scene.parent / "out" / name).read_bytes() == (whole / name).read_bytes()


@pytest.mark.parametrize(
    ("override", "code", "words"),
    [
        ("semi_analytical.cells=[8192,8192]", 4, "GiB"),
        ('semi_analytical.window=["0.5 mm","0.5 mm"]', 2, "edge of the window"),
        ("body.material.poisson_ratio=0.5001", 2, "poisson_ratio"),
        ('loading[2].tangential_force=["101 N", 0]', 2, "gross sliding"),
    ],
)
def test_refusal_says_why_in_one_message_and_leaves_nothing(
    scene: Path, override: str, code: int, words: str
) -> None:
    ended = run(scene, "--set", override)
    assert ended.returncode == code
    assert ended.stderr.count("error: ") == 1
    assert words in ended.stderr
    assert "Traceback" not in ended.stderr
    assert os.listdir(scene.parent) == [scene.name]


def test_output_that_nobody_reads_has_a_code_of_its_own(scene: Path) -> None:
    """As under `| head -1`; the results are there."""
    running = command(scene, "--figures", "none")
    others = ([*running[:3], name, str(scene)] for name in ("check", "plan"))  # text, a table
    for arguments in (running, *others):
        read, write = os.pipe()
        os.close(read)
        outcome = subprocess.run(
            arguments, cwd=ROOT, stdout=write, stderr=subprocess.PIPE, check=False
        )
        os.close(write)
        assert outcome.returncode == 141
        assert b"Error" not in outcome.stderr
    assert (scene.parent / "out" / "summary.json").is_file()
