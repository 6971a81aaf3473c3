"""Contact pushed sideways or twisted, by finite elements: partial slip and its memory."""

import numpy as np
import pytest
from contact_scenes import (
    LIMIT,
    LOAD,
    MU,
    NU,
    PRESS,
    YOUNG,
    A,
    hertz,
    push,
    scene,
    steel,
)
from fem_scenes import both_laws, end, solved

from contact_scene.quantities.summary import ContactStatus
from contact_scene.solver_errors import GrossSliding
from fem_reference import Method
from verification.closed_forms.cattaneo_mindlin import PartialSlip
from verification.closed_forms.moduli import tangential_modulus
from verification.closed_forms.torsion import TorsionalPartialSlip
from verification.quantities import shift_along_x

G = steel().shear_modulus
HERTZ = hertz()
VIRGIN = PartialSlip(
    LOAD, A, MU, tangential_modulus((YOUNG, NU), (YOUNG, NU)), 0.0
)  # fmt: skip
UNTWISTED = TorsionalPartialSlip(A, HERTZ.peak_pressure, MU, G / 2, A)
EXACT, PENALTY = Method.COMPLEMENTARITY, Method.PENALTY


def test_mirrored_load_has_the_mirrored_answer() -> None:
    right, left = end(scene(PRESS, push(0.7))), end(scene(PRESS, push(-0.7)))
    assert left.tangential_shift == pytest.approx([-x for x in right.tangential_shift])
    # The plan measures along the load, so that to it the two are one and the same.
    assert np.array_equal(left.shear_along_load, right.shear_along_load)
    back = end(scene(PRESS, push(0.2), push(-0.7)))
    forth = end(scene(PRESS, push(-0.2), push(0.7)))
    assert np.array_equal(back.shear_along_load, forth.shear_along_load)


def test_oblique_load_is_the_same_along_its_line() -> None:
    along, oblique = end(scene(PRESS, push(0.5))), end(scene(PRESS, push(0.3, 0.4)))
    assert oblique.shear_along_load == pytest.approx(along.shear_along_load, rel=1e-9, abs=1.0)
    x, y = oblique.tangential_shift
    assert np.hypot(x, y) == pytest.approx(shift_along_x(along), rel=1e-9)
    assert y / x == pytest.approx(4 / 3, rel=1e-12)


def test_force_and_shift_lead_to_the_same_state() -> None:
    by_force = end(scene(PRESS, push(0.7)))
    by_shift = end(scene(PRESS, {"tangential_shift": by_force.tangential_shift}))
    assert by_shift.tangential_force == pytest.approx((0.7 * LIMIT, 0.0), rel=1e-9)
    assert by_shift.shear_along_load == pytest.approx(by_force.shear_along_load, rel=1e-8, abs=1.0)


@both_laws
def test_sliding_contact_carries_all_that_friction_can(law: Method) -> None:
    sliding = end(scene(PRESS, {"tangential_shift": (3 * VIRGIN.sliding_shift, 0.0)}), law=law)
    assert sliding.status is ContactStatus.GROSS_SLIDING
    assert sliding.tangential_force[0] == pytest.approx(LIMIT, rel=1e-9)
    assert sliding.stick_radius == 0
    at_limit = end(scene(PRESS, push(1.0)), law=law)
    assert at_limit.status is ContactStatus.GROSS_SLIDING
    assert at_limit.tangential_shift is None
    assert at_limit.dissipated_energy is None
    assert at_limit.shear_along_load == pytest.approx(sliding.shear_along_load)


@both_laws
def test_gross_sliding_under_force_is_refused_by_name(law: Method) -> None:
    """Unloading by approach leaves too little pressure: nothing in the scene gives that away."""
    asked = scene(PRESS, push(0.5), {"approach": 0.2 * HERTZ.approach, "increments": 5})
    with pytest.raises(GrossSliding, match="prescribe the shift") as caught:
        solved(asked, law=law)
    assert caught.value.where.startswith("step 3, increment")
    assert caught.value.last_state.tangential_force == (0.5 * LIMIT, 0.0)


@both_laws
def test_less_pressure_under_constant_shear_slips_inwards(law: Method) -> None:
    result = solved(
        scene(PRESS, push(0.5), {"normal_force": 0.6 * LOAD, "increments": 10}), law=law
    )
    radii = [step.stick_radius for step in result.increments[1:]]
    assert np.all(np.diff(radii) < 0)
    shifts = [shift_along_x(step) for step in result.increments[1:]]
    assert np.all(np.diff(shifts) > 0)
    assert max(i.residuals.worst for i in result.increments) < 1e-11


def test_torque_and_twist_lead_to_the_same_state() -> None:
    torque = 0.6 * UNTWISTED.sliding_moment
    by_torque = end(scene(PRESS, {"torque": torque}))
    by_twist = end(scene(PRESS, {"twist": by_torque.twist}))
    assert by_twist.torque == pytest.approx(torque, rel=1e-9)
    with pytest.raises(GrossSliding, match="torque"):
        end(scene(PRESS, {"torque": 1.2 * UNTWISTED.sliding_moment}))


# The gap of springs is the small difference of a large overlap and their strain.
ROUND_OFF = {EXACT: 1e-11, PENALTY: 1e-10}


@both_laws
def test_equations_hold_to_round_off(law: Method) -> None:
    loop = scene(PRESS, push(0.9), push(-0.9), push(0.9))
    twisted = scene(PRESS, {"torque": 0.01}, {"torque": -0.01}, {"twist": 0.0})
    for asked in (loop, twisted):
        result = solved(asked, law=law)
        assert max(i.residuals.worst for i in result.increments) < ROUND_OFF[law]
        energy = [i.dissipated_energy for i in result.increments]
        assert np.all(np.diff(energy) >= 0)
