"""Tests of the order of the finite elements: nodes, polynomials, and contacts by another order."""

from dataclasses import replace

import numpy as np
import pytest
from processes import run

from fem_reference.mesh import element_order
from fem_reference.mesh.element_order import BIQUADRATIC, lagrange_polynomials

CORNERS = np.array([0.0, 0.3, 1.0, 1.2])
# Modules read the order when they are imported, so that a new process replaces it before.
BY_BILINEAR_ELEMENTS = """
import sys
from dataclasses import replace
from importlib.util import module_from_spec, spec_from_file_location

from skfem import ElementLineP1, ElementQuad1

name = "fem_reference.mesh.element_order"
spec = spec_from_file_location(name, sys.argv[1])
orders = sys.modules[name] = module_from_spec(spec)
spec.loader.exec_module(orders)
orders.ELEMENTS = replace(
    orders.BIQUADRATIC,
    degree=1,
    element=ElementQuad1(),
    trace=ElementLineP1(),
    strains=(0.5,),
    kind="quad",
    cells=((0, 1, 2, 3),),
)

from contact_scenes import A, LIMIT, LOAD, MU, NU, RADIUS, YOUNG, hertz, push, scene, steel
from fem_reference import Method
from fem_reference.stress import SurfaceTractions, subsurface
from fem_scenes import elements, end
from verification.closed_forms.cattaneo_mindlin import PartialSlip
from verification.closed_forms.hertz import PointContact, contact_modulus, tangential_modulus

exact = hertz()
modulus = tangential_modulus((YOUNG, NU), (YOUNG, NU))
slipping = PartialSlip(LOAD, A, MU, modulus, 0.6 * LIMIT)
pushed = scene({"normal_force": LOAD}, push(0.6))
for law in Method:
    found = end(pushed, law=law)
    print(found.approach / exact.approach, found.contact_radius / A)
    print(found.tangential_shift[0] / slipping.shift, found.stick_radius / slipping.stick_radius)
incompressible = end(scene({"normal_force": LOAD}, friction=None, body=steel(0.5)))
stiffness = contact_modulus((YOUNG, 0.5), (YOUNG, NU))
print(incompressible.approach / PointContact.under_load(LOAD, RADIUS, stiffness).approach)
below = subsurface(pushed.body, SurfaceTractions.of(found), elements(16))
print(-below.stress()[2, below.axis[0]] / exact.peak_pressure)
"""


@pytest.mark.parametrize("degree", [1, 2, 3])
def test_nodes_divide_edges_and_determine_polynomials_of_the_degree(degree):
    order = replace(BIQUADRATIC, degree=degree)
    nodes = order.nodes(CORNERS)
    assert nodes[::degree] == pytest.approx(CORNERS)
    assert np.diff(nodes) == pytest.approx(np.repeat(np.diff(CORNERS) / degree, degree))
    x = np.array([0.1, 0.7, 1.0])
    assert lagrange_polynomials(order.places, x) @ order.places**degree == pytest.approx(x**degree)
    assert len(set(order.pressures)) == degree * (degree + 1) // 2
    assert {sum(powers) for powers in order.pressures} == set(range(degree))


def test_contacts_by_another_order_need_its_record_only(tmp_path):
    """Bilinear elements, 16 over the radius, agree with Hertz and Cattaneo-Mindlin."""
    ran = run(tmp_path, element_order.__file__, program=BY_BILINEAR_ELEMENTS)
    assert ran.code == 0, ran.said
    *ratios, stress = map(float, ran.out.split())
    assert len(ratios) == 9
    assert ratios == pytest.approx(np.ones(9), abs=0.01)
    assert abs(ratios[0] - 1.0) > 4e-3  # of the approach; of biquadratic elements 6e-4
    # The stress is that at the middles of elements, which are 1/32 of the radius.
    assert stress == pytest.approx(1.0, abs=1 / 32)
