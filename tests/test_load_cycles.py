"""Tests of load cycles: where they close, and the slip and tension that they leave."""

from itertools import combinations
from math import cos, pi, sin

import contact_scenes
import numpy as np
import pytest
from contact_scenes import (
    LOAD,
    MU,
    PRESS,
    YOUNG,
    A,
    hertz,
    paraboloid,
    push,
    slide,
    steel,
)

import slipstick
from contact_results import cycles
from contact_results.cycles import fretting_cycles
from contact_results.solvers import solver_of
from contact_scene import (
    FiniteElementDiscretisation,
    LoadStep,
    RadialDiscretisation,
)
from contact_scene.quantities.cycles import load_cycles
from contact_scene.stepping.load_path import load_path
from verification.closed_forms.cattaneo_mindlin import CycledContact, PartialSlip
from verification.closed_forms.hertz import contact_modulus

LOOP = (PRESS, push(0.9, increments=4), push(-0.9, increments=8), push(0.9, increments=8))
CIRCLE = [push(0.5 * cos(k * pi / 2), 0.5 * sin(k * pi / 2)) for k in range(9)]
CYCLES = {
    "there and back": (LOOP, [(2, 4)]),
    "to nothing and back": ((PRESS, push(0.9), push(0.0)), [(1, 3)]),
    "holding is no cycle": ((PRESS, push(0.9), push(0.9), push(-0.9), push(0.9)), [(3, 5)]),
    "on a circle, with round-off": ((PRESS, *CIRCLE), [(k, k + 4) for k in range(2, 7)]),
    "of the load": ((PRESS, {"normal_force": 0.5 * LOAD}, PRESS), [(1, 3)]),
    "both together": (({**PRESS, **push(0.5)}, {**PRESS, **push(0.1)}, PRESS, push(0.5)), [(1, 4)]),
    "a shift is not a force": ((PRESS, push(0.5), slide(1), push(0.5)), [(2, 4)]),
    "of the torque": ((PRESS, {"torque": 1.0}, {"torque": -1.0}, {"torque": 1.0}), [(2, 4)]),
    "not the twist": ((PRESS, push(0.5), {"twist": 1e-3}, push(0.0), push(0.5)), [(3, 5)]),
    "of the strain": (
        (PRESS, push(0.2), push(-0.2), {**push(0.2), "bulk_strain": (1e-4, 0.0, 0.0)}),
        [],
    ),
    "never back": ((PRESS, push(0.1), push(0.2), push(0.3)), []),
}


@pytest.mark.parametrize(("loading", "expected"), CYCLES.values(), ids=CYCLES)
def test_a_cycle_closes_where_all_loads_return(loading, expected):
    found = load_cycles(load_path([LoadStep(**step) for step in loading]))
    assert [(cycle.start, cycle.end) for cycle in found] == expected


def mindlin_loop(part):
    """Scene of a loop to parts of the friction limit for ν = 0, and its closed form."""
    contact, loose = hertz(poisson_ratio=0.0), steel(0.0)
    modulus = contact_modulus((YOUNG, 0.0), (YOUNG, 0.0))
    end = PartialSlip(LOAD, contact.contact_radius, MU, modulus, part * MU * LOAD)
    loading = PRESS, push(part), push(-part), push(part)
    posed = contact_scenes.scene(*loading, indenter=paraboloid(loose), body=loose)
    return posed, CycledContact(end, contact.peak_pressure), contact.contact_radius


@pytest.mark.parametrize(
    ("solver", "asked", "off"),
    [
        ("fem-complementarity", FiniteElementDiscretisation(elements_per_radius=12), 0.02),
        ("radial", None, 0.01),
    ],
)
def test_the_largest_slip_on_rings_lies_at_the_edge(solver, asked, off):
    """The outermost ring lies inside the edge: with 12 elements its slip is 27 % too small."""
    posed, exact, a = mindlin_loop(0.7)
    found = fretting_cycles(slipstick.solve(posed, solver, asked))[0]
    slip = exact.slip_amplitude(a)
    assert found.largest_slip == pytest.approx(slip, rel=off)
    assert found.largest_f1 == pytest.approx(exact.largest_f1, rel=3 * off)
    assert np.max(found.slip_amplitude) < (1 - off) * slip


@pytest.mark.parametrize("part", [0.5])
def test_elements_state_the_slip_around_the_contact_that_they_neglect(part):
    """It varies by ν/(2 - ν) around a narrow annulus, and by half of this in gross slip."""
    loop_of = (PRESS, push(part, increments=4), push(-part, increments=8), push(part, increments=8))
    described = contact_scenes.scene(*loop_of, indenter=paraboloid(steel()), body=steel())
    elements = slipstick.solve(
        described, "fem-complementarity", FiniteElementDiscretisation(elements_per_radius=32)
    )
    (of_elements,) = fretting_cycles(elements)
    (around,) = fretting_cycles(slipstick.solve(described, "radial"))
    neglected = solver_of(elements).neglected_errors(elements)
    for name in ("slip_amplitude", "ruiz_f1"):
        lost = around.numbers[name] / of_elements.numbers[name] - 1
        assert 0.4 * neglected[name] < lost < neglected[name]


def test_slip_of_torsion_states_the_error_of_few_rings():
    """The rings carry no unknowns; the largest values are interpolated between them."""
    torque = 0.3 * MU * LOAD * A
    loading = [PRESS, *({"torque": sign * torque, "increments": 2} for sign in (1, -1, 1))]
    posed = contact_scenes.scene(*loading, indenter=paraboloid(steel()), body=steel())
    few, many = (
        slipstick.solve(posed, "radial", RadialDiscretisation(rings=rings)) for rings in (8, 128)
    )
    (found,), (exact,) = fretting_cycles(few), fretting_cycles(many)
    errors = slipstick.stated_errors(few).steps[-1]
    for name in ("slip_amplitude", "ruiz_f1"):
        off = abs(found.numbers[name] - exact.numbers[name])
        assert off < errors[name].error < 0.01 * exact.numbers[name]
        assert off > 1e-6 * exact.numbers[name]


@pytest.mark.parametrize("width", [0.0, 0.05, 0.3, 1.0])
def test_slip_amplitude_keeps_its_bound(width):
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
