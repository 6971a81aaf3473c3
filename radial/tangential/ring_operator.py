"""Linear maps between vectors at points on rings that do not couple angular harmonics."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from contact_scene.array_types import Array


@dataclass(frozen=True, eq=False)
class RingOperator:
    """Symmetric linear map between vectors at the points of n rings × `count` angles.

    transform  transform of the components r, θ, z from values at the angles of a ring to
               amplitudes of harmonics (3, harmonics, count)
    matrices   matrices between the nodes of the radius for each harmonic (harmonics, 3, 3, n, n)
    """

    transform: Array
    matrices: Array

    def __call__(self, vectors: Array) -> Array:
        """Apply the map to vectors at the points (…, 3, n count).

        The products are those of the harmonics, which are fewer than those of `matrix`.
        """
        (_, harmonics, count), nodes = self.transform.shape, self.matrices.shape[-1]
        values = vectors.reshape(-1, 3, nodes, count).swapaxes(2, 3)
        amplitudes = (self.transform @ values).transpose(2, 1, 3, 0)
        found = self._flat @ amplitudes.reshape(harmonics, 3 * nodes, -1)
        found = found.reshape(harmonics, 3, nodes, -1).transpose(3, 1, 2, 0)
        return np.asarray(found @ self.transform).reshape(vectors.shape)

    @cached_property
    def _flat(self) -> Array:
        """Matrices with components and nodes in one index (harmonics, 3 n, 3 n)."""
        nodes = self.matrices.shape[-1]
        return np.ascontiguousarray(self.matrices.swapaxes(2, 3)).reshape(-1, 3 * nodes, 3 * nodes)

    @cached_property
    def matrix(self) -> Array:
        """Matrix between all points (3 n count, 3 n count); components are outermost."""
        (_, harmonics, angles), nodes = self.transform.shape, self.matrices.shape[-1]
        whole = np.empty((3, nodes, angles, 3, nodes, angles))
        for a, b in np.ndindex(3, 3):
            both = (self.transform[a, :, :, None] * self.transform[b, :, None]).reshape(
                harmonics, -1
            )
            block = self.matrices[:, a, b].reshape(harmonics, -1).T @ both
            whole[a, :, :, b] = block.reshape(nodes, nodes, angles, angles).swapaxes(1, 2)
        return whole.reshape(3 * nodes * angles, -1)

    @cached_property
    def diagonal(self) -> Array:
        """Diagonal of `matrix` (3 n count,)."""
        own = np.einsum("haaii->hai", self.matrices)
        return np.asarray(np.einsum("ahj,hai->aij", self.transform**2, own)).ravel()
