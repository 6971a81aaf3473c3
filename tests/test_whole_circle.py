"""Tests of finite elements at points on the whole circle: turned tangential loads, and torsion."""

from dataclasses import replace
from functools import cache
from math import pi

import numpy as np
import pytest
from contact_scenes import LIMIT, MU, PRESS, RADIUS, RIGID_BALL, A, push, scene, steel
from fem_scenes import EXACT, both_laws, elements, solved

import radial
from contact_scene import Body, Layer, RadialDiscretisation, Scene
from contact_scene.quantities.summary import ContactStatus
from contact_scene.rig import Rig
from contact_scene.solver_errors import GrossSliding
from fem_reference import Increment, Path, Result, plan
from fem_reference.compliance.angular_grid import AngularGrid, end_grid, whole_grid
from fem_reference.contact.method import ContactMethod
from fem_reference.expected_radius import meshed_radius
from fem_reference.history import solved_increments
from fem_reference.model import ContactModel
from fem_reference.stress import SurfaceTractions, subsurface
from verification.observed.observed_laws import observed

SLIDING = 3 * pi / 16 * LIMIT * A  # torque at which a Hertz contact slips at all points
PRESSED = {**PRESS, "increments": 4}
COATED = Body(material=steel(), layers=(Layer(thickness=A, material=steel(0.3, 1e12)),))


def twist(part: float, **more) -> dict:
    """A torque in parts of that at which all points slip."""
    return {"torque": part * SLIDING, **more}


TURNED = (push(0.5, increments=4), push(0.5 / 2**0.5, 0.5 / 2**0.5, increments=4))
TWISTED = (push(0.5, increments=3), twist(0.4, increments=3))
LOADS = {
    "turned": TURNED,
    "pushed, then twisted": TWISTED,
    "twisted, then pushed": TWISTED[::-1],
    "free to twist": ({"torque": 0.0, **TURNED[0]}, TURNED[1]),
}
BODIES = {
    "uncoupled": {},
    "coupled": {"indenter": RIGID_BALL},
}


def coated(*loading) -> Scene:
    return scene(*loading, indenter=RIGID_BALL).model_copy(update={"body": COATED})


@cache
def example() -> Result:
    return solved(coated(PRESSED, *TURNED), 8, harmonics=4)


def on_grid(of: Scene, path: Path, grid: AngularGrid, **changes) -> list[Increment]:
    """Increments of a scene on the points of a grid, along another path than that of its plan."""
    model = ContactModel.of(of, elements(8), meshed_radius(of, None))
    method = ContactMethod(model, replace(plan(of), path=path, **changes), around=grid)
    return list(solved_increments(method, 1e-10))


SHARED = ("pressure", "gap", "shear_radial", "shear_circumferential", "slip_radial", "in_stick")
SCALARS = ("approach", "contact_radius", "stick_radius", "dissipated_energy")


@pytest.mark.parametrize("bodies", [{}, {"indenter": RIGID_BALL}], ids=["uncoupled", "coupled"])
def test_loads_on_one_line_are_those_of_the_half_circle(bodies):
    of = scene(PRESSED, push(0.6, increments=2), push(-0.3, increments=2), **bodies)
    half = on_grid(of, Path.HARMONICS, end_grid(4))
    whole = on_grid(of, Path.WHOLE_CIRCLE, whole_grid(4))
    assert len(half) == len(whole) > 4
    for one, other in zip(half, whole, strict=True):
        for name in SHARED:
            a, b = getattr(one, name), getattr(other, name)
            if a is None or one.angles is None:
                continue
            size = max(float(np.max(np.abs(a))), 1e-12 * A)
            np.testing.assert_allclose(b[:, :5], a, atol=1e-9 * size, err_msg=name)
        for name in SCALARS:
            assert getattr(other, name) == pytest.approx(getattr(one, name), rel=1e-9, abs=1e-15)
        assert other.tangential_shift == pytest.approx(one.tangential_shift, rel=1e-9, abs=1e-18)


@pytest.mark.parametrize(
    ("loads", "bodies"), [*((loads, "coupled") for loads in LOADS), ("turned", "uncoupled")]
)
def test_motions_and_energies_are_those_of_the_radial_solver(loads, bodies):
    """On 16 elements the cusps of the shear cause an error of 5e-3 of the motions."""
    of = scene(PRESSED, *LOADS[loads], **BODIES[bodies])
    ours = solved(of, 16, harmonics=6)
    theirs = radial.solve(of, RadialDiscretisation())
    assert ours.plan.path is Path.WHOLE_CIRCLE
    for one, other in zip(ours.steps, theirs.steps, strict=True):
        assert one.approach == pytest.approx(other.approach, rel=1e-3)
        assert one.contact_radius == pytest.approx(other.contact_radius, rel=3e-3)
        assert one.elastic_energy == pytest.approx(other.elastic_energy, rel=2e-3)
        assert one.input_work == pytest.approx(other.input_work, rel=2e-3)
        shift = np.linalg.norm(np.subtract(one.tangential_shift, other.tangential_shift))
        assert shift <= 5e-3 * np.linalg.norm(other.tangential_shift)
        if one.twist is not None:
            # The error of a free twist is 1e-3 of the twists by the torques of these loads.
            assert one.twist == pytest.approx(other.twist, rel=1e-2, abs=1e-6)


def test_springs_of_a_rig_act_along_and_across_the_load():
    rig = Rig(normal_stiffness=2e8, tangential_stiffness=5e7)
    of = scene(PRESSED, *TURNED, indenter=RIGID_BALL).model_copy(update={"rig": rig})
    one = solved(of, 16, harmonics=6).steps[-1]
    other = radial.solve(of, RadialDiscretisation()).steps[-1]
    for name in ("tangential_shift", "actuator_shift", "actuator_approach"):
        assert getattr(one, name) == pytest.approx(getattr(other, name), rel=5e-3)
    assert one.elastic_energy == pytest.approx(other.elastic_energy, rel=2e-3)


@both_laws
def test_torsion_of_coupled_bodies_is_that_of_the_radial_solver(law):
    of = coated({**PRESS, "increments": 8}, twist(0.5, increments=8), twist(-0.2, increments=8))
    ours, theirs = solved(of, 16, law), radial.solve(of, RadialDiscretisation())
    assert ours.plan.path is Path.TWISTING_WITH_FRICTION
    assert ours.increments[-1].angles is None
    largest = max(abs(end.twist) for end in theirs.steps)
    for one, other in zip(ours.steps, theirs.steps, strict=True):
        assert one.torque == pytest.approx(other.torque, rel=1e-9)
        assert one.twist == pytest.approx(other.twist, abs=5e-3 * largest)
        assert one.approach == pytest.approx(other.approach, rel=1e-3)
        assert one.elastic_energy == pytest.approx(other.elastic_energy, rel=2e-3)
        assert one.tangential_shift == (0.0, 0.0)


@both_laws
@pytest.mark.parametrize("loads", LOADS)
def test_states_obey_the_laws(loads, law):
    """Contact, friction, equilibrium and energies are computed again from the stored fields."""
    settings = {} if law is EXACT else {"augmentations": 0, "overlap": 1.0}
    found = observed(solved(coated(PRESSED, *LOADS[loads]), 8, law, harmonics=4, **settings))
    assert found.violation < 1e-8
    assert found.imbalance < 1e-4
    assert not found.of_slip


def test_a_scene_that_needs_no_whole_circle_computes_no_more():
    """One compliance of each harmonic and no torsion, on the points of the half circle."""
    of = scene(PRESSED, push(0.5, increments=2), push(-0.5, increments=2), indenter=RIGID_BALL)
    result = solved(of, 8, harmonics=3)
    assert result.plan.path is Path.HARMONICS
    assert sum(increment.factorizations for increment in result.increments) == 4
    assert result.steps[-1].pressure.shape[1] == 4


def test_force_and_torque_above_the_limit_together_are_refused():
    of = scene(PRESSED, twist(0.5, increments=2), push(0.9, increments=2))
    with pytest.raises(GrossSliding, match="together exceed the friction limit"):
        solved(of, 8, harmonics=4)


@pytest.mark.parametrize("bodies", BODIES)
def test_a_turned_force_at_the_limit_leaves_the_shift_undefined(bodies):
    of = scene(PRESSED, push(0.5, increments=2), push(0.6, 0.8, increments=2), **BODIES[bodies])
    last = solved(of, 8, harmonics=4).steps[-1]
    assert last.status is ContactStatus.GROSS_SLIDING
    assert last.tangential_shift is None
    assert last.dissipated_energy is None
    assert last.stick_radius == 0.0
    cos_, sin_ = np.cos(last.angles), np.sin(last.angles)
    q_x = last.shear_radial * cos_ - last.shear_circumferential * sin_
    q_y = last.shear_radial * sin_ + last.shear_circumferential * cos_
    np.testing.assert_allclose(q_x, 0.6 * MU * last.pressure, atol=1e-9 * last.peak_pressure)
    np.testing.assert_allclose(q_y, 0.8 * MU * last.pressure, atol=1e-9 * last.peak_pressure)


def test_stress_below_turned_tractions_is_the_turned_stress():
    """Tractions turned by two points of a ring, and a uniform torsion."""
    end = example().steps[-1]
    own = SurfaceTractions.of(end)
    turned = replace(
        own,
        **{
            name: np.roll(getattr(own, name), 2, axis=1)
            for name in ("pressure", "shear_radial", "shear_circumferential")
        },
    )
    field, other = (subsurface(COATED, each, elements(4)) for each in (own, turned))
    step, peak = own.angles[2], end.peak_pressure
    for theta in (0.0, 1.0):
        np.testing.assert_allclose(
            other.stress(theta + step), field.stress(theta), atol=1e-9 * peak
        )
        np.testing.assert_allclose(
            other.displacement(theta + step), field.displacement(theta), atol=1e-9 * RADIUS
        )
