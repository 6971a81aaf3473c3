"""Quantities that cases and studies derive from a result: residuals, forces, energies and
angles.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from contact_results.surface import surface_of
from contact_scene.array_types import Field
from contact_scene.quantities.increment import (
    SCALARS,
    State,
    components,
)
from verification.norms import max_norm

if TYPE_CHECKING:
    from contact_results.surface import Result
    from semi_analytical import Increment


def largest_residual(result: Result) -> float:
    """Return the largest residual of the contact and friction equations in any increment [1].

    The result is NaN if any residual is NaN.
    """
    return float(np.max([increment.residuals.worst for increment in result.increments]))


def unit_of(name: str) -> str:
    """Return the SI unit of a named result of an increment.

    name  name of the result, such as approach or tangential_force_x
    """
    return next(mark.unit for known, mark in SCALARS.items() if name in components(known))


def force_along_x(increment: State) -> float:
    """Return the tangential force along x at the end of an increment [force]; 0 without
    friction.
    """
    return 0.0 if increment.tangential_force is None else float(increment.tangential_force[0])


def shift_along_x(increment: State) -> float:
    """Return the tangential shift along x at the end of an increment [length]; 0 without
    friction.
    """
    return 0.0 if increment.tangential_shift is None else float(increment.tangential_shift[0])


def shear_of(increment: Increment) -> Field:
    """Return the shear tractions of the cells (2, nx, ny) at the end of an increment
    [force/length²].

    The result is zero without friction.
    """
    if increment.shear is None:
        return np.zeros((2, *increment.pressure.shape))
    return increment.shear


def tractions_along_load(result: Result, end: Any) -> tuple[Field, Field, Field]:
    """Return the pressure, and the shear along the load, on the line of profiles of a result.

    Without friction the shear is zero.

    end  state at the end of a load step

    Returns the places on the line [length] and both tractions [force/length²].
    """
    surface = surface_of(result)
    pressure, shear = surface.scalar(end, "pressure"), surface.vector(end, "shear")
    assert pressure is not None
    p = surface.along(pressure)
    q = 0 * p if shear is None else surface.vector_along(shear)[0]
    return surface.profile_line.places, p, q


def relative_difference(name: str, step: int, one: Any, other: Any) -> float:
    """Compute the relative difference of a scalar of two results at the end of a load step [1].

    Vectors are compared by their magnitudes.

    name        registered name of the scalar, such as "approach"
    step        index of the load step
    one, other  results of any solvers; the difference is relative to the second
    """
    found, expected = (np.linalg.norm(getattr(end.steps[step], name)) for end in (one, other))
    return float(abs(found / expected - 1))


def energy_between(result: Result, first: int, last: int) -> float:
    """Compute the energy dissipated by friction between the ends of two load steps [force·length].

    result       result of any solver
    first, last  numbers of the load steps, from 1
    """
    start, end = (result.steps[number - 1].dissipated_energy for number in (first, last))
    if start is None or end is None:
        raise ValueError("no energy is dissipated without friction")
    return float(end - start)


def transverse_shear(increment: Increment, friction_coefficient: float) -> float:
    """Compute the largest shear |q_y| across a load along x, over the largest friction limit µp
    [1].

    The ratio is 0 if all shear tractions are along x.

    increment             increment on cells
    friction_coefficient  µ
    """
    limit = friction_coefficient * np.max(increment.pressure)
    return float(max_norm(shear_of(increment)[1]) / limit)
