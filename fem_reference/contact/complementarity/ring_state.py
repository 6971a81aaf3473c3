"""What the complementarity method carries from one increment to the next."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from contact_scene.residuals import Residuals
from contact_scene.summary import ContactStatus
from fem_reference.contact.box_program import Sides
from fem_reference.contact.one_component import Led
from fem_reference.loads import Loads

Field = NDArray[np.float64]


@dataclass(frozen=True)
class Slid:
    """The shear part of a state.

    shear             q (n,), its component as of the problem's `Sideways`
    limit             of friction (n,)
    offset            displacement of the surfaces past each other, less the indenter's motion, over
                      the hats (n,): what the next slip is counted from, touching or not
    motion            shift or twist of the indenter; None at the friction limit under force control
    sides             0 where the surfaces stick or are apart, ±1 where they slip
    slip              accumulated while in contact, over the hats (n,)
    dissipated        energy since the start; None where the motion is
    resultant         force or torque of the shear; zero for radial shear
    """

    shear: Field
    limit: Field
    offset: Field
    motion: float | None
    sides: Sides
    slip: Field
    dissipated: float | None
    resultant: float
    status: ContactStatus


def untouched(rings: int) -> Slid:
    """Before first touch."""
    nothing = np.zeros(rings)
    sides = np.zeros(rings, dtype=np.int8)
    return Slid(nothing, nothing, nothing, 0.0, sides, nothing, 0.0, 0.0, ContactStatus.FULL_STICK)


@dataclass(frozen=True)
class State(Led):
    """The end of an increment.

    loads     that were reached
    gap       over the hats (n,)
    contact   sides of the pressure: 0 where the surfaces touch
    slid      None where the path has no shear
    steps     linear systems solved in the increment
    sweeps    alternations between pressure and shear
    """

    loads: Loads
    pressure: Field
    approach: float
    normal_force: float
    gap: Field
    contact: Sides
    slid: Slid | None
    residuals: Residuals
    steps: int
    sweeps: int

    @property
    def carried(self) -> float:
        """By the shear [force] or [force length]."""
        return self.slid.resultant if self.slid else 0.0

    @property
    def moved(self) -> float | None:
        """Along the shear [length] or [radian]."""
        return self.slid.motion if self.slid else 0.0
