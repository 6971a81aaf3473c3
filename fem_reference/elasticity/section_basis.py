"""Bases of a section: biquadratic displacements, and pressures linear in an element.

A field ∝ cos n theta or sin n theta has, apart from n, the derivatives u/r, u_,r and u_,z.
Integrals have the weight r; the factors 2 pi and pi of the angle belong to the resultants.
"""

from typing import Any

import numpy as np
from skfem import Basis, DiscreteField, ElementQuad2
from skfem.element import Element
from skfem.refdom import RefQuad

from fem_reference.mesh.section_mesh import SectionMesh

EXACT = 5
"""Order of the 3 x 3 Gauss points, which integrate every energy exactly."""


class ElementQuadLinear(Element):  # type: ignore[misc]
    """1, r and z, counted from the middle of an element over its size; no more on its edges.

    What scikit-fem has on quadrilaterals is bilinear.
    """

    interior_dofs = 3
    nodal_dofs = facet_dofs = edge_dofs = 0
    maxdeg = 1
    dofnames = ("p", "p_r", "p_z")
    doflocs = np.full((3, 2), 0.5)
    refdom = RefQuad

    def gbasis(self, mapping: Any, X: Any, i: int, tind: Any = None) -> tuple[DiscreteField]:
        """Evaluate the basis function i at points; see `skfem.Element.gbasis`."""
        at = mapping.F(X, tind)
        if i == 0:
            return (DiscreteField(np.ones_like(at[0])),)
        quads = mapping.mesh.t if tind is None else mapping.mesh.t[:, tind]
        corners = mapping.mesh.p[i - 1, quads]
        middle, size = corners.mean(axis=0), np.ptp(corners, axis=0)
        return (DiscreteField((at[i - 1] - middle[:, None]) / size[:, None]),)


def displacement_basis(section: SectionMesh, quadrature: Any = None) -> Basis:
    """Create the basis of one component of the displacement, with u/r, u_,r and u_,z as `grad`.

    quadrature  points and weights on the unit square; None for exact integration
    """
    basis = Basis(section.mesh, ElementQuad2(), intorder=EXACT, quadrature=quadrature)
    r = np.asarray(basis.global_coordinates())[0]
    basis.dx = basis.dx * r
    basis.basis = [
        (DiscreteField(np.array(u), np.stack([u / r, *u.grad])),) for (u,) in basis.basis
    ]
    return basis


def pressure_basis(displacement: Basis) -> Basis:
    """Create the basis of the pressure, at the points and with the weights of that of the
    displacement."""
    basis = displacement.with_element(ElementQuadLinear())
    basis.dx = displacement.dx
    return basis
