"""Tests of `slipstick sweep`: values of keys, samples of distributions, resumption, and
refusals."""

import json
import shlex
from pathlib import Path

import numpy as np
import pytest
from command import outcome, rows

from slipstick.sweep_chart import SweptQuantity, round_ticks

pytestmark = pytest.mark.usefixtures("one_process")
HERTZ = """
title = "steel ball"
[indenter]
shape = "paraboloid"
radius = "18 mm"
material = { young_modulus = "210 GPa", poisson_ratio = 0.3 }
[body]
material = { young_modulus = "210 GPa", poisson_ratio = 0.3 }
[[loading]]
normal_force = "1 kN"
"""
MODULUS = 210e9 / 0.91 / 2
RADIUS = "indenter.radius [mm]"


def peak(radius: float, force: float) -> float:
    return float((6 * force * MODULUS**2 / (np.pi**3 * radius**2)) ** (1 / 3))


@pytest.fixture
def scene(tmp_path: Path) -> Path:
    path = tmp_path / "ball.toml"
    path.write_text(HERTZ, encoding="utf-8")
    return path


def sweep(scene: Path, *arguments: object, out: str = "out"):
    return outcome("sweep", scene, "-o", out, *arguments, cwd=scene.parent)


def test_a_row_has_value_error_and_a_scene_that_gives_it_again(scene: Path) -> None:
    varied = (
        "--vary",
        "indenter.radius=9..36 mm log 3",
        "--vary",
        "loading[1].normal_force=1..2 kN 2",
    )
    wanted = ("--get", "peak_pressure,von_mises@body", "--solver", "radial")
    ended = sweep(scene, *varied, *wanted)
    assert ended.returncode == 0, ended.stderr
    found = rows(scene.parent / "out/sweep.csv")
    assert len(found) == 6
    for row in found:
        exact = peak(1e-3 * float(row[RADIUS]), 1e3 * float(row["loading[1].normal_force [kN]"]))
        error = abs(float(row["peak_pressure [Pa]"]) - exact)
        assert error <= float(row["peak_pressure error [Pa]"]) + 1e-14 * exact
        assert float(row["von_mises@body [Pa]"]) == pytest.approx(0.62 * exact, rel=2e-3)
    outcome("run", *shlex.split(found[4]["scene"]), "-o", "again", cwd=scene.parent)
    again = json.loads((scene.parent / "again/summary.json").read_text(encoding="utf-8"))
    assert again["steps"][-1]["peak_pressure"] == float(found[4]["peak_pressure [Pa]"])
    assert (scene.parent / "out/sweep.png").stat().st_size > 5000
    scene.write_text(HERTZ.replace("0.3 }\n[body]", "0.2 }\n[body]"), encoding="utf-8")
    assert "already there" not in sweep(scene, *varied, *wanted).stderr


@pytest.mark.parametrize(
    ("ends", "ticks"),
    [
        ((10.0, 100.0), [10, 20, 50, 100]),
        ((3.0, 70.0), [5, 10, 20, 50]),
        ((2e-6, 9e-6), [2e-6, 5e-6]),
        ((1.0, 1e3), [1, 10, 100, 1000]),
        ((1e-9, 1e6), [1e-9, 1e-7, 1e-5, 1e-3, 0.1, 10, 1000, 1e5]),
        ((11.0, 18.0), [12, 13, 14, 15, 16, 17]),
        ((7.0, 7.0), [7]),
    ],
)
def test_ticks_of_a_logarithmic_axis_are_round_numbers(
    ends: tuple[float, float], ticks: list[float]
) -> None:
    assert round_ticks(*ends) == ticks


def test_errors_bound_the_percentiles_of_every_value_within_them() -> None:
    draw = np.random.default_rng(1)
    values, errors = draw.normal(size=(2, 50)), draw.uniform(0, 0.3, size=(2, 50))
    middle, low, high = SweptQuantity("", "", values, errors).percentiles
    moved = SweptQuantity("", "", values + errors * draw.uniform(-1, 1, (2, 50)), errors)
    assert np.all(low < middle)
    assert np.all(middle < high)
    assert np.all((low <= moved.percentiles[0]) & (moved.percentiles[0] <= high))
