"""Tests of `slipstick run` from end to end with a real solver, including interruption."""

import json
import os
import subprocess
import sys
from pathlib import Path

import jsonschema
import numpy as np
import pytest
from command import outcome, succeeded
from conftest import leave_figures_undrawn
from scene_texts import COARSE, STEEL_BALL_PRESSED
from small_result import small_result

from contact_results.directory.file_names import SUMMARY
from contact_scene.quantities.summary import summary_schema
from slipstick import load, save

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
    + COARSE.replace("32", "16")
)
# A closed load cycle.
STEPS = ("normal_force=1e3", *(f"tangential_force=[{force}, 0]" for force in (90, -90, 90)))
REVERSED = f"loading=[{', '.join(f'{{{step}}}' for step in STEPS)}]"
FILES = {
    "summary.json",
    "timing.json",
    "result.h5",
    "profiles.csv",
    "increments.csv",
    "columns.csv",
    "pressure.png",
    "shear.png",
    "profiles.png",
    "stick_slip.png",
    "dissipation.png",
    "slip.png",
    "overview.png",
    "index.html",
}


@pytest.fixture
def scene(tmp_path):
    path = tmp_path / "scene.toml"
    path.write_text(SCENE, encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
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
    return json.loads(text)


def test_run_writes_every_file_and_the_same_bytes_in_another_process(whole, scene):
    """Figures of equal results are equal: see test_run_output."""
    assert set(os.listdir(whole)) == FILES
    subprocess.run(command(scene, "--figures", "none"), cwd=ROOT, capture_output=True, check=True)
    jsonschema.validate(summary(scene), summary_schema())
    figures = {name for name in FILES if name.endswith(".png")}
    assert set(os.listdir(scene.parent / "out")) == FILES - figures - {"index.html"}
    for name in FILES - figures - {"index.html", "timing.json"}:
        assert (scene.parent / "out" / name).read_bytes() == (whole / name).read_bytes()


def test_output_that_nobody_reads_has_a_code_of_its_own(scene):
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


PARTS = {
    "the load cycles": "contact_results.result_report.fretting_cycles",
    "the errors": "contact_errors.coarse_solves.compare_with_coarse_solves",
    "the tables": "contact_results.files.tables.write_profiles",
    "the figures": "contact_results.figures.figure_files.overview",
    "the page": "contact_results.figures.run_page.key_numbers",
}


def test_parts_that_cannot_be_computed_are_named_and_the_rest_is_written(scene, monkeypatch):
    """The directory is then still that of a run, for all commands that read one."""
    with monkeypatch.context() as planted:
        for function in PARTS.values():
            planted.setattr(function, lambda *_, **__: 1 / 0)
        ended = run(scene, "--set", REVERSED)
    assert ended.returncode == 70
    warnings = " ".join(map(str, summary(scene)["warnings"]))
    for part in PARTS:
        told = f"{part} could not be computed: ZeroDivisionError: division by zero"
        assert told in " ".join(ended.stderr.split())
        assert told in warnings
    out = scene.parent / "out"
    stored = load(out)
    assert np.max(stored.end_of_step(3).pressure) > 0
    assert len(stored.last_cycle) == 0
    profile = scene.parent / "profile.csv"
    profile.write_text("x [um],p [MPa]\n0,1000\n10,900\n", encoding="utf-8")
    for words in (
        ("export", out, "-o", scene.parent / "surface"),
        ("stress", out, "-o", scene.parent / "stress", "--figures", "none"),
        ("against", profile, out),
    ):
        succeeded(*words, cwd=ROOT)


def test_a_saved_result_names_what_could_not_be_computed(tmp_path, monkeypatch):
    monkeypatch.setattr(PARTS["the page"], lambda *_: 1 / 0)
    with pytest.warns(UserWarning, match="the page could not be computed") as given:
        save(small_result(), tmp_path / "out")
    assert given[0].filename == __file__  # the line of the caller
    assert load(tmp_path / "out").summary.warnings[-1].startswith("the page could not")
