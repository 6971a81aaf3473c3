"""Influence coefficients of a layered body: integrals of its point response over the loaded cell.

The rule of integration depends on the distance from the loaded cell and is exact to rounding:

    at the origin   closed form of the outer material plus Gauss points for the smooth remainder;
    near            Gauss points on boxes that are small compared with their distance;
    far             nine-point average along x and y of the response at cell centres.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property, partial
from math import hypot
from pathlib import Path

import numpy as np
import scipy

from contact_scene.array_types import Field
from contact_scene.disk_cache import sources_digest
from semi_analytical.frf.stack import Stack
from semi_analytical.influence.closed_form import HalfSpaceCoefficients
from semi_analytical.influence.coefficients import PARITY
from semi_analytical.influence.layered_cells import MARGIN, cell_integrals, integrals_near
from semi_analytical.influence.layered_response import (
    half_space_response,
    point_response,
    remainder_table,
)
from semi_analytical.influence.radial_table import RadialTable

# Cache of arrays: key, shape and function that computes the array.
Remember = Callable[[str, tuple[int, ...], Callable[[], Field]], Field]

PACKAGE = Path(__file__).resolve().parents[1]
# Folders whose sources determine the coefficients.
FOLDERS = ("frf", "influence")
LIBRARIES = (np.__version__, scipy.__version__)


@dataclass(frozen=True)
class LayeredCoefficients:
    """Influence coefficients of layers on a half-space or a rigid base, exact up to rounding.

    The coefficients are surface displacements per unit traction on one cell [length^3/force]. Their
    error is about 1e-15 of the value at the loaded cell (1e-12 if the cell is large compared with
    the layers on a rigid base). Each component is computed on first use.

    stack     body with at least one layer
    spacing   cell sides [length]
    shape     number of offsets along x and y, including zero
    remember  cache of arrays, for instance `disk_cache.cached_array`
    """

    stack: Stack
    spacing: tuple[float, float]
    shape: tuple[int, int]
    remember: Remember = lambda identity, shape, compute: compute()
    _known: dict[str, Field] = field(default_factory=dict, init=False, repr=False, compare=False)

    def __getitem__(self, component: str) -> Field:
        """Return one component of the influence coefficients of a layered body at all cell offsets
        (nx, ny).

        The coefficients are surface displacements per unit traction on one cell [length^3/force].
        They come from the cache if it contains them.

        component  displacement and traction, e.g. "zx" for the normal displacement by the shear q_x
        """
        if component not in self._known:
            (dx, dy), (nx, ny) = self.spacing, self.shape
            given = (self.stack.layers, self.stack.base, float(dx), float(dy), int(nx), int(ny))
            sources = sources_digest(PACKAGE, FOLDERS, LIBRARIES)
            identity = repr((sources, component, *given))
            compute = partial(self._integrate_component, component)
            self._known[component] = self.remember(identity, (nx, ny), compute)
        return self._known[component]

    @cached_property
    def _remainder_table(self) -> RadialTable:
        """Table of the displacement under a point force that the layers add to a half-space,
        to the farthest point of the integration over cells."""
        sides = ((n + MARGIN) * d for n, d in zip(self.shape, self.spacing, strict=True))
        return remainder_table(self.stack, hypot(*sides))

    def _integrate_component(self, component: str) -> Field:
        """Integrate the surface displacement under a point force over the loaded cell, for all
        offsets.

        The result (nx, ny) is one component of the influence coefficients [length^3/force].

        component  displacement and force, e.g. "zx"
        """
        outer, parity, by_layers = self.stack.outer, PARITY[component], self._remainder_table
        response = partial(point_response, component, by_layers, half_space_response(outer))
        (result,) = cell_integrals(response, [parity], self.spacing, self.shape)
        if parity == (1, 1):
            # The singularity of the half-space lies in the loaded cell.
            smooth = partial(point_response, component, by_layers, np.zeros(4))
            clearance, own = 2 * self.stack.layers[0].thickness, np.zeros((1, 2), dtype=int)
            result[0, 0] = np.sum(integrals_near(smooth, own, self.spacing, clearance))
            half_space = HalfSpaceCoefficients(self.spacing, (1, 1), *outer)
            result[0, 0] += half_space[component][0, 0]
        return result
