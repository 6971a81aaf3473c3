"""The comparison of the solvers: what it measures, and that it can fail."""

from dataclasses import replace

import numpy as np
import pytest

from contact_scene import IsotropicMaterial
from verification.cases.cross_check import Pressed, cross_check
from verification.judging.judgement import judge
from verification.judging.outcome import Status
from verification.judging.run import SectionRun

SMOOTH = Pressed(2.0, 1.0, 0.0, 64, 32)
ROUGH = Pressed(0.5, 1.0, 0.1, 32, 16)


def test_tractions_of_the_solvers_are_taken_at_the_same_radii() -> None:
    runs = (ROUGH.on_cells[1], ROUGH.on_elements[1], ROUGH.on_radii)
    found = [run.solve() for run in runs]
    at = ROUGH.radii(*found)
    (p, q), *others = (ROUGH.tractions(result, at) for result in found)
    for pressure, shear in others:
        np.testing.assert_allclose(pressure, p, atol=0.05)
        np.testing.assert_allclose(shear, q, atol=0.1)
    with pytest.raises(ValueError, match="rings"):
        ROUGH.tractions(found[1], at + 0.01)


def stiffer_film(run: object) -> object:
    """The run of elements with a coating of 1.02 times the modulus; that of others as it is."""
    if not isinstance(run, SectionRun):
        return run.solve()  # type: ignore[attr-defined]
    body = run.scene.body
    (layer,) = body.layers
    E, nu = layer.material.young_modulus, layer.material.poisson_ratio
    material = IsotropicMaterial(young_modulus=1.02 * E, poisson_ratio=nu)
    other = body.model_copy(update={"layers": (layer.model_copy(update={"material": material}),)})
    return replace(run, scene=run.scene.model_copy(update={"body": other})).solve()


@pytest.mark.slow
@pytest.mark.parametrize("broken", [False, True], ids=["same bodies", "another coating"])
def test_case_tells_bodies_apart(broken: bool) -> None:
    case = cross_check(given=((replace(SMOOTH, cells=96, elements=64),), ()))
    outcome = judge(case, stiffer_film) if broken else judge(case)
    failed = {
        (verdict.name, "on radii" in verdict.run)
        for verdict in outcome.verdicts
        if verdict.status is Status.FAIL
    }
    expected = {
        ("approach_difference", False), ("pressure_difference", False),
        ("stress_difference", False), ("approach_difference_of_radial", True),
        ("pressure_difference_of_radial", True),
    }  # fmt: skip
    assert failed == (expected if broken else set())


@pytest.mark.slow
def test_stress_of_other_tractions_differs() -> None:
    one, other = SMOOTH.on_cells[1].solve(), SMOOTH.on_elements[1].solve()
    assert SMOOTH.stress_apart(one, other) < 0.02
    weaker = replace(
        other,
        increments=tuple(replace(i, pressure=0.9 * i.pressure) for i in other.increments),
    )
    assert SMOOTH.stress_apart(one, weaker) > 0.05
