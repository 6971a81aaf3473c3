"""Tests of the separation of the bodies: empty contact, and return from the virgin state."""

from typing import NamedTuple

import numpy as np
import pytest
from contact_scenes import APPROACH, LOAD, PRESS, RADIUS, push, scene, slide

import slipstick
from contact_results.stress.loaded_bodies import NoSuchState, state_of_result
from contact_scene import FiniteElementDiscretisation, SurfaceDiscretisation
from contact_scene.quantities.summary import ContactStatus

ELEMENTS = FiniteElementDiscretisation(elements_per_radius=12)
SOLVERS = {
    "semi-analytical": SurfaceDiscretisation(cells=(32, 32)),
    "fem-complementarity": ELEMENTS,
    "fem": ELEMENTS,
    "radial": None,
}
TO_EDGE = 2e-3  # relative error of the coarse cells and elements
FEW = {"increments": 4}
LIFT = {"normal_force": 0.0, **FEW}
UNCHANGED = ("pressure", "gap", "shear", "shear_radial", "slip", "slip_radial", "in_stick")


class History(NamedTuple):
    """Load steps up to separation, after the return, and of a virgin contact that begins alike."""

    before: tuple[dict, ...]
    after: tuple[dict, ...]
    virgin: tuple[dict, ...]
    friction: float | None = 0.1


PUSHED = PRESS, push(0.5, **FEW)
TWISTED = PRESS, {"torque": 1.2e-2, **FEW}
UNTWISTED = *TWISTED, {"torque": 0.0, **FEW}, LIFT
LED = ({"approach": APPROACH},)
HISTORIES = {
    "pressed": History((PRESS, LIFT), (PRESS,), (PRESS,), None),
    "by approach": History((*LED, {"approach": 0.0}), LED, LED, None),
    "pushed": History((*PUSHED, {**LIFT, **push(0)}), PUSHED, PUSHED),
    "twisted": History(UNTWISTED, TWISTED, UNTWISTED),
    "moved while apart": History(
        (PRESS, slide(1, **FEW), LIFT, slide(2)),
        (PRESS, slide(3, **FEW)),
        (PRESS, slide(1, **FEW)),
    ),
}


def solved(steps, solver, friction=0.1):
    return slipstick.solve(scene(*steps, friction=friction), solver, SOLVERS[solver])


def close(one, other, exponent):
    part = 10.0**exponent
    return np.allclose(one, other, rtol=part, atol=part * np.max(np.abs(other)) + 1e-300)


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("name", HISTORIES)
def test_return_is_a_virgin_contact(name, solver):
    history = HISTORIES[name]
    whole = solved((*history.before, *history.after), solver, history.friction)
    virgin, again = solved(history.virgin, solver, history.friction).steps, whole.steps
    lifted = len(history.before)
    apart, before = again[lifted - 1], again[1 if history.friction else 0]

    assert apart.status is ContactStatus.SEPARATED
    assert apart.normal_force == apart.approach == apart.contact_area == apart.elastic_energy == 0
    assert not apart.pressure.any()
    assert 0 <= np.min(apart.gap) < 2e-3 * APPROACH
    with pytest.raises(NoSuchState, match="separated"):
        state_of_result(whole, lifted)
    if history.friction:
        assert apart.input_work == apart.dissipated_energy > before.dissipated_energy > 0
        assert apart.stick_area == (apart.torque or 0.0) == 0
        force = apart.tangential_force
        assert force is None or not np.any(force)
    if name == "moved while apart":
        assert close(apart.tangential_shift, slide(2)["tangential_shift"], -12)

    for end, new in zip(again[lifted:], virgin, strict=False):
        assert end.status is new.status
        for field in UNCHANGED:
            if getattr(new, field, None) is not None:
                assert close(getattr(end, field), getattr(new, field), -9), field
        for number in ("dissipated_energy", "tangential_shift", "twist"):
            if getattr(new, number) is not None:
                gained = np.subtract(getattr(end, number), getattr(apart, number))
                assert close(gained, getattr(new, number), -7), number
        assert end.approach == pytest.approx(APPROACH, rel=TO_EDGE)
        assert end.normal_force == pytest.approx(LOAD, rel=TO_EDGE)


@pytest.mark.parametrize("solver", [solver for solver in SOLVERS if solver != "fem"])
def test_separation_is_the_limit_of_small_loads(solver):
    """The point that loses contact last has not slipped: the residual shift vanishes with W. The
    dissipated energy agrees with that of a history that ends just above 0."""
    # A penalty overlaps in this unloading, at any load.
    pushed = PRESS, push(0.6, **FEW), push(0, **FEW)
    ends = (0.0, 1e-3 * LOAD)
    (*_, residual, apart), (*_, near) = (
        solved((*pushed, {"normal_force": end, "increments": 10}), solver).steps for end in ends
    )
    assert residual.tangential_shift[0] > 0
    assert abs(apart.tangential_shift[0]) < 0.02 * residual.tangential_shift[0]
    uncertain = apart.dissipation_uncertainty + near.dissipation_uncertainty
    assert 0 < uncertain < apart.dissipated_energy
    assert abs(apart.dissipated_energy - near.dissipated_energy) <= uncertain


def test_tilted_bodies_separate_at_first_touch():
    """A paraboloid of radius R, tilted by φ about the origin, first touches at −Rφ²/2."""
    slope = 1e-3
    steps = {**PRESS, "tilt": (0.0, slope)}, {"normal_force": 0.0}, PRESS
    first, apart, again = solved(steps, "semi-analytical", None).steps
    assert apart.approach == pytest.approx(-RADIUS * slope**2 / 2, rel=1e-9)
    assert 0 <= np.min(apart.gap) < 1e-3 * APPROACH
    assert tuple(apart.tilt) == (0.0, slope)
    assert again.approach == first.approach


@pytest.mark.parametrize("solver", ["semi-analytical", "fem-complementarity"])
@pytest.mark.parametrize("returns", [False, True])
def test_increments_before_first_touch_are_empty(solver, returns):
    """The first of 30 lies within a cell or ring. The end is that of one increment."""
    before = (*LED, slide(1, **FEW), {"approach": 0.0, **slide(1)}) if returns else ()
    posed = (*before, {**LED[0], "increments": 30})
    fine = {"semi-analytical": SurfaceDiscretisation(cells=(16, 16))}.get(
        solver, FiniteElementDiscretisation(elements_per_radius=8)
    )
    found, alone = (
        slipstick.solve(scene(*steps), solver, fine) for steps in (posed, (*before, *LED))
    )
    first, *_, end = found.increments[-30:]
    assert first.status is ContactStatus.SEPARATED
    assert first.approach == pytest.approx(APPROACH / 900)
    assert first.normal_force == first.contact_area == (first.elastic_energy or 0.0) == 0
    assert np.min(first.gap) > 0
    assert ((first.dissipated_energy or 0.0) > 0) == returns
    last = alone.increments[-1]
    for number in ("normal_force", "elastic_energy", "dissipated_energy"):
        one, other = getattr(end, number) or 0.0, getattr(last, number) or 0.0
        assert one == pytest.approx(other, rel=1e-6), number
