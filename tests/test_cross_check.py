"""Tests of the comparison of the solvers: the comparison detects differences."""

from dataclasses import replace

import pytest

from contact_scene import IsotropicMaterial
from verification.cases.cross_check import Contact, cross_check
from verification.judging.case import SectionRun
from verification.judging.judgement import judge
from verification.judging.outcome import Status

SMOOTH = Contact(2.0, 1.0, 0.0, 64, 32)


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
    case = cross_check(given=(replace(SMOOTH, cells=96, elements=64),))
    outcome = judge(case, stiffer_film) if broken else judge(case)
    failed = {
        (verdict.name, "on radii" in verdict.run)
        for verdict in outcome.verdicts
        if verdict.status is Status.FAIL
    }
    expected = {
        (f"{of}_difference", rings) for of in ("approach", "pressure") for rings in (False, True)
    }
    assert failed == (expected | {("stress_difference", False)} if broken else set())
    assert [
        1e-12 <= v.reference_uncertainty < 3e-3
        for v in outcome.verdicts
        if v.reference_kind == "other solver"
    ] == [True] * 7


@pytest.mark.slow
def test_stress_of_other_tractions_differs() -> None:
    one, other = (run.solve() for run in SMOOTH.runs[:2])
    assert SMOOTH.stress_apart(one, other) < 0.02
    weaker = replace(
        other,
        increments=tuple(replace(i, pressure=0.9 * i.pressure) for i in other.increments),
    )
    assert SMOOTH.stress_apart(one, weaker) > 0.05
