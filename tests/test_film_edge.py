"""Tests of the pressure at the contact edge on a film: law of the edge and its reach."""

import numpy as np
import pytest

from contact_scene import RIGID, Body, IsotropicMaterial, Layer
from semi_analytical.edge.film import FilmLaw, film_law
from semi_analytical.frf.stack import stack_of
from semi_analytical.frf.surface import scalars

A = 1e-3
YOUNG = 210e9
NU = 0.3
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
def test_the_law_goes_from_the_root_of_the_film_to_that_of_its_base(ratio):
    """Which is the root of the ratio of their moduli smaller."""
    law = law_of(ratio, 1.0)
    near, far = law.over_root(np.array([1e-5, 1e5]), np.zeros(2))
    assert near == pytest.approx(1.0, abs=1e-4)
    assert far == pytest.approx(ratio**-0.5, rel=1e-3)


def test_no_film_calls_for_a_law_where_an_edge_sees_none():
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
    # The response is the compliance of both bodies over that of their outermost materials.
    film = coated(4.0, 0.1).layers[0]
    k, outermost = np.array([0.01, 0.1, 1.0, 5.0]), Body(material=film.material)
    compliance, unit = (
        sum(scalars(stack_of(body), k / film.thickness).c22 for body in bodies)
        for bodies in ((coated(4.0, 0.1), bare), (outermost, bare))
    )
    np.testing.assert_allclose(one.response(k), compliance / unit, rtol=1e-10)
    s, c = np.array([0.3, 3.0]), np.zeros(2)
    np.testing.assert_allclose(one.over_root(s, c), other.over_root(s, c), rtol=1e-12)
