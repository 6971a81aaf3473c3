"""Tests of other laws and of maps of friction in all solvers."""

from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import contact_scenes
import numpy as np
import pytest
from contact_scenes import LIMIT, LOAD, RIGID_BALL, grid, hertz, push, steel

import fem_reference
import radial
import semi_analytical
from contact_scene import (
    CoulombFriction,
    FiniteElementDiscretisation,
    FrictionMap,
    RadialDiscretisation,
    Scene,
)
from contact_scene.checks.axisymmetric import SYMMETRIC
from contact_scene.quantities.summary import ContactStatus
from contact_scene.solver_errors import GrossSliding, UnsupportedScene
from fem_reference.discretised import ElementSolver
from fem_reference.plan import ANGULAR
from radial.discretised import RingSolver
from verification.judging.case import OVER_ANGLES
from verification.observed.observed_laws import observed

CELLS = (6, 5)


def mapped(values, **placed):
    return FrictionMap.model_validate({"map": values, "spacing": (0.5, 2.0), **placed})


TOLERANCE = 1e-6
# Convolutions of an increment of coupled cells: Newton's method takes at most 78. It takes 142 to
# 259 where the shear of slipping cells is a tenth below the limit and the alternation ends it.
MAX_CONVOLUTIONS = 110
# Of 40 cells, 24 rings and 32 elements; energy of thin annuli is known no better.
AGREE = {"approach": 2e-4, "tangential_shift": 1e-2, "twist": 1e-2, "dissipated_energy": 0.2}
PEAK = hertz().peak_pressure
PRESS = {"normal_force": LOAD, "increments": 6}
PUSH = push(0.4, increments=2)
TWIST = {"torque": 0.1 * LIMIT * hertz().contact_radius, "increments": 2}


def capped(mu, p):
    """Limit and slope of min(µp, half of that below the peak)."""
    most = 0.5 * mu * PEAK
    return np.minimum(mu * p, most), np.where(mu * p < most, mu, 0.0)


def saturating(mu, p):
    """Limit and slope of µp/(1 + p/p0)."""
    share = 1 / (1 + p / PEAK)
    return mu * p * share, mu * share**2


def use_law(law: Callable[[Any, Any], tuple[Any, Any]], patch: pytest.MonkeyPatch) -> None:
    """Replace Coulomb's law by one in which the coefficient is that of low pressures."""

    def limit(self, pressure, where=...):
        return law(self._at(where), np.asarray(pressure))[0]

    def slope(self, pressure, where=...):
        return law(self._at(where), np.asarray(pressure))[1]

    patch.setattr(CoulombFriction, "limit", limit)
    patch.setattr(CoulombFriction, "slope", slope)


def on_cells(scene: Scene) -> semi_analytical.Result:
    """A window a little wider than the contact."""
    return semi_analytical.solve(scene, grid(40, 1.3), tolerance=1e-8)


def on_rings(scene: Scene) -> radial.Result:
    """The default rings."""
    return radial.solve(scene, RadialDiscretisation())


def on_elements(method: fem_reference.Method) -> Callable[[Scene], fem_reference.Result]:
    """Springs on harmonics alone, as only their law can be observed."""

    def solve(scene: Scene) -> fem_reference.Result:
        on_harmonics = fem_reference.plan(scene).path in ANGULAR
        more = {"penalty": 1000.0, "augmentations": 0, "overlap": 1.0} if on_harmonics else {}
        mesh = FiniteElementDiscretisation(elements_per_radius=32, harmonics=4, **more)
        return fem_reference.solve(scene, mesh, method)

    return solve


ELEMENTS = {method.value: on_elements(method) for method in fem_reference.Method}


def scene(*loading, coupled, mu=0.1):
    """A ball on a half-space of the same contact modulus: coupled if the ball is rigid."""
    unlike = {"indenter": RIGID_BALL, "body": steel(young_modulus=210e9)} if coupled else {}
    return contact_scenes.scene(*loading, friction=mu, **unlike)


# Loading, whether bodies couple, and bound of violations on rings: between the angles of its points
# the solver interpolates the shear, whose direction turns where coupled bodies are pushed. Of
# torsion the displacements are known to 5e-5.
HISTORIES = {
    "pushed": ((PRESS, PUSH), False, 2e-3),
    "pressed, coupled": ((PRESS,), True, 1e-2),
    "pushed, coupled": ((PRESS, PUSH), True, OVER_ANGLES),
    "twisted": ((PRESS, TWIST), False, 1e-4),
}


EVERYWHERE = {"cells": on_cells, "rings": on_rings, **ELEMENTS}


def number(value):
    """A number, or the first component of a vector; zero if it is absent."""
    return 0.0 if value is None else float(np.ravel(value)[0])


def lawful_and_equal(asked: Scene, on_rings: float) -> dict[str, Any]:
    """Results of all solvers, which obey the laws, on rings within a bound, and agree."""
    results = {name: solve(asked) for name, solve in EVERYWHERE.items()}
    known = results["rings"].steps[-1]
    for name, result in results.items():
        assert observed(result).violation < (on_rings if name == "rings" else TOLERANCE), name
        for quantity, most in AGREE.items():
            found, expected = (number(getattr(end, quantity)) for end in (result.steps[-1], known))
            assert found == pytest.approx(expected, rel=most, abs=1e-12), (name, quantity)
    return results


@pytest.mark.parametrize(
    ("law", "history"),
    [
        *((capped, name) for name in ("pushed", "pushed, coupled")),
        *((saturating, name) for name in ("pressed, coupled", "twisted")),
    ],
)
def test_any_law_of_friction_holds_in_every_solver_which_agree(law, history, monkeypatch):
    use_law(law, monkeypatch)
    loading, coupled, bound = HISTORIES[history]
    asked = scene(*loading, coupled=coupled)
    assert asked.friction.uniform is None
    assert asked.friction.largest_tangential_force(LOAD) is None
    results = lawful_and_equal(asked, bound)
    if coupled:
        assert max(one.convolutions for one in results["cells"].increments) < MAX_CONVOLUTIONS


def radial_map(mu, count=201, **placed):
    """A map over 5 contact radii of a coefficient that is a function of r/a."""
    side = 5 * hertz().contact_radius / count
    x = (np.arange(count) - 0.5 * (count - 1)) * side
    values = mu(np.hypot(x[:, None], x) / hertz().contact_radius)
    return FrictionMap.model_validate({"map": values, "spacing": side, **placed})


def falling(x):
    return 0.1 * (1.2 - 0.4 * np.minimum(x, 1.5) ** 2)


def steep(x):
    return 0.05 + 0.15 * np.exp(-2 * x**2)


def waving(x):
    return 0.1 * (1 + 0.5 * np.cos(np.pi * x / 2))


SLID = {"tangential_shift": (10 * hertz().approach, 0.0)}
SPUN = {"twist": 0.1}
TURN = push(0.3, 0.2) | TWIST
ABOUT_THE_AXIS = {
    "pushed, coupled": ((PRESS, PUSH), True),
    "turned and twisted": ((PRESS, PUSH, TURN), False),
}


@pytest.mark.parametrize("history", ABOUT_THE_AXIS)
def test_a_map_about_the_axis_gives_the_same_in_every_solver(history):
    loading, coupled = ABOUT_THE_AXIS[history]
    asked = scene(*loading, coupled=coupled, mu=radial_map(steep))
    mapped = lawful_and_equal(asked, OVER_ANGLES)["rings"].steps[-1]
    uniform = on_rings(scene(*loading, coupled=coupled)).steps[-1]
    pairs = {q: [number(getattr(end, q)) for end in (uniform, mapped)] for q in AGREE}
    assert any(abs(a - b) > 2 * AGREE[q] * abs(b) for q, (a, b) in pairs.items())  # the map matters


@pytest.mark.parametrize("solve", EVERYWHERE.values(), ids=EVERYWHERE)
def test_gross_slip_under_a_map_has_the_integral_of_its_limit(solve):
    """Over Hertz's p = p₀√(1 - x²): ∫ µ p dA = 1.04 µ₀ W, ∫ µ p r dA = (3π/16) µ₀ W a, with
    µ = µ₀ (1.2 - 0.4 x²)."""
    pressed = {"normal_force": LOAD}
    for moved, name, known in (
        (SLID, "tangential_force", 1.04 * LIMIT),
        (SPUN, "torque", 3 * np.pi / 16 * LIMIT * hertz().contact_radius),
    ):
        loading = pressed, {**moved, "increments": 1}
        asked = scene(*loading, coupled=False, mu=radial_map(falling))
        end = solve(asked).steps[-1]
        assert number(getattr(end, name)) == pytest.approx(known, rel=2e-3)
        assert end.status is ContactStatus.GROSS_SLIDING
    above = push(1.05, increments=1)
    asked = scene(pressed, above, coupled=False, mu=radial_map(falling))
    with pytest.raises(GrossSliding, match=r"exceeds the friction limit 10[34]"):
        solve(asked)


def test_a_map_is_refused_where_it_does_not_cover_the_contact():
    small = radial_map(waving)
    small = small.model_copy(update={"spacing": (small.spacing[0] / 3,) * 2})
    for solve in (on_rings, *ELEMENTS.values()):
        with pytest.raises(UnsupportedScene, match="friction map covers distances up to"):
            solve(scene(PRESS, PUSH, coupled=False, mu=small))


def test_a_map_is_symmetric_up_to_its_interpolation():
    coarse, fine = (radial_map(waving, count) for count in (101, 201))
    assert fine.asymmetry < 1e-3
    assert coarse.asymmetry == pytest.approx(4 * fine.asymmetry, rel=0.2)
    r = np.linspace(0, 2.4, 50) * hertz().contact_radius
    means = fine.at_radii(r).map.values
    np.testing.assert_allclose(means, waving(r / hertz().contact_radius), rtol=5e-4)
    moved = radial_map(waving, origin=(0.2 * hertz().contact_radius, 0.0))
    assert moved.asymmetry > SYMMETRIC
    assert mapped(np.zeros(CELLS)).asymmetry == 0.0


@pytest.mark.parametrize("load", [PUSH, TWIST])
def test_the_asymmetry_of_a_map_is_a_part_of_stated_errors(load):
    nearly = radial_map(lambda x: steep(x) + 1e-3 * (np.arange(201) > 100))
    assert 0.002 < nearly.asymmetry < SYMMETRIC
    asked = scene(PRESS, load, coupled=False, mu=nearly)
    rings = RingSolver(asked, RadialDiscretisation())
    elements = ElementSolver(asked, FiniteElementDiscretisation())
    plans = SimpleNamespace(plan=fem_reference.plan(asked))
    for neglected in (rings.neglected_errors(None), elements.neglected_errors(plans)):
        assert min(neglected.values()) >= nearly.asymmetry
        assert {"tangential_shift", "twist", "dissipated_energy"} <= set(neglected)
