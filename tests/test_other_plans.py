"""Solving with another plan than the scene's: effects forced on, or coupled one way only."""

import subprocess
import sys

import numpy as np
import pytest
from contact_scenes import PRESS, grid, paraboloid, push, slide
from contact_scenes import scene as alike_scene
from coupled_scenes import BALL, bulk, coated, press, scene
from coupled_scenes import push as coupled_push

from contact_scene import LoadStep
from semi_analytical import Coupling, all_effects, one_way, plan, solve
from semi_analytical.operator.domain import WINDOW
from semi_analytical.operator.operator import DisplacementOperator
from semi_analytical.operator.transforms import MirroredWaves, Waves
from semi_analytical.plan import COMPUTED, EDGES, MIRROR_PLANES
from verification.cases.goodman_indentation import goodman_indentation_on
from verification.judging.judgement import judge
from verification.judging.outcome import Status
from verification.quantities import largest_difference

TOLERANCE = 1e-8
# Tractions answer residuals of the tolerance a few times over.
SAME = 10 * TOLERANCE

REDUCED = {
    "frictionless": alike_scene(PRESS, friction=None),
    "rigid on elastic, frictionless": alike_scene(PRESS, friction=None, indenter=BALL),
    "no tangential load": alike_scene(PRESS),
    "pushed to and fro": alike_scene(PRESS, push(0.8), push(-0.8)),
    "shifted until it slides": alike_scene(PRESS, slide(0.5), slide(20), slide(0)),
    "turning": alike_scene(PRESS, push(0.5, increments=2), push(0, 0.5, increments=4)),
    "unloading": alike_scene(PRESS, push(0.3), {"normal_force": 500, "increments": 3}),
    "pushed, where bodies couple": scene(press(), coupled_push(0.5)),
    "coated alike": scene(
        PRESS, push(0.7), body=coated(), indenter=paraboloid().model_copy(update=dict(coated()))
    ),
}


@pytest.fixture
def transformed(monkeypatch):
    """How many values have been transformed along an axis so far, for preconditioners and on coarse
    grids too: what a solve costs, by whatever products it goes."""
    spent = [0]

    def counted(owner, name):
        transform = getattr(owner, name)

        def counting(self, values, *out):
            result = transform(self, values, *out)
            spent[0] += max(np.size(values), np.size(out[0] if out else result))
            return result

        monkeypatch.setattr(owner, name, counting)

    for side in (Waves, MirroredWaves):
        for name in ("forward", "back"):
            counted(side, name)
    return spent


@pytest.mark.parametrize("described", REDUCED.values(), ids=REDUCED)
def test_the_reduced_model_equals_the_full_model(described, transformed):
    decided = plan(described)
    planned = solve(described, grid(32), TOLERANCE)
    reduced = transformed[0]
    forced = solve(described, grid(32), TOLERANCE, plan=all_effects(decided))
    assert largest_difference(planned, forced) <= SAME
    assert reduced <= transformed[0] - reduced
    for a, b in zip(planned.increments, forced.increments, strict=True):
        if described.friction is None:
            assert b.status == a.status
        assert np.all(b.gap >= -SAME * b.approach)


def test_forcing_says_what_it_forces():
    decided = plan(REDUCED["frictionless"])
    forced = all_effects(decided)
    assert forced.coupling is Coupling.FULL
    assert forced.shear
    assert forced.increments == decided.increments
    changed = [e for e, old in zip(forced.effects, decided.effects, strict=True) if e != old]
    assert {e.name for e in changed} == {*COMPUTED, MIRROR_PLANES}
    assert all(e.on and "forced on" in e.why for e in changed if e.name in COMPUTED)
    assert forced.symmetry == WINDOW


def test_edges_are_not_known_of_bodies_of_which_one_way_of_coupling_is_left_out():
    decided = plan(scene(press(), coupled_push(0.5)), edge="last")
    assert decided.edge == "last"
    one = one_way(decided)
    assert one.edge == "off"
    assert not any(e.on for e in one.effects if e.name == EDGES)


def test_forcing_twice_changes_nothing():
    forced = all_effects(plan(scene(press(), coupled_push(0.5))))
    assert all(effect.on for effect in forced.effects if effect.name in COMPUTED)
    assert all_effects(forced) == forced


def coupled_one_way(described, cells=48):
    return solve(described, grid(cells, 1.2), TOLERANCE, plan=one_way(plan(described)))


def test_one_way_the_pressure_is_that_without_friction():
    described = scene(press(), coupled_push(0.6), body=bulk())
    smooth = solve(scene(press(), body=bulk(), friction=None), grid(48, 1.2), TOLERANCE)
    for step in coupled_one_way(described).steps:
        expected = smooth.steps[-1].pressure  # of a quarter, not of half the window
        np.testing.assert_allclose(step.pressure, expected, atol=1e-12 * np.max(expected))


@pytest.mark.parametrize("body", [bulk(), coated()], ids=["homogeneous", "coated"])
def test_one_way_every_increment_obeys_friction(body):
    described = scene(press(), coupled_push(0.6), coupled_push(-0.6), press(0.7), body=body)
    lost = 0.0
    for increment in coupled_one_way(described).increments:
        assert increment.residuals.worst <= TOLERANCE
        assert np.any(increment.in_contact & ~increment.in_stick)
        assert increment.dissipated_energy >= lost
        lost = increment.dissipated_energy
    assert lost > 0


def test_one_way_equals_uncoupled_for_alike_bodies():
    described = REDUCED["pushed to and fro"]
    planned = solve(described, grid(32), TOLERANCE)
    sequential = solve(described, grid(32), TOLERANCE, plan=one_way(plan(described)))
    assert largest_difference(planned, sequential) <= SAME


def test_one_way_is_off_by_the_square_of_beta():
    """Where all sticks the shear is of order β p, and what that does to the pressure of order
    β²."""
    apart, beta = [], []
    for nu in (0.4, 0.45, 0.475):
        described = scene(press(), body=bulk(nu), friction=5.0)
        full = solve(described, grid(32, 1.2), TOLERANCE)
        apart.append(largest_difference(full, coupled_one_way(described, 32)))
        beta.append((1 - 2 * nu) / (2 * (1 - nu)))
    orders = np.diff(np.log(apart)) / np.diff(np.log(beta))
    assert orders == pytest.approx([2, 2], abs=0.1)


def test_one_way_costs_less_than_full_coupling(transformed):
    described = scene(press(), coupled_push(0.6), body=bulk())
    coupled_one_way(described)
    one = transformed[0]
    solve(described, grid(48, 1.2), TOLERANCE)
    assert one < transformed[0] - one


def test_one_way_at_the_limit_and_under_a_shift():
    limit = scene(press(), coupled_push(0.5), coupled_push(1.0, increments=1))
    end = coupled_one_way(limit).increments[-1]
    assert end.tangential_shift is None
    assert end.residuals.worst <= TOLERANCE
    far = scene(press(), LoadStep(tangential_shift=(1e-4, 0.0), increments=3).model_dump())
    slid = coupled_one_way(far).increments[-1]
    assert not np.any(slid.in_stick)
    assert slid.tangential_force[0] == pytest.approx(0.1 * slid.normal_force, rel=1e-6)


def test_uncoupled_scenes_do_not_import_the_one_way_increment():
    code = (
        "import sys; sys.path.insert(0, 'tests'); import test_other_plans as t; "
        "t.solve(t.REDUCED['pushed to and fro'], t.grid(16), 1e-6); "
        "assert 'semi_analytical.one_way_increment' not in sys.modules; "
        "assert 'semi_analytical.coupled_increment' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


def stick_verdict():
    outcome = judge(goodman_indentation_on(64, (0.2,)))
    verdicts = {v.name: v.status for v in outcome.verdicts}
    stick = verdicts.pop("stick_ratio")
    assert set(verdicts.values()) == {Status.PASS}
    return stick


def test_goodman_case_passes_and_sees_a_coupling_too_weak(monkeypatch):
    assert stick_verdict() is Status.PASS
    whole = DisplacementOperator.tangential_by_pressure
    monkeypatch.setattr(
        DisplacementOperator, "tangential_by_pressure", lambda self, p: 0.97 * whole(self, p)
    )
    assert stick_verdict() is Status.FAIL
