"""Quantities that are read off a result."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from contact_scene.quantities.field_metadata import Kind
from contact_scene.quantities.increment import (
    SCALARS,
    State,
    components,
    numbers,
)

if TYPE_CHECKING:
    from contact_results.surface import Result
    from semi_analytical import Increment

Field = NDArray[np.float64]

# Below this part of the peak friction limit the direction of a traction is round-off.
LEAST_SHEAR = 1e-6


def largest_residual(result: Result) -> float:
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


def force_along_x(increment: State) -> float:
    """Tangential force along x [force]; zero without friction."""
    return 0.0 if increment.tangential_force is None else float(increment.tangential_force[0])


def shift_along_x(increment: State) -> float:
    """Tangential shift along x [length]; zero without friction."""
    return 0.0 if increment.tangential_shift is None else float(increment.tangential_shift[0])


def shear_of(increment: Increment) -> Field:
    """The shear (2, nx, ny); zero without friction [force/length²]."""
    if increment.shear is None:
        return np.zeros((2, *increment.pressure.shape))
    return increment.shear


def energy_between(result: Result, first: int, last: int) -> float:
    """Energy lost to friction from the end of one loading step to the end of another."""
    start, end = (result.steps[number - 1].dissipated_energy for number in (first, last))
    if start is None or end is None:
        raise ValueError("no energy is dissipated without friction")
    return float(end - start)


def transverse_shear(increment: Increment, friction_coefficient: float) -> float:
    """Largest |q_y| relative to the largest µp [1]; zero where shear is along x everywhere."""
    limit = friction_coefficient * np.max(increment.pressure)
    return float(np.max(np.abs(shear_of(increment)[1])) / limit)


def slip_traction_angle(increment: Increment, friction_coefficient: float) -> float:
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
