"""Finite-element bases of a section: biquadratic displacements and element-wise linear pressures.

A field ∝ cos n theta or sin n theta has the derivatives u/r, u_,r and u_,z, and factors n.
Integrals have the weight r. The factors 2 pi and pi from the integral over the angle are contained
in the resultants instead.
"""

from typing import Any

import numpy as np
from skfem import Basis, DiscreteField, ElementQuad2
from skfem.element import Element
from skfem.refdom import RefQuad

from fem_reference.mesh.section_mesh import SectionMesh

EXACT = 5
"""Order of the quadrature with 3 x 3 Gauss points, which integrates every energy exactly."""


class ElementQuadLinear(Element):  # type: ignore[misc]
    """Discontinuous linear element on quadrilaterals, for the pressure.

    The functions are 1, r and z. r and z are measured from the middle of the element and divided by
    the size of the element. All 3 degrees of freedom are interior. The linear functions of
    scikit-fem on quadrilaterals are bilinear and therefore not suitable.
    """

    interior_dofs = 3
    nodal_dofs = facet_dofs = edge_dofs = 0
    maxdeg = 1
    dofnames = ("p", "p_r", "p_z")
    doflocs = np.full((3, 2), 0.5)
    refdom = RefQuad

    def gbasis(self, mapping: Any, X: Any, i: int, tind: Any = None) -> tuple[DiscreteField]:
        """Evaluate one basis function of the pressure for scikit-fem, at points of the elements.

        The functions are 1, r and z, relative to the middle and the size of the element. The other
        arguments and the result are those of `skfem.Element.gbasis`.

        mapping, X, tind
           map from the unit square to the elements, points in the unit square, and indices of the
           elements; None for all elements
        i  index of the function: 0 for 1, 1 for r, 2 for z
        """
        at = mapping.F(X, tind)
        if i == 0:
            return (DiscreteField(np.ones_like(at[0])),)
        quads = mapping.mesh.t if tind is None else mapping.mesh.t[:, tind]
        corners = mapping.mesh.p[i - 1, quads]
        middle, size = corners.mean(axis=0), np.ptp(corners, axis=0)
        return (DiscreteField((at[i - 1] - middle[:, None]) / size[:, None]),)


def displacement_basis(section: SectionMesh, quadrature: Any = None) -> Basis:
    """Create the basis of one displacement component on a meridional section of a body.

    Integrals over the basis have the weight r. The attribute `grad` of the functions contains u/r,
    u_,r and u_,z.

    quadrature  points and weights on the unit square; None for exact integration of the energy
    """
    basis = Basis(section.mesh, ElementQuad2(), intorder=EXACT, quadrature=quadrature)
    r = np.asarray(basis.global_coordinates())[0]
    basis.dx = basis.dx * r
    basis.basis = [
        (DiscreteField(np.array(u), np.stack([u / r, *u.grad])),) for (u,) in basis.basis
    ]
    return basis


def pressure_basis(displacement: Basis) -> Basis:
    """Create the finite-element basis of the pressure for a given displacement basis.

    The pressure is linear in each element and discontinuous between elements. The quadrature points
    and weights are those of the displacement basis.
    """
    basis = displacement.with_element(ElementQuadLinear())
    basis.dx = displacement.dx
    return basis
