"""Tests of torsion by the radial solver: energies of the fields, control, limit and refusal."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

import radial
from contact_scene import (
    RIGID,
    Body,
    Cone,
    CoulombFriction,
    FlatPunch,
    IsotropicMaterial,
    Layer,
    LoadStep,
    Paraboloid,
    Scene,
)
from contact_scene.geometry import ShapedBody
from contact_scene.solver_errors import UnsupportedScene
from radial.normal.disc import (
    Disc,
    disc,
)
from radial.normal.surface import (
    pressure,
)
from radial.response.bodies import Bodies
from radial.torsion.torsion import (
    PartialSlip,
    Torsion,
)
from radial.torsion.twist_path import TwistPath

# a = 1, E* = π/2 and p_H = 1 on the bare body. Incompressible: it does not couple with a rigid one.
SOFT = IsotropicMaterial(young_modulus=0.75 * np.pi / 2, poisson_ratio=0.5)
FRICTION = 0.3
UNIT_BALL = Paraboloid(radius=1.0, material=RIGID)
BARE = Body(material=SOFT)


def incompressible(modulus: float, thickness: float) -> Body:
    layer = IsotropicMaterial(young_modulus=modulus * SOFT.young_modulus, poisson_ratio=0.5)
    return Body(material=SOFT, layers=(Layer(thickness=thickness, material=layer),))


def scene_of(body, *steps, indenter=UNIT_BALL, **more):
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
def test_torque_and_energies_are_those_of_the_fields(shape, body):
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


def test_a_closed_loop_of_twist_loses_the_work_that_is_done_on_it():
    torsion = twisted(BARE)[1]
    far = 2 * torsion.partial_slip(0.5).twist
    first = TwistPath(torsion).continue_to_twist(far)
    again = first.continue_to_twist(-far).continue_to_twist(far)
    lost = again.dissipated - first.dissipated
    assert_allclose(again.work - first.work, lost, rtol=1e-9)
    assert lost > 3 * first.dissipated > 0


def test_slip_that_does_not_begin_at_the_edge_is_refused():
    """A punch on a stiff layer presses little in the middle."""
    punch = FlatPunch(radius=1.0, material=SOFT, layers=STIFF.layers)
    with pytest.raises(UnsupportedScene, match="slips first within"):
        radial.solve(scene_of(STIFF, LoadStep(torque=0.45), indenter=punch))
