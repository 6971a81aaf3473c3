"""Tests of absurd contacts: each is planned or refused soon."""

import pytest
from processes import run

nightly = [pytest.mark.slow, pytest.mark.timeout(3600)]
SOLVERS = ("semi-analytical", "fem", "fem-complementarity", "radial")
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
def test_an_absurd_contact_is_planned_or_refused_soon(name, solver, tmp_path):
    (tmp_path / "scene.toml").write_text(ABSURD[name])
    end = run(tmp_path, "plan", "scene.toml", "--solver", solver)
    assert end.code in {0, 2, 3, 4}, end.said
    assert end.seconds <= 10
