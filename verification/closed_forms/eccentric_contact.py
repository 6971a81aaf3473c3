"""Partial slip of a Hertz contact under a tangential force and a strain of the lower body, ν = 0.

Elastically similar bodies with ν = 0 have equal compliances along and across a shear, and the same
operator for pressure and shear. A bulk strain exx = ε and a force T along x that grow in proportion
require the relative displacement δ - ε x of the stick zone. The gap of a smaller Hertz contact has
the same form, x²/2R shifted by e: the corrective traction is µ times the pressure of a contact of
the same shape under the load W - T/µ, centred at e = ε R/µ. The slip is the gap of that contact, so
that it has one sign, and Coulomb's law holds exactly if the ellipses are nested. The plane limit is
Hills and Nowell's (1987) e/a = σ/4µp₀.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from verification.closed_forms.elliptical_contact import EllipticalContact


@dataclass(frozen=True)
class EccentricContact:
    """State under T and ε that have grown in proportion; fields are functions of x and y.

    contact  normal contact, for the modulus E* that is also the tangential one
    friction µ
    tangential_force  T along x [force]
    strain   ε of the lower body along x
    """

    contact: EllipticalContact
    friction: float
    tangential_force: float
    strain: float

    def __post_init__(self) -> None:
        if self.eccentricity + self.stick.semi_axes[0] > self.contact.semi_axes[0]:
            raise ValueError("the stick zone reaches the edge of the contact: slip turns back")

    @property
    def stick(self) -> EllipticalContact:
        """The smaller contact, whose ellipse is the stick zone."""
        load = self.contact.load - self.tangential_force / self.friction
        modulus = self.contact.contact_modulus
        return EllipticalContact.under_load(load, self.contact.radii, modulus)

    @property
    def eccentricity(self) -> float:
        """e of the centre of the stick zone [length]."""
        return self.strain * self.contact.radii[0] / self.friction

    @property
    def shift(self) -> float:
        """δ [length]."""
        drawn = 0.5 * self.strain * self.eccentricity
        return self.friction * (self.contact.approach - self.stick.approach) + drawn

    @property
    def stick_radius(self) -> float:
        """√(area/π) of the stick zone [length]."""
        a, b = self.stick.semi_axes
        return float(np.sqrt(a * b))

    def shear(self, x: ArrayLike, y: ArrayLike) -> NDArray[np.float64]:
        """Compute the shear along x on the lower body [force/length²]."""
        xs = np.asarray(x, dtype=float)
        lacking = self.stick.pressure(xs - self.eccentricity, y)
        return self.friction * (self.contact.pressure(xs, y) - lacking)

    @property
    def dissipated_energy(self) -> float:
        """∫ µp s dA with the slip s, µ times the gap of the smaller contact [force length].

        By reciprocity of the two contacts; ∫ p x² dA = W a²/5.
        """
        whole, stick, e = self.contact, self.stick, self.eccentricity
        (R_x, R_y), lost = whole.radii, 0.0
        for sign, of in ((1, whole), (-1, stick)):
            a, b = of.semi_axes
            lost += sign * of.load * ((a**2 / 5 + e**2) / R_x + b**2 / (5 * R_y)) / 2
        lost += whole.approach * stick.load - stick.approach * whole.load
        return self.friction**2 * lost
