"""Tests of symmetries and scaling laws of the semi-analytical solver, without reference
solutions."""

import numpy as np
import pytest
from contact_scenes import (
    APPROACH,
    LIMIT,
    LOAD,
    MU,
    NU,
    PRESS,
    RADIUS,
    YOUNG,
    A,
    grid,
    push,
    scene,
    steel,
)

from contact_scene import (
    Body,
    CoulombFriction,
    Ellipsoid,
    IsotropicMaterial,
    LoadStep,
    Paraboloid,
    Scene,
    SurfaceDiscretisation,
)
from semi_analytical import (
    ContactAtWindowEdge,
    ContactNotResolved,
    NotConverged,
    ResourceRefused,
    SurfaceGrid,
    UnsupportedScene,
    plan,
    solve,
    solve_discretised,
)
from semi_analytical.increments import stick_slip

TOLERANCE = 1e-9
# Solutions agree to the tolerance, not to round-off, where the arithmetic takes another path.
SAME = 1e-6
RADII = (RADIUS, 2 * RADIUS)


def loop(rotate=lambda x, y: (x, y)):
    """A history whose direction turns."""
    return (
        PRESS,
        *({"tangential_force": rotate(x * LIMIT, y * LIMIT)} for x, y in [(0.7, 0), (-0.6, 0)]),
        {"tangential_force": rotate(0.2 * LIMIT, 0.4 * LIMIT), "increments": 3},
    )


def solved(loading, radii=RADII, cells=(32, 28), window=(3.3 * A, 4.0 * A)):
    ellipsoid = Ellipsoid(radii=radii, material=steel())
    return solve(scene(*loading, indenter=ellipsoid), SurfaceGrid(cells, window), TOLERANCE)


def assert_close(field, expected):
    np.testing.assert_allclose(field, expected, rtol=0, atol=SAME * np.max(np.abs(expected)))


def scaled(length, stress):
    """The same problem with lengths and moduli in other proportions."""
    force = stress * length**2
    material = IsotropicMaterial(young_modulus=YOUNG * stress, poisson_ratio=NU)
    loading = [
        {"normal_force": LOAD * force},
        {"tangential_force": (0.8 * LIMIT * force, 0.0)},
        {"tangential_force": (-0.4 * LIMIT * force, 0.0)},
    ]
    problem = Scene(
        indenter=Paraboloid(radius=RADIUS * length, material=material),
        body=Body(material=material),
        friction=CoulombFriction(coefficient=MU),
        loading=[LoadStep(**step) for step in loading],
    )
    return solve(problem, grid(32, radius=A * length), TOLERANCE).steps


@pytest.mark.parametrize("length", [1e-6, 1e3])
@pytest.mark.parametrize("stress", [1e-9, 1.0, 1e6])
def test_result_is_unit_neutral(length, stress):
    plain, other = scaled(1.0, 1.0), scaled(length, stress)
    assert len(plain) == 3
    # Round-off only: iterations stop at the same place, so the paths are the same.
    for one, two in zip(plain, other, strict=True):
        unit = stress * length**2
        assert two.approach == pytest.approx(length * one.approach, rel=1e-10)
        assert two.contact_area == pytest.approx(length**2 * one.contact_area, rel=1e-10)
        assert two.peak_pressure == pytest.approx(stress * one.peak_pressure, rel=1e-10)
        assert two.stick_area == pytest.approx(length**2 * one.stick_area, rel=1e-9)
        assert two.dissipated_energy == pytest.approx(
            unit * length * one.dissipated_energy, rel=1e-9
        )
        assert two.iterations == one.iterations


def test_the_same_run_twice_gives_the_same_bits():
    for one, other in zip(solved(loop()).increments, solved(loop()).increments, strict=True):
        for name in ("pressure", "shear", "slip", "gap"):
            np.testing.assert_array_equal(getattr(one, name), getattr(other, name))
        assert one.iterations == other.iterations


def test_answer_does_not_depend_on_the_window():
    """There is no periodicity: cells of the same size far outside the contact change nothing."""
    spacing = 3 * A / 32
    of = scene(PRESS, push(0.8), push(-0.3))
    on_cells = plan(of, edge="off")  # the correction of edges ends with a round, not a residual
    runs = [
        solve(of, SurfaceGrid((n, m), (n * spacing, m * spacing)), TOLERANCE, plan=on_cells).steps[
            -1
        ]
        for n, m in [(24, 24), (32, 40), (64, 64)]
    ]
    assert len(runs) == 3
    for run in runs[1:]:
        assert run.approach == pytest.approx(runs[0].approach, rel=1e-8)
        assert run.dissipated_energy == pytest.approx(runs[0].dissipated_energy, rel=SAME)
        nx, ny = run.pressure.shape
        middle = (slice(nx // 2 - 12, nx // 2 + 12), slice(ny // 2 - 12, ny // 2 + 12))
        assert_close(run.pressure[middle], runs[0].pressure)
        assert_close(run.shear[(..., *middle)], runs[0].shear)


@pytest.mark.parametrize("factor", [2.0, 1e-3, 10.0])
def test_friction_and_force_in_proportion_leave_the_stick_zone(factor):
    plain = solve(scene(PRESS, push(0.7)), grid(), TOLERANCE).steps[-1]
    more = solve(scene(PRESS, push(0.7 * factor), friction=MU * factor), grid(), TOLERANCE)
    assert_close(more.steps[-1].shear, factor * plain.shear)
    assert more.steps[-1].stick_area == pytest.approx(plain.stick_area, rel=SAME)


# ---- What the solver refuses, it refuses by name, with what to do, and without a half answer.


LOOSE = 1e-8


def test_contact_at_the_edge_of_the_window_is_refused():
    with pytest.raises(ContactAtWindowEdge, match=r"step 1.*larger window"):
        solve(scene(PRESS), grid(contacts=0.9), LOOSE)


def test_contact_that_grows_to_the_edge_names_the_step_and_keeps_the_state_before():
    with pytest.raises(ContactAtWindowEdge, match="step 2") as caught:
        solve(scene(PRESS, {"normal_force": 1e5}), grid(), LOOSE)
    assert caught.value.last_state.normal_force == pytest.approx(1e3)


@pytest.mark.parametrize("cells", [31, 32])
def test_contact_between_the_cell_centres_is_refused(cells):
    tiny = {"approach": 1e-7 * APPROACH}
    on = grid(cells)
    asked = SurfaceDiscretisation(cells=on.cells, window=on.window)
    touched = r"1 of them carry" if cells % 2 else r"no cell .* contact"  # a centre is at the tip
    with pytest.raises(ContactNotResolved, match=touched):
        solve_discretised(scene(tiny, friction=None), asked)


def test_a_friction_map_that_ends_within_the_window_is_refused():
    friction = {"map": np.full((8, 9), 0.1), "spacing": (2.9 * A / 8, 4 * A / 9)}
    with pytest.raises(UnsupportedScene, match=r"friction.*\|x\|.*at most"):
        solve(scene(PRESS, push(0.5), friction=friction), grid(), LOOSE)


class Unseen(Paraboloid):
    """Its gap is never asked for."""

    def initial_gap(self, x, y):
        pytest.fail("memory is taken")


def test_more_memory_than_there_is_is_refused_before_any_is_taken():
    enormous = SurfaceGrid((2**20, 2**20), (3 * A, 3 * A))
    with pytest.raises(ResourceRefused, match=r"GiB.*fewer cells"):
        solve(scene(PRESS), enormous, LOOSE)
    ball = Unseen(radius=RADIUS, material=steel())
    asked = SurfaceDiscretisation(cells=(16384, 16384), window=(3 * A, 3 * A))
    long = scene({**PRESS, "increments": 50}, push(0.5, increments=50), indenter=ball)
    with pytest.raises(ResourceRefused, match=r"GiB.*fewer cells"):
        solve_discretised(long, asked)


def test_not_converged_says_where_and_carries_the_last_good_state(monkeypatch):
    def fail(*_, **__):
        raise NotConverged("the shear", 7, 1e-3, LOOSE)

    seen = []
    monkeypatch.setattr(stick_slip, "shear", fail)
    with pytest.raises(NotConverged, match=r"step 2, increment 1 of 2.*1\.00e-03.*7") as caught:
        solve(scene(PRESS, push(0.5, increments=2)), grid(), LOOSE, seen.append)
    error = caught.value
    assert (error.iterations, error.residual, error.tolerance) == (7, 1e-3, LOOSE)
    np.testing.assert_array_equal(error.last_state.pressure, seen[-1].pressure)
