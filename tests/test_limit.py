"""Tests of critical loads: first yield and cracking against closed forms, and their search."""

from dataclasses import dataclass
from math import exp
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

from contact_errors.error_formula import unknown_error
from contact_scene import (
    Body,
    IsotropicMaterial,
    LoadStep,
    Paraboloid,
    Scene,
)
from contact_scene.loading import CONTROLS
from contact_scene.solver_errors import ContactAtWindowEdge
from slipstick.critical_load import LoadFactorSearch, critical_loads
from verification.closed_forms.hertz import PointContact, contact_modulus
from verification.closed_forms.huber_stress import (
    huber_stress,
)

E = 210e9
R = 10e-3
W = 50.0
# The radial solver searches its maxima to nine digits.
SEARCHED = 1e-8
YIELD = 1e9
TENSILE = 0.3e9


def steel(nu: float, **strengths: float) -> IsotropicMaterial:
    return IsotropicMaterial(young_modulus=E, poisson_ratio=nu, **strengths)


def hertz(load: float, nu: float) -> PointContact:
    return PointContact.under_load(load, R, contact_modulus((E, nu), (E, nu)))


def load_at(peak_pressure: float, nu: float) -> float:
    """Load factor of W under which the ball has this peak pressure."""
    return (peak_pressure / hertz(W, nu).peak_pressure) ** 3


def yield_on_axis(nu: float) -> tuple[float, float]:
    """Largest von Mises stress below a pressed ball over p0, and its depth over a."""

    def stress(z: float) -> float:
        found = huber_stress(0.0, z, 1.0, 1.0, nu)
        return float(abs(found.axial - found.radial))

    at = minimize_scalar(lambda z: -stress(z), bounds=(0.0, 2.0), options={"xatol": 1e-9})
    return stress(at.x), float(at.x)


def error_of(one):
    assert one.error.status == "estimated"
    return float(one.error.error)


@pytest.mark.parametrize("nu", [0.3, 0.5])
def test_ball_yields_below_and_cracks_at_the_edge(nu):
    """p0 = 1.60 Y at 0.48 a for nu = 0.3 (Johnson 1985), and tension (1 - 2nu)/3 p0 (Huber)."""
    ball = Paraboloid(radius=R, material=steel(nu))
    body = Body(material=steel(nu, yield_strength=YIELD, tensile_strength=TENSILE))
    press = LoadStep(normal_force=W, increments=1)
    found = critical_loads(Scene(indenter=ball, body=body, loading=(press,)), "radial")
    limits, (constant, depth) = {one.measure: one for one in found.limits}, yield_on_axis(nu)
    first = limits["von_mises"]
    wrong = first.load_factor - load_at(YIELD / constant, nu)
    assert abs(wrong) <= error_of(first) + SEARCHED * first.load_factor
    assert first.normal_force == pytest.approx(W * first.load_factor, rel=1e-3)
    radius = hertz(first.normal_force, nu).contact_radius
    assert first.place[2] == pytest.approx(depth * radius, rel=1e-4)
    assert len(found.load_factors) <= 4
    crack = limits["max_principal"]
    if nu == 0.5:  # no tension at the edge: (1 - 2nu)/3 = 0
        assert (crack.load_factor, crack.below) == (None, pytest.approx(100.0))
        return
    exact = load_at(TENSILE / ((1 - 2 * nu) / 3), nu)
    assert abs(crack.load_factor - exact) <= error_of(crack) + SEARCHED * exact
    assert np.hypot(*crack.place[:2]) == pytest.approx(
        hertz(crack.normal_force, nu).contact_radius, rel=1e-2
    )


COMPONENTS = {
    **dict.fromkeys(("tangential_force", "tangential_shift", "moment", "tilt"), (0.01, -0.02)),
    **dict.fromkeys(("bulk_stress", "bulk_strain"), (0.01, 0.0, -0.02)),
}


@pytest.mark.parametrize("number", [0, 1])
def test_load_factor_multiplies_every_control(number):
    values = {pair[number]: COMPONENTS.get(pair[number], 0.01) for pair in CONTROLS}
    doubled = {name: np.multiply(2, value).tolist() for name, value in values.items()}
    step = LoadStep(**values, increments=3)
    assert step.multiplied(2.0) == LoadStep(**doubled, increments=3)


# ---- search of the root

KEY = ("body", "interface 1 above", "interface_shear")


@dataclass
class Formula(LoadFactorSearch):
    """Search on a stress law instead of solves."""

    law: Any = None

    def largest_stresses(self, x):
        if x not in self.solved:
            value = self.law(exp(x))
            place = SimpleNamespace(value=value, x=0.0, y=0.0, depth=0.0)
            end = SimpleNamespace(normal_force=1.0, step=1)
            self.solved[x] = {} if value <= 0 else {KEY: (place, end)}
        return self.solved[x]

    def _error_of_factor(self, *given):
        return unknown_error("a formula")


def search_root(law):
    """Critical load of a law of the load factor for the strength 1, and the number of solves."""
    search = Formula(None, {KEY: 1.0}, None, law=law)
    search.largest_stresses(0.0)
    return search.critical_load(KEY), len(search.solved)


@pytest.mark.parametrize(
    ("law", "exact", "solves"),
    [
        (lambda f: 2.0 * f ** (1 / 3), 0.125, 2),
        (lambda f: f ** (1 / 3), 1.0, 2),  # the given load is critical
        (lambda f: 0.5 * f**0.5, 4.0, 3),
        (lambda f: 0.25 * f**0.2 + f / 64, 32.0, 6),
        (lambda f: max(0.3 * f ** (1 / 3), 0.002 * f**2), 500**0.5, 8),  # another place takes over
        (lambda f: f - 5.0, 6.0, 10),  # compression at small loads
        (lambda f: 0.9 if f < 7 else 1.2, 7.0, 22),  # a jump
        *((lambda f, at=at: 0.0 if f < at else 1.2, at, 22) for at in (3.0, 7.0)),  # compression
        (lambda f: 1.0, 1.0, 2),  # independent of the load, at the strength
    ],
)
def test_root_is_found_in_few_solves(law, exact, solves):
    found, made = search_root(law)
    assert found.load_factor == pytest.approx(exact, rel=1e-3)
    assert made <= solves


@pytest.mark.parametrize("law", [lambda f: 0.5, lambda f: 0.01 * f**0.2, lambda f: 0.0])
def test_limit_beyond_the_range_is_told_so(law):
    found, made = search_root(law)
    assert (found.load_factor, found.below) == (None, pytest.approx(100.0))
    assert made <= 4


def test_solver_that_refuses_a_larger_load_ends_the_search():
    def law(factor):
        if factor > 4:
            raise ContactAtWindowEdge("the contact reaches the edge")
        return 0.4 * factor ** (1 / 3)

    one, _ = search_root(law)
    assert (one.load_factor, one.below) == (None, 1.0)
    assert "the contact reaches the edge" in one.reason
