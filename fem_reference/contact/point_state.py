"""The state of a contact on points at the end of an increment."""

from dataclasses import dataclass

import numpy as np

from contact_scene.array_types import Field, Mask, Vector
from contact_scene.quantities.residuals import Residuals
from contact_scene.quantities.summary import ContactStatus


@dataclass(frozen=True)
class PointState:
    """Converged fields; vectors (2, points) are components r and θ, on Path.SHEARING x alone.

    axisymmetric       true if points are whole rings
    displacement       u_t of the bodies [length]; with the motion the history of the next increment
    multiplier         tractions without springs, r, θ, z (3, points); zero for the exact law
    edge_tractions     r, θ, z (3, points) that determine the edges of contact and stick: of the
                       first pass of a penalty that does not move them, because later passes
                       oscillate there
    gap                between the bodies, negative for an overlap [length]
    slip               since the start, of the lower body's particles relative to the indenter's
                       [length]
    load               tangential force [force] or torque [force length]
    motion             shift [length] or twist [radian]; None at the friction limit under a load
    dissipated_energy  None if the motion is None
    overlap            largest overlap by springs [length]
    moved              largest mean tangential displacement so far, weighted with the shear [length]
    outer_iterations, solves
                       numbers of alternating iterations and of linear systems
    augmentations      number of updates of the multipliers
    strain             of the lower body since first contact, equal in all directions
    algorithm                algorithm for pressure and shear; None if they are not coupled
    """

    axisymmetric: bool
    pressure: Vector
    shear: Field
    displacement: Field
    multiplier: Field
    edge_tractions: Field
    gap: Vector
    slip: Field
    in_stick: Mask
    status: ContactStatus
    normal_force: float
    approach: float
    load: float
    motion: float | None
    dissipated_energy: float | None
    residuals: Residuals
    overlap: float = 0.0
    moved: float = 0.0
    outer_iterations: int = 0
    solves: int = 0
    augmentations: int = 0
    strain: float = 0.0
    algorithm: str | None = None

    @property
    def tractions(self) -> Field:
        """Shear and pressure, r, θ, z (3, points)."""
        return np.concatenate([self.shear, self.pressure[None]])


def length(vectors: Field) -> Vector:
    """Compute the length of each vector of (2, points)."""
    return np.asarray(np.sqrt(vectors[0] ** 2 + vectors[1] ** 2))


def longest(vectors: Field) -> float:
    """Compute the length of the longest vector of (2, points)."""
    return float(np.max(length(vectors)))
