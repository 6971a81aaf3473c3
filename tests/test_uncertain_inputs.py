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
[[loading]]
normal_force = "1 kN"
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


def test_changes_by_inputs_are_the_powers_of_hertz(tmp_path: Path) -> None:
    (tmp_path / "scene.toml").write_text(SCENE, encoding="utf-8")
    command = ("run", "scene.toml", "-o", "out", "--solver", "radial", "--inputs", INPUTS)
    ended = succeeded(*command, "--no-error", cwd=tmp_path)
    found = json.loads((tmp_path / "out/inputs.json").read_text(encoding="utf-8"))
    assert [one["deviation"] for one in found["inputs"]] == [0.01, 0.54, 4.2]
    for name, powers in HERTZ.items():
        number = found["numbers"][name]
        assert number["numerical"] is None  # unknown because of --no-error, not 0
        changes = [change / number["value"] for change in number["changes"].values()]
        # The third derivative is left.
        expected = [power * share for power, share in zip(powers, SHARES, strict=True)]
        assert changes == pytest.approx(expected, rel=1e-3)
        assert number["by_inputs"] == pytest.approx(hypot(*changes) * number["value"])
    page = (tmp_path / "out/index.html").read_text(encoding="utf-8")
    assert "Uncertainty by inputs" in page
    assert "by indenter.radius" in ended.stdout
