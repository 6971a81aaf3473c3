"""Tests of the friction limit: at a point, on a part of the surface, and in total."""

from __future__ import annotations

from collections.abc import Callable
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest
from contact_scenes import LIMIT, LOAD, RADIUS, grid, hertz, steel
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from pydantic import ValidationError

import fem_reference
import radial
import semi_analytical
from contact_errors.on_elements import ElementSolver
from contact_errors.on_radii import RingSolver
from contact_results.figures.profile_plot import profile_plot
from contact_results.result_report import ResultReport
from contact_scene import (
    RIGID,
    Body,
    CoulombFriction,
    FiniteElementDiscretisation,
    FrictionMap,
    LoadStep,
    Paraboloid,
    RadialDiscretisation,
    Scene,
)
from contact_scene.checks.axisymmetric import SYMMETRIC
from contact_scene.friction import FRICTIONLESS, sliding_friction
from contact_scene.quantities.summary import ContactStatus
from contact_scene.solver_errors import GrossSliding, UnsupportedScene
from fem_reference.plan import ANGULAR
from verification.judging.case import OVER_ANGLES
from verification.observed.observed_laws import observed

CELLS = (6, 5)
PRESSURES = arrays(np.float64, CELLS, elements=st.floats(0.0, 1e9))
UNIFORM = st.floats(0.0, 2.0).map(lambda mu: CoulombFriction(coefficient=mu))
MAPPED = arrays(np.float64, CELLS, elements=st.floats(0.0, 2.0)).map(
    lambda values: CoulombFriction.model_validate({"coefficient": {"map": values, "spacing": 1.0}})
)
BOX = (slice(1, 5), slice(2, 4))


@given(UNIFORM | MAPPED, PRESSURES)
def test_the_limit_on_a_part_of_the_surface_is_that_part_of_the_limit(friction, p) -> None:
    whole = friction.limit(p)
    assert whole.shape == p.shape
    np.testing.assert_array_equal(friction.limit(p[BOX], where=BOX), whole[BOX])


@given(UNIFORM | MAPPED, PRESSURES)
def test_the_limit_is_between_none_and_the_largest_ratio_of_the_pressure(friction, p) -> None:
    limit = friction.limit(p)
    assert np.all((limit >= 0) & (limit <= friction.largest * p))
    assert np.all(limit[p == 0] == 0)
    assert not np.any(FRICTIONLESS.limit(p))


@given(UNIFORM | MAPPED, PRESSURES)
def test_the_slope_is_how_fast_the_limit_grows(friction, p) -> None:
    step = np.full(CELLS, 2.0**20)
    grown = friction.limit(p + step) - friction.limit(p)
    np.testing.assert_allclose(grown, friction.slope(p) * step, atol=1e-6)


@given(UNIFORM | MAPPED, PRESSURES)
def test_what_is_carried_in_all_is_the_sum_of_the_limit_or_not_known(friction, p) -> None:
    carried = friction.largest_tangential_force(float(np.sum(p)))
    assert (carried is None) == (friction.uniform is None) == (friction.coefficient_map is not None)
    if carried is not None:
        assert carried == pytest.approx(float(np.sum(friction.limit(p))), rel=1e-12, abs=1e-300)


def mapped(values, **placed):
    return FrictionMap.model_validate({"map": values, "spacing": (0.5, 2.0), **placed})


@pytest.mark.parametrize("origin", [(0.0, 0.0), (0.3, -0.9)])
@pytest.mark.parametrize(("cells", "window"), [((7, 8), (1.0, 2.0)), ((30, 5), (1.9, 4.0))])
def test_a_coefficient_stays_at_its_place_whatever_window_and_cells(origin, cells, window) -> None:
    def plane(x, y):
        return 0.5 + 0.1 * x - 0.03 * y

    x, y = (np.arange(n) - (n - 1) / 2 for n in CELLS)
    values = plane(0.5 * x[:, None] + origin[0], 2.0 * y + origin[1])
    spacing = (window[0] / cells[0], window[1] / cells[1])
    found = mapped(values, origin=origin).on_grid(cells, spacing).map.values
    x, y = ((np.arange(n) - (n - 1) / 2) * side for n, side in zip(cells, spacing, strict=True))
    np.testing.assert_allclose(found, plane(x[:, None], y), rtol=1e-12)


def test_a_map_is_even_about_the_origin_of_the_contact_alone() -> None:
    even = 0.1 + 0.01 * np.add.outer(np.abs(np.arange(6) - 2.5), np.abs(np.arange(5) - 2))
    assert mapped(even).is_even
    assert not any(mapped(even, origin=at).is_even for at in ((0.3, 0.0), (0.0, -0.9)))
    assert not any(mapped(even + np.eye(6, 5)[::sign]).is_even for sign in (1, -1))


def test_beyond_its_extent_a_map_says_nothing() -> None:
    placed = mapped(np.ones(CELLS), origin=(-0.5, 1.0))
    assert placed.extent == (2.0, 8.0)
    placed.on_grid((8, 8), (0.25, 1.0))
    with pytest.raises(ValueError, match="at most"):
        placed.on_grid((8, 8), (0.25, 1.01 * 1.25))
    with pytest.raises(ValidationError, match="does not reach the origin"):
        mapped(np.ones(CELLS), origin=(1.5, 0.0))


def test_friction_while_sliding_is_the_mean_of_both_limits_along_the_shear_at_the_end() -> None:
    start, shear = np.ones((2, 3)), np.array([[3.0, 0.0, -6.0], [4.0, 0.0, 0.0]])
    limits = np.array([1.0, 2.0, 0.0]), np.array([4.0, 2.0, 3.0])
    found = sliding_friction(start, shear, np.ones((2, 3)), *limits)
    np.testing.assert_allclose(found, [[1.5, 0.0, -1.5], [2.0, 0.0, 0.0]], rtol=1e-15)


def test_friction_of_what_parts_is_along_its_way_and_half_the_shear_that_it_had() -> None:
    start, passed = np.array([[0.3], [-0.4]]), np.array([[0.0], [-7.0]])
    found = sliding_friction(start, 0 * start, passed, np.array([1.0]), np.array([0.0]))
    np.testing.assert_allclose(found, [[0.0], [-0.25]], rtol=1e-15)


# ---- Laws of friction other than Coulomb's, substituted in `contact_scene.friction` alone.


TOLERANCE = 1e-6
# Convolutions of an increment of coupled cells: Newton's method takes at most 78. It takes 142 to
# 259 where the shear of slipping cells is a tenth below the limit and the alternation ends it.
MAX_CONVOLUTIONS = 110
# Of 40 cells, 24 rings and 32 elements; energy of thin annuli is known no better.
AGREE = {"approach": 2e-4, "tangential_shift": 1e-2, "twist": 1e-2, "dissipated_energy": 0.2}
PEAK = hertz().peak_pressure
PRESS = LoadStep(normal_force=LOAD, increments=6)
PUSH = LoadStep(tangential_force=(0.4 * LIMIT, 0.0), increments=2)
TWIST = LoadStep(torque=0.1 * LIMIT * hertz().contact_radius, increments=2)


def capped(mu: Any, p: Any) -> tuple[Any, Any]:
    """Limit and slope of min(µp, half of that below the peak)."""
    most = 0.5 * mu * PEAK
    return np.minimum(mu * p, most), np.where(mu * p < most, mu, 0.0)


def saturating(mu: Any, p: Any) -> tuple[Any, Any]:
    """Limit and slope of µp/(1 + p/p0)."""
    share = 1 / (1 + p / PEAK)
    return mu * p * share, mu * share**2


@pytest.fixture(params=[capped, saturating])
def law(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> Any:
    """A law in which the coefficient is that of low pressures."""

    def limit(self: Any, pressure: Any, where: Any = ...) -> Any:
        return request.param(self._at(where), np.asarray(pressure))[0]

    def slope(self: Any, pressure: Any, where: Any = ...) -> Any:
        return request.param(self._at(where), np.asarray(pressure))[1]

    monkeypatch.setattr(CoulombFriction, "limit", limit)
    monkeypatch.setattr(CoulombFriction, "slope", slope)
    return request.param


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


def scene(*loading: LoadStep, coupled: bool, mu: float = 0.1) -> Scene:
    """A ball on a half-space of the same contact modulus: coupled if the ball is rigid."""
    return Scene(
        indenter=Paraboloid(radius=RADIUS, material=RIGID if coupled else steel()),
        body=Body(material=steel(young_modulus=210e9) if coupled else steel()),
        friction=CoulombFriction(coefficient=mu),
        loading=loading,
    )


# Loading, whether bodies couple, and bound of violations on rings: between the angles of its points
# the solver interpolates the shear, whose direction turns where coupled bodies are pushed. Of
# torsion the displacements are known to 5e-5.
HISTORIES = {
    "pushed": ((PRESS, PUSH), False, 2e-3),
    "pressed, coupled": ((PRESS,), True, 1e-2),
    "pushed, coupled": ((PRESS, PUSH), True, OVER_ANGLES),
    "twisted": ((PRESS, TWIST), False, 1e-4),
}


@pytest.mark.parametrize("history", HISTORIES)
def test_any_law_of_friction_holds_in_every_solver_which_agree(law, history) -> None:
    loading, coupled, bound = HISTORIES[history]
    asked = scene(*loading, coupled=coupled)
    assert asked.friction is not None
    assert asked.friction.uniform is None
    assert asked.friction.largest_tangential_force(LOAD) is None
    cells, rings = on_cells(asked), on_rings(asked)
    elements = {name: solve(asked) for name, solve in ELEMENTS.items()}
    assert observed(cells).violation < TOLERANCE
    if coupled:
        assert max(one.convolutions for one in cells.increments) < MAX_CONVOLUTIONS
    assert observed(rings).violation < bound
    for name, result in elements.items():
        assert observed(result).violation < TOLERANCE, name
    for name, most in AGREE.items():
        expected = number(getattr(rings.steps[-1], name))
        for result in (cells, *elements.values()):
            found = number(getattr(result.steps[-1], name))
            assert found == pytest.approx(expected, rel=most, abs=1e-12), (name, result.solver)


def number(value: Any) -> float:
    """A number, or the first component of a vector; zero if it is absent."""
    return 0.0 if value is None else float(np.ravel(value)[0])


@pytest.mark.parametrize("solve", [on_cells, on_rings, *ELEMENTS.values()])
def test_a_force_between_the_limit_of_the_law_and_that_of_its_coefficient_slides(law, solve):
    push = LoadStep(tangential_force=(0.9 * LIMIT, 0.0))
    with pytest.raises(GrossSliding):
        solve(scene(LoadStep(normal_force=LOAD), push, coupled=False))


# ---- Maps of the coefficient that depend on the distance from the axis.


def radial_map(mu: Callable[[Any], Any], count: int = 201, **placed: Any) -> FrictionMap:
    """A map over 5 contact radii of a coefficient that is a function of r/a."""
    side = 5 * hertz().contact_radius / count
    x = (np.arange(count) - 0.5 * (count - 1)) * side
    values = mu(np.hypot(x[:, None], x) / hertz().contact_radius)
    return FrictionMap.model_validate({"map": values, "spacing": side, **placed})


def with_friction(asked: Scene, coefficient: float | FrictionMap) -> Scene:
    return asked.model_copy(update={"friction": CoulombFriction(coefficient=coefficient)})


def falling(x: Any) -> Any:
    return 0.1 * (1.2 - 0.4 * np.minimum(x, 1.5) ** 2)


def steep(x: Any) -> Any:
    return 0.05 + 0.15 * np.exp(-2 * x**2)


def waving(x: Any) -> Any:
    return 0.1 * (1 + 0.5 * np.cos(np.pi * x / 2))


EVERYWHERE: dict[str, Callable[[Scene], Any]] = {"cells": on_cells, "rings": on_rings, **ELEMENTS}
SLID = {"tangential_shift": (10 * hertz().approach, 0.0)}
SPUN = {"twist": 0.1}


TURN = LoadStep(tangential_force=(0.3 * LIMIT, 0.2 * LIMIT), torque=TWIST.torque, increments=2)
ABOUT_THE_AXIS = {name: HISTORIES[name][:2] for name in HISTORIES if name != "pressed, coupled"}
ABOUT_THE_AXIS["turned and twisted"] = ((PRESS, PUSH, TURN), False)


@pytest.mark.parametrize("history", ABOUT_THE_AXIS)
def test_a_map_about_the_axis_gives_the_same_in_every_solver(history: str) -> None:
    loading, coupled = ABOUT_THE_AXIS[history]
    asked = with_friction(scene(*loading, coupled=coupled), radial_map(steep))
    results = {name: solve(asked) for name, solve in EVERYWHERE.items()}
    expected = results["rings"].steps[-1]
    for name, result in results.items():
        allowed = OVER_ANGLES if name == "rings" else TOLERANCE
        assert observed(result).violation < allowed, name
        for quantity, most in AGREE.items():
            found = number(getattr(result.steps[-1], quantity))
            known = number(getattr(expected, quantity))
            assert found == pytest.approx(known, rel=most, abs=1e-12), (name, quantity)
    uniform = on_rings(scene(*loading, coupled=coupled)).steps[-1]
    pairs = {q: [number(getattr(end, q)) for end in (uniform, expected)] for q in AGREE}
    assert any(abs(a - b) > 2 * AGREE[q] * abs(b) for q, (a, b) in pairs.items())  # the map matters


@pytest.mark.parametrize("solve", EVERYWHERE.values(), ids=EVERYWHERE)
def test_gross_slip_under_a_map_has_the_integral_of_its_limit(solve) -> None:
    """Over Hertz's p = p₀√(1 - x²): ∫ µ p dA = 1.04 µ₀ W, ∫ µ p r dA = (3π/16) µ₀ W a, with
    µ = µ₀ (1.2 - 0.4 x²)."""
    pressed = LoadStep(normal_force=LOAD)
    for moved, name, known in (
        (SLID, "tangential_force", 1.04 * LIMIT),
        (SPUN, "torque", 3 * np.pi / 16 * LIMIT * hertz().contact_radius),
    ):
        loading = pressed, LoadStep(**moved, increments=1)
        asked = with_friction(scene(*loading, coupled=False), radial_map(falling))
        end = solve(asked).steps[-1]
        assert number(getattr(end, name)) == pytest.approx(known, rel=2e-3)
        assert end.status is ContactStatus.GROSS_SLIDING
    above = LoadStep(tangential_force=(1.05 * LIMIT, 0.0), increments=1)
    asked = scene(pressed, above, coupled=False, mu=0.2)
    with pytest.raises(GrossSliding, match=r"exceeds the friction limit 10[34]"):
        solve(with_friction(asked, radial_map(falling)))


@pytest.mark.parametrize("solve", EVERYWHERE.values(), ids=EVERYWHERE)
@pytest.mark.parametrize("coupled", [False, True])
def test_an_even_map_equals_its_coefficient(solve, coupled: bool) -> None:
    """A map of one value is its number; one value that differs by round-off makes it a map."""
    asked = scene(PRESS, PUSH, coupled=coupled)
    nearly = radial_map(lambda x: np.where(x > 2.4, 0.1 * (1 + 1e-13), 0.1 + 0 * x))
    number_, map_, one = (
        solve(with_friction(asked, mu)).steps[-1]
        for mu in (0.1, nearly, radial_map(lambda x: 0.1 + 0 * x))
    )
    assert nearly.constant is None
    for name in AGREE:
        expected = number(getattr(number_, name))
        assert number(getattr(one, name)) == expected
        assert number(getattr(map_, name)) == pytest.approx(expected, rel=1e-9, abs=1e-15)


ASKEW = {
    "off-centre": radial_map(waving, origin=(0.2 * hertz().contact_radius, 0.0)),
    "along x": radial_map(waving).model_copy(
        update={"spacing": (radial_map(waving).spacing[0], 1.2 * radial_map(waving).spacing[1])}
    ),
}


@pytest.mark.parametrize("askew", ASKEW)
@pytest.mark.parametrize("load", [PUSH, TWIST])
def test_other_maps_are_refused_for_one_reason(askew: str, load: LoadStep) -> None:
    asked = with_friction(scene(PRESS, load, coupled=False), ASKEW[askew])
    told = set()
    for plan in (fem_reference.plan, radial.plan):
        with pytest.raises(UnsupportedScene, match="is a map, and at equal distance") as refused:
            plan(asked)
        told.add(str(refused.value))
    assert len(told) == 1
    semi_analytical.plan(asked)
    pressed = with_friction(scene(PRESS, coupled=False), ASKEW[askew])
    assert not fem_reference.plan(pressed).path.value.endswith("coupled")  # friction does not act


def test_a_map_is_refused_where_rings_do_not_take_it() -> None:
    asked = with_friction(scene(PRESS, coupled=True), radial_map(waving))
    with pytest.raises(UnsupportedScene, match="is a map, and this solver requires one number"):
        radial.plan(asked)
    small = radial_map(waving)
    small = small.model_copy(update={"spacing": (small.spacing[0] / 3,) * 2})
    for solve in (on_rings, *ELEMENTS.values()):
        with pytest.raises(UnsupportedScene, match="friction map covers distances up to"):
            solve(with_friction(scene(PRESS, PUSH, coupled=False), small))


def test_a_map_is_symmetric_up_to_its_interpolation() -> None:
    coarse, fine = (radial_map(waving, count) for count in (101, 201))
    assert fine.asymmetry < 1e-3
    assert coarse.asymmetry == pytest.approx(4 * fine.asymmetry, rel=0.2)
    r = np.linspace(0, 2.4, 50) * hertz().contact_radius
    means = fine.at_radii(r).map.values
    np.testing.assert_allclose(means, waving(r / hertz().contact_radius), rtol=5e-4)
    moved = ASKEW["off-centre"]
    assert moved.asymmetry > SYMMETRIC
    assert mapped(np.zeros(CELLS)).asymmetry == 0.0


@pytest.mark.parametrize("load", [PUSH, TWIST])
def test_the_asymmetry_of_a_map_is_a_part_of_stated_errors(load: LoadStep) -> None:
    nearly = radial_map(lambda x: steep(x) + 1e-3 * (np.arange(201) > 100))
    assert 0.002 < nearly.asymmetry < SYMMETRIC
    asked = with_friction(scene(PRESS, load, coupled=False), nearly)
    rings = RingSolver(asked, RadialDiscretisation())
    elements = ElementSolver(asked, FiniteElementDiscretisation())
    plans = SimpleNamespace(plan=fem_reference.plan(asked))
    for neglected in (rings.neglected_errors(None), elements.neglected_errors(cast("Any", plans))):
        assert min(neglected.values()) >= nearly.asymmetry
        assert {"tangential_shift", "twist", "dissipated_energy"} <= set(neglected)


@pytest.mark.parametrize("solve", [on_cells, on_rings, *ELEMENTS.values()])
@pytest.mark.parametrize("load", [PUSH, TWIST])
def test_the_profile_shows_the_limit_of_a_map(solve, load: LoadStep) -> None:
    asked = scene(PRESS, load, coupled=False)
    bands = []
    for mu in (0.1, radial_map(lambda x: 0.2 + 1e-6 * x**2)):
        result = solve(with_friction(asked, mu))
        (band,) = profile_plot(ResultReport.of(result)).axes[1].collections
        bands.append(np.max(band.get_paths()[0].vertices[:, 1]))
    assert bands[1] == pytest.approx(2 * bands[0], rel=1e-2)
