"""The state of a contact on points (r, θ), and how well it fulfils its equations."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from contact_scene.residuals import Residuals
from contact_scene.summary import ContactStatus
from fem_reference.contact.friction_limit import contact_status
from fem_reference.contact.harmonics.point_compliance import PointCompliance
from fem_reference.residuals import over

Field = NDArray[np.float64]
Vector = NDArray[np.float64]
Mask = NDArray[np.bool_]

# Of the approach: tangential displacements below are round-off of bodies that do not couple.
ROUND_OFF = 1e-6


@dataclass(frozen=True)
class PointState:
    """Converged fields at the end of an increment; vectors (2, points) are (r, θ) components.

    limit              friction limit µW [force]
    displacement       u_t [length]; with the shift it is what the increment after remembers
    slip               since the start, of the lower body's particles past the indenter's [length]
    tangential_shift   None at the friction limit under a force
    dissipated_energy  None where the shift is
    carried            shear and pressure that need no springs (3, points)
    augmentations      how often they were corrected
    """

    compliance: PointCompliance
    pressure: Vector
    shear: Field
    displacement: Field
    gap: Vector
    slip: Field
    in_stick: Mask
    limit: float
    normal_force: float
    approach: float
    tangential_force: float
    tangential_shift: float | None
    dissipated_energy: float | None
    residuals: Residuals
    carried: Field
    turns: int
    solves: int
    augmentations: int = 0

    @property
    def overlap(self) -> float:
        """Largest overlap that springs leave [length]."""
        across, _ = self.compliance.springs
        return across * float(np.max(np.abs(self.pressure - self.carried[2])))

    @property
    def left(self) -> float:
        """By springs: overlap over approach, or their strain along the surface over what the shear
        moves it, whichever is larger."""
        _, along = self.compliance.springs
        strained = along * longest(self.shear - self.carried[:2])
        moved, _ = self.compliance.displacement(np.zeros_like(self.pressure), self.shear)
        approach = abs(self.approach)
        scale = max(longest(moved), ROUND_OFF * approach)
        return max(over(self.overlap, approach), over(strained, scale))

    @property
    def torque(self) -> float:
        """None acts: that would break the mirror symmetry."""
        return 0.0

    @property
    def twist(self) -> float | None:
        """The indenter does not turn."""
        return 0.0

    @property
    def status(self) -> ContactStatus:
        """How the contact carries its tangential load."""
        touching = self.pressure > 0
        return contact_status(touching, self.in_stick, self.tangential_force, self.limit)


def length(vectors: Field) -> Vector:
    """Of each vector of (2, points)."""
    return np.asarray(np.sqrt(vectors[0] ** 2 + vectors[1] ** 2))


def longest(vectors: Field) -> float:
    """Length of the longest of them."""
    return float(np.max(length(vectors)))
