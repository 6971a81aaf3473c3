"""Load cycles: where they close, and what they do to the surface."""

import json
from itertools import combinations
from math import cos, pi, sin

import contact_scenes
import coupled_scenes
import h5py
import numpy as np
import pytest
from contact_scenes import LIMIT, LOAD, PRESS, A, grid, paraboloid, push, slide

from contact_results import cycles
from contact_results.cycles import fretting_cycles
from contact_results.result_files import write_result
from contact_scene import RIGID, Body, LoadStep
from contact_scene.quantities.cycles import load_cycles
from contact_scene.stepping.load_path import load_path
from semi_analytical import solve
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


NU_ZERO = contact_scenes.steel(0.0, 2 * paper.CONTACT_MODULUS)


def loop(cells, *loading, window=1.1):
    """The ball with ν = 0, where the closed form holds."""
    described = contact_scenes.scene(*(loading or LOOP), indenter=paraboloid(NU_ZERO), body=NU_ZERO)
    return solve(described, grid(cells, window), TOLERANCE)


def test_slip_amplitude_is_half_the_largest_distance_of_two_slips(monkeypatch):
    """Of more cells than are told at once, too."""
    monkeypatch.setattr(cycles, "MAX_AT_ONCE", 1000)
    monkeypatch.setattr(cycles, "NEAR_AT_HAND", 200)
    result = loop(16, PRESS, push(0.8, 0.1), push(-0.8, increments=4), push(0.8, 0.1, increments=4))
    (found,) = fretting_cycles(result)
    slips = [i.slip for i in result.increments if i is result.steps[1] or i.step in (3, 4)]
    assert len(slips) == 9
    largest = np.max([np.hypot(*(a - b)) for a, b in combinations(slips, 2)], axis=0)
    np.testing.assert_allclose(found.slip_amplitude, largest / 2, rtol=1e-13)


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
