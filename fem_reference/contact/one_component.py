"""Paths on which the shear has one component: what leads the indenter along it, and the report."""

from abc import ABC, abstractmethod
from dataclasses import dataclass, replace
from math import pi

import numpy as np
from numpy.typing import NDArray

from fem_reference.fields import Increment
from fem_reference.loads import Loads
from fem_reference.plan import Path, Plan

Field = NDArray[np.float64]


@dataclass(frozen=True)
class SidewaysTarget:
    """Either the shear's resultant over 2π, or the indenter's motion, or none for radial shear."""

    resultant: float | None = None
    motion: float | None = None


def target_of(loads: Loads) -> SidewaysTarget:
    """What leads the indenter sideways or round; nothing for radial shear."""
    if loads.tangential is not None:
        force, motion = loads.tangential.force, loads.tangential.shift
    elif loads.twisting is not None:
        force, motion = loads.twisting.torque, loads.twisting.twist
    else:
        return SidewaysTarget()
    return SidewaysTarget(None if force is None else force / (2 * pi), motion)


class Led(ABC):
    """The end of an increment, as far as it leads the indenter; zero on a path without.

    carried  force or torque of the shear
    moved    shift or twist of the indenter; None where undefined: at the friction limit under
             force control
    """

    loads: Loads

    @property
    @abstractmethod
    def carried(self) -> float: ...

    @property
    @abstractmethod
    def moved(self) -> float | None: ...

    @property
    def tangential_force(self) -> float:
        """Along the load, as prescribed or carried [force]."""
        load = self.loads.tangential
        if load is None:
            return 0.0
        return self.carried if load.force is None else load.force

    @property
    def tangential_shift(self) -> float | None:
        """Along the load [length]."""
        return 0.0 if self.loads.tangential is None else self.moved

    @property
    def torque(self) -> float:
        """About z, as prescribed or carried [force length]."""
        load = self.loads.twisting
        if load is None:
            return 0.0
        return self.carried if load.torque is None else load.torque

    @property
    def twist(self) -> float | None:
        """About z [radian]."""
        return 0.0 if self.loads.twisting is None else self.moved


def with_shear(pressed: Increment, plan: Plan, state: Led, shear: Field, slip: Field) -> Increment:
    """An increment with its shear and slip by the names that they have on the plan's path."""
    if plan.path is Path.TWISTING:
        return replace(
            pressed,
            shear_circumferential=shear,
            slip_circumferential=slip,
            torque=state.torque,
            twist=state.twist,
        )
    if plan.path is Path.PRESSING_WITH_FRICTION:
        sheared = replace(pressed, shear_radial=shear, slip_radial=slip)
    else:
        sheared = replace(pressed, shear_along_load=shear, slip_along_load=slip)
    force, shift = state.tangential_force, state.tangential_shift
    x, y = plan.direction
    return replace(
        sheared,
        tangential_force=(force * x, force * y),
        tangential_shift=None if shift is None else (shift * x, shift * y),
    )
