"""The comparison of the solvers: what it measures, and that it can fail."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from contact_scene import IsotropicMaterial
from verification.cases.cross_check import Pressed, cross_check, kept_edges, kept_fronts
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


# ---- Where the shear of two solvers is not compared: at kinks that stick keeps, and nowhere e


PLACES = np.arange(6.0)

growths = st.lists(st.floats(0.0, 1.0), min_size=1, max_size=20).map(sorted)


@given(radii=growths)
def test_an_edge_that_only_spreads_keeps_one_kink(radii: list[float]) -> None:
    assert kept_edges(radii, 0.0) == (radii[-1],)


@given(inner=st.floats(0.1, 0.5), back=st.floats(0.05, 0.4), steps=st.integers(2, 9))
def test_an_edge_that_comes_back_and_spreads_again_keeps_where_it_turned(
    inner: float, back: float, steps: int
) -> None:
    there = np.linspace(inner, inner + back, steps).tolist()
    path = [*there, *there[::-1], *there]
    assert kept_edges(path, 0.9 * back) == (inner, there[-1])


@given(inner=st.floats(0.1, 0.5), back=st.floats(0.05, 0.4))
def test_coming_back_by_less_than_is_resolved_is_none(inner: float, back: float) -> None:
    assert kept_edges([inner + back, inner, inner + back], 1.1 * back) == (inner + back,)


def test_slip_that_comes_further_in_wipes_the_kink_out() -> None:
    assert kept_edges([0.5, 0.3, 0.6, 0.1, 0.7], 0.05) == (0.1, 0.7)
    assert kept_edges([0.5, 0.3, 0.6, 0.1], 0.05) == (0.1,)


def stuck(*increments: str) -> NDArray[np.bool_]:
    """One character per place: + sticks."""
    return np.array([[place == "+" for place in places] for places in increments])


def test_a_front_is_kept_where_both_sides_stick_on() -> None:
    history = stuck("--++--", "++++++", "++++++")
    assert kept_fronts(PLACES, history, [0, 2]) == [1.5, 3.5]


def test_a_front_is_lost_on_the_side_where_slip_passes() -> None:
    history = stuck("--++--", "+++++-", "++++--", "+++++-")
    assert kept_fronts(PLACES, history, [0, 3]) == [1.5, 4.5]


def test_only_a_load_that_turns_leaves_a_front_behind() -> None:
    history = stuck("--++--", "-++++-", "++++++")
    assert kept_fronts(PLACES, history, [2]) == []
