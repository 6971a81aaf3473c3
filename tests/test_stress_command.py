"""Tests of `slipstick stress` from end to end: from a scene, from a run, and refusals."""

import json
from pathlib import Path

import numpy as np
import pytest
from command import outcome, rows
from scene_texts import STEEL_BALL_PRESSED

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
def place(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A scene, its run in `run`, and the stress of the scene in `out`."""
    directory = tmp_path_factory.mktemp("stress")
    scene = directory / "scene.toml"
    scene.write_text(SCENE, encoding="utf-8")
    for arguments in (
        ("run", scene, "-o", directory / "run", "--figures", "none", "--no-error"),
        ("stress", scene, "-o", directory / "out"),
    ):
        ended = outcome(*arguments, cwd=ROOT)
        assert ended.returncode == 0, ended.stderr
    return directory


def test_traction_on_the_interface_is_the_largest_of_one_side(place: Path) -> None:
    record = json.loads((place / "out" / "stress.json").read_text(encoding="utf-8"))
    measures = ("interface_shear", "interface_tensile_stress")
    found = [e for e in record["maxima"] if e["measure"] in measures]
    # The pressed interface is in compression, which decays to zero outside the computed region.
    assert [(e["region"], e["measure"]) for e in found] == [("interface 1 above", measures[0])]
    places, maxima = ("x", "y", "depth"), rows(place / "out" / "stress_maxima.csv")
    assert [[float(row[f"{name} [m]"]) for name in places] for row in maxima] == [
        [entry[name] for name in places] for entry in record["maxima"]
    ]
    table = rows(place / "out" / "stress_interfaces.csv")
    xz, zz, x = (
        np.array([float(row[name]) for row in table if row["side"] == "above"])
        for name in ("sigma_xz [Pa]", "sigma_zz [Pa]", "x [m]")
    )
    # The section is at y = 0, between rows of cells.
    assert found[0]["value"] == pytest.approx(np.max(np.abs(xz)), rel=0.02)
    radius = np.hypot(found[0]["x"], found[0]["y"])
    assert radius == pytest.approx(abs(x[np.argmax(np.abs(xz))]), abs=x[1] - x[0])
    assert np.max(zz) < 0
    assert found[0]["error"]["error"] < 0.1 * found[0]["value"]


def at_points(place: Path, source: str, out: str, *arguments: object) -> list[dict[str, str]]:
    ended = outcome("stress", place / source, "-o", place / out, *arguments, cwd=ROOT)
    assert ended.returncode == 0, ended.stderr
    return rows(place / out / "stress_history.csv")


def test_points_are_read_from_a_table(place: Path) -> None:
    table = place / "points.csv"
    table.write_bytes(
        "label;x [mm];y [µm];depth [mm]\na;0,1;50;0,03\nb;0;0;0,1\n;;;\n".encode("latin-1")
    )
    given = ("--at", "0.1 mm,50 um,0.03 mm", "--at", "0,0,0.1 mm")
    of_table = at_points(place, "run", "table", "--at", table)
    for found, expected in zip(of_table, at_points(place, "run", "at", *given), strict=True):
        assert found["material"] == expected["material"]
        for name in ("x [m]", "y [m]", "depth [m]", *SIGMA):
            value = float(expected[name])
            assert float(found[name]) == pytest.approx(value, rel=1e-9, abs=1e-3)
    for text, message in (
        ("x [mm],y [mm]\n1,2\n", "got no column z, expected x, y and z"),
        ("x [mm],y [mm],z [mm]\n1,2,-1\n", "depth is -0.001"),
    ):
        table.write_text(text, encoding="utf-8")
        ended = outcome("stress", place / "run", "-o", place / "no", "--at", table, cwd=ROOT)
        assert ended.returncode == 2
        assert message in " ".join(ended.stderr.replace("│", " ").split())


SIGMA = tuple(f"sigma_{name} [Pa]" for name in ("xx", "yy", "zz", "yz", "xz", "xy"))


def test_stress_at_a_point_is_that_of_the_table_on_both_sides(place: Path) -> None:
    found = at_points(place, "run", "point", "--at", "0,0,interface 1", "--step", 2)
    sides = [row for row in rows(place / "out/stress_axis.csv") if float(row["depth [m]"]) == 1e-4]
    assert len(found) == len(sides) == 2
    for row, of_axis in zip(found, sides, strict=True):
        assert row["material"] == of_axis["material"]
        for name in SIGMA:
            assert float(row[name]) == pytest.approx(float(of_axis[name]), rel=1e-9, abs=1.0)


def test_cells_and_rings_have_the_same_stress_at_points_within_their_errors(place: Path) -> None:
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


def test_a_history_of_points_needs_the_fields_of_all_increments(place: Path) -> None:
    point = ("--at", "0.2 mm,0,interface 1", "--history")
    shown = at_points(place, "scene.toml", "steps", *point)
    assert [(row["point"], row["step"], row["increment"]) for row in shown] == [
        (point, step, "1") for point in "12" for step in "12"
    ]
    four = ("--set", "loading[2].increments=4", "--figures", "none", "--no-error")
    for name, more in (("ends", ()), ("all", ("--all-fields",))):
        outcome("run", place / "scene.toml", "-o", place / name, *four, *more, cwd=ROOT)
    refused = outcome("stress", place / "ends", "-o", place / "no", *point, cwd=ROOT)
    assert refused.returncode == 2
    assert "run again with --all-fields" in " ".join(refused.stderr.replace("│", " ").split())
    found = at_points(place, "all", "history", *point)
    assert len(found) == 10
    assert float(found[4][SIGMA[2]]) == pytest.approx(float(shown[1][SIGMA[2]]), rel=1e-5)
    for row in found:
        largest, middle, least = (float(row[f"principal_{n} [Pa]"]) for n in (1, 2, 3))
        assert largest >= middle >= least
    for step in (1, 2):
        (of_step,) = at_points(place, "run", f"step {step}", *point[:2], "--step", step)[:1]
        assert of_step == shown[step - 1] | {"increment": ""}
    assert (place / "history/stress_history.png").is_file()


def test_the_last_step_of_a_scene_may_be_asked_for(tmp_path: Path) -> None:
    (tmp_path / "ball.toml").write_text(STEEL_BALL_PRESSED, encoding="utf-8")
    options = ("--solver", "radial", "--no-error", "--figures", "none", "-o", "out", "--step", 1)
    assert outcome("stress", "ball.toml", *options, cwd=tmp_path).returncode == 0
