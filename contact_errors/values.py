"""Scalars of a result that have an error: at the ends of load steps and of closed load cycles."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
from numpy.typing import NDArray

from contact_results.cycles import fretting_cycles
from contact_scene import LoadRamp
from contact_scene.quantities.field_metadata import reported
from contact_scene.quantities.increment import (
    SCALARS,
    State,
)
from contact_scene.quantities.summary import OF_CYCLES
from contact_scene.rig import Rig, prescribed_motions
from contact_scene.stepping.load_path import ControlKind

if TYPE_CHECKING:
    from contact_results.surface import Result

# A scalar is (1,), a vector (2,).
Values: TypeAlias = Mapping[str, NDArray[np.float64]]

PHYSICAL = tuple(name for name, mark in reported(State).items() if mark.physical)


def values_of(result: Result) -> tuple[Values, ...]:
    """Return the scalars that are defined at the end of each load step, by name."""
    closed = {
        cycle.cycle.end: {name: cycle.numbers.get(name) for name in OF_CYCLES}
        for cycle in fretting_cycles(result)
    }
    return tuple(
        {
            name: np.atleast_1d(np.asarray(value, dtype=float))
            for name, value in (
                {name: getattr(end, name) for name in PHYSICAL} | closed.get(end.step, {})
            ).items()
            if value is not None
        }
        for end in result.steps
    )


def prescribed(ramp: LoadRamp, rig: Rig | None) -> frozenset[str]:
    """Return the names of the scalars that the load step prescribes at its end: with a rig the
    motions of the actuator."""
    approach, shift = prescribed_motions(rig)
    controls = (
        (ramp.normal.kind, "normal_force", approach),
        (ramp.tangential.kind, "tangential_force", shift),
        (ramp.twisting.kind, "torque", "twist"),
        (ramp.tilting.kind, "moment", "tilt"),
    )
    by_force = ramp.tangential.kind is ControlKind.FORCE
    amplitude = "shift_amplitude" if shift == "tangential_shift" else "actuator_amplitude"
    return frozenset(
        {
            *("bulk_strain", "bulk_shear", "force_amplitude" if by_force else amplitude),
            *(force if kind is ControlKind.FORCE else motion for kind, force, motion in controls),
        }
    )


def scale(name: str, values: Values) -> float:
    """Return the characteristic magnitude of a scalar in the history; 0 if it has none."""
    sizes = {key: float(np.max(np.abs(value))) for key, value in values.items()}
    length, force = sizes["approach"], sizes["normal_force"]
    radius = sizes["contact_radius"]
    by_unit = {
        "m": length,
        "m^2": sizes["contact_area"],
        "N": force,
        "N m": force * radius,
        "rad": length / radius if radius else 0.0,
        "Pa": sizes["peak_pressure"],
        "J": force * length,
    }
    return by_unit.get(SCALARS[name].unit, 0.0) if name in SCALARS else 0.0
