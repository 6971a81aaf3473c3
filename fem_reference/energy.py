"""Energy balance of an increment: work of the loads, and error of the dissipated energy.

All integrals are computed from the fields of the increments.
"""

from dataclasses import replace
from math import pi

import numpy as np

from contact_scene.array_types import Field
from fem_reference.fields import Increment
from fem_reference.plan import Plan


def add_energies(
    plan: Plan,
    before: Increment | None,
    increment: Increment,
    on_strain: float = 0.0,
) -> Increment:
    """Add input work and the error of the dissipated energy to an increment.

    If the work of the loads is defined, the stored input work is elastic energy plus dissipated
    energy. Its difference from the work of the loads is stored as `unresolved_work`.

    plan       load steps that are path-dependent
    before     previous increment of the history; None for the first increment
    increment  increment of the result without work
    on_strain  work of the shear on the imposed strain of the lower body in this increment [force
               length]
    """
    work = input_work(before, increment)
    assert increment.elastic_energy is not None
    known = increment.elastic_energy + (increment.dissipated_energy or 0.0)
    return replace(
        increment,
        input_work=None if work is None else known,
        unresolved_work=None if work is None else work - on_strain - known,
        dissipation_uncertainty=dissipation_uncertainty(plan, before, increment),
    )


def input_work(before: Increment | None, increment: Increment) -> float | None:
    """Compute the work of all loads since the start of the history by the trapezoidal rule.

    The work is Σ ½ (f₀ + f₁)(ω₁ - ω₀) over the increments [force length]. f are the normal force,
    tangential force and torque at the start (0) and end (1) of an increment. ω are the conjugate
    motions of the indenter: approach, shift and twist. Return None as soon as a motion is
    undefined, that is at the friction limit under force control.

    before     previous increment, whose work is continued; None for the first increment
    increment  increment whose contribution is added
    """
    worked = 0.0 if before is None else before.trapezoidal_work
    forces, motions = (np.zeros(4), np.zeros(4)) if before is None else _conjugate_loads(before)
    now, place = _conjugate_loads(increment)
    if worked is None or motions is None or place is None:
        return None
    return worked + float(np.sum(0.5 * (forces + now) * (place - motions)))


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


def _conjugate_loads(increment: Increment) -> tuple[Field, Field | None]:
    """Return the loads of the indenter and its conjugate motions, for the work of the loads.

    The loads are (W, T_x, T_y, M_z): normal force, tangential force and torque. The motions are
    (approach, shift along x, shift along y, twist). They are None if the shift or the twist is
    undefined, as at the friction limit under force control.

    increment  increment of the result
    """
    force, shift = increment.tangential_force, increment.tangential_shift
    torque, twist = increment.torque, increment.twist
    now = np.array([increment.normal_force, *(force or (0.0, 0.0)), torque or 0.0])
    if (force is not None and shift is None) or (torque is not None and twist is None):
        return now, None
    return now, np.array([increment.approach, *(shift or (0.0, 0.0)), twist or 0.0])
