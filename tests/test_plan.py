"""Tests of the plan of a run: required physical effects, and increments of the load steps."""

from dataclasses import replace

import numpy as np
import pytest
from contact_scenes import INDENTERS, PRESS, RIGID_BALL, paraboloid, push, scene, slide
from coupled_scenes import bulk, coated
from coupled_scenes import scene as coupled_scene

import fem_reference
import radial
from contact_scene.stepping.load_stepping import fractions
from semi_analytical import Coupling, all_effects, plan
from semi_analytical.operator.domain import WINDOW
from semi_analytical.plan import COMPUTED, MIRROR_PLANES

LEAST = 1e-3


def test_a_load_under_shear_is_cut_alike_there_and_back():
    half = {"normal_force": 0.5 * PRESS["normal_force"], **push(0.2)}
    whole = {**PRESS, **push(0.9)}
    *_, back, there = plan(scene(PRESS, push(0.9), half, whole)).increments
    assert back == there > 1


@pytest.mark.parametrize("of", [plan, fem_reference.plan, radial.plan])
@pytest.mark.parametrize("indenter", [RIGID_BALL, paraboloid()], ids=["coupled", "uncoupled"])
def test_unloading_to_almost_nothing_has_a_bounded_number_of_increments(of, indenter):
    """T/µW of no state exceeds 1: its change is not measured by the friction limit at the end."""
    unload = {"normal_force": 1e-6 * PRESS["normal_force"], "tangential_force": (0.0, 0.0)}
    counts = of(scene(PRESS, push(0.3), unload, indenter=indenter)).increments
    assert 20 <= counts[-1] <= 100


@pytest.mark.parametrize(
    ("least", "shape", "order"),
    [
        *[(0.0, shape, 3) for shape in ("paraboloid", "sphere", "ellipsoid")],
        *[(0.0, "cone", 2), (0.0, "flat punch", 1)],
        *[(1e-6, "paraboloid", 3), (0.1, "paraboloid", 3), (0.3, "paraboloid", 1)],
    ],
)
def test_increments_follow_small_loads_by_the_contact_radius(least, shape, order):
    """Uniform in it from and to loads below that of one increment, else in the load."""
    indenter, loads = INDENTERS[shape], (least * PRESS["normal_force"], PRESS["normal_force"])
    for end, start in (loads, loads[::-1]):
        steps = {"normal_force": start or LEAST}, {"normal_force": end}
        posed = scene(*steps, indenter=indenter)
        ramp = posed.load_path()[-1]
        ramp = replace(ramp, normal=replace(ramp.normal, start=start))
        parts = np.array([0.0, *fractions(posed, ramp, 5)])
        steps = np.diff(((start + parts * (end - start)) / loads[1]) ** (1 / order))
        assert steps == pytest.approx(np.full(5, np.mean(steps)), rel=1e-6)


def free(x):
    """A push in parts of the friction limit that leaves its increments to the solver."""
    return {"tangential_force": (x * 0.1 * PRESS["normal_force"], 0.0)}


@pytest.mark.parametrize(
    "described",
    [
        coupled_scene(PRESS, body=bulk(0.3)),
        coupled_scene(PRESS, body=bulk(0.3), friction=0.3),
        coupled_scene(PRESS, free(0.6), body=bulk(0.3)),
        coupled_scene(PRESS, free(0.9), body=coated(2.0)),
        scene(PRESS, push(0.5), push(0, 0.5)),
        scene({**PRESS, **slide(0.3)}),
    ],
)
def test_more_accuracy_takes_more_increments(described):
    fine, coarse = (plan(described, accuracy).increments for accuracy in (1e-3, 1e-1))
    assert all(f >= c for f, c in zip(fine, coarse, strict=True))
    assert sum(fine) > sum(coarse)


def test_forcing_says_what_it_forces():
    decided = plan(scene(PRESS, friction=None))
    forced = all_effects(decided)
    assert forced.coupling is Coupling.FULL
    assert forced.shear
    assert forced.increments == decided.increments
    changed = [e for e, old in zip(forced.effects, decided.effects, strict=True) if e != old]
    assert {e.name for e in changed} == {*COMPUTED, MIRROR_PLANES}
    assert all(e.on and "forced on" in e.why for e in changed if e.name in COMPUTED)
    assert forced.symmetry == WINDOW
