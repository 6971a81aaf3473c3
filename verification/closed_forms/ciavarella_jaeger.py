"""Partial slip of any profile as the difference of two normal contacts (Ciavarella; Jäger).

Under constant load W and a tangential force T raised from zero, the shear is µ times the pressure
at W minus µ times the pressure at W - T/µ, whose contact area is the stick zone (Ciavarella 1998;
Jäger 1998). Exact for uncoupled pairs in plane contact and, in three dimensions, for nu = 0; for
other nu the slip direction is off as described in `cattaneo_mindlin`. For an axisymmetric contact
the ratio E*/G* follows from `moduli`; for an ellipse from `elliptical_contact`.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import copysign
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from verification.closed_forms.validity import require_positive, require_within_friction_limit


class NormalContact(Protocol):
    """What the superposition asks of a normal contact; positions are (r) or (x, y)."""

    @property
    def load(self) -> float:
        """Normal load [force]."""

    @property
    def approach(self) -> float:
        """Approach of distant points [length]."""

    @property
    def pressure(self) -> Callable[..., NDArray[np.float64]]:
        """Pressure at a position [force/length²]."""

    @property
    def gap(self) -> Callable[..., NDArray[np.float64]]:
        """Deformed gap at a position [length]."""


@dataclass(frozen=True)
class Superposition:
    """Difference of two normal contacts, times µ; build with `superpose`.

    full                  contact under the load W
    stick                 contact under W - |T|/µ; its area is the stick zone
    friction_coefficient  µ
    modulus_ratio         E*/G*
    tangential_force      T [force]
    """

    full: NormalContact
    stick: NormalContact
    friction_coefficient: float
    modulus_ratio: float
    tangential_force: float

    @property
    def shift(self) -> float:
        """Tangential shift of the indenter, µ (E*/G*) times the difference in approach [length]."""
        return self._signed * self.modulus_ratio * (self.full.approach - self.stick.approach)

    def shear(self, *position: ArrayLike) -> NDArray[np.float64]:
        """Shear traction on the lower body at (r) or (x, y) [force/length²].

        Under an apex both pressures are infinite; ask at a distance from it.
        """
        return np.asarray(
            self._signed * (self.full.pressure(*position) - self.stick.pressure(*position))
        )

    def slip(self, *position: ArrayLike) -> NDArray[np.float64]:
        """Slip of the lower surface relative to the indenter, nu = 0, inside the contact [length].

        It opposes the shear and is the gap left by the stick contact, scaled by µ E*/G*.
        """
        opened = self.stick.gap(*position) - self.full.gap(*position)
        return np.asarray(-self._signed * self.modulus_ratio * opened)

    @property
    def _signed(self) -> float:
        return copysign(self.friction_coefficient, self.tangential_force)


def superpose(
    contact_under_load: Callable[[float], NormalContact],
    load: float,
    tangential_force: float,
    friction_coefficient: float,
    modulus_ratio: float,
) -> Superposition:
    """Partial slip of the contact that `contact_under_load` describes.

    contact_under_load    normal load [force], from zero, to the contact it makes
    load                  W > 0 [force]
    tangential_force      T, |T| <= µW [force]
    friction_coefficient  µ > 0
    modulus_ratio         E*/G* > 0

    Raises ValueError when |T| > µW.
    """
    require_positive(
        load=load, friction_coefficient=friction_coefficient, modulus_ratio=modulus_ratio
    )
    require_within_friction_limit(tangential_force, friction_coefficient, load)
    stick_load = max(load - abs(tangential_force) / friction_coefficient, 0.0)
    return Superposition(
        contact_under_load(load),
        contact_under_load(stick_load),
        friction_coefficient,
        modulus_ratio,
        tangential_force,
    )
