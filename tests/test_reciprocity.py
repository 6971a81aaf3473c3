"""Tests of reciprocity (Betti): two loads do the same work on the displacements of each other."""

import numpy as np
import pytest
from contact_scenes import (
    LIMIT,
    LOAD,
    PRESS,
    A,
    grid,
    paraboloid,
    push,
    scene,
    steel,
)
from coupled_scenes import scene as coupled_scene
from fem_scenes import elements
from numpy.testing import assert_allclose

from fem_reference.compliance.ring_compliance import ring_compliance as element_compliance
from fem_reference.model import ContactModel
from fem_reference.plan import Path
from radial.frictional.coupling import Coupling
from radial.tangential.ring_compliance import ring_compliance
from semi_analytical import solve
from semi_analytical.influence.bodies import influence_coefficients
from semi_analytical.operator.domain import WINDOW
from semi_analytical.operator.operator import DisplacementOperator
from semi_analytical.operator.transforms import Convolutions, offsets_for

HIGHEST = 4
NODES = (0.0, 0.1, 0.22, 0.3, 0.5, 0.8, 0.95, 1.0, 1.3)
PRESSED = coupled_scene(PRESS, friction=None, indenter=paraboloid(steel(0.1)))


def test_reciprocity_of_tractions_on_cells(rng):
    """The layers couple shear and pressure: each does work on the displacement by the other."""
    shape, spacing = (13, 8), (0.3 * A, 0.17 * A)
    bodies = PRESSED.body, PRESSED.indenter
    K = influence_coefficients(*bodies, spacing, offsets_for(shape))
    operator = DisplacementOperator(K, shape, WINDOW, Convolutions())
    one, other = rng.standard_normal((2, 3, *shape))
    by_one, by_other = operator.together(one), operator.together(other)
    scale = np.sqrt(np.sum(one * by_one) * np.sum(other * by_other))
    assert np.sum(one * by_other) == pytest.approx(np.sum(other * by_one), abs=1e-12 * scale)


def test_reciprocity_of_tractions_on_rings():
    found = ring_compliance(Coupling.of(PRESSED), NODES, 1.3 * A, HIGHEST)
    assert_allclose(found, found.transpose(0, 2, 1, 4, 3), atol=1e-14 * np.max(np.abs(found)))


@pytest.mark.parametrize("at_gauss_points", [False, True])
def test_reciprocity_of_tractions_on_elements(at_gauss_points):
    model = ContactModel.of(PRESSED, elements(8), A)
    for found in element_compliance(model, Path.HARMONICS, HIGHEST, at_gauss_points).harmonics:
        largest = np.max(np.abs(found))
        assert_allclose(found, found.transpose(2, 3, 0, 1), rtol=0, atol=1e-10 * largest)


def test_reciprocity_of_force_and_torque():
    """A contact beside the origin that sticks: what a force turns, a torque shifts."""
    beside = {**PRESS, "moment": (0.4 * A * LOAD, 0.0), "torque": 0.0}
    torque = 0.1 * 3 * np.pi / 16 * LIMIT * A

    def end(more):
        return solve(scene(beside, more, friction=50.0), grid(32, 2.0), 1e-9).steps[-1]

    pushed, turned = end(push(0.1)), end({"torque": torque})
    by_force = pushed.twist / pushed.tangential_force[0]
    by_torque = turned.tangential_shift[0] / turned.torque
    assert abs(by_force) > 0
    assert by_force == pytest.approx(by_torque, rel=1e-6)
