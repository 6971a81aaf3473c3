"""Tests of `slipstick run --inputs`: the uncertainty of results by the inputs of a scene."""

import json
from math import hypot
from pathlib import Path

import pytest
from command import succeeded

SCENE = """
[indenter]
shape = "paraboloid"
radius = "18 mm"
material = "rigid"
[body]
material = { young_modulus = "210 GPa", poisson_ratio = 0.3 }
[friction]
coefficient = 0.1
[[loading]]
normal_force = "1 kN"
[[loading]]
tangential_force = [50, 0]
increments = 4
[semi_analytical]
cells = [32, 32]
[radial]
rings = 10
"""
# Exponents of force, radius and Young's modulus in Hertz' results (Johnson 1985, section 4.2).
HERTZ = {
    "approach": (2 / 3, -1 / 3, -2 / 3),
    "contact_radius": (1 / 3, 1 / 3, -1 / 3),
    "peak_pressure": (1 / 3, -2 / 3, 2 / 3),
}
INPUTS = (
    "loading[1].normal_force = 1±.01 kN, indenter.radius=18+-.54 mm, "
    "body.material.young_modulus=210+/-4.2 GPa"
)
SHARES = (0.01, 0.03, 0.02)


@pytest.mark.parametrize("solver", ["semi-analytical", "fem", "radial"])
def test_changes_by_inputs_are_the_powers_of_hertz(tmp_path: Path, solver: str) -> None:
    pressed = SCENE.partition("[friction]")[0] + "[[loading]]\nnormal_force = '1 kN'\n"
    (tmp_path / "scene.toml").write_text(pressed, encoding="utf-8")
    coarse = "semi_analytical.cells=[32,32]", "fem_reference.elements_per_radius=6"
    changed = [word for one in coarse for word in ("--set", one)]
    command = ("run", "scene.toml", "-o", "out", "--solver", solver, "--inputs", INPUTS)
    ended = succeeded(*command, *changed, "--no-error", cwd=tmp_path)
    found = json.loads((tmp_path / "out/inputs.json").read_text(encoding="utf-8"))
    assert [one["deviation"] for one in found["inputs"]] == [0.01, 0.54, 4.2]
    for name, powers in HERTZ.items():
        number = found["numbers"][name]
        assert number["numerical"] is None  # unknown because of --no-error, not 0
        changes = [change / number["value"] for change in number["changes"].values()]
        # The third derivative is left, and at most a hundredth by elements.
        rough = 0.01 if solver == "fem" else 1e-3
        expected = [power * share for power, share in zip(powers, SHARES, strict=True)]
        assert changes == pytest.approx(expected, rel=rough)
        assert number["by_inputs"] == pytest.approx(hypot(*changes) * number["value"])
    page = (tmp_path / "out/index.html").read_text(encoding="utf-8")
    assert "Uncertainty by inputs" in page
    assert "by indenter.radius" in ended.stdout
