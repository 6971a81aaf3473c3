"""Tests of the radial solver: closed forms of half-spaces, laws of layers, and refusals."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from numpy.typing import ArrayLike

import radial
import slipstick
from contact_scene import (
    RIGID,
    Body,
    Cone,
    CoulombFriction,
    Ellipsoid,
    FlatPunch,
    IsotropicMaterial,
    Layer,
    LoadStep,
    Paraboloid,
    RadialDiscretisation,
    RevolvedProfile,
    Scene,
)
from contact_scene.geometry import ShapedBody
from contact_scene.quantities.summary import ContactStatus
from contact_scene.solver_errors import UnsupportedScene
from radial.normal.disc import (
    Disc,
    disc,
)
from radial.normal.surface import (
    displacement,
    largest_pressure,
    pressure,
)
from radial.response.bodies import Bodies
from radial.torsion.torsion import (
    PartialSlip,
    Torsion,
)
from radial.torsion.twist_path import TwistPath
from semi_analytical.frf.surface import remainder_scalars
from verification.closed_forms.coated_indentation import LayeredSurface
from verification.closed_forms.coated_indentation import flat_punch as coated_punch
from verification.closed_forms.coated_indentation import paraboloid as coated_paraboloid
from verification.closed_forms.torsion import (
    CoatedTorsion,
    TorsionalPartialSlip,
    TorsionalSurface,
    one_layer,
)

STEEL = IsotropicMaterial(young_modulus=210e9, poisson_ratio=0.3)
MODULUS = STEEL.plane_strain_modulus
FORCE = 1e3
RADIUS = 18e-3
BALL = Paraboloid(radius=RADIUS, material=RIGID)

ratios = st.floats(-0.5, 0.5)
moduli = st.floats(0.1, 10.0)
thicknesses = st.floats(0.2, 5.0)


def pressed(indenter: ShapedBody, body: Body | None = None, **step: Any) -> radial.Increment:
    loading = (LoadStep(**(step or {"normal_force": FORCE})),)
    scene = Scene(indenter=indenter, body=body or Body(material=STEEL), loading=loading)
    return radial.solve(scene).steps[-1]


def coated(modulus: float, thickness: float, ratio: float = 0.3, base: Any = None) -> Body:
    """A layer on a substrate of unit modulus E/(1 - ν²), lengths in the units of the scene."""
    substrate = IsotropicMaterial(young_modulus=0.91, poisson_ratio=0.3)
    layer = IsotropicMaterial(young_modulus=0.91 * modulus, poisson_ratio=ratio)
    return Body(material=base or substrate, layers=(Layer(thickness=thickness, material=layer),))


# ---- half-spaces ------------------------------------------------------------------------------


class PowerLaw(ShapedBody):
    """r^k / k in metres: a shape that says nothing of itself but its gap."""

    power: float

    def initial_gap(self, x: ArrayLike, y: ArrayLike) -> Any:
        return np.hypot(x, y) ** self.power / self.power


@pytest.mark.parametrize("power", [1.0, 2.0, 3.0, 4.0, 6.0])
def test_any_smooth_profile_is_pressed_as_sneddon_says(power: float) -> None:
    """δ = S(a) and W = 2E* ∫ (δ - S) ds, with S(s) = sᵏ ½√π Γ(k/2)/Γ((k+1)/2)."""
    bodies = Bodies((), MODULUS)
    a = 2e-3
    made = disc(bodies, PowerLaw.model_construct(power=power, material=RIGID, layers=()), a)
    at_edge = (
        a**power * math.sqrt(math.pi) / 2 * math.gamma(power / 2) / math.gamma((power + 1) / 2)
    )
    assert_allclose(made.approach, at_edge, rtol=1e-11)
    assert_allclose(made.load, 2 * MODULUS * a * at_edge * power / (power + 1), rtol=1e-11)


@pytest.mark.parametrize("ratio", [1.001, 1.05, 1.5, 4.0])
def test_a_profile_with_a_flat_on_the_axis_is_pressed_as_sneddon_says(ratio: float) -> None:
    """Flat up to b, then (r - b)²/2R, with b = a sin φ at the contact radius a; layers of the
    same material make the equation of layered bodies."""
    flat = 1e-3
    a, phi = ratio * flat, math.asin(1 / ratio)
    depth = a / RADIUS * (a * math.cos(phi) - flat * (math.pi / 2 - phi))
    moments = (
        math.cos(phi) - math.cos(phi) ** 3 / 3,
        (math.pi / 2 - phi) / 2 + math.sin(2 * phi) / 4,
    )
    force = 2 * MODULUS * a**2 / RADIUS * (a * moments[0] - flat * moments[1])
    r = np.linspace(0.0, 5 * flat, 26)
    table: Any = np.stack([r, np.maximum(r - flat, 0.0) ** 2 / (2 * RADIUS)])
    indenter = RevolvedProfile(file=table, material=RIGID)
    same = Body(material=STEEL, layers=(Layer(thickness=a, material=STEEL),))
    for body in (Body(material=STEEL), same):
        end = pressed(indenter, body, normal_force=force)
        assert_allclose((end.contact_radius, end.approach), (a, depth), rtol=1e-5)


# ---- layers -----------------------------------------------------------------------------------


@given(modulus=moduli, thickness=thicknesses, ratio=ratios)
def test_layers_press_as_the_nystrom_method_says(
    modulus: float, thickness: float, ratio: float
) -> None:
    """The closed form's own nodes, wavenumbers and derivative for the pressure; the response of
    the layers is what both have in common."""
    bodies = Bodies.of(_scene(BALL, coated(modulus, thickness, ratio)))
    surface = LayeredSurface(_compliance(bodies), bodies.modulus, thickness)
    ball = coated_paraboloid(surface, RADIUS, 1.0)
    ours = disc(bodies, BALL, 1.0)
    assert_allclose([ours.approach, ours.load], [ball.approach, ball.load], rtol=1e-10)
    x = np.linspace(0, 0.99, 12)
    assert_allclose(pressure(ours, x), ball.pressure(x), rtol=0, atol=1e-9 * ball.load)
    punch = FlatPunch(radius=1.0, material=RIGID)
    stiffness = coated_punch(surface, 1.0).load
    assert_allclose(disc(bodies, punch, 1.0, 1.0).load, stiffness, rtol=1e-10)


@given(modulus=st.floats(0.05, 20.0), thickness=st.floats(0.05, 5.0))
def test_the_surface_touches_where_there_is_pressure(modulus: float, thickness: float) -> None:
    """The displacement just outside meets the indenter, by another integral than the equation's;
    the gap opens from there as a power of three halves."""
    bodies = Bodies.of(_scene(BALL, coated(modulus, thickness)))
    made = disc(bodies, BALL, 1.0)
    x = 1 + np.array([1e-6, 1e-4])
    gap = x**2 / (2 * RADIUS) + displacement(made, x) - made.approach
    assert_allclose(gap[0], 0.0, atol=1e-8 * made.approach)
    assert gap[1] > 0


@pytest.mark.parametrize("body", [Body(material=STEEL), coated(3.0, 1e-3, base=RIGID)])
@pytest.mark.parametrize(
    "indenter",
    [BALL, Cone(slope_angle=0.05, material=RIGID), FlatPunch(radius=1e-3, material=RIGID)],
)
def test_what_is_stored_is_the_work_of_the_load(indenter: ShapedBody, body: Body) -> None:
    """dU = W dδ, by differences of neighbouring loads."""
    force, step = FORCE if body.layers == () else 1e-6, 1e-3
    less, more = (pressed(indenter, body, normal_force=f * force) for f in (1 - step, 1 + step))
    assert less.elastic_energy is not None
    assert more.elastic_energy is not None
    stored = more.elastic_energy - less.elastic_energy
    assert_allclose(stored, force * (more.approach - less.approach), rtol=step**2)


def test_round_off_of_thin_and_unlike_layers_is_refused_by_its_name() -> None:
    """A film of ten million times the stiffness: the message names a tolerance above round-off."""
    film = IsotropicMaterial(young_modulus=2.1e18, poisson_ratio=0.3)
    asked = Scene(
        indenter=Paraboloid(radius=0.018, material=RIGID),
        body=Body(material=STEEL, layers=(Layer(thickness=2e-6, material=film),)),
        loading=(LoadStep(normal_force=1e3, increments=1),),
    )
    with pytest.raises(UnsupportedScene, match=r"round-off.* tolerance = 1e-0[89]"):
        radial.solve(asked)
    (end,) = radial.solve(asked, RadialDiscretisation(tolerance=1e-8)).steps
    assert end.worst_residual < 1e-8


# ---- histories, errors and files --------------------------------------------------------------


def test_rings_reach_beyond_the_largest_contact_and_the_work_adds_up() -> None:
    steps = tuple(LoadStep(normal_force=part * FORCE) for part in (0.1, 1.0, 0.5))
    contact = Scene(indenter=BALL, body=Body(material=STEEL), loading=steps)
    ends = radial.solve(contact).steps
    assert all(end.radii[-1] > 1.5 * ends[1].contact_radius for end in ends)
    loads, motions = np.transpose([(0.0, 0.0), *((e.normal_force, e.approach) for e in ends)])
    assert_allclose(ends[-1].trapezoidal_work, np.trapezoid(loads, motions), rtol=1e-9)


def test_a_peak_between_rings_is_found() -> None:
    profile = PowerLaw.model_construct(power=4.0, material=RIGID, layers=())
    made = disc(Bodies((), MODULUS), profile, 2e-3)
    few, many = np.linspace(0, 1, 6), np.linspace(0, 1, 4001)
    found = largest_pressure(made, few, pressure(made, few))
    assert_allclose(found, np.max(pressure(made, many)), rtol=1e-6)


def test_pressing_with_friction_takes_two_fifths_of_force_times_approach() -> None:
    """W grows as δ^(3/2): friction keeps the contact similar to itself."""
    contact = Scene(
        indenter=BALL,
        body=Body(material=STEEL),
        friction={"coefficient": 0.2},
        loading=({"normal_force": FORCE, "increments": 4},),
    )
    (end,) = radial.solve(contact).steps
    assert_allclose(end.input_work, 0.4 * FORCE * end.approach, rtol=2e-5)


def _scene(indenter: ShapedBody, body: Body, **step: Any) -> Scene:
    return Scene(indenter=indenter, body=body, loading=(LoadStep(**(step or {"normal_force": 1})),))


def _compliance(bodies: Bodies) -> Any:
    def compliance(k: Any) -> Any:
        added = sum(remainder_scalars(stack, k).c22 for stack in bodies.layered)
        return 2 / (k * bodies.modulus) + added

    return compliance


# ---- what is refused --------------------------------------------------------------------------

RUB = CoulombFriction(coefficient=0.1)
REFUSED = {
    "not axisymmetric": {"indenter": Ellipsoid(radii=(1e-2, 2e-2), material=RIGID)},
    "moment or a tilt": {"loading": (LoadStep(normal_force=1e3, moment=(1e-3, 0)),)},
    "rim": {"indenter": FlatPunch(radius=1e-3, material=RIGID), "friction": RUB},
    "separate within the contact": {
        "indenter": FlatPunch(radius=1e-3, material=RIGID),
        "body": coated(1e3, 5e-5),
        "loading": (LoadStep(normal_force=1e-6),),
    },
    "polynomials": {"body": coated(0.01, 1e-7), "loading": (LoadStep(normal_force=1e-3),)},
}


@pytest.mark.parametrize("reason", REFUSED)
def test_what_is_no_pressing_of_revolution_is_refused_by_name(reason: str) -> None:
    usual = {
        "indenter": BALL,
        "body": Body(material=STEEL),
        "loading": (LoadStep(normal_force=1e3),),
    }
    with pytest.raises(UnsupportedScene, match=reason):
        radial.solve(Scene(**(usual | REFUSED[reason])))


# ---- Torsion by the radial solver: closed forms, reversals, energies, layers, and what it ref


# a = 1, E* = π/2 and p_H = 1 on the bare body. Incompressible: it does not couple with a rigid one.
SOFT = IsotropicMaterial(young_modulus=0.75 * np.pi / 2, poisson_ratio=0.5)
FRICTION = 0.3
UNIT_BALL = Paraboloid(radius=1.0, material=RIGID)
BARE = Body(material=SOFT)
X = np.array([0.0, 1e-3, 0.1, 0.4, 0.7, 0.9, 0.999])


def incompressible(modulus: float, thickness: float) -> Body:
    layer = IsotropicMaterial(young_modulus=modulus * SOFT.young_modulus, poisson_ratio=0.5)
    return Body(material=SOFT, layers=(Layer(thickness=thickness, material=layer),))


def scene_of(body: Body, *steps: LoadStep, indenter: ShapedBody = UNIT_BALL, **more: Any) -> Scene:
    loading = (LoadStep(normal_force=2.0), *steps)
    friction = CoulombFriction(coefficient=FRICTION)
    return Scene(
        **({"indenter": indenter, "body": body, "loading": loading, "friction": friction} | more)
    )


def twisted(body: Body, indenter: ShapedBody = UNIT_BALL) -> tuple[Disc, Torsion]:
    """A contact of radius one."""
    scene = scene_of(body, indenter=indenter)
    approach = None if indenter.rim is None else 1.0
    contact = disc(Bodies.of(scene), indenter, 1.0, approach)
    return contact, Torsion.of(scene, contact, FRICTION)


@given(stick=st.floats(0.01, 0.999))
def test_a_ball_is_twisted_as_lubkin_says(stick: float) -> None:
    contact, torsion = twisted(BARE)
    ours = torsion.partial_slip(stick)
    exact = TorsionalPartialSlip(1.0, 1.0, FRICTION, SOFT.shear_modulus, stick)
    assert_allclose([ours.twist, ours.torque], [exact.twist, exact.moment], rtol=1e-12)
    shear = ours.shear(X, FRICTION * pressure(contact, X))
    assert_allclose(shear, exact.shear(X), rtol=0, atol=1e-12)


@given(modulus=st.floats(0.2, 5.0), thickness=st.floats(0.2, 3.0), stick=st.floats(0.11, 0.99))
def test_layers_twist_as_the_nystrom_method_says(
    modulus: float, thickness: float, stick: float
) -> None:
    contact, torsion = twisted(incompressible(modulus, thickness))
    G = SOFT.shear_modulus

    def limit(r: np.ndarray) -> np.ndarray:
        return FRICTION * pressure(contact, r.ravel()).reshape(r.shape)

    surface = TorsionalSurface(
        lambda k: one_layer(k, thickness, modulus * G, G), modulus * G, thickness
    )
    exact = CoatedTorsion(surface, 1.0, limit, stick)
    ours = torsion.partial_slip(stick)
    assert_allclose([ours.twist, ours.torque], [exact.twist, exact.torque], rtol=1e-10)


def _over_disc(state: PartialSlip, contact: Disc) -> tuple[np.ndarray, ...]:
    """r, q, u_θ and area weights, with nodes closer to the stick edge, to a rim and an axis."""
    v, w = np.polynomial.legendre.leggauss(80)
    u, w = (1 + v) / 2, w / 2
    parts = []
    for low, high in ((0.0, state.stick), (state.stick, 1.0)):
        smooth = u**4 * (35 - 84 * u + 70 * u**2 - 20 * u**3)
        parts.append((low + (high - low) * smooth, (high - low) * w * 140 * u**3 * (1 - u) ** 3))
    r, weights = (np.concatenate(some) for some in zip(*parts, strict=True))
    shear = state.shear(r, FRICTION * pressure(contact, r))
    return r, shear, state.twist * r + state.slip(r), 2 * np.pi * r * weights


SHAPES = {
    "ball": UNIT_BALL,
    "cone": Cone(slope_angle=0.1, material=RIGID),
    "punch": FlatPunch(radius=1.0, material=RIGID),
}


STIFF = incompressible(3.0, 0.5)


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("body", [BARE, STIFF])
def test_torque_and_energies_are_those_of_the_fields(shape: str, body: Body) -> None:
    contact, torsion = twisted(body, SHAPES[shape])
    state = torsion.partial_slip(0.6)
    r, shear, moved, area = _over_disc(state, contact)
    rtol = 1e-6
    assert_allclose(np.sum(area * shear * r), state.torque, rtol=rtol)
    assert_allclose(0.5 * np.sum(area * shear * moved), state.elastic_energy, rtol=rtol)
    lost = np.sum(area * shear * (state.twist * r - moved))
    assert_allclose(lost, state.dissipated, rtol=rtol)
    if (shape, body) != ("punch", STIFF):
        assert np.all(shear <= FRICTION * pressure(contact, r) * (1 + 1e-9))


# ---- histories --------------------------------------------------------------------------------


@given(amounts=st.lists(st.floats(-3.0, 3.0), min_size=1, max_size=6))
def test_twist_and_torque_lead_the_same_way(amounts: list[float]) -> None:
    torsion = twisted(BARE)[1]
    unit = torsion.partial_slip(0.5).twist
    assert unit > 0
    by_twist = by_torque = TwistPath(torsion)
    for amount in amounts:
        by_twist = by_twist.continue_to_twist(amount * unit)
        by_torque = by_torque.continue_to_torque(by_twist.torque)
        assert_allclose(by_torque.twist, by_twist.twist, rtol=1e-7, atol=1e-9 * unit)
        nearly = 1e-12 * abs(by_twist.work) + np.finfo(float).tiny
        assert by_twist.work >= by_twist.dissipated - nearly


def test_a_closed_loop_of_twist_loses_the_work_that_is_done_on_it() -> None:
    torsion = twisted(BARE)[1]
    far = 2 * torsion.partial_slip(0.5).twist
    first = TwistPath(torsion).continue_to_twist(far)
    again = first.continue_to_twist(-far).continue_to_twist(far)
    lost = again.dissipated - first.dissipated
    assert_allclose(again.work - first.work, lost, rtol=1e-9)
    assert lost > 3 * first.dissipated > 0


def test_beyond_its_limit_the_contact_turns_and_carries_no_more(tmp_path: Path) -> None:
    slippery = CoulombFriction(coefficient=0.01)
    steps = LoadStep(twist=0.9), LoadStep(twist=0.0)
    torsion = radial.solve(scene_of(BARE, *steps, friction=slippery))
    sliding, back = torsion.steps[1:]
    assert sliding.status is ContactStatus.GROSS_SLIDING
    carried = np.pi**2 / 8 * 0.01 * sliding.peak_pressure * sliding.contact_radius**3
    assert_allclose(sliding.torque, carried, rtol=1e-9)
    assert back.torque is not None
    assert_allclose(back.torque, -sliding.torque, rtol=1e-9)  # type: ignore[operator]
    errors = slipstick.stated_errors(torsion)
    slipstick.save(torsion, tmp_path / "out", figures="all", errors=errors)
    assert (tmp_path / "out" / "profiles.png").is_file()


def test_slip_that_does_not_begin_at_the_edge_is_refused() -> None:
    """A punch on a stiff layer presses little in the middle."""
    punch = FlatPunch(radius=1.0, material=SOFT, layers=STIFF.layers)
    with pytest.raises(UnsupportedScene, match="slips first within"):
        radial.solve(scene_of(STIFF, LoadStep(torque=0.45), indenter=punch))
