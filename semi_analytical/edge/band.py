"""The cells along the edge of a region."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from semi_analytical.edge.fit import Indices
from semi_analytical.edge.shape import depth_of
from semi_analytical.edge.touching import Touching
from semi_analytical.part import Part

Field = NDArray[np.float64]
Mask = NDArray[np.bool_]

# Layers of cells inside the edge. Farther in a traction is a slope within a cell, to 1/500 of it;
# outside of the cells that touch the region it is zero.
INSIDE = 5.5
# Layers up to which it is what the fit says; farther in second differences tell as much. They fade
# out, as an end of them would show in the pressure of the next cells.
FITTED = 2.5


@dataclass(frozen=True)
class Band:
    """Cells along the edge of a region (nx, ny), by their distance from the nearest outside.

    depth     (nx, ny) that distance
    inner     cells (i, j) inside that are fitted
    touching  those outside, which have the fits of these
    deep      those farther in, and how much of their second differences they have
    """

    region: Mask
    depth: Field
    inner: tuple[Indices, Indices]
    touching: Touching
    deep: tuple[Indices, Indices]
    fade: Field

    @classmethod
    def of(cls, region: Mask, part: Part) -> Band:
        """On a part of the window."""
        depth = depth_of(region, part)
        i, j = np.nonzero(region & (depth <= FITTED))
        # Those that the edge cuts first, and then those where no part is cut.
        order = np.argsort(depth[i, j], kind="stable")
        inner = i[order], j[order]
        around = part.framed(region, 1)
        along = around[:-2] | around[1:-1] | around[2:]
        touched = along[:, :-2] | along[:, 1:-1] | along[:, 2:]
        outer_i, outer_j = np.nonzero(touched & ~region)
        touching = Touching.of(outer_i, outer_j, inner, region.shape, part)
        deep_i, deep_j = np.nonzero((depth > FITTED) & (depth <= INSIDE))
        fade = (INSIDE - depth[deep_i, deep_j]) / (INSIDE - FITTED)
        return cls(region, depth, inner, touching, (deep_i, deep_j), fade)

    @property
    def fitted(self) -> tuple[Indices, Indices]:
        """Cells (i, j) outside and then inside that are fitted."""
        return (
            np.concatenate([self.touching.i, self.inner[0]]),
            np.concatenate([self.touching.j, self.inner[1]]),
        )
