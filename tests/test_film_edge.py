"""The pressure at the edge of a contact of layered bodies, against the radial solver."""

import numpy as np
import pytest
from numpy.typing import NDArray

from contact_scene import (
    RIGID,
    Body,
    IsotropicMaterial,
    Layer,
)
from semi_analytical.edge.film import FilmLaw, film_law
from semi_analytical.edge.fit import peak_of

Field = NDArray[np.float64]
A, RADIUS, YOUNG, NU = 1e-3, 0.018, 210e9, 0.3
NO_BODY = Body(material=RIGID)


def coated(ratio: float, thickness: float, base: float = YOUNG) -> Body:
    """Film of so many times the modulus of its base, its thickness over A."""
    film = IsotropicMaterial(young_modulus=ratio * base, poisson_ratio=NU)
    return Body(
        material=IsotropicMaterial(young_modulus=base, poisson_ratio=NU),
        layers=[Layer(thickness=thickness * A, material=film)],
    )


def law_of(ratio: float, thickness: float, spacing: float = A) -> FilmLaw:
    """Lengths over A where the spacing is A."""
    law = film_law(coated(ratio, thickness), NO_BODY, (spacing, spacing))
    assert law is not None
    return law


@pytest.mark.parametrize("ratio", [0.25, 4.0, 100.0])
def test_the_law_goes_from_the_root_of_the_film_to_that_of_its_base(ratio: float) -> None:
    """Which is the root of the ratio of their moduli smaller."""
    law = law_of(ratio, 1.0)
    near, far = law.over_root(np.array([1e-5, 1e5]), np.zeros(2))
    assert near == pytest.approx(1.0, abs=1e-4)
    assert far == pytest.approx(ratio**-0.5, rel=1e-3)


@pytest.mark.parametrize("place", [(-0.3, 0.8, 0.4), (0.1, 0.7, 0.0), (1.2, 0.5, -0.5), (9, 1, 0)])
def test_means_of_the_law_are_its_integrals(place: tuple[float, float, float]) -> None:
    """Over a square in which the distance is linear; the derivative by differences."""
    law, c = law_of(4.0, 1.0), np.array([-0.02])
    s, along, across = place
    x = (np.arange(400) + 0.5) / 400 - 0.5

    def means(at: float) -> Field:
        """Of the law and of the root."""
        inside = np.maximum(at + x * along + x[:, None] * across, 0.0)
        root = np.sqrt(inside)
        return np.array([np.mean(root * law.over_root(np.maximum(inside, 1e-12), c)), root.mean()])

    ratio, leaning = law.means_over_root(np.array([s]), np.array([along]), np.array([across]), c)
    of_law, of_root = means(s)
    assert ratio[0] == pytest.approx(of_law / of_root, rel=1e-3)
    rates = np.log(means(s + 0.05) / means(s - 0.05))
    assert leaning[0] == pytest.approx(rates[0] / rates[1] - 1, abs=0.02)


def test_no_film_calls_for_a_law_where_an_edge_sees_none() -> None:
    """None at all, one like its base, one as thick as the edge is far, one on a rigid base."""
    spacing = A / 40, A / 40
    bare = Body(material=IsotropicMaterial(young_modulus=YOUNG, poisson_ratio=NU))
    on_rigid = Body(material=RIGID, layers=coated(2.0, 0.1).layers)
    for body in (bare, coated(1.0, 0.1), coated(4.0, 1.0), on_rigid):
        assert film_law(body, NO_BODY, spacing) is None
    one, other = (
        film_law(coated(4.0, 0.1), bare, spacing),
        film_law(bare, coated(4.0, 0.1), spacing),
    )
    assert one is not None
    assert other is not None
    s, c = np.array([0.3, 3.0]), np.zeros(2)
    np.testing.assert_allclose(one.over_root(s, c), other.over_root(s, c), rtol=1e-12)


# ---- The largest pressure at a point, from means over cells.


CELLS = 64
POINTS, WEIGHTS = (half / 2 for half in np.polynomial.legendre.leggauss(3))


def means(pressure):
    """Over unit cells about the origin, off their symmetry."""
    at = np.arange(CELLS) - (CELLS - 1) / 2
    x, y = (at + 0.31)[:, None], at - 0.17
    return sum(
        w * v * pressure(x + s, y + t)
        for s, w in zip(POINTS, WEIGHTS, strict=True)
        for t, v in zip(POINTS, WEIGHTS, strict=True)
    )


def cap(x, y):
    return np.sqrt(np.maximum(1 - (x / 25) ** 2 - (y / 15) ** 2, 0))


def ring(x, y):
    return np.sqrt(np.maximum(1 - ((np.hypot(x, y) - 18) / 9) ** 2, 0))


def long_cap(x, y):
    along, across = 0.8 * x - 0.6 * y, 0.6 * x + 0.8 * y
    return np.sqrt(np.maximum(1 - (across / 9) ** 2 - (along / 200) ** 2, 0))


@pytest.mark.parametrize(
    ("pressure", "ridge", "within"),
    [(cap, False, 1e-6), (ring, True, 3e-5), (long_cap, True, 3e-5)],
    ids=["cap", "ring", "long cap"],
)
def test_the_peak_of_caps_and_ridges(pressure, ridge, within):
    """The largest means are 5e-4 too small."""
    found = peak_of(means(pressure))
    assert found.ridge is ridge
    assert found.value == pytest.approx(1.0, abs=within)
