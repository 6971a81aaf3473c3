"""The layered cases of the report pass, and fail when something is broken."""

from collections.abc import Callable

import numpy as np
import pytest
from test_frf import LAWS

from semi_analytical.frf.surface import SurfaceScalars
from semi_analytical.influence import bodies, layered
from verification.cases import coatings
from verification.cases import responses as reference
from verification.judging.judgement import judge
from verification.judging.outcome import CaseOutcome, Status
from verification.laws import frf_matrix as matrix
from verification.laws.law import Law, worst_violation

Patch = pytest.MonkeyPatch


def failed(outcome: CaseOutcome) -> set[str]:
    return {verdict.name for verdict in outcome.verdicts if verdict.status is Status.FAIL}


@pytest.fixture(autouse=True)
def fresh() -> None:
    """Forget what other tests have measured."""
    for measured in (reference._frf_errors, reference._coefficients):
        measured.cache_clear()


def scalars_by(patch: Patch, module: object, change: Callable[[SurfaceScalars], None]) -> None:
    """Let a module see wrong scalars of layered bodies."""
    whole = module.scalars  # type: ignore[attr-defined]

    def wrong(stack: object, alpha: object) -> SurfaceScalars:
        response = SurfaceScalars(*(np.array(value) for value in whole(stack, alpha)))
        if stack.layers:  # type: ignore[attr-defined]
            change(response)
        return response

    patch.setattr(module, "scalars", wrong)


def coupling_turned(response: SurfaceScalars) -> None:
    np.multiply(response.c12, -1, out=response.c12)


def normal_soft(response: SurfaceScalars) -> None:
    np.multiply(response.c22, 1.001, out=response.c22)


def shear_for_normal(response: SurfaceScalars) -> None:
    response.csh[...] = response.c22


@pytest.mark.parametrize("change", [coupling_turned, normal_soft, shear_for_normal])
def test_wrong_scalars_fail_the_reference_and_the_laws(
    change: Callable[[SurfaceScalars], None], monkeypatch: Patch
) -> None:
    scalars_by(monkeypatch, matrix, change)
    scalars_by(monkeypatch, reference, change)
    assert failed(judge(reference.layered_reference())) >= {"scalars", "matrix"}
    assert worst_violation(LAWS["homogeneous"]) > LAWS["homogeneous"].allowed


def test_wrong_stiffness_of_the_film_fails_the_first_order_theory(monkeypatch: Patch) -> None:
    scalars_by(
        monkeypatch, coatings, lambda response: np.power(response.c22, 1.01, out=response.c22)
    )
    assert failed(judge(coatings.film_stiffness())) == {"by_shear_modulus", "by_poisson_ratio"}


def test_wrong_coefficients_fail_the_reference_and_the_contact(monkeypatch: Patch) -> None:
    whole = layered.cell_integrals
    monkeypatch.setattr(layered, "cell_integrals", lambda *given: 1.0005 * whole(*given))
    monkeypatch.setattr(bodies, "remembered", layered.computed_afresh)
    assert failed(judge(reference.layered_reference())) == {"influence_coefficients"}
    assert "approach" in failed(
        judge(coatings.coated_paraboloid(cells=(96, 112, 128), required=(128,)))
    )


def test_layer_left_out_fails_the_identities(monkeypatch: Patch) -> None:
    whole = bodies.stack_of

    def without_the_last(body: object) -> object:
        stack = whole(body)
        return type(stack)(stack.layers[:-1], stack.base)

    monkeypatch.setattr(bodies, "stack_of", without_the_last)
    assert {"approach", "central_pressure"} <= failed(judge(coatings.layered_identities(cells=32)))


def test_nan_in_a_law_is_a_violation() -> None:
    values = iter([0.0, np.nan, 1.0])
    law = Law("nan", "P0", "never NaN", lambda rng: next(values), draws=3)
    assert not worst_violation(law) <= 1
