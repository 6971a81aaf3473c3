"""Histories turned about z, and how far two results are apart once one is turned back."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import cos, radians, sin
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from contact_scene import LoadStep
from contact_scene.residuals import worst
from verification.quantities import shear_of

if TYPE_CHECKING:
    from semi_analytical import Increment, Result

Field = NDArray[np.float64]


def turned(loading: Sequence[LoadStep], degrees: float) -> tuple[LoadStep, ...]:
    """The steps with their tangential forces turned from x to y."""
    c, s = cos(radians(degrees)), sin(radians(degrees))

    def one(step: LoadStep) -> LoadStep:
        if step.tangential_force is None:
            return step
        x, y = step.tangential_force
        return step.model_copy(update={"tangential_force": (c * x - s * y, s * x + c * y)})

    return tuple(one(step) for step in loading)


def difference_after_quarter(one: Result, other: Result) -> float:
    """How far the second result, turned by a right angle, is from the first in any increment:
    Σ|Δp|/Σp, Σ|Δq|/Σp, and shift over approach. The grid is square and turns into itself."""
    pairs = zip(one.increments, other.increments, strict=True)
    return worst(*(_quarter_difference(a, b) for a, b in pairs))


def difference_of_motion(degrees: float) -> Callable[[Result, Result], float]:
    """Largest difference, in any increment, of the shift and of the energy lost, once the second
    result is turned; relative to the largest of either in the second."""
    c, s = cos(radians(degrees)), sin(radians(degrees))
    turn = np.array([[c, -s], [s, c]])

    def difference(one: Result, other: Result) -> float:
        found, expected = _shifts(one), _shifts(other)
        shift = np.max(np.hypot(*(found.T - turn @ expected.T))) / np.max(np.hypot(*expected.T))
        lost, energy = (
            np.array([i.dissipated_energy for i in result.increments], dtype=float)
            for result in (one, other)
        )
        return worst(shift, np.max(np.abs(lost - energy)) / np.max(energy))

    return difference


def _shifts(result: Result) -> Field:
    still = np.zeros(2)
    shifts = (i.tangential_shift for i in result.increments)
    return np.array([still if shift is None else shift for shift in shifts])


def _quarter_difference(one: Increment, other: Increment) -> float:
    total = np.sum(other.pressure)
    q_x, q_y = shear_of(other)
    shear = np.stack([-_quarter(q_y), _quarter(q_x)])
    apart = 0.0
    if one.tangential_shift is not None and other.tangential_shift is not None:
        x, y = other.tangential_shift
        apart = float(np.hypot(*(one.tangential_shift - np.array([-y, x])))) / one.approach
    return worst(
        float(np.sum(np.abs(one.pressure - _quarter(other.pressure))) / total),
        float(np.sum(np.abs(shear_of(one) - shear)) / total),
        apart,
    )


def _quarter(field: Field) -> Field:
    """Turned by a right angle from x to y."""
    return field.T[::-1]
