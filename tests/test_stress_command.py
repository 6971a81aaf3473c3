"""Tests of `slipstick stress` at points: cells and rings agree within their errors."""

from pathlib import Path

import pytest
from command import rows, succeeded

ROOT = Path(__file__).resolve().parents[1]

SCENE = r"""
title = 'coated $\frac{$'
[indenter]
shape = "paraboloid"
radius = "18 mm"
material = { young_modulus = "210 GPa", poisson_ratio = 0.3 }
[body]
material = { young_modulus = "210 GPa", poisson_ratio = 0.3 }
[[body.layers]]
thickness = "0.1 mm"
material = { young_modulus = "420 GPa", poisson_ratio = 0.25 }
[[loading]]
normal_force = "500 N"
[[loading]]
normal_force = "1 kN"
[semi_analytical]
cells = [32, 32]
window = ["1.2 mm", "1.2 mm"]
"""


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    """A scene, and its run in `run`."""
    directory = tmp_path_factory.mktemp("stress")
    scene = directory / "scene.toml"
    scene.write_text(SCENE, encoding="utf-8")
    options = ("-o", directory / "run", "--figures", "none", "--no-error")
    succeeded("run", scene, *options, cwd=ROOT)
    return directory


def at_points(place, source, out, *arguments):
    succeeded("stress", place / source, "-o", place / out, *arguments, cwd=ROOT)
    return rows(place / out / "stress_history.csv")


SIGMA = tuple(f"sigma_{name} [Pa]" for name in ("xx", "yy", "zz", "yz", "xz", "xy"))


def test_cells_and_rings_have_the_same_stress_at_points_within_their_errors(place):
    points = ("--at", "0.3 mm,0,0.25 mm", "--at", "0,0.3 mm,0.25 mm", "--at", "-.3mm,.2mm,.15mm")
    cells = at_points(place, "run", "cells", *points)
    rings = at_points(place, "scene.toml", "rings", *points, "--solver", "radial")
    asked = [(3e-4, 0.0), (0.0, 3e-4), (-3e-4, 2e-4)]
    for one, other, (x, y) in zip(cells, rings, asked, strict=True):
        assert (float(one["x [m]"]), float(one["y [m]"])) == (x, y)
        allowed = float(one["error [Pa]"]) + float(other["error [Pa]"])
        assert allowed < 2e7
        for name in SIGMA:
            assert abs(float(one[name]) - float(other[name])) <= allowed
    assert rings[0]["sigma_xx [Pa]"] == rings[1]["sigma_yy [Pa]"]
    assert abs(float(rings[2]["sigma_xy [Pa]"])) > 1e7


def test_a_table_at_points_is_written_without_a_figure_if_none_is_asked_for(place):
    """A figure of an earlier call, which shows other numbers, is removed."""
    point, figure = ("--at", "0.3 mm,0,0.25 mm"), place / "drawn/stress_history.png"
    at_points(place, "run", "drawn", *point)
    assert figure.is_file()
    at_points(place, "run", "drawn", *point, "--figures", "none")
    assert not figure.exists()


def test_errors_of_points_are_left_empty_if_none_are_asked_for(place):
    (row,) = at_points(place, "run", "bare", "--at", "0,0,0", "--figures", "none", "--no-error")
    assert row["error [Pa]"] == ""
    assert float(row["sigma_zz [Pa]"]) < 0
