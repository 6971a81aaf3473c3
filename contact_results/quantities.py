"""Quantities that are read off a result. The attributes they need are declared here, by protocols,
so that any solver whose result has them can be measured.
"""

from collections.abc import Sequence
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from contact_scene.increment import SCALARS, State, components, numbers
from contact_scene.reported import Kind
from contact_scene.residuals import Residuals

Field = NDArray[np.float64]
Components = Sequence[float] | NDArray[np.float64]  # along x and y

# Below this part of the peak friction limit the direction of a traction is round-off.
LEAST_SHEAR = 1e-6


class SolvedIncrement(Protocol):
    """What is read off one increment; shapes and signs as in CONVENTIONS."""

    @property
    def step(self) -> int:
        """Loading step, from 1."""

    @property
    def pressure(self) -> Field:
        """Pressure (nx, ny) [force/length²]."""

    @property
    def shear(self) -> Field | None:
        """Shear on the lower body (2, nx, ny) [force/length²]."""

    @property
    def slip(self) -> Field | None:
        """Slip of the lower body relative to the indenter, since the start (2, nx, ny) [length]."""

    @property
    def in_stick(self) -> NDArray[np.bool_] | None:
        """Cells in contact that stick (nx, ny)."""

    @property
    def in_contact(self) -> NDArray[np.bool_]:
        """Cells in contact (nx, ny)."""

    @property
    def tangential_force(self) -> Components | None:
        """Tangential force on the indenter [force]."""

    @property
    def tangential_shift(self) -> Components | None:
        """Tangential shift of the indenter [length]."""

    @property
    def dissipated_energy(self) -> float | None:
        """Energy lost to friction since the start [force*length]."""

    @property
    def residuals(self) -> Residuals:
        """How well it fulfils each equation."""


class SolvedHistory(Protocol):
    """What is read off a result."""

    @property
    def increments(self) -> Sequence[SolvedIncrement]:
        """All increments in order."""

    @property
    def steps(self) -> Sequence[SolvedIncrement]:
        """The last increment of every loading step."""


def largest_residual(result: SolvedHistory) -> float:
    """Largest residual of any kind at the end of any increment [1]; NaN wins over every number."""
    return float(np.max([increment.residuals.worst for increment in result.increments]))


def named_values(increment: State) -> dict[str, float]:
    """The key scalars that an increment has, then its key vectors, components with _x and _y; in
    SI."""
    values = numbers(increment)
    keys = [name for name, mark in SCALARS.items() if mark.key]
    return {
        part: float(value)
        for name in sorted(keys, key=lambda name: SCALARS[name].kind is Kind.VECTOR)
        for part in components(name)
        if (value := values[part]) is not None
    }


def unit_of(name: str) -> str:
    """The unit of a name of `named_values`."""
    return next(mark.unit for known, mark in SCALARS.items() if name in components(known))


def force_along_x(increment: SolvedIncrement) -> float:
    """Tangential force along x [force]; zero without friction."""
    return 0.0 if increment.tangential_force is None else float(increment.tangential_force[0])


def shift_along_x(increment: SolvedIncrement) -> float:
    """Tangential shift along x [length]; zero without friction."""
    return 0.0 if increment.tangential_shift is None else float(increment.tangential_shift[0])


def shear_of(increment: SolvedIncrement) -> Field:
    """The shear (2, nx, ny); zero without friction [force/length²]."""
    if increment.shear is None:
        return np.zeros((2, *increment.pressure.shape))
    return increment.shear


def energy_between(result: SolvedHistory, first: int, last: int) -> float:
    """Energy lost to friction from the end of one loading step to the end of another."""
    start, end = (result.steps[number - 1].dissipated_energy for number in (first, last))
    if start is None or end is None:
        raise ValueError("no energy is dissipated without friction")
    return float(end - start)


def transverse_shear(increment: SolvedIncrement, friction_coefficient: float) -> float:
    """Largest |q_y| relative to the largest µp [1]; zero where shear is along x everywhere."""
    limit = friction_coefficient * np.max(increment.pressure)
    return float(np.max(np.abs(shear_of(increment)[1])) / limit)


def slip_traction_angle(increment: SolvedIncrement, friction_coefficient: float) -> float:
    """Largest angle between the shear and the x axis in slipping cells [degree].

    The axis, not its direction: after a reversal the slipping cells pull the other way.
    """
    shear = shear_of(increment)
    size = np.hypot(shear[0], shear[1])
    limit = friction_coefficient * np.max(increment.pressure)
    slipping = increment.in_contact & (size > LEAST_SHEAR * limit)
    if increment.in_stick is not None:
        slipping &= ~increment.in_stick
    if not slipping.any():
        return 0.0
    along_x, along_y = np.abs(shear[:, slipping])
    return float(np.degrees(np.max(np.arctan2(along_y, along_x))))
