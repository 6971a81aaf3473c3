"""Tractions that are linear in r between corner nodes: hat functions over the radius.

A hat function is one at its corner node, zero at all others and linear in between. Displacements of
the surface are at least linear on each element edge. Gap and slip are weighted with the hat
functions of the tractions. There are then no more contact conditions than the displacements can
meet. The pressure has no oscillations, and the matrix is symmetric.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from skfem import Basis, BilinearForm, ElementLineP1, LinearForm, MeshLine

from contact_scene.array_types import Field, Matrix
from fem_reference.mesh.element_order import ELEMENTS

# Order of the quadrature. It is exact for the products of basis functions, and accurate to
# round-off for smooth gaps.
ORDER = 11
SAME = 1e-9


@BilinearForm  # type: ignore[untyped-decorator]
def product(hat: Any, trace: Any, w: Any) -> Any:
    """Return the integrand φ ψ r of the integral over the radius r that scikit-fem assembles.

    In plane strain the integrand is φ ψ.

    φ is a hat function of the tractions and ψ a trace function of the displacements. The
    integrals convert tractions at rings to forces on surface nodes.

    hat, trace  values of φ and ψ at the quadrature points
    w           scikit-fem data, with r as the first coordinate `w.x[0]` and the power of r
    """
    return hat * trace * w.x[0] ** w.power


@dataclass(frozen=True)
class TractionBasis(ABC):
    """Basis functions φ_j of the radius whose sums represent the surface tractions, with integrals.

    There is one function for each of n rings. ψ_i are the trace functions of the m surface
    nodes of the displacement. In plane strain integrals are over dr, in place of r dr, on
    one half of the surface.

    radii     radii of the rings, whose tractions are the unknowns (n,) [length]
    products  ∫ ψ_i φ_j r dr (m, n) [length^2]
    weights   ∫ φ_j r dr (n,) [length^2]
    arms      ∫ φ_j r² dr (n,) [length^3]
    power     power of r in the integrals: 1, and 0 in plane strain
    """

    radii: Field
    products: Matrix
    weights: Field
    arms: Field
    power: int = 1

    def compliance(self, nodal: Matrix) -> Matrix:
        """Convert the compliance of the surface nodes to the compliance of the rings (n, n).

        The ring compliance Mᵀ C M contains the displacement, integrated over each function φ_i r
        dr, per unit traction at each ring. M is the matrix `products` of integrals.

        nodal  C, displacement per generalised force at the surface nodes (m, m) [length/force]
        """
        weak = self.products.T @ nodal @ self.products
        return np.asarray(weak)

    @abstractmethod
    def integrate(self, function: Callable[[Field], Field]) -> Field:
        """Compute the integral of f(r) φ_j(r) r dr for each traction basis function φ_j (n,).

        Used to average the undeformed gap over each function.

        function  f, a function of an array of radii
        """


class Hats(TractionBasis):
    """Traction basis of hat functions over the radius, one for each corner node on the surface.

    Used for the exact contact law, and for the penalty law at nodes.
    """

    def integrate(self, function: Callable[[Field], Field]) -> Field:
        """Compute the integral of f(r) φ_j(r) r dr for each hat function φ_j of the tractions (n,).

        Used to average the undeformed gap over each function.

        function  f, a function of an array of radii
        """
        return _integrate_with_hats(_hat_basis(self.radii), function, self.power)


def corners_under(nodes: Field, reach: float) -> int:
    """Count the corner nodes on the surface from the axis out to a given radius.

    Used to end the tractions at the rim of the indenter.

    nodes  radii of all nodes on the surface, the first and the last at corners [length]
    reach  outer radius [length]
    """
    return int(np.count_nonzero(nodes[:: ELEMENTS.degree] <= reach * (1 + SAME)))


def hats_on(nodes: Field, reach: float = np.inf, power: int = 1) -> Hats:
    """Create the hat functions on surface nodes, from the axis to the corner node at a radius.

    The last corner has half a hat function, because no traction acts beyond it.

    nodes  radii of all nodes on the surface, the first and the last at corners (m,) [length]
    reach  outer radius of the tractions; infinite for all nodes [length]
    power  power of r in the integrals: 1, and 0 in plane strain
    """
    radii = nodes[:: ELEMENTS.degree][: corners_under(nodes, reach)]
    hats = _hat_basis(radii)
    traces = hats.with_element(ELEMENTS.trace)
    outwards = np.argsort(traces.doflocs[0])
    products = np.zeros((len(nodes), len(radii)))
    products[: traces.N] = product.assemble(hats, traces, power=power).toarray()[outwards]
    # The sum of all trace functions is 1, so that a column sum is the integral of a hat.
    arms = _integrate_with_hats(hats, lambda r: r, power)
    return Hats(radii, products, products.sum(axis=0), arms, power)


def _hat_basis(radii: Field) -> Basis:
    return Basis(MeshLine(radii), ElementLineP1(), intorder=ORDER)


def _integrate_with_hats(hats: Basis, function: Callable[[Field], Field], power: int) -> Field:
    """Compute ∫ f φ_j rᵐ dr for all hat functions φ_j (n,), with m = `power`:
    1, and 0 in plane strain."""
    load = LinearForm(lambda hat, w: function(np.asarray(w.x[0])) * hat * w.x[0] ** power)
    return np.asarray(load.assemble(hats))
