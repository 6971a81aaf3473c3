"""Tests of single increments: effects that are off are not computed, and growth without slip."""

from dataclasses import replace
from typing import Any

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
    RIGID_BALL,
    A,
    grid,
    hertz,
    push,
    scene,
    steel,
)

import slipstick
from contact_scene import (
    Cone,
    Ellipsoid,
    FiniteElementDiscretisation,
    HeightMap,
    RadialDiscretisation,
    SurfaceDiscretisation,
)
from contact_scene.rig import Rig
from contact_scene.stepping.increment_error import has_increment_error
from semi_analytical import SurfaceGrid, plan, solve
from semi_analytical.increments.increment_history import (
    PreviousIncrement,
    further,
    further_shear,
)
from semi_analytical.increments.normal_target import NormalTarget
from semi_analytical.increments.tangential_solve import TangentialTarget
from semi_analytical.operator.operator import DisplacementOperator

TOLERANCE = 1e-8
PRODUCTS = "normal", "tangential", "normal_by_shear", "tangential_by_pressure", "together"


@pytest.fixture
def calls(monkeypatch):
    """Names of the products, in the order in which they are called."""
    made = []

    def spy(name):
        plain = getattr(DisplacementOperator, name)

        def counted(self, field):
            made.append(name)
            return plain(self, field)

        monkeypatch.setattr(DisplacementOperator, name, counted)

    for name in PRODUCTS:
        spy(name)
    return made


@pytest.mark.parametrize(
    ("loading", "more"),
    [
        ((PRESS,), {"friction": None}),
        ((PRESS,), {"friction": None, "indenter": RIGID_BALL}),
        ((PRESS, {"normal_force": 0.5 * LOAD}), {}),
        ((PRESS, push(0)), {}),
    ],
    ids=["frictionless", "frictionless and dissimilar", "only pressed", "no push"],
)
def test_without_a_push_shear_costs_nothing(loading, more, calls):
    for increment in solve(scene(*loading, **more), grid(), TOLERANCE).increments:
        assert increment.shear is None
        assert increment.slip is None
        assert increment.in_stick is None
        assert increment.dissipated_energy is None
        assert increment.residuals.slip_direction is None
    assert set(calls) == {"normal"}


def test_shear_costs_nothing_until_the_first_push(calls):
    seen = []
    solve(scene(PRESS, push(0.5)), grid(), TOLERANCE, lambda _: seen.append(set(calls)))
    assert seen[0] == {"normal"}


def test_pressure_is_not_solved_again_where_the_normal_load_is_held(calls):
    def after(increment):
        if increment.step == 1:
            calls.clear()

    solve(scene(PRESS, push(0.5), push(-0.5)), grid(), TOLERANCE, after)
    assert set(calls) == {"tangential"}


def test_convolutions_count_what_was_convolved(calls):
    result = solve(scene(PRESS, push(0.5)), grid(), TOLERANCE)
    for increment, kind, price in [
        (result.increments[0], "normal", 1),
        (result.increments[1], "tangential", 2),
    ]:
        assert increment.convolutions == price * calls.count(kind)


def test_areas_within_a_load_step_change_nothing_at_its_end():
    described = scene(PRESS, push(0.7, increments=3), push(-0.7, increments=3))
    whole, last = (
        solve(described, grid(), TOLERANCE, plan=replace(plan(described), areas=areas))
        for areas in ("all", "last")
    )
    for one, other in zip(whole.increments, last.increments, strict=True):
        ends = one.index == one.increments_in_step
        assert (one.stick_area == other.stick_area) is ends
        assert other.stick_area <= other.contact_area
        np.testing.assert_array_equal(one.slip, other.slip)


# ---- The surface grid.


def test_centres_are_symmetric_and_fill_the_window():
    grid = SurfaceGrid((7, 4), (1.4, 2.0))
    np.testing.assert_array_equal(grid.x, -grid.x[::-1])
    assert grid.x[-1] + grid.spacing[0] / 2 == pytest.approx(0.7)
    assert grid.y[-1] + grid.spacing[1] / 2 == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("cells", "window"),
    [((1, 8), (1.0, 1.0)), ((8, 8), (0.0, 1.0)), ((8, 8), (1.0, np.nan)), ((8, 8), (1.0, np.inf))],
)
def test_impossible_grid_is_refused(cells, window):
    with pytest.raises(ValueError, match=r"use (at least 2|two positive)"):
        SurfaceGrid(cells, window)


# ---- The path so far: how far the next increment goes on, and what that spares the shear so


NOTHING = np.zeros((2, 1, 1))
FIRST = PreviousIncrement(
    target=NormalTarget(force=1.0),
    pressure=NOTHING[0],
    shear=NOTHING + 1,
    displacement=NOTHING + 10,
    normal_force=1.0,
    approach=1.0,
    force=np.array([0.1, 0.2]),
    shift=np.array([1.0, 2.0]),
    torque=1e-3,
    twist=1e-6,
)
SECOND = replace(
    FIRST,
    shear=NOTHING + 3,
    displacement=NOTHING + 50,
    force=np.array([0.3, 0.5]),
    shift=np.array([3.0, 5.0]),
    torque=2e-3,
    twist=3e-6,
)
WAY = np.array([0.2, 0.3])


@pytest.mark.parametrize("part", [0.01, 0.5, 1.0, 2.0])
def test_where_the_load_goes_straight_on_the_shear_goes_as_much_further(part):
    for target in (
        TangentialTarget(force=SECOND.force + part * WAY),
        TangentialTarget(shift=SECOND.shift + 10 * part * WAY),
        TangentialTarget(force=SECOND.force + part * WAY, torque=2e-3 + part * 1e-3),
        TangentialTarget(shift=SECOND.shift + 10 * part * WAY, twist=3e-6 + part * 2e-6),
    ):
        assert further(SECOND, FIRST, target) == pytest.approx(part, rel=1e-12)
        (shear, displacement), motion = further_shear(SECOND, FIRST, target)
        twist = [3e-6 + part * 2e-6] if target.torque else []
        np.testing.assert_allclose(motion, [3 + part * 2, 5 + part * 3, *twist])
        np.testing.assert_allclose(shear, 3 + 2 * part)
        np.testing.assert_allclose(displacement, 50 + 40 * part)


@pytest.mark.parametrize("way", [-WAY, 2.1 * WAY, 0 * WAY, WAY @ [[1, 0.01], [0, 1]]])
def test_where_the_load_turns_rests_or_leaps_the_shear_stays(way):
    target = TangentialTarget(force=SECOND.force + way)
    assert further(SECOND, FIRST, target) == 0
    straight = TangentialTarget(force=SECOND.force + WAY, torque=2e-3 + 2e-3 * way[0] / WAY[0])
    assert further(SECOND, FIRST, straight) == 0
    shear, displacement = further_shear(SECOND, FIRST, target)[0]
    assert (shear, displacement) == (SECOND.shear, SECOND.displacement)


def products(described, cells):
    """Of two convolutions each, in every increment but the first, which presses."""
    increments = solve(described, grid(cells), TOLERANCE).increments
    assert all(increment.halvings == 0 for increment in increments)
    return np.array([0.5 * increment.convolutions for increment in increments[1:]])


def test_a_loop_takes_few_products_on_any_cells():
    """Nested grids, the inverse on stick and the diagonal on slip took 41 and 80."""
    loop = scene(PRESS, push(0.9, increments=9), push(-0.9, increments=18))
    few, many = (np.mean(products(loop, cells)) for cells in (32, 128))
    assert few < 17
    assert many < 1.3**2 * few


# ---- Normal and tangential load that grow together.

# The discretisation, and its error of the shift over that of gross slip.
SOLVERS: dict[str, tuple[Any, float]] = {
    "semi-analytical": (SurfaceDiscretisation(cells=(64, 64)), 1e-4),
    "radial": (RadialDiscretisation(), 1e-5),
    "fem": (FiniteElementDiscretisation(elements_per_radius=16), 2e-3),
    "fem-complementarity": (FiniteElementDiscretisation(elements_per_radius=16), 1e-3),
}
# Shift over the part T/W of the approach of equal bodies (Mindlin 1949).
SOFTER = (2 - NU) / (2 * (1 - NU))
# Loads that grow together from nothing to T = 2/3 µW, then at another rate, without slip.
RATE = 2 / 3 * MU
TWICE = hertz(2 * LOAD).approach
BACK = -0.5 * MU
TOGETHER = {
    "by force": (
        {**PRESS, **push(2 / 3)},
        {"normal_force": 2 * LOAD, "tangential_force": ((RATE + BACK) * LOAD, 0.0)},
    ),
    "by motion": (
        {"approach": APPROACH, "tangential_shift": (RATE * SOFTER * APPROACH, 0.0)},
        {
            "approach": TWICE,
            "tangential_shift": (SOFTER * (RATE * APPROACH + BACK * (TWICE - APPROACH)), 0.0),
        },
    ),
}


@pytest.mark.parametrize("led", TOGETHER)
@pytest.mark.parametrize("solver", SOLVERS)
def test_loads_that_grow_together_take_one_increment(solver, led):
    """Nothing slips below µ: q = (T/W) p from nothing, and k Δp is added later (Jaeger 1998)."""
    mesh, error = SOLVERS[solver]
    described = scene(*TOGETHER[led])
    assert not any(has_increment_error(described))
    first, second = slipstick.solve(described, solver, mesh).increments
    shifts = RATE * APPROACH, RATE * APPROACH + BACK * (TWICE - APPROACH)
    for end, shift, carried, load in (
        (first, shifts[0], RATE, LOAD),
        (second, shifts[1], (RATE + BACK) / 2, 2 * LOAD),
    ):
        assert end.status == "full stick"
        scale = SOFTER * MU * end.approach
        assert end.tangential_shift[0] == pytest.approx(SOFTER * shift, abs=error * scale)
        limit = MU * end.normal_force
        assert end.tangential_force[0] == pytest.approx(
            carried * end.normal_force, abs=2 * error * limit
        )
        assert end.stick_radius == pytest.approx(hertz(load).contact_radius, rel=2e-3)
        assert end.stick_radius == pytest.approx(end.contact_radius, rel=1e-4)
        assert end.dissipated_energy == pytest.approx(0.0, abs=1e-12 * LOAD * APPROACH)
        assert end.dissipation_uncertainty == pytest.approx(0.0, abs=1e-12 * LOAD * APPROACH)


@pytest.mark.parametrize("solver", SOLVERS)
def test_growth_without_slip_is_followed_by_slip_from_the_edge(solver):
    """After T = k W from nothing a push slips as if to (T - kW)/(µ - k) at the friction µ - k.

    q = µp - (µ - k) p(W*) with W* = (µW - T)/(µ - k) (Jaeger 1998).
    """
    mesh, error = SOLVERS[solver]
    end = slipstick.solve(scene({**PRESS, **push(0.5)}, push(0.8)), solver, mesh).increments[-1]
    inner = hertz((1 - 0.8) / (1 - 0.5) * LOAD)
    shift = SOFTER * (MU * APPROACH - 0.5 * MU * inner.approach)
    # Along one line, the law for ν > 0 is 1e-3 from that of Cattaneo and Mindlin.
    assert end.tangential_shift[0] == pytest.approx(shift, rel=2e-3 + error)
    assert end.stick_radius == pytest.approx(inner.contact_radius, rel=0.03)


@pytest.mark.parametrize("solver", SOLVERS)
def test_loads_that_grow_by_more_than_friction_take_many(solver):
    from_nothing = scene(
        {"approach": APPROACH, "tangential_shift": (1.1 * MU * SOFTER * APPROACH, 0)}
    )
    later = scene(PRESS, {"normal_force": 2 * LOAD, "tangential_force": (1.1 * LIMIT, 0.0)})
    for described in (from_nothing, later):
        assert slipstick.plan(described, solver).increments[-1] > 1
        assert has_increment_error(described)[-1]


BUMPS = np.minimum(
    *(
        (np.add.outer((np.linspace(-2, 2, 65) * A - x) ** 2, np.linspace(-2, 2, 65) ** 2 * A**2))
        / 2
        / RADIUS
        for x in (-0.8 * A, 0.9 * A)
    )
)
GROWING = {
    "cone": ({"indenter": Cone(slope_angle=0.02, material=steel())}, None, True),
    "ellipse, obliquely": (
        {"indenter": Ellipsoid(radii=(RADIUS, RADIUS / 3), material=steel())},
        None,
        True,
    ),
    "springs": ({}, Rig(tangential_stiffness=3e8, normal_stiffness=5e8), True),
    "any shape without Poisson's ratio": (
        {
            "indenter": HeightMap(file=BUMPS, spacing=A / 16, material=steel(0.0)),
            "body": steel(0.0),
        },
        None,
        True,
    ),
    "any shape": (
        {"indenter": HeightMap(file=BUMPS, spacing=A / 16, material=steel())},
        None,
        False,
    ),
}


@pytest.mark.parametrize("name", GROWING)
def test_other_contacts_grow_without_slip(name):
    """One increment and eight agree where one is planned: to the error of the cells."""
    parts, rig, exact = GROWING[name]
    described = scene(
        {**PRESS, **push(0.5, 0.3)}, {"normal_force": 1.5 * LOAD, **push(0.3, 0.6)}, **parts
    )
    described = described.model_copy(update={"rig": rig})
    counts = plan(described).increments
    assert counts == (1, 1) if exact else min(counts) > 8
    one, many = (
        slipstick.solve(
            described.with_increments([n, n]),
            "semi-analytical",
            SurfaceDiscretisation(cells=(32, 32)),
        )
        for n in (1, 8)
    )
    for few, more in zip(one.steps, many.steps, strict=True):
        close = 1e-4 if exact else 2e-2
        assert few.tangential_shift == pytest.approx(more.tangential_shift, rel=close)
        scale = MU * few.peak_pressure
        assert np.mean(np.abs(few.shear - more.shear)) < 5 * close * scale
        assert few.energy_imbalance < 1e-8
