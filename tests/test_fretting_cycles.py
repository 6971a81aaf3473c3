"""Load cycles: where they close, and what they do to the surface."""

import json
from itertools import combinations
from math import cos, pi, sin

import contact_scenes
import coupled_scenes
import h5py
import numpy as np
import pytest
from contact_scenes import LIMIT, LOAD, MU, PRESS, A, grid, paraboloid, push, slide

from contact_results.cycles import NEAR_AT_HAND, _half_diameter, fretting_cycles
from contact_results.result_files import write_result
from contact_scene import RIGID, Body, LoadStep
from contact_scene.cycles import load_cycles
from contact_scene.load_path import load_path
from semi_analytical import SurfaceGrid, solve
from verification.closed_forms.cattaneo_mindlin import PartialSlip
from verification.closed_forms.moduli import tangential_modulus
from verification.closed_forms.ruiz import CycledContact
from verification.problems import paper_scene as paper

TOLERANCE = 1e-8
LOOP = (PRESS, push(0.9, increments=4), push(-0.9, increments=8), push(0.9, increments=8))
CIRCLE = [push(0.5 * cos(k * pi / 2), 0.5 * sin(k * pi / 2)) for k in range(9)]

HISTORIES = {
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


@pytest.mark.parametrize(("loading", "expected"), HISTORIES.values(), ids=HISTORIES)
def test_a_cycle_closes_where_all_loads_return(loading, expected):
    found = load_cycles(load_path([LoadStep(**step) for step in loading]))
    assert [(cycle.start, cycle.end) for cycle in found] == expected


def test_a_range_is_the_largest_distance_of_two_points():
    """Of more sets of points than are told at once, too."""
    sets = NEAR_AT_HAND // 14 + 50
    paths = np.random.default_rng(1).standard_normal((7, 2, sets))
    expected = [
        max(np.hypot(*(one - other)) for one, other in combinations(paths[..., k], 2))
        for k in range(sets)
    ]
    np.testing.assert_allclose(_half_diameter(paths), 0.5 * np.array(expected), rtol=1e-14)


NU_ZERO = contact_scenes.steel(0.0, 2 * paper.CONTACT_MODULUS)


def loop(cells, *loading, window=1.1):
    """The ball with ν = 0, where the closed form holds."""
    described = contact_scenes.scene(*(loading or LOOP), indenter=paraboloid(NU_ZERO), body=NU_ZERO)
    return solve(described, grid(cells, window), TOLERANCE)


@pytest.fixture(scope="module")
def fine():
    return loop(128)


def exact():
    constants = (NU_ZERO.young_modulus, NU_ZERO.poisson_ratio)
    modulus = tangential_modulus(constants, constants)
    return CycledContact(PartialSlip(LOAD, A, MU, modulus, 0.9 * LIMIT), paper.HERTZ.peak_pressure)


def test_slip_amplitude_is_that_of_mindlin_and_deresiewicz(fine):
    (cycle,) = fretting_cycles(fine)
    r = np.hypot(*fine.grid.coordinates())
    expected = np.where(r < A, exact().slip_amplitude(np.minimum(r, A)), 0.0)
    largest = exact().slip_amplitude(A)
    error = np.abs(cycle.slip_amplitude - expected)[r < A]
    assert np.max(error) <= 1e-3 * largest
    # The largest cell is one of those that the edge runs through.
    assert np.max(cycle.slip_amplitude) == pytest.approx(largest, rel=1e-2)
    assert not np.any(cycle.slip_amplitude[r > 1.03 * A])


def test_the_energy_of_a_cycle_is_four_times_its_ruiz_work(fine):
    """Constant µp over twice the whole range: 4 τ δ per area."""
    (cycle,) = fretting_cycles(fine)
    np.testing.assert_allclose(
        cycle.dissipation, 4 * cycle.ruiz_f1, atol=1e-6 * np.max(cycle.dissipation)
    )
    total = float(np.sum(cycle.dissipation)) * fine.grid.cell_area
    assert cycle.dissipated_energy == pytest.approx(total, rel=1e-10)
    assert total == pytest.approx(4 * exact().end.dissipated_energy, rel=1e-4)


def test_parameters_scale_with_length_and_modulus():
    length, modulus = 1e-3, 1e2
    one = loop(20, PRESS, push(0.8), push(-0.8), push(0.8))
    force = modulus * length**2
    loads = [
        {"normal_force": force * LOAD, "tangential_force": (force * x * LIMIT, 0.0)}
        for x in (0.0, 0.8, -0.8, 0.8)
    ]
    stiff = contact_scenes.steel(0.0, modulus * NU_ZERO.young_modulus)
    ball = paraboloid(stiff).model_copy(update={"radius": length * contact_scenes.RADIUS})
    small = SurfaceGrid(one.grid.cells, tuple(length * side for side in one.grid.window))
    other = solve(contact_scenes.scene(*loads, indenter=ball, body=stiff), small, TOLERANCE)
    (cycle,), (scaled,) = (fretting_cycles(result) for result in (one, other))
    for name, factor in (
        ("slip_amplitude", length),
        ("ruiz_f1", modulus * length),
        ("ruiz_f2", modulus**2 * length),
    ):
        expected = factor * np.max(getattr(cycle, name))
        assert np.max(getattr(scaled, name)) == pytest.approx(expected, rel=1e-5), name


def test_a_rigid_body_leaves_the_tension_to_the_indenter():
    """Both surfaces of like bodies carry the same; opposite shear, the other edge trails."""
    soft = coupled_scenes.SUBSTRATE
    loading = [{**step, "increments": 3} for step in (PRESS, push(0.8), push(-0.8), push(0.8))]
    lower = coupled_scenes.scene(*loading, body=Body(material=soft))
    upper = coupled_scenes.scene(*loading, body=Body(material=RIGID), indenter=paraboloid(soft))
    one, other = (
        fretting_cycles(solve(described, grid(24), TOLERANCE))[0] for described in (lower, upper)
    )
    assert np.max(other.surface_tension) == pytest.approx(np.max(one.surface_tension), rel=1e-3)
    assert np.max(other.ruiz_f2) == pytest.approx(np.max(one.ruiz_f2), rel=1e-2)


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


def test_cycles_reach_all_files(tmp_path, undrawn):
    result = loop(16, PRESS, push(0.8), push(-0.8), push(0.8), push(-0.8))
    write_result(result, tmp_path, figures="all")
    last = fretting_cycles(result)[-1]
    steps = json.loads((tmp_path / "summary.json").read_text(encoding="utf-8"))["steps"]
    assert [step["cycle_start"] for step in steps] == [None, None, None, 2, 3]
    assert steps[2]["slip_amplitude"] is None
    assert steps[4]["slip_amplitude"] == np.max(last.slip_amplitude)
    assert steps[4]["ruiz_f2"] == np.max(last.ruiz_f2)
    assert steps[4]["energy_per_cycle"] == last.dissipated_energy
    assert all(step["energy_imbalance"] <= 1e-6 for step in steps)
    rows = (tmp_path / "cycles.csv").read_text(encoding="utf-8").splitlines()
    assert len(rows) == 3
    assert rows[-1].startswith("3,5,")
    with h5py.File(tmp_path / "result.h5") as file:
        group = file["last_cycle"]
        assert (group.attrs["start_step"], group.attrs["end_step"]) == (3, 5)
        for name, unit in (("slip_amplitude", "m"), ("ruiz_f1", "Pa m"), ("ruiz_f2", "Pa^2 m")):
            np.testing.assert_array_equal(group[name][:], getattr(last, name))
            assert group[name].attrs["unit"] == unit
    assert {"dissipation.png", "fretting.png"} <= {path.name for path in tmp_path.iterdir()}
