"""Tests of the energies of traction rings and of their Bessel functions against closed forms."""

from __future__ import annotations

import math
import tracemalloc
from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import dblquad
from scipy.special import hyp2f1, jv, spherical_jn

from contact_scene import RIGID, Body, IsotropicMaterial, Layer, LoadStep, Paraboloid, Scene
from radial.frictional.coupling import Coupling
from radial.response.wavenumbers import spherical_bessel, waves
from radial.tangential import ring_energies
from radial.tangential.harmonic_kernels import equal_order_kernels
from radial.tangential.ring_compliance import ring_compliance
from radial.tangential.ring_energies import half_space_integrals

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
def test_what_rings_of_a_harmonic_do_to_each_other_is_a_legendre_function(ratio: float) -> None:
    found = equal_order_kernels(12, np.array([ratio]), np.array([1.0]), np.array([1 - ratio]))[:, 0]
    assert_allclose(
        found, [weber_schafheitlin(m, m, ratio, 1.0) for m in range(13)], rtol=3e-13, atol=0
    )


@pytest.mark.parametrize("name", ["equal_order", "shifted", "stepped"])
@pytest.mark.parametrize(("m", "i", "j"), [(1, 2, 3), (2, 1, 7)])
def test_energies_of_hats_are_their_kernels_integrated(name: str, m: int, i: int, j: int) -> None:
    def weighted(s: float, r: float) -> float:
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


def test_work_is_the_same_both_ways() -> None:
    """Betti: energies are symmetric, of layers, too."""
    coated = pair(SOFT, (material(2.0, 0.4), 0.5))
    whole = ring_compliance(coated, NODES, 1.3, HIGHEST)
    for found in (homogeneous(), whole):
        assert_allclose(found, found.transpose(0, 2, 1, 4, 3), atol=1e-14)


def test_a_layer_of_the_material_below_it_changes_nothing() -> None:
    same = ring_compliance(pair(SOFT, (SOFT, 0.4)), NODES, 1.0, HIGHEST)
    assert_allclose(same, homogeneous(), atol=1e-13)


@pytest.mark.parametrize("highest", [0, 1, 2, 10, 40])
def test_bessel_functions_of_all_orders_are_those_of_scipy(highest: int) -> None:
    at = np.concatenate([[0.0], np.geomspace(1e-8, 300, 2000), highest + np.linspace(-1, 1, 41)])
    at = np.abs(at)
    found = list(ring_energies.bessel_functions(highest, at))
    assert len(found) == highest + 1
    for m, values in enumerate(found):
        assert_allclose(values, jv(m, at), atol=2e-14)


@pytest.mark.parametrize("count", [1, 2, 3, 40, 300])
def test_spherical_bessel_functions_of_all_orders_are_those_of_scipy(count: int) -> None:
    at = np.geomspace(1e-8, 2500, 1500)
    expected = spherical_jn(np.arange(count)[:, None], at)
    found = spherical_bessel(count, at)
    assert_allclose(found * np.maximum(at, 1), expected * np.maximum(at, 1), rtol=0, atol=5e-14)
    small = (at < 1) & (np.abs(expected) > 1e-290)
    assert_allclose(found[small], expected[small], rtol=5e-13)


def test_transforms_of_many_wavenumbers_take_little_memory_beside_their_result() -> None:
    """Thin layers need 40 000 wavenumbers: all orders of all at once took gigabytes."""
    tracemalloc.start()
    many = waves(shortest=10_000.0, longest=1.0, reach=3.0)
    found = many.even_transforms(104), many.legendre_transform(np.ones(40))
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    kept = found[0].nbytes + 40 * found[1].nbytes
    assert peak < 1.5 * kept
