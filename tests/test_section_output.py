"""Tests of the output of finite-element results on a meridional section."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from command import rows, slipstick
from conftest import leave_figures_undrawn
from fem_scenes import solved

from contact_results.result_files import write_result
from contact_scene import (
    Body,
    CoulombFriction,
    IsotropicMaterial,
    Layer,
    LoadStep,
    Paraboloid,
    Scene,
)
from fem_reference import Result

STEEL = IsotropicMaterial(young_modulus=210e9, poisson_ratio=0.3)
FILM = Layer(thickness=0.2e-3, material=IsotropicMaterial(young_modulus=4e11, poisson_ratio=0.2))
FRICTION = CoulombFriction(coefficient=0.1)
BALL = Paraboloid(radius=18e-3, material=STEEL)
PRESS = LoadStep(normal_force=1e3)
PUSH, PULL = (LoadStep(tangential_force=(t, 0.0), increments=2) for t in (60.0, -60.0))
TURN = LoadStep(torque=0.01, increments=2)

HERTZ = Scene(title="Hertz", indenter=BALL, body=Body(material=STEEL), loading=(PRESS,))
LOOP = HERTZ.model_copy(
    update={"title": "loop", "friction": FRICTION, "loading": (PRESS, PUSH, PULL, PUSH)}
)
COATED = LOOP.model_copy(
    update={
        "title": "coated",
        "body": Body(material=STEEL, layers=(FILM,)),
        "loading": (PRESS, PUSH),
    }
)
TWISTED = LOOP.model_copy(update={"title": "twisted", "loading": (PRESS, TURN)})
SCENES = {scene.title: scene for scene in (HERTZ, LOOP, COATED, TWISTED)}
DRAWN = "loop"


@pytest.fixture(scope="module", params=SCENES)
def written(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory
) -> tuple[Result, Path]:
    result = solved(SCENES[request.param], 8, harmonics=2)
    directory = tmp_path_factory.mktemp("written")
    _write(result, directory)
    return result, directory


def _write(result: Result, directory: Path) -> None:
    """Figures drawn of one scene alone, which has all that rings can show."""
    with pytest.MonkeyPatch.context() as patch:
        if result.scene.title != DRAWN:
            leave_figures_undrawn(patch)
        write_result(result, directory, figures="all")


def test_profiles_are_the_fields_at_the_ends_of_steps(written: tuple[Result, Path]) -> None:
    result, directory = written
    found = rows(directory / "profiles.csv")
    for number, end in enumerate(result.steps, 1):
        of_step = [row for row in found if int(row["step"]) == number]
        behind, ahead = of_step[: len(of_step) // 2], of_step[len(of_step) // 2 :]
        assert [float(row["x [m]"]) for row in ahead] == end.radii.tolist()
        assert [float(row["x [m]"]) for row in behind] == (-end.radii[:0:-1]).tolist()
        assert {row["y [m]"] for row in of_step} == {"0.0"}

        def at(name: str, angle: int, end: Any = end) -> Any:
            field = getattr(end, name)
            if field is None:
                return 0.0
            return field[:, angle] if field.ndim == 2 else field

        assert [float(row["pressure [Pa]"]) for row in ahead] == at("pressure", 0).tolist()
        if result.scene.friction is None:
            assert {row["shear_x [Pa]"] for row in of_step} == {""}
            continue
        for rows_, angle, outward in ((ahead, 0, 1.0), (behind[::-1], -1, -1.0)):
            inner = slice(None) if outward > 0 else slice(1, None)
            radial, around, along = (
                np.broadcast_to(at(f"shear_{name}", angle), end.radii.shape)[inner]
                for name in ("radial", "circumferential", "along_load")
            )
            assert [float(row["shear_x [Pa]"]) for row in rows_] == (
                outward * radial + along
            ).tolist()
            if result.scene.title == "twisted":
                assert [float(row["shear_y [Pa]"]) for row in rows_] == (outward * around).tolist()


TOML = """
title = "coated"
[indenter]
shape = "paraboloid"
radius = "18 mm"
material = "rigid"
[body]
material = { young_modulus = "210 GPa", poisson_ratio = 0.3 }
[[body.layers]]
thickness = "0.2 mm"
material = { young_modulus = "420 GPa", poisson_ratio = 0.3 }
[friction]
coefficient = 0.1
[[loading]]
normal_force = "1 kN"
increments = 3
[fem_reference]
elements_per_radius = 8
[semi_analytical]
cells = [16, 16]
"""


@pytest.fixture(scope="module")
def place(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A scene, and its runs by both methods."""
    directory = tmp_path_factory.mktemp("commands")
    (directory / "scene.toml").write_text(TOML, encoding="utf-8")
    for solver in ("fem", "fem-complementarity"):
        asked = ("-o", directory / solver, "--solver", solver, "--figures", "none")
        assert slipstick("run", directory / "scene.toml", *asked) == 0
    return directory
