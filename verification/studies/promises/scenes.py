"""Scenes that promises are tried on, as texts."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

from contact_scene import Scene, read_scene_file

# With every table and nearly every key, so that a change may hit any of them.
EVERYTHING = """title = "everything"
[indenter]
shape = "ellipsoid"
radii = ["10 mm", 0.012]
material = { young_modulus = "210 GPa", poisson_ratio = 0.3 }
[[indenter.layers]]
thickness = "20 um"
material = { young_modulus = 4.2e11, poisson_ratio = 0.25 }
[body]
material = { young_modulus = "70000 N/mm^2", poisson_ratio = 0.33 }
[[body.layers]]
thickness = 5e-5
material = { young_modulus = "100 GPa", poisson_ratio = 0.5 }
[friction]
coefficient = 0.3
[[loading]]
normal_force = "100 N"
increments = 4
[[loading]]
tangential_force = [20, "-1 N"]
torque = "1 N mm"
[[loading]]
approach = "1 um"
tangential_shift = ["0.1 um", 0]
tilt = ["0.01 deg", 0]
[semi_analytical]
cells = [32, 24]
window = ["1 mm", 1e-3]
tolerance = 1e-8
path_accuracy = 0.01
[fem_reference]
elements_per_radius = 16
box = 100.0
tolerance = 1e-8
harmonics = 4
"""
FRETTING = """[indenter]
shape = "sphere"
radius = "10 mm"
material = {{ young_modulus = "210 GPa", poisson_ratio = 0.3 }}
[body]
material = {{ young_modulus = "{modulus!r} GPa", poisson_ratio = {nu!r} }}
{layer}
{friction}
[[loading]]
normal_force = 100
increments = 2
{push}
[semi_analytical]
cells = [{cells}, {cells}]
[fem_reference]
elements_per_radius = {elements}
"""
LAYER = """[[body.layers]]
thickness = "{thickness!r} mm"
material = {{ young_modulus = "{modulus!r} GPa", poisson_ratio = {nu!r} }}
"""
FRICTION = "[friction]\ncoefficient = 0.3"
PUSH = """[[loading]]
tangential_force = [{force!r}, 0]
increments = {increments}
"""
CONTACT = 0.1437  # mm, the contact radius between half-spaces


def fretting(
    *,
    cells: int = 32,
    elements: int = 8,
    modulus: float = 210.0,
    nu: float = 0.3,
    layer: str = "",
    pushes: int = 0,
) -> str:
    """A ball pressed onto a body, and pushed there and back for so many increments each."""
    push = "".join(PUSH.format(force=f, increments=pushes) for f in (20.0, -20.0)) if pushes else ""
    return FRETTING.format(
        modulus=modulus, nu=nu, layer=layer, friction=FRICTION if pushes else "", push=push,
        cells=cells, elements=elements,
    )  # fmt: skip


def absurd() -> Iterator[tuple[str, str]]:
    """Contacts that nobody builds: films by stiffness and thickness far from any, with names."""
    for ratio in (1e-6, 1e6, 1e-3, 1e3):
        for thickness in (1.0, 1e12, 1e-12, 3e-3):
            film = LAYER.format(thickness=thickness * CONTACT, modulus=210.0 * ratio, nu=0.3)
            yield f"E1/E2 = {ratio:g}, h/a = {thickness:g}", fretting(layer=film, pushes=3)
    yield "ν = -0.999999", fretting(nu=-0.999999, pushes=3)
    film = LAYER.format(thickness=CONTACT, modulus=420.0, nu=-0.999999)
    yield "ν = -0.999999 in a film", fretting(layer=film, pushes=3)
    films = (LAYER.format(thickness=0.1 * CONTACT, modulus=m, nu=0.3) for m in 25 * (210.0, 420.0))
    yield "50 layers", fretting(layer="".join(films), pushes=3)


def read(text: str) -> Scene:
    """The scene of a text."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "scene.toml"
        path.write_text(text, encoding="utf-8")
        return read_scene_file(path).scene
