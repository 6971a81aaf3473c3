"""The semi-closed coated contact against what is known about it from elsewhere."""

import numpy as np
import pytest

from semi_analytical.frf.stack import Stack
from semi_analytical.frf.surface import scalars
from verification.closed_forms.coated_indentation import (
    LayeredSurface,
    flat_punch,
    paraboloid,
    paraboloid_under,
)
from verification.closed_forms.flat_punch import FlatPunchContact
from verification.closed_forms.gao_chiu_lee import modulus_weight, ratio_weight
from verification.closed_forms.goodman import stick_ratio
from verification.closed_forms.hertz import PointContact
from verification.references import load_reference

ROWS = load_reference("coated_frictionless_paraboloid")["rows"]
RADIUS = 10.0


def surface(stack: Stack) -> LayeredSurface:
    G, nu = stack.outer
    return LayeredSurface(
        lambda k: scalars(stack, k).c22, 2 * G / (1 - nu), stack.layers[0].thickness
    )


def homogeneous(thickness: float) -> LayeredSurface:
    return LayeredSurface(lambda k: 2 / (3.0 * k), 3.0, thickness)


@pytest.mark.parametrize("row", ROWS, ids=lambda row: f"E1/E2 = {row['E1_over_E2']}")
def test_paraboloid_on_a_coating_is_the_reference(row: dict) -> None:
    G2, nu2 = 1.0, row["nu2"]
    # Units in which the Hertz radius is one.
    modulus = 2 * G2 / (1 - nu2)
    load = 4 * modulus / (3 * RADIUS)
    G1 = row["E1_over_E2"] * G2 * (1 + nu2) / (1 + row["nu1"])
    stack = Stack([(G1, row["nu1"], row["h_over_aH"])], (G2, nu2))
    contact = paraboloid_under(load, surface(stack), RADIUS)
    assert contact.contact_radius == pytest.approx(row["a_over_aH"], rel=1e-12)
    assert contact.approach * RADIUS == pytest.approx(row["delta_over_deltaH"], rel=1e-12)
    r = contact.contact_radius * np.array(row["r_over_a"])
    peak = 1.5 * load / np.pi
    np.testing.assert_allclose(contact.pressure(r) / peak, row["p_over_pH"], rtol=1e-12)


@pytest.mark.parametrize("thickness", [0.1, 1.0, 100.0])
def test_without_layers_it_is_hertz_and_boussinesq(thickness: float) -> None:
    ball, exact = paraboloid(homogeneous(thickness), RADIUS, 0.7), PointContact(RADIUS, 3.0, 0.7)
    assert (ball.load, ball.approach) == pytest.approx((exact.load, exact.approach), rel=1e-13)
    r = np.linspace(0, 1, 30)
    np.testing.assert_allclose(ball.pressure(r), exact.pressure(r), atol=1e-12 * ball.load)
    punch = flat_punch(homogeneous(thickness), 0.7)
    exact_punch = FlatPunchContact(0.7, 3.0, punch.load)
    assert exact_punch.approach == pytest.approx(1, rel=1e-13)
    inside = np.linspace(0, 0.699, 30)
    np.testing.assert_allclose(punch.pressure(inside), exact_punch.pressure(inside), rtol=1e-12)


@pytest.mark.parametrize(
    "stack",
    [
        Stack([(2.0, 0.3, 0.3)], (1.0, 0.25)),
        Stack([(1.0, 0.5, 0.1)]),
        Stack([(0.3, 0.2, 0.2), (5.0, 0.4, 0.5)], (1.0, 0.0)),
    ],
)
@pytest.mark.parametrize("indenter", ["paraboloid", "punch"])
def test_pressure_carries_the_load(stack: Stack, indenter: str) -> None:
    contact = (
        flat_punch(surface(stack), 1.0)
        if indenter == "punch"
        else paraboloid(surface(stack), RADIUS, 1.0)
    )
    nodes, weights = np.polynomial.legendre.leggauss(80)
    angle, weights = np.pi / 4 * (nodes + 1), np.pi / 4 * weights
    # r = sin(angle): the root at the edge, or its reciprocal, becomes smooth
    r = np.sin(angle)
    integrand = contact.pressure(r) * np.cos(angle) * 2 * np.pi * r
    assert integrand @ weights == pytest.approx(contact.load, rel=1e-10)


def test_first_order_stiffness_has_its_limits_and_printed_values() -> None:
    assert modulus_weight(0.5, 0.3) == pytest.approx(0.2774073, abs=6e-8)
    assert modulus_weight(1.0, 0.3) == pytest.approx(0.4493566, abs=6e-8)
    assert ratio_weight(0.5) == pytest.approx(0.5513172, abs=6e-8)
    assert ratio_weight(1.0) == pytest.approx(0.7206356, abs=6e-8)
    for weight in (lambda xi: modulus_weight(xi, 0.3), ratio_weight):
        assert weight(1e-9) == pytest.approx(0, abs=1e-6)
        assert weight(1e9) == pytest.approx(1, abs=1e-6)


# ---- One-way coupled indentation: the stick radius by another route, its limits and printed


BETA = 0.4 / 1.4  # ν = 0.3 under a rigid indenter


@pytest.mark.parametrize(("friction", "ratio"), [(0.1, 0.2240), (0.2, 0.7334), (0.3, 0.9186)])
def test_printed_values(friction, ratio):
    assert stick_ratio(friction, BETA) == pytest.approx(ratio, abs=5e-5)


def test_limits():
    assert stick_ratio(1e-6, BETA) == 0
    assert stick_ratio(100, BETA) == 1
    with pytest.raises(ValueError, match="dundurs_beta"):
        stick_ratio(0.1, 0.0)
