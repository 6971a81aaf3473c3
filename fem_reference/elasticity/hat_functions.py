"""Tractions that are linear between corner nodes: hat functions over the radius.

Displacements of the surface are quadratic on an element, tractions linear, and gap and slip are
tested with the same hats: no more conditions than the displacement can meet, so that the pressure
does not ripple and the matrix stays symmetric.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from skfem import Basis, BilinearForm, ElementLineP1, ElementLineP2, LinearForm, MeshLine

from contact_scene.array_types import Field, Matrix

# Order of the integrals: exact for the products below, and for smooth gaps to round-off.
ORDER = 11
SAME = 1e-9


@BilinearForm  # type: ignore[untyped-decorator]
def product(hat: Any, trace: Any, w: Any) -> Any:
    """Return φ ψ r."""
    return hat * trace * w.x[0]


@dataclass(frozen=True)
class TractionBasis(ABC):
    """Functions φ of the radius that span the tractions, and their products with the trace ψ.

    radii     (n,) of the rings whose values are the unknowns [length]
    products  ∫ ψ_i φ_j r dr (m, n) [length^2]
    weights   ∫ φ r dr (n,) [length^2]
    arms      ∫ φ r² dr (n,) [length^3]
    """

    radii: Field
    products: Matrix
    weights: Field
    arms: Field

    def compliance(self, nodal: Matrix) -> Matrix:
        """Compute displacements, integrated over φ, per traction at the rings: Mᵀ C M.

        nodal  displacement per generalised force at the nodes (m, m)
        """
        weak = self.products.T @ nodal @ self.products
        return np.asarray(weak)

    @abstractmethod
    def of(self, function: Callable[[Field], Field]) -> Field:
        """Integrate f(r) φ(r) r dr over the radius, for each basis function φ."""


class Hats(TractionBasis):
    """Hat functions of the corner nodes."""

    def of(self, function: Callable[[Field], Field]) -> Field:
        """Integrate f(r) φ(r) r dr over the radius, for each basis function φ."""
        return _integrals(_hat_basis(self.radii), function)


def corners_under(nodes: Field, reach: float) -> int:
    """Count the corners from the axis out to a radius; corners have the even indices of `nodes`."""
    return int(np.count_nonzero(nodes[::2] <= reach * (1 + SAME)))


def hats_on(nodes: Field, reach: float = np.inf) -> Hats:
    """Return the hats on nodes (corner and midside alternating), up to the corner at `reach`.

    The last corner has half a hat: no traction acts beyond it.
    """
    radii = nodes[::2][: corners_under(nodes, reach)]
    hats = _hat_basis(radii)
    traces = hats.with_element(ElementLineP2())
    outwards = np.argsort(traces.doflocs[0])
    products = np.zeros((len(nodes), len(radii)))
    products[: traces.N] = product.assemble(hats, traces).toarray()[outwards]
    # The sum of the quadratics is 1.
    return Hats(radii, products, products.sum(axis=0), _integrals(hats, lambda r: r))


def _hat_basis(radii: Field) -> Basis:
    return Basis(MeshLine(radii), ElementLineP1(), intorder=ORDER)


def _integrals(hats: Basis, function: Callable[[Field], Field]) -> Field:
    """Return ∫ f φ r dr of every hat."""
    load = LinearForm(lambda hat, w: function(np.asarray(w.x[0])) * hat * w.x[0])
    return np.asarray(load.assemble(hats))
