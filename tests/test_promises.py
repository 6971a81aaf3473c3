"""Tests of robustness by many random attacks: each ends in one clear error or a correct result."""

import math
import os
import random
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from processes import run

import radial
from contact_scene import (
    RIGID,
    Body,
    CoulombFriction,
    FiniteElementDiscretisation,
    IsotropicMaterial,
    Layer,
    LoadStep,
    Paraboloid,
    Scene,
    SceneError,
    read_scene_file,
)
from contact_scene.solver_errors import SolverError
from fem_reference import Method
from fem_reference import solve as solve_on_rings
from fem_reference.elasticity.factored_section import FactoredSection
from semi_analytical import SurfaceGrid, solve
from semi_analytical.operator.transforms import Transforms
from verification.running.cold_cache import cold_cache

nightly = [pytest.mark.slow, pytest.mark.timeout(3600)]
SOLVERS = ("semi-analytical", "fem", "fem-complementarity", "radial")
TOLERANCE = 1e-8
CONTACT = 0.1437e-3  # contact radius of FRETTING between half-spaces [m]
FRETTING = """[indenter]
shape = "sphere"
radius = "10 mm"
material = {{ young_modulus = "210 GPa", poisson_ratio = 0.3 }}
[body]
material = {{ young_modulus = "210 GPa", poisson_ratio = {nu} }}
{layers}
[friction]
coefficient = 0.3
[[loading]]
normal_force = 100
increments = 2
[[loading]]
tangential_force = [20, 0]
increments = {pushes}
[[loading]]
tangential_force = [-20, 0]
increments = {pushes}
[semi_analytical]
cells = [24, 24]
[fem_reference]
elements_per_radius = 6
"""


def layer(thickness: float, ratio: float, nu: float = 0.3) -> str:
    """A layer by its thickness over the contact radius and its modulus over the body's."""
    material = f"{{ young_modulus = {210e9 * ratio!r}, poisson_ratio = {nu} }}"
    return f"[[body.layers]]\nthickness = {thickness * CONTACT!r}\nmaterial = {material}\n"


def fretting(layers: str = "", pushes: int = 2, nu: float = 0.3) -> str:
    return FRETTING.format(layers=layers, pushes=pushes, nu=nu)


ABSURD = {
    f"E1/E2 = {ratio:g}, h/a = {h:g}": fretting(layer(h, ratio))
    for ratio in (1e-6, 1e6, 1e-3, 1e3)
    for h in (1.0, 1e12, 1e-12, 3e-3)
} | {
    "ν near -1": fretting(nu=-0.999999),
    "ν near -1 in a film": fretting(layer(1.0, 2.0, -0.999999)),
    "50 layers": fretting("".join(layer(0.1, 1.0 + n % 2) for n in range(50))),
}


@pytest.mark.parametrize("solver", [pytest.param(s, marks=nightly) for s in SOLVERS])
@pytest.mark.parametrize("name", ABSURD)
def test_an_absurd_contact_is_planned_or_refused_soon(
    name: str, solver: str, tmp_path: Path
) -> None:
    (tmp_path / "scene.toml").write_text(ABSURD[name])
    end = run(tmp_path, "plan", "scene.toml", "--solver", solver)
    assert end.code in {0, 2, 3, 4}, end.said
    assert end.seconds <= 10


# OUT is a folder beside that of the scene; its height map would be taken if it were read.
NAMES = (
    *("../out/h.npy", "OUT/h.npy", "a/../../out/h.npy", "..//out//h.npy", "a/../h.npy", "..", ""),
    *("/", "../out", "a/", "link.npy", "linked/h.npy", "dangling.npy", "loop.npy", "queue.npy"),
    *("..\\\\out\\\\h.npy", "C:\\\\h.npy", "\\\\\\\\server\\\\h.npy", "//server/h", "~/h.npy"),
    *("file://OUT/h.npy", "http://localhost:9/h.npy", "$HOME/h.npy", "%2e%2e/out/h.npy"),
    *("．．/out/h.npy", "..\\u2215out\\u2215h.npy", "h.npy\\u0000.txt", "h.npy\\n", "\\u202eh.npy"),
    *("/dev/zero", "/dev/stdin", "/proc/self/environ", "/etc/passwd", "CON", "h.npy:x", "|id"),
    *("$(id)", "`id`", "a" * 5000, 300 * "a/" + "h.npy", "-o", "*.npy"),
)
MAPS = (
    'friction = { coefficient = 0 }\n[indenter]\nshape = "height_map"\nfile = "NAME"\n'
    'spacing = "10 um"',
    'friction = { coefficient = { map = "NAME", spacing = "10 um" } }\n[indenter]\n'
    'shape = "sphere"\nradius = "10 mm"',
)
REST = '\nmaterial = "rigid"\n[body]\nmaterial = { young_modulus = 2e11, poisson_ratio = 0.3 }\n'
REST += "[[loading]]\nnormal_force = 1\n"
opened: list[str] | None = None


def listen(event: str, given: tuple[Any, ...]) -> None:
    if opened is not None and event in ("open", "os.listdir", "socket.connect"):
        opened.append(str(given[0]))


@pytest.fixture(scope="module")
def audited() -> None:
    sys.addaudithook(listen)  # it cannot be removed


@pytest.mark.parametrize("text", MAPS, ids=["height map", "friction map"])
@pytest.mark.parametrize("name", NAMES)
def test_a_name_that_leads_elsewhere_is_refused(
    name: str, text: str, tmp_path: Path, audited: None
) -> None:
    global opened
    scenes, out = tmp_path / "scenes", tmp_path / "out"
    (scenes / "a").mkdir(parents=True)
    out.mkdir()
    for place in (scenes / "h.npy", out / "h.npy"):
        np.save(place, np.zeros((8, 8)))
    for link, target in (
        ("link.npy", out / "h.npy"),
        ("linked", out),
        ("dangling.npy", out / "x"),
        ("loop.npy", scenes / "loop.npy"),
    ):
        (scenes / link).symlink_to(target)
    os.mkfifo(scenes / "queue.npy")
    (scenes / "scene.toml").write_text(text.replace("NAME", "h.npy") + REST)
    read_scene_file(scenes / "scene.toml")  # the mistake is the name alone
    (scenes / "scene.toml").write_text(text.replace("NAME", name.replace("OUT", str(out))) + REST)
    before = sorted(map(str, tmp_path.rglob("*")))
    opened = []
    try:
        with pytest.raises(SceneError) as refused:
            read_scene_file(scenes / "scene.toml")
        heard = opened
    finally:
        opened = None
    assert all(str(p).isprintable() and len(str(p)) < 1000 for p in refused.value.problems)
    elsewhere = (str(out), "/dev/", "/proc/", "/etc/")
    assert [path for path in heard if os.path.realpath(path).startswith(elsewhere)] == []
    assert sorted(map(str, tmp_path.rglob("*"))) == before


@contextmanager
def planted(of: type, name: str, at: int, value: float, chance: random.Random) -> Iterator[None]:
    """Replace a number that the method returns at one of its calls."""
    sound, calls = getattr(of, name), [0]

    def spoilt(*given: Any) -> Any:
        values = np.array(sound(*given))
        calls[0] += 1
        if calls[0] == at:
            values.ravel()[chance.randrange(values.size)] = value
        return values

    setattr(of, name, spoilt)
    try:
        with np.errstate(all="ignore"), cold_cache():
            yield
    finally:
        setattr(of, name, sound)


@pytest.mark.parametrize(
    "seed", [*range(2), *(pytest.param(n, marks=nightly) for n in range(2, 60))]
)
def test_a_planted_number_that_is_none_ends_in_an_error_or_in_the_answer(
    seed: int, tmp_path: Path
) -> None:
    """An answer differs by ten tolerances at most: a solve that goes on stops elsewhere."""
    (tmp_path / "scene.toml").write_text(fretting())
    scene, chance = read_scene_file(tmp_path / "scene.toml").scene, random.Random(seed)
    coarse = FiniteElementDiscretisation(elements_per_radius=4, box=10.0, harmonics=2)
    window = (3 * CONTACT, 3 * CONTACT)
    ways = (
        (
            Transforms,
            "filter_fields",
            60,
            lambda: solve(scene, SurfaceGrid((20, 20), window), TOLERANCE),
        ),
        (FactoredSection, "compliance", 1, lambda: solve_on_rings(scene, coarse)),
    )
    of, name, calls, compute = ways[seed % 2]
    sound = compute().steps[-1].pressure
    value = chance.choice((math.nan, math.inf, -math.inf))
    try:
        with planted(of, name, chance.randint(1, calls), value, chance):
            found = compute().steps[-1].pressure
    except SolverError:
        return
    assert np.max(np.abs(found - sound)) <= 10 * TOLERANCE * np.max(sound)


OF = {
    "approach": (1, 0),
    "peak_pressure": (0, 1),
    "contact_area": (2, 0),
    "stick_area": (2, 0),
    "dissipated_energy": (3, 1),
    "elastic_energy": (3, 1),
}
"""Powers of length and of stress."""


def pushed(way: Any, pose: Any, angle: float, length: float, stress: float) -> Any:
    """The end of a contact of revolution that is pushed to and fro along a line."""
    push, rigid, film = pose
    force = 1e3 * stress * length**2

    def material(modulus: float) -> IsotropicMaterial:
        return IsotropicMaterial(young_modulus=210e9 * stress * modulus, poisson_ratio=0.3)

    def step(part: float) -> LoadStep:
        size = 0.1 * part * push * force
        along = (size * math.cos(angle), size * math.sin(angle))
        return LoadStep(tangential_force=along, increments=2)

    films = (Layer(thickness=2e-4 * length, material=material(film)),) if film else ()
    scene = Scene(
        indenter=Paraboloid(radius=0.018 * length, material=RIGID if rigid else material(1.0)),
        body=Body(material=material(1.0), layers=films),
        friction=CoulombFriction(coefficient=0.1),
        loading=(LoadStep(normal_force=force, increments=2), step(1.0), step(-0.5)),
    )
    if way == "radial":
        return radial.solve(scene).steps[-1]
    mesh = FiniteElementDiscretisation(
        elements_per_radius=4, box=10.0, harmonics=2, tolerance=1e-10
    )
    return solve_on_rings(scene, mesh, way).steps[-1]


@pytest.mark.parametrize("way", ["radial", Method.COMPLEMENTARITY, Method.PENALTY])
@pytest.mark.parametrize("seed", [0, *(pytest.param(n, marks=nightly) for n in range(1, 20))])
def test_no_direction_and_no_unit_counts(way: Any, seed: int) -> None:
    chance, within = random.Random(seed), 1e-9
    pose = chance.uniform(0.2, 0.9), chance.random() < 0.5, chance.choice((0.0, 0.5, 2.0))
    angle = chance.choice((math.pi, math.pi / 2, chance.uniform(0, 2 * math.pi)))
    length, stress = (10.0 ** chance.randint(-6, 6) for _ in range(2))
    there, here = pushed(way, pose, 0.0, 1.0, 1.0), pushed(way, pose, angle, length, stress)
    for name, (of_length, of_stress) in OF.items():
        if getattr(there, name) is not None:
            expected = getattr(there, name) * length**of_length * stress**of_stress
            assert getattr(here, name) == pytest.approx(expected, rel=within), name
    size = math.copysign(math.hypot(*there.tangential_shift), there.tangential_shift[0])
    for found, line in zip(here.tangential_shift, (math.cos(angle), math.sin(angle)), strict=True):
        assert found == pytest.approx(length * size * line, abs=within * abs(size) * length)
    pressure = np.abs(here.pressure / stress - there.pressure)
    assert np.max(pressure) <= within * np.max(there.pressure)
