"""Tests of the edge correction, by which the contact edge lies inside the cells."""

import numpy as np
import pytest
from contact_scenes import (
    APPROACH,
    LIMIT,
    LOAD,
    MU,
    RADIUS,
    RIGID_BALL,
    A,
    hertz,
    paraboloid,
    scene,
    steel,
)

import slipstick
from contact_results.result_warnings import warnings_of
from contact_scene import (
    Body,
    HeightMap,
    Layer,
    Scene,
    SurfaceDiscretisation,
)
from semi_analytical import SurfaceGrid, plan, solve
from semi_analytical.edge.displacement import Within
from semi_analytical.edge.kernels import PARTS
from semi_analytical.edge_correction.pressure import left_over
from semi_analytical.operator.domain import ReducedDomain
from verification.closed_forms.hertz import PointContact

CELLS = 48
WINDOW = 2.6 * A
COARSE = SurfaceGrid((16, 16), (WINDOW, WINDOW))
PRESS = {"normal_force": LOAD}


def solved(of: Scene, edge: str = "last", grid: SurfaceGrid | None = None):
    grid = grid or SurfaceGrid((CELLS, CELLS), (WINDOW, WINDOW))
    return solve(of, grid, 1e-8, plan=plan(of, edge=edge))


def frictionless(*loading, indenter=None) -> Scene:
    return scene(*loading, friction=None, indenter=indenter)


def test_the_edge_on_a_stiff_film_is_where_rings_have_it():
    film = Layer(thickness=A / 4, material=steel(young_modulus=4 * steel().young_modulus))
    body = Body(material=steel(), layers=(film,))
    coated = scene(PRESS, friction=None, indenter=RIGID_BALL, body=body)
    (rings,) = slipstick.solve(coated, "radial").steps
    (end,) = slipstick.solve(coated, discretisation=SurfaceDiscretisation(cells=(64, 64))).steps
    assert end.contact_radius == pytest.approx(rings.contact_radius, rel=1e-4)


def bumps(cells: int, *places: tuple[float, float, float, float]) -> tuple[Scene, SurfaceGrid]:
    """Paraboloids side by side: x, y and radius of each over those of the others, and its depth
    below the highest over the approach."""
    side = 6 * A
    at = (np.arange(cells) - (cells - 1) / 2) * side / cells
    X, Y = np.meshgrid(at, at, indexing="ij")
    heights = np.min(
        [
            ((X - x * A) ** 2 + (Y - y * A) ** 2) / (2 * RADIUS * r) + deep * APPROACH
            for x, y, r, deep in places
        ],
        axis=0,
    )
    indenter = HeightMap(file=heights, spacing=side / cells, material=steel())
    return frictionless(PRESS, indenter=indenter), SurfaceGrid((cells, cells), (side, side))


PATCHES = (-1.2, 0.1, 1, 0), (1.25, -0.2, 0.3, 0.45)


def test_every_patch_has_its_edge_inside_the_cells():
    """What more than twice the cells find, from which those without are 4e-3 apart."""
    ends = [solved(of, "last", grid) for of, grid in (bumps(n, *PATCHES) for n in (60, 96))]
    few, many = (end.steps[-1].contact_radius for end in ends)
    assert few == pytest.approx(many, rel=1e-4)


STEPS = (PRESS, {"normal_force": 0.5 * LOAD}, {"normal_force": 0.8 * LOAD})


def test_no_later_state_knows_of_the_correction():
    """What is not corrected is the same to the last bit, and so is each corrected state."""
    loading = tuple({**step, "increments": 2} for step in STEPS[:2])
    runs = (solved(frictionless(*loading), edge).increments for edge in ("off", "last", "all"))
    for plain, last, every in zip(*runs, strict=True):
        assert plain.residuals == last.residuals == every.residuals
        assert plain.edge_change is None is not every.edge_change
        assert (last.edge_change is None) == (last.index == 1)
        same = plain if last.index == 1 else every
        assert last.elastic_energy == same.elastic_energy
        np.testing.assert_array_equal(last.pressure, same.pressure)


ALIKE = steel(poisson_ratio=0.0)  # then all slip is along the force
EXACT = hertz(poisson_ratio=0.0)


UNLOADED = {"normal_force": 0.6 * LOAD}
X, Y = np.meshgrid(np.linspace(-2, 2, 33), np.linspace(-2, 2, 33), indexing="ij")
FRICTION = {
    "none": None,
    "even map": MU * (1 + 0.3 * np.cos(2 * X) * np.cos(Y)),
    "random map": MU * np.random.default_rng(1).uniform(0.5, 1.5, X.shape),
}


@pytest.mark.parametrize("name", FRICTION)
def test_the_pressure_of_uncoupled_bodies_does_not_depend_on_friction(name):
    """A map of friction left the edge within cells uncorrected."""
    values, push = FRICTION[name], {"tangential_force": (0.4 * LIMIT, 0.0)}
    friction = None if values is None else {"map": values, "spacing": 4 * A / 33}
    steps = (PRESS, UNLOADED) if values is None else (PRESS, push, UNLOADED)
    one, other = (
        solved(described).steps[-1]
        for described in (scene(PRESS, push, UNLOADED), scene(*steps, friction=friction))
    )
    assert one.edge_change is not None
    np.testing.assert_allclose(other.pressure, one.pressure, rtol=0, atol=1e-12 * one.peak_pressure)
    for scalar in ("approach", "contact_radius", "peak_pressure"):
        assert getattr(other, scalar) == pytest.approx(getattr(one, scalar), rel=1e-12)


@pytest.mark.parametrize("name", ["even map", "random map"])
def test_the_shear_under_a_friction_map_carries_the_force_below_its_limit(name):
    """Its border of stick is that of the cells, of which a warning tells; in gross slip none is.
    Across the push the pressure changes an uneven shear by some 1e-5 of the force."""
    friction = {"map": FRICTION[name], "spacing": 4 * A / 33}
    far = {"tangential_shift": (8 * APPROACH, 0.0)}
    for push, sticks in (({"tangential_force": (0.4 * LIMIT, 0.0)}, True), (far, False)):
        result = solved(scene(PRESS, push, friction=friction))
        end, law = result.steps[-1], result.scene.friction
        assert (end.edge_report.stick is None) == sticks
        assert any("border of stick" in told for told in warnings_of(result)) == sticks
        limit = law.on_grid(result.grid.cells, result.grid.spacing).limit(end.pressure)
        assert np.all(np.hypot(*end.shear) <= limit * (1 + 1e-12))
        carried = np.sum(end.shear[0]) * result.grid.cell_area
        assert carried == pytest.approx(end.tangential_force[0], abs=1e-6 * LIMIT)


def test_where_the_stick_border_cannot_follow_the_pressure_is_corrected_alone():
    """At a changed normal force; before, the approach jumped by 2e-4 at a constant one."""
    loading = PRESS, {"tangential_force": (0.5 * LIMIT, 0.0)}, {"normal_force": 1.2 * LOAD}
    of = scene(*loading, indenter=paraboloid(ALIKE), body=ALIKE)
    result = solved(of)
    assert [end.edge_report.stick is not None for end in result.steps] == [True, True, False]
    assert any("step 3 " in told and "stick" in told for told in warnings_of(result))
    end, exact = (
        result.steps[-1],
        PointContact.under_load(1.2 * LOAD, RADIUS, EXACT.contact_modulus),
    )
    assert end.contact_radius == pytest.approx(exact.contact_radius, rel=1e-4)
    assert end.approach == pytest.approx(exact.approach, rel=1e-5)
    assert np.all(np.hypot(*end.shear) <= MU * end.pressure * (1 + 1e-12))
    carried = np.sum(end.shear, axis=(1, 2)) * result.grid.cell_area
    np.testing.assert_allclose(carried, end.tangential_force, atol=1e-6 * LIMIT)


@pytest.mark.parametrize("far", [(9.0, 0.0), (6.0, -6.0)])
def test_gross_slip_under_a_shift_has_the_friction_limit_of_the_corrected_force(far):
    """On 16 cells the normal forces before and after the correction differ by 0.2 %.

    A prescribed force is that of the scene, with or without a stick zone."""
    held = solved(scene(PRESS, {"tangential_force": (0.9999 * LIMIT, 0.0)}), grid=COARSE).steps[-1]
    assert held.tangential_force[0] == 0.9999 * LIMIT
    controls = {"approach": APPROACH}
    loading = controls, {"tangential_shift": tuple(APPROACH * np.array(far))}
    end = solved(scene(*loading), grid=COARSE).steps[-1]
    assert end.edge_change is not None
    assert np.hypot(*end.tangential_force) == pytest.approx(MU * end.normal_force, rel=1e-6)


@pytest.mark.parametrize("mirrors", [(True, False), (False, True), (True, True)])
def test_variations_within_cells_are_mirrored_with_their_cells(mirrors):
    def placed(one):
        parts = np.zeros((*one.slopes.shape[1:], PARTS, PARTS))
        parts[one.i, one.j] = one.rest
        return parts

    rest = np.arange(3.0 * PARTS**2).reshape(3, PARTS, PARTS)
    half = Within(np.zeros((2, 4, 5)), np.array([0, 2, 3]), np.array([1, 0, 4]), rest)
    domain, expected = ReducedDomain(mirrors), placed(half)
    for axis in domain.planes:
        image = np.flip(expected, (axis, axis + 2))
        expected = np.concatenate([image, expected], axis=axis)
    np.testing.assert_array_equal(placed(half.extend_to_window(domain)), expected)


@pytest.mark.parametrize("ratio", [0.2, 0.5, 0.8])
def test_what_is_left_over_is_the_rest_of_a_geometric_series(ratio):
    changes = [7.0, *(3.0 * ratio ** np.arange(5))]
    rest = sum(3.0 * ratio ** np.arange(5, 400))
    assert changes[-1] * left_over(changes) == pytest.approx(rest)
