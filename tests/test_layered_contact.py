"""Contact of layered bodies: what does not change it, and what is refused."""

import numpy as np
import pytest

from contact_scene import RIGID, Body, IsotropicMaterial, Layer, LoadStep, Paraboloid, Scene
from contact_scene.solver_errors import ResourceRefused, UnsupportedScene
from semi_analytical import SurfaceGrid, plan, solve
from semi_analytical.influence import layered
from verification.closed_forms.coated_indentation import paraboloid
from verification.problems.layered_scene import surface_of

RADIUS = 100.0
GRID = SurfaceGrid((64, 64), (3.0, 3.0))


def material(E: float, nu: float = 0.3) -> IsotropicMaterial:
    return IsotropicMaterial(young_modulus=E, poisson_ratio=nu)


def body(base: IsotropicMaterial, *layers: tuple[float, IsotropicMaterial]) -> Body:
    return Body(material=base, layers=[Layer(thickness=h, material=m) for h, m in layers])


def pressed(lower: Body, upper: Body | None = None, **load: float) -> Scene:
    upper = upper or Body(material=RIGID)
    ball = Paraboloid(radius=RADIUS, material=upper.material, layers=upper.layers)
    return Scene(indenter=ball, body=lower, loading=(LoadStep(**load),))


COATED = body(material(1.0), (0.5, material(2.0)))


@pytest.mark.parametrize(
    ("contrast", "thickness"), [(1e2, 1.0), (1e4, 1.0), (1e6, 1.0), (30.0, 0.1), (1e3, 0.1)]
)
def test_stiff_coating_bends_over_its_base(contrast: float, thickness: float) -> None:
    """The spectrum of its coefficients has negative entries, and pressed cells lift others."""
    lower = body(material(1.0), (thickness, material(contrast)))
    exact = paraboloid(surface_of(lower), RADIUS, 1.0)
    end = solve(pressed(lower, normal_force=exact.load), GRID, 1e-8).steps[-1]
    assert end.approach == pytest.approx(exact.approach, rel=2e-4)
    assert end.contact_radius == pytest.approx(1, rel=4e-2)


@pytest.mark.parametrize("thickness", [1e-12, 1e3])
def test_layer_far_thinner_or_thicker_than_the_contact_is_none_or_all(thickness: float) -> None:
    layered = pressed(body(material(1.0), (thickness, material(2.0))), normal_force=0.01)
    alone = pressed(body(material(1.0 if thickness < 1 else 2.0)), normal_force=0.01)
    p, q = (solve(scene, GRID, 1e-9).steps[-1].pressure for scene in (layered, alone))
    assert np.abs(p - q).max() < 1e-6 * q.max()


@pytest.mark.parametrize(
    "lower",
    [
        body(material(1e-30), (0.5, material(1.0))),
        body(material(1.0), (0.5, material(1e30))),
        body(material(1.0), (0.5, material(1e-9)), (0.5, material(1e9))),
    ],
)
def test_layer_that_is_as_good_as_free_is_refused(lower: Body) -> None:
    with pytest.raises(UnsupportedScene, match="as good as free or rigid"):
        plan(pressed(lower, normal_force=0.01))


def test_layered_window_beyond_memory_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(layered, "available_bytes", lambda: 1 << 20)
    with pytest.raises(ResourceRefused, match="influence coefficients for"):
        solve(pressed(COATED, normal_force=0.01), GRID, 1e-8)
