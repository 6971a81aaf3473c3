"""Error of the dissipated energy by finite increments, from the fields of the increments."""

from math import pi

import numpy as np

from contact_scene.array_types import Field
from fem_reference.fields import Increment
from fem_reference.plan import Plan


def dissipation_uncertainty(
    plan: Plan, before: Increment | None, increment: Increment
) -> float | None:
    """Estimate the error of the dissipated energy caused by finite increments [force length].

    The estimate is Σ ∫ |q₁ - q₀| |s₁ - s₀| dA over the increments of path-dependent load steps: the
    change of the shear q times the change of the slip s in an increment. Return None if the
    dissipated energy is None.

    plan       load steps that are path-dependent
    before     previous increment, whose estimate is continued; None for the first increment
    increment  increment whose contribution is added
    """
    if increment.dissipated_energy is None:
        return None
    known = 0.0 if before is None else before.dissipation_uncertainty or 0.0
    if not plan.path_matters[increment.step - 1]:
        return known
    changed, slipped = (_change_magnitude(name, before, increment) for name in ("shear", "slip"))
    density = (changed * slipped).T
    if increment.angles is None:
        around = 2 * pi * density
    elif increment.covers_circle:
        around = 2 * pi * np.mean(density, axis=0)
    else:
        around = np.asarray(2 * np.trapezoid(density, increment.angles, axis=0))
    return known + float(np.trapezoid(around * increment.radii, increment.radii))


COMPONENTS = ("radial", "circumferential", "along_load")


def _change_magnitude(name: str, before: Increment | None, increment: Increment) -> Field:
    """Compute the magnitude of the change of shear or slip in one increment, at every ring.

    The result has the shape of the field: (rings,), or (rings, angles) if the field depends on the
    angle. Used to estimate the error of the dissipated energy.

    name       prefix of the field names, "shear" or "slip"
    before     previous increment, at the start; None counts as zero shear and slip
    increment  increment at whose end the field is taken
    """
    changes = []
    for component in COMPONENTS:
        now = getattr(increment, f"{name}_{component}")
        last = getattr(before, f"{name}_{component}", None)
        if now is not None:
            # A previous field without angles is axisymmetric.
            start = np.zeros_like(now) if last is None else last
            changes.append(now - (start[:, None] if start.ndim < now.ndim else start))
    return np.asarray(np.hypot.reduce(np.abs(changes), axis=0))
