"""The error by finite increments, estimated by doubling them."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from contact_scenes import PRESS, grid, push, scene, slide
from coupled_scenes import bulk
from coupled_scenes import scene as coupled_scene
from scene_texts import RIGID_BALL

from contact_results.files.summary_file import summary_of
from contact_results.path_error import CHANGES, compared, shear_difference
from contact_scene.path_error import PathError
from contact_scene.summary import load_summary
from semi_analytical import Result, plan, solve
from slipstick.path_errors import path_errors

TOLERANCE = 1e-9
TURNING = scene(PRESS, push(0.5), push(0, 0.5, increments=8))
PUSHED = coupled_scene(
    {**PRESS, "increments": 4}, {"tangential_shift": (2e-7, 0), "increments": 6}, body=bulk()
)


def solved(described, factor=1) -> Result:
    return solve(described, grid(), TOLERANCE, plan=plan(described).refined(factor))


@pytest.fixture(scope="module")
def turning() -> tuple[Result, PathError, Result]:
    """A result, its estimate at the end, and the result with sixteen times the increments."""
    result = solved(TURNING)
    return result, path_errors(result)[-1], solved(TURNING, 16)


def test_estimate_brackets_the_true_error_of_a_load_that_turns(turning):
    """Cattaneo's contact, then the force turns: the error is one to two and a half changes."""
    result, estimate, exact = turning
    true = shear_difference(TURNING, result.steps[-1], exact.steps[-1])
    assert estimate.shear / CHANGES <= true <= estimate.shear
    for quantity in estimate.quantities:
        if quantity.name in ("tangential_shift_y", "dissipated_energy"):
            error = abs(quantity.value - value(exact, quantity.name))
            assert quantity.error / CHANGES <= error <= quantity.error, quantity.name


def test_richardson_beats_the_finer_of_the_two(turning):
    _, estimate, exact = turning
    for quantity in estimate.quantities:
        if quantity.name in ("tangential_shift_x", "tangential_shift_y", "dissipated_energy"):
            finer = (quantity.value + quantity.extrapolated) / 2
            limit = value(exact, quantity.name)
            assert abs(quantity.extrapolated - limit) < 0.5 * abs(finer - limit), quantity.name
            assert abs(quantity.extrapolated - limit) <= quantity.uncertainty


def value(result: Result, name: str) -> float:
    end = result.steps[-1]
    stem, _, axis = name.rpartition("_")
    return float(getattr(end, stem)["xy".index(axis)] if axis in ("x", "y") else getattr(end, name))


def test_every_step_is_doubled_whether_its_path_is_known_to_matter_or_not(turning):
    result, _, _ = turning
    found = path_errors(result)
    assert [(e.increments, e.doubled_increments) for e in found] == [(1, 2), (1, 2), (8, 16)]
    assert all(e.shear < 1e-2 for e in found[:2])


def test_what_one_increment_of_sliding_leaves_out_shows():
    """Between alike bodies a shift goes straight: one increment, of which nothing is known."""
    (_, _, end) = path_errors(solved(scene(PRESS, slide(20), slide(-20))))
    by_name = {quantity.name: quantity for quantity in end.quantities}
    assert end.doubled_increments == 2 * end.increments
    assert by_name["dissipated_energy"].error > 0


def test_the_edge_of_the_stick_zone_is_known_to_a_part_of_a_cell_at_best(turning):
    result, estimate, exact = turning
    (stick,) = (q for q in estimate.quantities if q.name == "stick_radius")
    assert stick.error >= 0.5 * result.grid.spacing[0]
    assert abs(stick.value - value(exact, "stick_radius")) <= stick.error


def test_estimates_under_shift_control_are_of_the_force(turning):
    (_, end) = path_errors(solved(PUSHED))
    by_name = {quantity.name: quantity for quantity in end.quantities}
    assert by_name["tangential_shift_x"].error == 0
    assert by_name["tangential_force_x"].error > 0
    assert end.pressure > 0


def test_without_friction_there_is_no_shear_to_be_wrong():
    (end,) = path_errors(solved(scene(PRESS, friction=None)))
    assert end.shear is None
    assert [q.name for q in end.quantities] == [
        "normal_force", "approach", "contact_radius", "peak_pressure"
    ]  # fmt: skip


def test_comparison_with_itself_finds_nothing(turning):
    result, _, _ = turning
    assert all(e.shear == e.pressure == 0 for e in compared(result, result))


def test_summary_has_the_estimate_only_if_it_was_asked_for(turning):
    result, _, _ = turning
    assert summary_of(result, ()).path_errors is None
    errors = path_errors(result)
    assert summary_of(result, (), errors).path_errors == errors


SCENE = f"""{RIGID_BALL}
[[loading]]
normal_force = "1 kN"
increments = 2
[[loading]]
tangential_force = ["50 N", 0]
increments = 2
[semi_analytical]
cells = [16, 16]
window = ["1 mm", "1 mm"]
"""
ROOT = Path(__file__).resolve().parents[1]


def test_command_writes_and_prints_the_estimate(tmp_path):
    (tmp_path / "scene.toml").write_text(SCENE)
    code = f"import sys; sys.path.insert(0, {str(ROOT)!r}); from slipstick.cli import main; main()"
    arguments = ["run", "scene.toml", "--output", "out", "--no-figures", "--path-error"]
    outcome = subprocess.run(
        [sys.executable, "-c", code, *arguments],
        cwd=tmp_path, capture_output=True, text=True, check=True,
    )  # fmt: skip
    assert "errors by finite increments" in outcome.stdout
    text = (tmp_path / "out" / "summary.json").read_text(encoding="utf-8")
    errors = load_summary(text).path_errors
    assert errors is not None
    assert [(e.increments, e.doubled_increments) for e in errors] == [(2, 4), (2, 4)]
    assert errors[1].shear > 1e-3
    assert np.isfinite(json.loads(text)["path_errors"][1]["shear"])
