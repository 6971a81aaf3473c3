"""Finite-element basis of the displacements of a section.

A field ∝ cos n theta or sin n theta has the derivatives u/r, u_,r and u_,z, and factors n.
Integrals have the weight r. In plane strain the weight is 1, and u/r is replaced by 0: r and z are
then coordinates along and normal to the surface, and no field depends on the third one. The factors
2 pi and pi from the integral over the angle are contained in the resultants instead.
"""

from typing import Any

import numpy as np
from skfem import Basis, DiscreteField

from fem_reference.mesh.element_order import ELEMENTS
from fem_reference.mesh.section_mesh import SectionMesh

EXACT = 2 * ELEMENTS.degree + 1
"""Order of the quadrature that integrates every energy of rectangles exactly, with one Gauss point
more in each direction than the degree of the displacements."""


def displacement_basis(section: SectionMesh, quadrature: Any = None) -> Basis:
    """Create the finite-element basis of one displacement component on a meridional section.

    Integrals over the basis have the weight r (1 in plane strain). The attribute `grad` of the
    functions contains u/r (0 in plane strain) and the derivatives of u by r and by z, from which
    the strains follow.

    section     mesh of the meridional section of a body
    quadrature  points and weights on the unit square; None for exact integration of the energy
    """
    basis = Basis(section.mesh, ELEMENTS.element, intorder=EXACT, quadrature=quadrature)
    r, power = np.asarray(basis.global_coordinates())[0], section.outline.power
    basis.dx = basis.dx * r**power
    basis.basis = [
        (DiscreteField(np.array(u), np.stack([power * u / r, *u.grad])),) for (u,) in basis.basis
    ]
    return basis
