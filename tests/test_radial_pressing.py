"""Tests of pressing by the radial solver: closed forms of half-spaces and of layers."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

import radial
from contact_scene import (
    RIGID,
    Body,
    Cone,
    FlatPunch,
    IsotropicMaterial,
    Layer,
    LoadStep,
    Paraboloid,
    RadialDiscretisation,
    Scene,
)
from contact_scene.geometry import ShapedBody
from contact_scene.solver_errors import UnsupportedScene
from radial.normal.disc import (
    disc,
)
from radial.normal.surface import (
    displacement,
    largest_pressure,
    pressure,
)
from radial.response.bodies import Bodies

STEEL = IsotropicMaterial(young_modulus=210e9, poisson_ratio=0.3)
MODULUS = STEEL.plane_strain_modulus
FORCE = 1e3
RADIUS = 18e-3
BALL = Paraboloid(radius=RADIUS, material=RIGID)


def scene_of(indenter, body, force):
    return Scene(indenter=indenter, body=body, loading=(LoadStep(normal_force=force),))


def coated(modulus, thickness, ratio=0.3, base=None):
    """A layer on a substrate of unit modulus E/(1 - ν²), lengths in the units of the scene."""
    substrate = IsotropicMaterial(young_modulus=0.91, poisson_ratio=0.3)
    layer = IsotropicMaterial(young_modulus=0.91 * modulus, poisson_ratio=ratio)
    return Body(material=base or substrate, layers=(Layer(thickness=thickness, material=layer),))


class PowerLaw(ShapedBody):
    """r^k / k in metres: a shape that says little of itself but its gap."""

    power: float

    @property
    def is_of_revolution(self) -> bool:
        return True

    def initial_gap(self, x, y):
        return np.hypot(x, y) ** self.power / self.power


@pytest.mark.parametrize("power", [1.0, 2.0, 3.0, 4.0, 6.0])
def test_any_smooth_profile_is_pressed_as_sneddon_says(power):
    """δ = S(a) and W = 2E* ∫ (δ - S) ds, with S(s) = sᵏ ½√π Γ(k/2)/Γ((k+1)/2)."""
    bodies = Bodies((), MODULUS)
    a = 2e-3
    made = disc(bodies, PowerLaw.model_construct(power=power, material=RIGID, layers=()), a)
    at_edge = (
        a**power * math.sqrt(math.pi) / 2 * math.gamma(power / 2) / math.gamma((power + 1) / 2)
    )
    assert_allclose(made.approach, at_edge, rtol=1e-11)
    assert_allclose(made.load, 2 * MODULUS * a * at_edge * power / (power + 1), rtol=1e-11)


@given(modulus=st.floats(0.05, 20.0), thickness=st.floats(0.05, 5.0))
def test_the_surface_touches_where_there_is_pressure(modulus, thickness):
    """The displacement just outside meets the indenter, by another integral than the equation's;
    the gap opens from there as a power of three halves."""
    bodies = Bodies.of(scene_of(BALL, coated(modulus, thickness), 1.0))
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
def test_what_is_stored_is_the_work_of_the_load(indenter, body):
    """dU = W dδ, by differences of neighbouring loads."""
    force, step = FORCE if body.layers == () else 1e-6, 1e-3
    less, more = (
        radial.solve(scene_of(indenter, body, f * force)).steps[-1] for f in (1 - step, 1 + step)
    )
    stored = more.elastic_energy - less.elastic_energy
    assert_allclose(stored, force * (more.approach - less.approach), rtol=step**2)


def test_round_off_of_thin_and_unlike_layers_is_refused_by_its_name():
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


def test_a_peak_between_rings_is_found():
    profile = PowerLaw.model_construct(power=4.0, material=RIGID, layers=())
    made = disc(Bodies((), MODULUS), profile, 2e-3)
    few, many = np.linspace(0, 1, 6), np.linspace(0, 1, 4001)
    found = largest_pressure(made, few)
    assert_allclose(found, np.max(pressure(made, many)), rtol=1e-6)


@pytest.mark.parametrize("power", [1.0, 4.0])
def test_the_peak_of_a_contact_within_the_first_ring_grows_with_its_mean(power):
    """A gap ∝ r^k keeps the contact similar to itself, also if no ring of output lies inside."""
    indenter = PowerLaw.model_construct(power=power, material=RIGID, layers=())
    if power == 1:
        indenter = Cone(slope_angle=0.05, material=RIGID)
    loading = tuple(LoadStep(normal_force=share * FORCE) for share in (1.0, 1e-12))
    whole, small = radial.solve(
        Scene.model_construct(indenter=indenter, body=Body(material=STEEL), loading=loading)
    ).steps
    assert whole.radii[1] > small.contact_radius > 0
    means = [end.normal_force / end.contact_area for end in (whole, small)]
    assert_allclose(small.peak_pressure / means[1], whole.peak_pressure / means[0], rtol=1e-6)


def test_pressing_with_friction_takes_two_fifths_of_force_times_approach():
    """W grows as δ^(3/2): friction keeps the contact similar to itself."""
    contact = Scene(
        indenter=BALL,
        body=Body(material=STEEL),
        friction={"coefficient": 0.2},
        loading=({"normal_force": FORCE, "increments": 4},),
    )
    (end,) = radial.solve(contact).steps
    assert_allclose(end.input_work, 0.4 * FORCE * end.approach, rtol=2e-5)
