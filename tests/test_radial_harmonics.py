"""Tests of the compliance of traction rings, for each angular harmonic, against closed forms."""

import math
from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import dblquad
from scipy.special import hyp2f1

from contact_scene import RIGID, Body, IsotropicMaterial, Layer, LoadStep, Paraboloid, Scene
from radial.frictional.coupling import Coupling
from radial.tangential.harmonic_kernels import equal_order_kernels
from radial.tangential.hat_integrals import half_space_integrals
from radial.tangential.ring_compliance import ring_compliance

NODES = (0.0, 0.1, 0.22, 0.3, 0.5, 0.8, 0.95, 1.0, 1.3)
HIGHEST = 6


def material(young_modulus: float, poisson_ratio: float) -> IsotropicMaterial:
    return IsotropicMaterial(young_modulus=young_modulus, poisson_ratio=poisson_ratio)


SOFT = material(0.91, 0.3)


def weber_schafheitlin(mu: int, nu: int, a: float, b: float) -> float:
    """∫₀^∞ J_µ(at) J_ν(bt) dt for a < b (DLMF 10.22.56)."""
    first = a**mu * math.gamma((mu + nu + 1) / 2) / b ** (mu + 1) / math.gamma(mu + 1)
    upper = (nu - mu + 1) / 2
    if upper <= 0 and upper == int(upper):
        return 0.0
    return float(
        first
        / math.gamma(upper)
        * hyp2f1((1 + mu + nu) / 2, (1 + mu - nu) / 2, mu + 1, (a / b) ** 2)
    )


def kernel(name: str, m: int, r: float, s: float) -> float:
    before, behind = {"equal_order": (m, m), "shifted": (m - 1, m + 1), "stepped": (m, m + 1)}[name]
    if r < s:
        return weber_schafheitlin(before, behind, r, s)
    return weber_schafheitlin(behind, before, s, r)


def hat(i: int, r: float) -> float:
    return float(np.interp(r, NODES, np.arange(len(NODES)) == i))


@pytest.mark.parametrize("ratio", [1e-4, 0.3, 0.69, 0.72, 0.97])
def test_what_rings_of_a_harmonic_do_to_each_other_is_a_legendre_function(ratio):
    found = equal_order_kernels(12, np.array([ratio]), np.array([1.0]), np.array([1 - ratio]))[:, 0]
    assert_allclose(
        found, [weber_schafheitlin(m, m, ratio, 1.0) for m in range(13)], rtol=3e-13, atol=0
    )


@pytest.mark.parametrize("name", ["equal_order", "shifted", "stepped"])
@pytest.mark.parametrize(("m", "i", "j"), [(1, 2, 3), (2, 1, 7)])
def test_energies_of_hats_are_their_kernels_integrated(name, m, i, j):
    def weighted(s, r):
        return hat(i, r) * hat(j, s) * kernel(name, m, r, s) * r * s

    total = 0.0
    for e in (i - 1, i):
        for f in (j - 1, j):
            r, s = (NODES[e], NODES[e + 1]), (NODES[f], NODES[f + 1])
            if e != f:
                total += dblquad(weighted, *r, *s, epsabs=1e-10, epsrel=1e-8)[0]
                continue
            for below in (
                (lambda r: r, lambda _, end=s[1]: end),
                (
                    lambda _, end=s[0]: end,
                    lambda r: r,
                ),
            ):
                total += dblquad(weighted, *r, *below, epsabs=1e-10, epsrel=1e-8)[0]
    found = getattr(half_space_integrals(NODES, HIGHEST), name)[m][i, j]
    assert_allclose(found, total, rtol=2e-8, atol=1e-10)


def pair(base: IsotropicMaterial, *films: tuple[IsotropicMaterial, float]) -> Coupling:
    """A rigid ball and a body; films by material and thickness, outermost first."""
    layers = tuple(Layer(material=film, thickness=thickness) for film, thickness in films)
    ball, body = Paraboloid(radius=1.0, material=RIGID), Body(material=base, layers=layers)
    return Coupling.of(Scene(indenter=ball, body=body, loading=(LoadStep(normal_force=1.0),)))


@cache
def homogeneous() -> np.ndarray:
    return ring_compliance(pair(SOFT), NODES, 1.0, HIGHEST)


def test_a_layer_of_the_material_below_it_changes_nothing():
    same = ring_compliance(pair(SOFT, (SOFT, 0.4)), NODES, 1.0, HIGHEST)
    assert_allclose(same, homogeneous(), atol=1e-13)
