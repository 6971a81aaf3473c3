"""Tests of `--save-expected` and `--expect`: a later result is held to the stated errors alone."""

import json
from pathlib import Path
from typing import Any

import pytest
from command import outcome

from slipstick.expected import (
    ExpectedNumber,
    Source,
    expected_changes,
)

pytestmark = pytest.mark.usefixtures("one_process")
BALL = """
title = "steel ball"
[indenter]
shape = "paraboloid"
radius = "18 mm"
material = "rigid"
[body]
material = { young_modulus = "210 GPa", poisson_ratio = 0.3 }
[[body.layers]]
thickness = "0.4 mm"
material = { young_modulus = "420 GPa", poisson_ratio = 0.3 }
[[loading]]
normal_force = "1 kN"
[semi_analytical]
cells = [24, 24]
"""
SOURCE = Source("run", {"indenter.radius": 0.018}, "radial")
EXPECTED = "expected.json"


def number(value: float, error: float | None, mark: str = "") -> ExpectedNumber:
    return ExpectedNumber(value=value, error=error, reliable=not mark, unit="m", scale=1.0)


@pytest.mark.parametrize(
    ("was", "now", "kind"),
    [
        ((1, 0.1), (1.19, 0.1), "unchanged"),
        ((1, 0.1), (1.21, 0.1), "outside"),
        ((1, 0.1), (0.79, 0.1), "outside"),
        ((1, 1e-9), (1 + 3e-9, 1e-9), "outside"),
        ((1, 0.1), (1, 0.149), "unchanged"),
        ((1, 0.1), (1, 0.151), "worse"),
        ((1, 1e-6), (1, 1.9e-6), "unchanged"),
        ((1, 1e-6), (1, 2.1e-6), "worse"),
        ((1, 0.1), (1, 0.049), "better"),
        ((1, 0.0), (1 + 0.9e-6, 0.0), "unchanged"),
        ((1, 0.0), (1 + 1.1e-6, 0.0), "outside"),
        ((1, 0.1), (1, 0.1, "?"), "worse"),
        ((1, 0.1, "?"), (1, 0.1), "better"),
        ((1, 0.1, "?"), (2.9, 0.1, "?"), "unchanged"),
        ((1, 0.1, "?"), (3.1, 0.1, "?"), "outside"),
        ((1, 0.1), (1, None, "?"), "worse"),
        ((1, None, "?"), (2, None, "?"), "drift"),
        ((1, 0.1), None, "gone"),
        (None, (1, 0.1), "new"),
    ],
)
def test_numbers_are_compared_by_their_stated_errors(was: Any, now: Any, kind: str) -> None:
    """No tolerance is chosen. An error with a question mark is right to an order of magnitude."""
    expected, found = (
        SOURCE.with_numbers({"step 1": {"approach": number(*one)} if one else {}})
        for one in (was, now)
    )
    kinds = [row.kind for row in expected_changes(found, expected, EXPECTED)]
    assert kinds == [kind] * (kind != "unchanged")


@pytest.fixture
def scene(tmp_path: Path) -> Path:
    path = tmp_path / "ball.toml"
    path.write_text(BALL, encoding="utf-8")
    return path


COMMANDS = {
    "run": ("run", "--figures", "none"),
    "stress": ("stress", "--figures", "none"),
    "sweep": (
        *("sweep", "--vary", "body.layers[1].thickness=100..400 um 2"),
        *("--get", "peak_pressure,von_mises@body", "--workers", "1"),
    ),
}
# What a user may change: cells, increments, solver, title and the notation of a value.
FINER = (
    *("--set", "semi_analytical.cells=[48,48]", "--set", "loading[1].increments=2"),
    *("--set", 'title="ball"', "--set", "body.layers[1].thickness=400um"),
)


def call(scene: Path, name: str, *more: str) -> tuple[int, str]:
    command, *options = COMMANDS[name]
    ended = outcome(command, scene.name, "-o", name, *options, *more, cwd=scene.parent)
    return ended.returncode, ended.stdout + ended.stderr


@pytest.mark.parametrize("name", COMMANDS)
def test_results_of_a_scene_are_held_to_saved_ones(scene: Path, name: str) -> None:
    saved = scene.parent / EXPECTED
    assert call(scene, name, "--save-expected", EXPECTED)[0] == 0
    code, said = call(scene, name, "--expect", EXPECTED)
    assert (code, "nothing has changed since expected.json" in said) == (0, True)
    record = json.loads(saved.read_text())
    of_place = next(of for of in reversed(record["numbers"].values()) if of)
    changed = next(one for one in of_place.values() if one["error"])
    changed["value"] += 3 * changed["error"]
    of_place["lost"] = changed
    saved.write_text(json.dumps(record), encoding="utf-8")
    code, said = call(scene, name, "--expect", EXPECTED)
    assert code == 7
    assert "the intervals exclude each other" in said
    assert "lost" in said
    assert any((scene.parent / name).iterdir())


def test_a_result_on_coarser_cells_is_worse_and_is_written(scene: Path) -> None:
    assert call(scene, "run", "--save-expected", EXPECTED, *FINER)[0] == 0
    code, said = call(scene, "run", "--expect", EXPECTED)
    assert (code, "the stated error is" in said) == (7, True)
    assert json.loads((scene.parent / "run" / "summary.json").read_text())["cells"] == [24, 24]
    code, said = call(scene, "run", "--expect", EXPECTED, "--solver", "radial")
    assert (code, "better; --save-expected expected.json saves" in said) == (0, True), said
    assert call(scene, "run", "--save-expected", "again.json", *FINER)[0] == 0
    assert (scene.parent / "again.json").read_bytes() == (scene.parent / EXPECTED).read_bytes()
