"""Tests of the energy balance: input work is stored or dissipated in every increment."""

from dataclasses import replace
from itertools import combinations
from math import cos, pi, sin, sqrt
from time import process_time

import contact_scenes
import coupled_scenes
import numpy as np
import pytest
from contact_scenes import (
    APPROACH,
    LIMIT,
    LOAD,
    MU,
    PRESS,
    YOUNG,
    A,
    grid,
    hertz,
    paraboloid,
    push,
    slide,
    steel,
)
from coupled_scenes import bulk, coated
from hypothesis import given, settings
from hypothesis import strategies as st

import fem_reference
import radial
from contact_results import cycles
from contact_results.cycles import fretting_cycles
from contact_results.edge_slip import CycleEdge
from contact_results.surface import Cells
from contact_scene import (
    RIGID,
    Body,
    FiniteElementDiscretisation,
    FlatPunch,
    LoadStep,
    SurfaceDiscretisation,
)
from contact_scene.quantities.cycles import load_cycles
from contact_scene.quantities.summary import ContactStatus
from contact_scene.stepping.load_path import load_path
from semi_analytical import NotConverged, history, plan, solve, solve_discretised
from semi_analytical.increments.increment import solve_increment
from verification.closed_forms.cattaneo_mindlin import CycledContact, PartialSlip
from verification.closed_forms.hertz import contact_modulus
from verification.problems import problem as paper

TOLERANCE = 1e-8
# Balance of the first law asked for; the equations are solved to the tolerance above.
CLOSES = 1e-6
GRID = grid(20, 1.6)

PARTS = st.integers(1, 20).map(lambda n: n / 20)
SHIFTS = st.integers(-40, 40).map(lambda n: n / 10)
TURNS = st.integers(-10, 10).map(lambda n: n * 1e-4)
STEPS = st.one_of(
    st.builds(lambda w: {"normal_force": w * LOAD}, PARTS),
    st.builds(lambda d: {"approach": d * APPROACH}, PARTS),
    st.builds(slide, SHIFTS, SHIFTS),
    st.builds(lambda w, s: {"normal_force": w * LOAD, **slide(s)}, PARTS, SHIFTS),
    st.builds(lambda turn: {"twist": turn}, TURNS),
    st.builds(lambda x, y: {"tilt": (x, y)}, TURNS, TURNS),
)
HISTORIES = st.lists(
    st.builds(lambda step, n: {**step, "increments": n}, STEPS, st.integers(1, 2)),
    min_size=1,
    max_size=3,
).map(lambda steps: [{**PRESS, "increments": 1}, *steps])
BODIES = {
    "alike": lambda loading: contact_scenes.scene(*loading),
    "coated": lambda loading: coupled_scenes.scene(*loading, body=coated()),
    "nu = 0": lambda loading: coupled_scenes.scene(*loading, body=bulk(0.0)),
    "indenter coupled, friction strong": lambda loading: coupled_scenes.scene(
        *loading, body=Body(material=RIGID), indenter=paraboloid(), friction=0.6
    ),
    "frictionless": lambda loading: contact_scenes.scene(
        *(without_friction(step) for step in loading), friction=None
    ),
}


def without_friction(step):
    """The same but for what needs friction; what is left then presses on."""
    kept = {key: step[key] for key in step if key not in ("tangential_shift", "twist")}
    return kept if len(kept) > 1 else {**PRESS, **kept}


def assert_first_law(increments, cell_area):
    for increment in increments:
        assert increment.energy_imbalance <= CLOSES
        assert increment.elastic_energy > 0
        if increment.shear is None:
            continue
        assert np.all(increment.dissipation_increment >= 0)
        assert np.all(increment.slip_distance >= np.hypot(*increment.slip) * (1 - 1e-12))
        lost = float(np.sum(increment.dissipation)) * cell_area
        assert lost == pytest.approx(increment.dissipated_energy, rel=1e-11, abs=1e-25)


@pytest.mark.parametrize("body", BODIES.values(), ids=BODIES)
@settings(max_examples=5)
@given(history=HISTORIES)
def test_work_is_stored_or_dissipated_over_any_history(body, history):
    result = solve(body(history), GRID, TOLERANCE)
    assert_first_law(result.increments, GRID.cell_area)


def punch(*loading):
    return coupled_scenes.scene(*loading, indenter=FlatPunch(radius=A, material=RIGID))


NAMED = {
    "unloading and reversal": contact_scenes.scene(
        PRESS, push(0.9, increments=3), push(-0.9, increments=3), push(0.0)
    ),
    "load and force together": contact_scenes.scene(
        {**PRESS, **push(0.5, 0.2), "increments": 3},
        {"normal_force": 0.3 * LOAD, **push(0.1, -0.1), "increments": 4},
    ),
    "sliding": contact_scenes.scene(PRESS, slide(20, 5), slide(-20)),
    "held in sliding": contact_scenes.scene(
        PRESS, slide(20), {"normal_force": 0.5 * LOAD, "increments": 2}, slide(20)
    ),
    "torque": contact_scenes.scene(
        PRESS, {"torque": 0.3 * LIMIT * A}, {"torque": -0.3 * LIMIT * A, **push(0.2)}
    ),
    "free to tilt": punch(
        {**PRESS, "increments": 4},
        {"moment": (0.02 * LOAD * A, 0.1 * LOAD * A), "increments": 2},
        push(0.4, increments=4),
    ),
    "no friction": coupled_scenes.scene(PRESS, slide(3), friction=0.0),
}


@pytest.mark.parametrize("scene", NAMED.values(), ids=NAMED)
def test_work_is_stored_or_dissipated(scene):
    result = solve(scene, grid(24, 1.6), TOLERANCE)
    assert_first_law(result.increments, result.grid.cell_area)


@pytest.mark.parametrize("tolerance", [1e-2, 1e-12])
def test_friction_never_gives_energy_back(tolerance):
    """Nor does what a solver leaves as residual, however much that is."""
    still = {"normal_force": LOAD, "increments": 3}
    described = contact_scenes.scene(PRESS, slide(3), still, slide(3.0), slide(2.9999999))
    for increment in solve(described, grid(48), tolerance).increments:
        assert np.all(increment.dissipation_increment >= 0)


def unresolved(*loading, **more):
    described = contact_scenes.scene(*loading, **more)
    steps = solve(described, grid(32), 1e-9).steps
    return np.diff([0.0, *(step.unresolved_work for step in steps)])


REFINED = {
    "pressing": lambda n: unresolved({**PRESS, "increments": n}, friction=None)[0],
    "unloading": lambda n: unresolved(
        PRESS, {"normal_force": 0.3 * LOAD, "increments": n}, friction=None
    )[1],
    "pushing": lambda n: unresolved(PRESS, push(0.9, increments=n))[1],
    "reversal": lambda n: unresolved(PRESS, push(0.9), push(-0.9, increments=2 * n))[2],
}


@pytest.mark.parametrize("work", REFINED.values(), ids=REFINED)
def test_what_increments_leave_open_vanishes_with_their_square(work):
    coarse, fine = work(4), work(12)
    order = np.log(coarse / fine) / np.log(3)
    assert order == pytest.approx(2.0, abs=0.2)


def test_an_increment_in_two_halves_adds_up_both(monkeypatch):
    """The halves are not reported, their work and their dissipation are."""
    loading = (PRESS, push(0.6, increments=1))
    halves = (PRESS, push(0.6, increments=2))
    expected = solve(contact_scenes.scene(*halves), GRID, TOLERANCE).increments[-1]
    refused = []

    def solve_or_refuse(model, before, normal, tangential, tolerance):
        if before is not None and not refused:
            refused.append(True)
            raise NotConverged("the shear", 1, 1.0, tolerance)
        return solve_increment(model, before, normal, tangential, tolerance)

    monkeypatch.setattr(history, "solve_increment", solve_or_refuse)
    end = solve(contact_scenes.scene(*loading), GRID, TOLERANCE).increments[-1]
    assert end.halvings == 1
    assert end.energy_imbalance <= CLOSES
    for name in ("elastic_energy", "input_work", "dissipated_energy", "unresolved_work"):
        assert getattr(end, name) == pytest.approx(getattr(expected, name), rel=1e-9)
    np.testing.assert_allclose(end.dissipation, expected.dissipation, atol=1e-9)
    np.testing.assert_array_equal(end.dissipation_increment, end.dissipation)


@pytest.mark.parametrize("law", fem_reference.Method)
@pytest.mark.parametrize("body", [coated(), bulk()], ids=["coated", "coupled half-space"])
def test_elements_and_rings_store_and_dissipate_alike(body, law):
    growing = {"normal_force": LOAD, **push(0.4), "increments": 3}
    first = {"normal_force": 0.5 * LOAD, "increments": 2}
    scene = coupled_scenes.scene(first, growing, {**push(0.6), "increments": 2}, body=body)
    one = fem_reference.solve(scene, FiniteElementDiscretisation(elements_per_radius=12), law).steps
    other = radial.solve(scene).steps
    for name in ("elastic_energy", "input_work", "dissipated_energy", "unresolved_work"):
        found, expected = ([getattr(end, name) for end in ends] for ends in (one, other))
        np.testing.assert_allclose(found, expected, atol=6e-3 * other[-1].elastic_energy)


def test_at_the_limit_under_force_control_work_and_slip_are_undefined():
    end = solve(contact_scenes.scene(PRESS, push(1.0)), GRID, TOLERANCE).increments[-1]
    assert end.status is ContactStatus.GROSS_SLIDING
    assert end.elastic_energy > 0
    undefined = "input_work unresolved_work energy_imbalance dissipated_energy dissipation "
    undefined += "dissipation_uncertainty"
    for name in (*undefined.split(), "slip_distance", "slip_increment", "dissipation_increment"):
        assert getattr(end, name) is None, name


def test_increments_add_up_to_what_they_have_led_to():
    of = contact_scenes.scene(PRESS, push(0.9), push(-0.9))
    result = solve(of, GRID, TOLERANCE, plan=plan(of, edge="off"))
    last = result.increments[-1]
    slips = [i.slip_increment for i in result.increments]
    lost = [i.dissipation_increment for i in result.increments]
    np.testing.assert_allclose(np.sum(slips, axis=0), last.slip, atol=1e-12 * APPROACH)
    np.testing.assert_allclose(np.sum(lost, axis=0), last.dissipation, rtol=1e-12)
    way = np.sum([np.hypot(*slip) for slip in slips], axis=0)
    np.testing.assert_allclose(way, last.slip_distance, atol=1e-12 * APPROACH)
    # Back and forth: the way is longer than the distance.
    assert np.max(last.slip_distance - np.hypot(*last.slip)) > 0.1 * np.max(way)
    # Friction µp over the way, as the pressure stays: wear of Archard and dissipation go together.
    expected = MU * last.pressure * last.slip_distance
    np.testing.assert_allclose(last.dissipation, expected, atol=1e-6 * np.max(expected))


@pytest.mark.parametrize("then", [{}, {"normal_force": 0.4 * LOAD}], ids=["loaded", "unloaded"])
def test_what_finite_increments_leave_uncertain_covers_what_they_miss(then):
    def end(count):
        steps = coupled_scenes.press(increments=count), {**then, "increments": count}
        described = coupled_scenes.scene(*steps[: 1 + bool(then)], body=bulk(), friction=0.3)
        return solve(described, grid(24), 1e-7).increments[-1]

    few, many = end(6), end(32)
    missed = abs(few.dissipated_energy - many.dissipated_energy)
    assert 0.05 * few.dissipation_uncertainty < missed < few.dissipation_uncertainty
    assert many.dissipation_uncertainty < 0.3 * few.dissipation_uncertainty


# ---- Load cycles: where they close, and what they do to the surface.


LOOP = (PRESS, push(0.9, increments=4), push(-0.9, increments=8), push(0.9, increments=8))
CIRCLE = [push(0.5 * cos(k * pi / 2), 0.5 * sin(k * pi / 2)) for k in range(9)]

CYCLES = {
    "there and back": (LOOP, [(2, 4)]),
    "to nothing and back": ((PRESS, push(0.9), push(0.0)), [(1, 3)]),
    "holding is no cycle": ((PRESS, push(0.9), push(0.9), push(-0.9), push(0.9)), [(3, 5)]),
    "every turn closes one": (
        (PRESS, *(push(x) for x in (0.9, -0.9, 0.9, -0.9, 0.9))),
        [(2, 4), (3, 5), (4, 6)],
    ),
    "on a circle, with round-off": ((PRESS, *CIRCLE), [(k, k + 4) for k in range(2, 7)]),
    "of the load": ((PRESS, {"normal_force": 0.5 * LOAD}, PRESS), [(1, 3)]),
    "both together": (({**PRESS, **push(0.5)}, {**PRESS, **push(0.1)}, PRESS, push(0.5)), [(1, 4)]),
    "a shift is not a force": ((PRESS, push(0.5), slide(1), push(0.5)), [(2, 4)]),
    "of the torque": ((PRESS, {"torque": 1.0}, {"torque": -1.0}, {"torque": 1.0}), [(2, 4)]),
    "not the twist": ((PRESS, push(0.5), {"twist": 1e-3}, push(0.0), push(0.5)), [(3, 5)]),
    "never back": ((PRESS, push(0.1), push(0.2), push(0.3)), []),
}


@pytest.mark.parametrize(("loading", "expected"), CYCLES.values(), ids=CYCLES)
def test_a_cycle_closes_where_all_loads_return(loading, expected):
    found = load_cycles(load_path([LoadStep(**step) for step in loading]))
    assert [(cycle.start, cycle.end) for cycle in found] == expected


NU_ZERO = contact_scenes.steel(0.0, 2 * paper.CONTACT_MODULUS)


def loop(cells, *loading, window=1.1):
    """The ball with ν = 0, where the closed form holds."""
    described = contact_scenes.scene(*(loading or LOOP), indenter=paraboloid(NU_ZERO), body=NU_ZERO)
    return solve(described, grid(cells, window), TOLERANCE)


def test_cycles_are_computed_once_for_a_result_and_released_with_it():
    result = loop(16, PRESS, push(0.5), push(-0.5), push(0.5))
    assert fretting_cycles(result) is fretting_cycles(result)
    assert fretting_cycles(replace(result)) is not fretting_cycles(result)
    kept = len(cycles._KEPT)
    del result
    assert len(cycles._KEPT) < kept


def test_slip_amplitude_is_half_the_largest_distance_of_two_slips():
    result = loop(16, PRESS, push(0.8, 0.1), push(-0.8, increments=4), push(0.8, 0.1, increments=4))
    (found,) = fretting_cycles(result)
    slips = [i.slip for i in result.increments if i is result.steps[1] or i.step in (3, 4)]
    assert len(slips) == 9
    largest = np.max([np.hypot(*(a - b)) for a, b in combinations(slips, 2)], axis=0)
    np.testing.assert_allclose(found.slip_amplitude, largest / 2, rtol=1e-13)


@pytest.mark.parametrize(("part", "cells"), [(0.4, 51), (0.7, 51), (0.9, 36)])
def test_the_largest_slip_lies_at_the_edge_within_a_cell(part, cells):
    """In closed form for ν = 0; the largest value of the cells is up to 7 % off, F2 by 20 %."""
    contact, loose = hertz(poisson_ratio=0.0), steel(0.0)
    a, to = contact.contact_radius, part * MU * LOAD
    end = PartialSlip(LOAD, a, MU, contact_modulus((YOUNG, 0.0), (YOUNG, 0.0)), to)
    cycled = CycledContact(end, contact.peak_pressure)
    exact = cycled.slip_amplitude(a)
    loop = [PRESS, push(part), push(-part), push(part)]
    posed = contact_scenes.scene(*loop, indenter=paraboloid(loose), body=loose)
    asked = SurfaceDiscretisation(cells=(cells, cells), window=(2.7 * a, 2.7 * a))
    (found,) = fretting_cycles(solve_discretised(posed, asked))
    assert abs(found.largest_slip / exact - 1) < 0.5 * abs(np.max(found.slip_amplitude) / exact - 1)

    assert found.ruiz_f2 is not None
    assert found.largest_f2 is not None
    off, of_cells = found.largest_f2 - cycled.largest_f2, np.max(found.ruiz_f2) - cycled.largest_f2
    assert abs(off) < 0.6 * abs(of_cells)


def test_the_largest_slip_below_a_rim_is_that_of_the_cells():
    """There the pressure does not fall towards the edge."""
    x = np.linspace(-1.5, 1.5, 40)
    r = np.hypot(x[:, None], x)
    pressure = np.where(r < 1, 1 / np.sqrt(np.maximum(1 - r**2, 0.01)), 0.0)
    slip = np.where(r < 1, r**2, 0.0)
    edge = CycleEdge(Cells(x, x, 1.0), True, pressure, slip, pressure, None)
    assert edge.largest_amplitude() == np.max(slip)


@pytest.mark.parametrize("width", [0.0, 0.05, 0.3, 1.0])
def test_slip_amplitude_keeps_its_bound_in_linear_time(width):
    """On lines in all directions, exactly; on ellipses and random paths within the bound."""
    angle, turn = np.linspace(0, 2 * pi, 64), np.linspace(0, pi, 50)
    along, across = np.cos(angle)[:, None], width * np.sin(angle)[:, None]
    path = np.stack(
        [
            along * np.cos(turn) - across * np.sin(turn),
            along * np.sin(turn) + across * np.cos(turn),
        ],
        axis=1,
    )
    path += 0.3 * width * np.random.default_rng(7).normal(size=path.shape)
    exact = np.max([np.hypot(*(a - b)) for a, b in combinations(path, 2)], axis=0) / 2
    ratio = cycles._slip_amplitude(lambda: iter(path)) / exact
    assert np.all(ratio <= 1 + 1e-12)
    assert np.all(ratio >= (cos(pi / 2 / cycles.DIRECTIONS) if width else 1 - 1e-12))
    seconds = []
    for times in (8, 64):
        long = np.concatenate([path] * times)
        begin = process_time()
        cycles._slip_amplitude(lambda long=long: iter(long))
        seconds.append(process_time() - begin)
    assert seconds[1] < 20 * seconds[0]  # 64 times as long if every pair is compared


def test_the_tension_of_a_loop_is_that_along_its_force():
    oblique = [push(x * sqrt(0.5), x * sqrt(0.5), increments=8) for x in (0.9, -0.9, 0.9)]
    found = [fretting_cycles(loop(32, *loading))[0] for loading in (LOOP, (PRESS, *oblique))]
    along_x, along_diagonal = (np.max(cycle.surface_tension) for cycle in found)
    assert along_diagonal == pytest.approx(along_x, rel=0.02)
    for cycle in found:
        pulled = cycle.surface_tension > 0
        assert np.array_equal(cycle.ruiz_f2 > 0, pulled & (cycle.ruiz_f1 > 0))


@pytest.mark.parametrize(
    "loading",
    [
        (PRESS, {"normal_force": 0.5 * LOAD}, PRESS),
        (PRESS, *({"torque": x * LIMIT * A} for x in (0.2, -0.2, 0.2))),
        # The force is then a sum of shear, with its round-off.
        ({**PRESS, **slide(0)}, *({"twist": x * 1e-3} for x in (1, -1, 1))),
    ],
    ids=["load", "torque", "twist without a shift"],
)
def test_without_a_change_of_force_tension_has_no_direction(loading):
    described = coupled_scenes.scene(*({**step, "increments": 2} for step in loading))
    cycles = fretting_cycles(solve(described, grid(24), TOLERANCE))
    assert cycles
    for cycle in cycles:
        assert cycle.surface_tension is None
        assert cycle.ruiz_f2 is None
        assert np.max(cycle.ruiz_f1) > 0
