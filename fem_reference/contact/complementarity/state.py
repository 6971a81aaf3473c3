"""What the complementarity method carries from one increment to the next."""

from dataclasses import dataclass
from math import pi

import numpy as np
from numpy.typing import NDArray

from contact_scene.residuals import Residuals
from contact_scene.summary import ContactStatus
from fem_reference.contact.complementarity.box_program import Sides
from fem_reference.contact.complementarity.contact_problem import Sideways
from fem_reference.loads import Loads

Field = NDArray[np.float64]


@dataclass(frozen=True)
class Slid:
    """The shear part of a state.

    shear             q (n,), its component as of the problem's `Sideways`
    offset            displacement of the surfaces past each other, less the indenter's motion, over
                      the hats (n,): what the next slip is counted from, touching or not
    motion            shift or twist of the indenter; None at the friction limit under force control
    sides             0 where the surfaces stick or are apart, ±1 where they slip
    slip              accumulated while in contact, over the hats (n,)
    dissipated        energy since the start; None where the motion is
    resultant         force or torque of the shear; zero for radial shear
    """

    shear: Field
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
    return Slid(nothing, nothing, 0.0, sides, nothing, 0.0, 0.0, ContactStatus.FULL_STICK)


@dataclass(frozen=True)
class State:
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
    def tangential_force(self) -> float:
        """Along the load, as prescribed or carried; zero on a path without [force]."""
        load = self.loads.tangential
        if self.slid is None or load is None:
            return 0.0
        return self.slid.resultant if load.force is None else load.force

    @property
    def tangential_shift(self) -> float | None:
        """Along the load; None where undefined [length]."""
        return self.slid.motion if self.slid and self.loads.tangential else 0.0

    @property
    def torque(self) -> float:
        """About z, as prescribed or carried; zero on a path without [force length]."""
        load = self.loads.twisting
        if self.slid is None or load is None:
            return 0.0
        return self.slid.resultant if load.torque is None else load.torque

    @property
    def twist(self) -> float | None:
        """About z; None where undefined [radian]."""
        return self.slid.motion if self.slid and self.loads.twisting else 0.0


def resultant(sideways: Sideways, q: Field) -> float:
    """Force or torque of a shear; zero where symmetry leaves none."""
    return 0.0 if sideways.motion is None else 2 * pi * float(np.sum(sideways.motion * q))
