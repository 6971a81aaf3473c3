"""Tests of whole commands by all solvers: at the friction limit, and of drawn scenes."""

import json
from math import pi, sqrt
from pathlib import Path
from typing import Any

import pytest
from contact_scenes import LIMIT, PRESS, A, push, scene, steel
from whole_commands import SOLVERS, failures_of_drawn_scenes, run_command, write_scene

from contact_scene import Body, CoulombFriction, Layer, LoadStep, Paraboloid, Scene
from contact_scene.friction_limit import AT_LIMIT, ROUND_OFF

AT_THE_LIMIT = {
    "oblique": (scene(PRESS, push(sqrt(0.5), sqrt(0.5))), SOLVERS),
    "rounding error below": (scene(PRESS, push(1 - 2**-53)), SOLVERS[:2]),
    "rounding error above": (scene(PRESS, push(1 + 2**-52, increments=2)), SOLVERS[:3]),
    "just below": (scene(PRESS, push(1 - 0.5 * AT_LIMIT)), SOLVERS),
    "at once": (scene({**PRESS, **push(1.0), "increments": 2}), SOLVERS),
}


def summary(folder: Path, solver: str, *options: str) -> dict[str, Any]:
    """Summary of a run of the scene in a folder, which ends with exit code 0."""
    output = folder / solver
    scene_file = folder / "scene.toml"
    given: tuple[str | Path, ...] = (
        "--solver",
        solver,
        "--figures",
        "none",
        "--output",
        output,
        *options,
    )
    ran = run_command("run", scene_file, *given)
    assert ran.code == 0, ran.text
    record: dict[str, Any] = json.loads((output / "summary.json").read_text(encoding="utf-8"))
    return record


def test_round_off_at_the_friction_limit_is_no_stick_zone(tmp_path: Path) -> None:
    """Few elements below a stiff film: the friction limit exceeds the shear by 1e-10."""
    film = Layer(thickness=1e-5, material=steel(0.3, 1e15))
    base = Body(material=steel(0.3, 1e12), layers=(film,))
    contact = Scene(
        indenter=Paraboloid(radius=0.0464, **dict(base)),
        body=base,
        friction=CoulombFriction(coefficient=1.0),
        loading=[
            LoadStep(normal_force=20341.4793441547, increments=3),
            LoadStep(tangential_force=(20341.479342120554, 0.0), increments=1),
        ],
    )
    write_scene(contact, tmp_path / "scene.toml")
    assert summary(tmp_path, "fem", "--no-error")["steps"][-1]["stick_radius"] == 0


@pytest.mark.parametrize(
    ("name", "solver"),
    [(name, solver) for name, (_, solvers) in AT_THE_LIMIT.items() for solver in solvers],
)
def test_every_solver_slides_at_the_friction_limit(tmp_path: Path, name: str, solver: str) -> None:
    """The oblique push also by whole commands with errors, plan and export."""
    write_scene(AT_THE_LIMIT[name][0], tmp_path / "scene.toml")
    whole = name == "oblique"
    record = summary(tmp_path, solver, *([] if whole else ["--no-error"]))
    end = record["steps"][-1]
    assert (end["status"], end["stick_radius"]) == ("gross sliding", 0)
    assert end["tangential_shift"] is end["dissipated_energy"] is end["input_work"] is None
    warned = [text for text in record["warnings"] if "friction limit" in text]
    assert len(warned) == 1
    assert "prescribe tangential_shift" in warned[0]
    if whole:
        planned = run_command("plan", tmp_path / "scene.toml", "--solver", solver)
        assert planned.code == 0
        assert planned.text.count("prescribe tangential_shift") == 1
        exported = run_command("export", tmp_path / solver, "--output", tmp_path / "surface")
        assert exported.code == 0, exported.text


@pytest.mark.parametrize("solver", SOLVERS)
def test_nothing_sticks_without_friction(tmp_path: Path, solver: str) -> None:
    """A coefficient of 0: a prescribed shift moves the indenter without a force."""
    shifted = {"tangential_shift": (1e-7, 0.0), "increments": 2}
    write_scene(scene(PRESS, shifted, friction=0.0), tmp_path / "scene.toml")
    end = summary(tmp_path, solver)["steps"][-1]
    assert (end["status"], end["stick_radius"]) == ("gross sliding", 0)
    assert (end["tangential_force"], end["dissipated_energy"]) == ([0, 0], 0)


def test_a_torque_at_its_friction_limit_slides(tmp_path: Path) -> None:
    """Torque 3π/16 µWa of a paraboloid, by the closed form of the radial solver."""
    limit = 3 * pi / 16 * LIMIT * A
    for part in (1.0, 1 - 0.5 * AT_LIMIT):
        write_scene(scene(PRESS, {"torque": part * limit}), tmp_path / "scene.toml")
        record = summary(tmp_path, "radial", "--overwrite")
        end = record["steps"][-1]
        assert (end["status"], end["stick_radius"], end["twist"]) == ("gross sliding", 0, None)
        assert end["torque"] == part * limit
        assert sum("prescribe twist" in text for text in record["warnings"]) == 1
    write_scene(scene(PRESS, {"torque": limit * (1 + 100 * ROUND_OFF)}), tmp_path / "scene.toml")
    ran = run_command("run", tmp_path / "scene.toml", "--solver", "radial", "--output", tmp_path)
    assert ran.code == 2
    assert "exceeds the friction limit" in ran.text


@pytest.mark.parametrize(("count", "seed"), [(2, 15), pytest.param(40, 0, marks=pytest.mark.slow)])
def test_commands_of_drawn_scenes_end_as_documented(count: int, seed: int) -> None:
    assert failures_of_drawn_scenes(count, seed) == []
