"""The state of a contact on points (r, θ), and how well it fulfils its equations."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from contact_scene.residuals import Residuals
from contact_scene.summary import ContactStatus
from fem_reference.contact.friction_limit import contact_status
from fem_reference.contact.harmonics.point_compliance import PointCompliance

Field = NDArray[np.float64]
Vector = NDArray[np.float64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True)
class PointState:
    """Converged fields at the end of an increment; vectors (2, points) are (r, θ) components.

    limit              friction limit µW [force]
    displacement       u_t [length]; with the shift it is what the increment after remembers
    slip               since the start, of the lower body's particles past the indenter's [length]
    tangential_shift   None at the friction limit under a force
    dissipated_energy  None where the shift is
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
    turns: int
    solves: int

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
