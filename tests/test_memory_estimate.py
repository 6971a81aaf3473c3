"""Tests of the memory estimate: the peak memory of a run is known before the run."""

import sys
import tracemalloc
from dataclasses import replace
from pathlib import Path

import contact_scenes
import pytest
from command import outcome
from contact_scenes import PRESS, RIGID_BALL, YOUNG, A, grid, steel
from processes import run

import radial
from contact_results.stress import on_cells
from contact_results.stress.loaded_bodies import state_of_result
from contact_results.stress.on_cells import OnCells
from contact_scene import Body, Layer, SceneFile, machine, read_scene_file
from contact_scene.solver_errors import ResourceRefused, UnsupportedScene
from radial.memory import estimated_bytes as radial_estimated_bytes
from semi_analytical import SurfaceGrid, discretise, plan, solve
from semi_analytical.memory import estimated_bytes
from semi_analytical.operator.domain import WINDOW, ReducedDomain
from semi_analytical.plan import Plan
from semi_analytical.stress import field as stress_field

WITHIN = 0.15
SCENE_FILES = Path(__file__).resolve().parents[1] / "scenes"
SCENE = """
[indenter]
shape = "sphere"
radius = "18 mm"
material = {{ young_modulus = "420 GPa", poisson_ratio = 0.3 }}
[body]
material = {{ young_modulus = "420 GPa", poisson_ratio = {nu} }}
{layer}
{friction}
[[loading]]
normal_force = 1000
increments = 1
{then}
[semi_analytical]
cells = {cells}
edge = "{edge}"
"""
LAYER = """[[body.layers]]
thickness = "100 um"
material = { young_modulus = "210 GPa", poisson_ratio = 0.3 }
"""
FRICTION = "[friction]\ncoefficient = 0.1"
PUSHED = "[[loading]]\ntangential_force = [60, 0]\nincrements = 2"
OBLIQUE = "[[loading]]\ntangential_force = [50, 30]\nincrements = 2"
TURNED = "[[loading]]\ntorque = 0.01\nincrements = 1"
TURNED_ROUND = "".join(
    f"[[loading]]\ntangential_force = [{force}, 0]\nincrements = 2\n"
    for force in (60, -60, 60, -60)
)
UNLOADED = "[[loading]]\nnormal_force = 500\nincrements = 20"
TILTED = "[[loading]]\nmoment = [0.02, 0]\nincrements = 2"

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="the peak is read from /proc")


def scene(
    cells: int | tuple[int, int],
    *,
    nu: float = 0.3,
    layer: str = "",
    then: str = "",
    edge: str = "last",
) -> str:
    nx, ny = (cells, cells) if isinstance(cells, int) else cells
    friction = "" if then in ("", UNLOADED, TILTED) and nu > 0 else FRICTION
    return SCENE.format(cells=[nx, ny], nu=nu, layer=layer, friction=friction, then=then, edge=edge)


SCENES = {
    "pressed": scene(512),
    "edge not seen in the stress": scene(94, layer=LAYER),
}
DEAR = {
    # The checkpoints of the longest of these solves take no memory of its history.
    **{path.stem: path.read_text(encoding="utf-8") for path in sorted(SCENE_FILES.glob("*.toml"))},
    "coupled and pushed": scene(224, nu=0.0, then=PUSHED),
    "libraries": scene(32),
    "figures of five steps": scene(32, then=TURNED_ROUND),
    "long": scene((16, 16384)),
    "long, sheared": scene((16, 16384), then=PUSHED),
    "many increments": scene(256, then=UNLOADED),
    "coated": scene(1024, layer=LAYER),
    "tilted": scene(512, then=TILTED),
    "sheared": scene(512, then=PUSHED),
    "sheared, cells alone": scene(512, then=PUSHED, edge="off"),
    "sheared, turned round": scene(512, then=TURNED_ROUND),
    "turned": scene(512, then=TURNED),
    "coated and sheared": scene(512, layer=LAYER, then=PUSHED),
    "coupled": scene(512, nu=0.0),
    "coupled, cells on the mirror planes": scene(511, nu=0.0, edge="off"),
    "coupled and pushed, fine": scene(512, nu=0.0, then=PUSHED),
    "coupled, coated and pushed": scene(384, nu=0.0, layer=LAYER, then=PUSHED),
    "coupled and pushed obliquely": scene(512, nu=0.0, then=OBLIQUE),
}


def test_a_long_history_keeps_little_of_each_increment_in_memory(tmp_path):
    path = tmp_path / "scene.toml"
    path.write_text(scene(256), encoding="utf-8")
    contents = read_scene_file(path)
    grid, decided = discretise(contents.scene, contents.semi_analytical), plan(contents.scene)
    short, long = (estimated_bytes(grid, decided.cut_into([n])) for n in (1000, 2000))
    assert 0 < long - short < 1e6


def _plan_of(text: str, folder: Path) -> Plan:
    (folder / "scene.toml").write_text(text, encoding="utf-8")
    return plan(read_scene_file(folder / "scene.toml").scene, edge="last")


def _bytes(side: int, decided: Plan, domain: ReducedDomain) -> int:
    grid = SurfaceGrid((side, side), (1e-3, 1e-3))
    return estimated_bytes(grid, replace(decided, symmetry=domain))


def test_mirror_planes_save_memory_unless_they_pass_through_cells(tmp_path):
    """With shear, the edge correction uses the work space of the shear: a mirror plane saves as
    much as in pressing alone."""
    pressed, pushed = (_plan_of(scene(64, then=then), tmp_path) for then in ("", PUSHED))
    whole, half = WINDOW, ReducedDomain((True, False))
    saved = []
    for decided in (replace(pressed, edge="off"), pushed, pressed):
        most = _bytes(8000, decided, whole)  # so many cells that figures take less
        assert _bytes(7999, decided, half) < most < _bytes(8001, decided, half)
        saved.append(most - _bytes(8000, decided, half))
    alone, with_shear, with_edge = saved
    assert 0 < alone < with_edge
    assert with_shear == pytest.approx(alone)


def test_each_effect_and_each_edge_cell_takes_memory(tmp_path):
    for then in ("", PUSHED):
        decided = _plan_of(scene(64, then=then), tmp_path)
        alone = replace(decided, edge="off")
        tilted, twisted = replace(alone, tilt=True), replace(alone, torsion=True)
        least = _bytes(8000, alone, WINDOW)
        assert least < min(_bytes(8000, more, WINDOW) for more in (tilted, twisted, decided))
        both = _bytes(8000, replace(tilted, torsion=True), WINDOW)
        assert both > max(_bytes(8000, one, WINDOW) for one in (tilted, twisted))
        square, strip = (
            [
                estimated_bytes(SurfaceGrid(cells, (1e-3, 1e-3)), replace(one, symmetry=WINDOW))
                for one in (alone, decided)
            ]
            for cells in ((8000, 8000), (800, 80_000))
        )
        assert square[0] == strip[0]
        assert square[1] < strip[1]


RADIAL_SCENE = """
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
TURN = "[[loading]]\ntangential_force = [0, 60]\nincrements = 2"
PUSH = "[[loading]]\ntangential_force = [60, 0]\nincrements = 2"


def radial_scene(
    thickness: float, modulus: float = 420e9, friction: str = "", push: str = ""
) -> str:
    pressed = RADIAL_SCENE.format(thickness=thickness, modulus=modulus, friction=friction)
    return f"{pressed}{push}\n"


RADIAL_SCENES = {"pressed": radial_scene(1e-4)}
RADIAL_DEAR = {
    "rubbed": radial_scene(1e-4, friction=FRICTION),
    "film, pressed": radial_scene(1e-6),
    "film, rubbed": radial_scene(3e-6, friction=FRICTION),
    "pushed": radial_scene(1e-4, friction=FRICTION, push=PUSH),
    "thin, pushed": radial_scene(6e-6, friction=FRICTION, push=PUSH),
    "turned": radial_scene(1e-4, friction=FRICTION, push=f"{PUSH}\n{TURN}"),
    "soft": radial_scene(3e-4, 210e3),
    "stiff": radial_scene(1e-5, 210e15),
}


def estimated(contents: SceneFile, solver: str) -> int:
    if solver == "radial":
        return radial_estimated_bytes(contents.scene, radial.plan(contents.scene))
    fineness = contents.semi_analytical
    decided = plan(contents.scene, fineness.path_accuracy, fineness.edge)
    return estimated_bytes(discretise(contents.scene, fineness), decided)


QUICK = {"semi-analytical": SCENES, "radial": RADIAL_SCENES}
DEAR_ONES = {"semi-analytical": DEAR, "radial": RADIAL_DEAR}


@pytest.mark.parametrize(
    ("solver", "text"),
    [
        pytest.param(solver, text, id=f"{name}, {solver}", marks=marks)
        for all_scenes, marks in ((QUICK, ()), (DEAR_ONES, pytest.mark.slow))
        for solver, scenes in all_scenes.items()
        for name, text in scenes.items()
    ],
)
def test_estimated_memory_is_the_peak_of_the_run(solver, text, tmp_path):
    """Of solves, coarse solves, files and figures."""
    (tmp_path / "scene.toml").write_text(text, encoding="utf-8")
    ended = run(tmp_path, "run", "scene.toml", "-o", "out", "--solver", solver)
    assert ended.code == 0, ended.said
    found = estimated(read_scene_file(tmp_path / "scene.toml"), solver)
    assert found == pytest.approx(ended.memory * 2**20, rel=WITHIN)


def test_what_does_not_fit_is_refused_before_it_is_begun(tmp_path, monkeypatch):
    path = tmp_path / "scene.toml"
    path.write_text(radial_scene(3e-6, friction=FRICTION), encoding="utf-8")
    described = read_scene_file(path).scene
    monkeypatch.setattr(machine, "available_bytes", lambda: 300 << 20)
    monkeypatch.setattr("radial.history._create_solver", None)  # nothing is made
    with pytest.raises(ResourceRefused, match=r"need about 0\.\d GiB, 0\.3 GiB are"):
        radial.solve(described)


def test_plan_says_how_much_and_refuses_what_no_polynomials_resolve(tmp_path):
    path = tmp_path / "scene.toml"
    path.write_text(radial_scene(2e-5), encoding="utf-8")
    ended = outcome("plan", path, "--solver", "radial", cwd=tmp_path)
    assert "memory      about 17" in ended.stdout
    path.write_text(radial_scene(1e-7), encoding="utf-8")
    described = read_scene_file(path).scene
    with pytest.raises(UnsupportedScene, match="times the thickness of the outermost"):
        radial_estimated_bytes(described, radial.plan(described))


# ---- stress


def test_stress_is_refused_before_it_takes_more_memory_than_there_is(
    monkeypatch,
):
    """Fields of the whole volume. The estimate adds the numbers of the file to their peak."""
    film = Layer(thickness=A, material=steel(young_modulus=2 * YOUNG))
    body = Body(material=steel(), layers=(film,))
    posed = contact_scenes.scene(PRESS, friction=None, indenter=RIGID_BALL, body=body)
    state = state_of_result(solve(posed, grid(64), 1e-6), 1)
    required = []
    monkeypatch.setattr(stress_field, "FIXED", 0)
    monkeypatch.setattr(machine, "available_bytes", lambda: max(required, default=1 << 40))

    def stress_in_volume():
        return OnCells(state, see_edge=False).stress(volume=True).volume

    tracemalloc.start()
    volume = stress_in_volume()
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    required.append(int(0.95 * peak))
    with pytest.raises(ResourceRefused, match="Use fewer cells or depths"):
        stress_in_volume()
    required.append(int((1 + on_cells.WRITTEN / on_cells.COMPUTED) * peak))
    assert stress_in_volume().stress.shape == volume.stress.shape
