"""The radial solver states the memory of a run before it takes it, and keeps no more than that."""

import sys
from pathlib import Path

import pytest
from command import outcome
from test_size_bombs import slipstick

import radial
from contact_scene import read_scene_file
from contact_scene.solver_errors import ResourceRefused, UnsupportedScene
from radial import memory
from radial.memory import estimated_bytes

WITHIN = 0.15
SCENE = """
[indenter]
shape = "paraboloid"
radius = "18 mm"
material = "rigid"
[body]
material = {{ young_modulus = "210 GPa", poisson_ratio = 0.3 }}
[[body.layers]]
thickness = {thickness}
material = {{ young_modulus = {modulus}, poisson_ratio = 0.3 }}
{friction}
[[loading]]
normal_force = 1000
increments = 2
"""
FRICTION = "[friction]\ncoefficient = 0.1"
TURN = "[[loading]]\ntangential_force = [0, 60]\nincrements = 2"
PUSH = "[[loading]]\ntangential_force = [60, 0]\nincrements = 2"
slow = pytest.mark.slow


def scene(thickness: float, modulus: float = 420e9, friction: str = "", push: str = "") -> str:
    pressed = SCENE.format(thickness=thickness, modulus=modulus, friction=friction)
    return f"{pressed}{push}\n"


@pytest.mark.skipif(sys.platform != "linux", reason="the peak is read from /proc")
@pytest.mark.parametrize(
    "text",
    [
        pytest.param(scene(1e-4), id="pressed"),
        pytest.param(scene(1e-4, friction=FRICTION), id="rubbed"),
        pytest.param(scene(1e-5), id="thin, pressed", marks=slow),
        pytest.param(scene(1e-5, friction=FRICTION), id="thin, rubbed", marks=slow),
        pytest.param(scene(1e-6), id="film, pressed", marks=slow),
        pytest.param(scene(3e-6, friction=FRICTION), id="film, rubbed", marks=slow),
        pytest.param(scene(1e-4, friction=FRICTION, push=PUSH), id="pushed", marks=slow),
        pytest.param(scene(6e-6, friction=FRICTION, push=PUSH), id="thin, pushed", marks=slow),
        pytest.param(
            scene(1e-4, friction=FRICTION, push=f"{PUSH}\n{TURN}"), id="turned", marks=slow
        ),
        pytest.param(scene(3e-4, 210e3), id="soft", marks=slow),
        pytest.param(scene(1e-5, 210e15), id="stiff", marks=slow),
    ],
)
def test_estimated_memory_is_the_peak_of_the_run(text: str, tmp_path: Path) -> None:
    """Solving, the solve beside it, files and figures, in a process of its own."""
    path = tmp_path / "scene.toml"
    path.write_text(text, encoding="utf-8")
    described = read_scene_file(path).scene
    ended = slipstick("run", path, "-o", tmp_path / "out", "--solver", "radial")
    assert ended.code == 0, ended.said
    needed = estimated_bytes(described, radial.plan(described))
    assert needed == pytest.approx(ended.memory, rel=WITHIN)


def test_what_does_not_fit_is_refused_before_it_is_begun(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "scene.toml"
    path.write_text(scene(3e-6, friction=FRICTION), encoding="utf-8")
    described = read_scene_file(path).scene
    monkeypatch.setattr(memory, "available_bytes", lambda: 300 << 20)
    monkeypatch.setattr("radial.history._solver", None)  # nothing is made
    with pytest.raises(ResourceRefused, match=r"need about 0\.\d GiB, 0\.3 GiB are available"):
        radial.solve(described)


def test_plan_says_how_much_and_refuses_what_no_polynomials_resolve(tmp_path: Path) -> None:
    path = tmp_path / "scene.toml"
    path.write_text(scene(1e-5), encoding="utf-8")
    ended = outcome("plan", path, "--solver", "radial", cwd=tmp_path)
    assert "memory      about 2" in ended.stdout
    path.write_text(scene(1e-7), encoding="utf-8")
    described = read_scene_file(path).scene
    with pytest.raises(UnsupportedScene, match="times as large as the outermost layer is thick"):
        estimated_bytes(described, radial.plan(described))
