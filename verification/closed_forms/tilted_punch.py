"""Rigid flat-ended circular punch under a normal force beside its axis: it tilts.

Valid for frictionless faces or pairs without normal–tangential coupling, and while the punch
touches all over: up to an eccentricity of a third of its radius.
"""

from dataclasses import dataclass
from math import hypot, pi

import numpy as np
from numpy.typing import ArrayLike, NDArray

from verification.closed_forms.validity import require_positive


@dataclass(frozen=True)
class TiltedPunch:
    """State of a flat punch whose load acts at (x, y) = eccentricity (Sneddon 1951, § 52).

    A pressure ∝ x/√(a²-r²) moves the disc below it like a plane, as one ∝ 1/√(a²-r²) moves it
    like a constant (Galin's theorem for a polynomial of first degree).

    contact_radius   punch radius a [length]
    contact_modulus  E* [force/length²]
    load             normal load W > 0 [force]
    eccentricity     (e_x, e_y) [length]; ValueError beyond a/3, where the punch lifts off
    """

    contact_radius: float
    contact_modulus: float
    load: float
    eccentricity: tuple[float, float]

    def __post_init__(self) -> None:
        require_positive(
            contact_radius=self.contact_radius,
            contact_modulus=self.contact_modulus,
            load=self.load,
        )
        if hypot(*self.eccentricity) > self.contact_radius / 3:
            raise ValueError(
                f"eccentricity {hypot(*self.eccentricity)!r} exceeds a third of the radius "
                f"{self.contact_radius!r}: the punch lifts off on one side"
            )

    @property
    def approach(self) -> float:
        """Approach W/2E*a of the axis [length]: the tilt does not change it."""
        return self.load / (2 * self.contact_modulus * self.contact_radius)

    @property
    def tilt(self) -> tuple[float, float]:
        """Slopes along x and y, 3We/(4E*a³) each: the tilting stiffness is (4/3) E* a³."""
        stiffness = 4 / 3 * self.contact_modulus * self.contact_radius**3
        e_x, e_y = self.eccentricity
        return self.load * e_x / stiffness, self.load * e_y / stiffness

    def pressure(self, x: ArrayLike, y: ArrayLike) -> NDArray[np.float64]:
        """W/(2πa√(a²-r²)) (1 + 3 (e_x x + e_y y)/a²) [force/length²]; infinite at the rim, zero
        outside."""
        a, (e_x, e_y) = self.contact_radius, self.eccentricity
        X, Y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
        r = np.hypot(X, Y)
        room = np.where(r <= a, (a - r) * (a + r), np.inf)
        with np.errstate(divide="ignore", invalid="ignore"):
            upright = self.load / (2 * pi * a * np.sqrt(room))
        return np.asarray(upright * (1 + 3 * (e_x * X + e_y * Y) / a**2))
