"""Results for separated bodies (the empty contact), which are exact without a solve.

Without a normal load there is no contact: tractions, elastic energy, forces and moments are 0. A
later contact starts from the virgin state. Only sums over the history and the position of the
bodies continue (CONVENTIONS).
"""

from collections.abc import Mapping
from dataclasses import fields, replace
from typing import Any, TypeVar, cast

import numpy as np

from contact_scene.array_types import Field
from contact_scene.bulk_strain import Strain
from contact_scene.height_map import lowest_point
from contact_scene.quantities.increment import STIFFNESSES
from contact_scene.quantities.residuals import Residuals
from contact_scene.quantities.summary import ContactStatus
from contact_scene.rig import MOTIONS, plain
from contact_scene.stepping.load_path import (
    Control,
    ControlKind,
    LoadRamp,
)

Reported = TypeVar("Reported")

# Attributes for the positions of an increment in space and in the history.
_PLACES = frozenset({"radii", "angles", "step", "index", "increments_in_step", "path"})
# Fields and scalars that separation does not set to 0.
_UNCHANGED = _PLACES | frozenset(
    {
        "slip_distance",
        *("slip", "slip_radial", "slip_circumferential", "slip_along_load", "dissipation"),
        *("tangential_shift", "twist", "tilt", "dissipated_energy", "dissipation_uncertainty"),
    }
)
# Values that continue in a later contact, each with the value at separation that is added.
_CONTINUED = {
    **{name: name for name in ("tangential_shift", "twist", "input_work", "unresolved_work")},
    "actuator_shift": "actuator_shift",
    **{name: name for name in ("dissipated_energy", "dissipation_uncertainty", "slip_distance")},
    **{"dissipation": "dissipation", "dissipation_before": "dissipation"},
}
_CONJUGATE = {
    **{"normal_force": "approach", "tangential_force": "tangential_shift"},
    **{"torque": "twist", "moment": "tilt"},
}


def separated_increment(
    last: Reported,
    ramp: LoadRamp,
    fraction: float,
    gap: Field,
    place: Mapping[str, int],
    approach: float | None = None,
) -> Reported:
    """Return the results of separated bodies at the end of an increment without contact.

    Tractions, forces and elastic energy are 0. The displacements of the indenter follow from the
    loads (see `position`). Slip and dissipated energy are those of the preceding increment.

    last      results of the preceding increment
    ramp      load ramp of the load step
    fraction  fraction of the ramp at the end of the increment
    gap       undeformed gap at zero approach and at the tilt that `position` returns [length]
    place     load step, increment and number of increments, by the names of the results
    approach  prescribed approach [length]; None for the approach of first contact at this tilt
    """
    before: Any = last
    found = {f.name: _zero_of_type(getattr(before, f.name)) for f in fields(before) if f.init}
    found = {name: value for name, value in found.items() if name not in _UNCHANGED}
    if before.in_stick is not None:  # a small contact may not have had its stick zone determined
        found |= {name: 0.0 for name in ("stick_area", "stick_radius") if name in found}
    found |= position(before, ramp, fraction)
    lowest = approach or 0.0
    if approach is None and found["tilt"] is not None and np.any(found["tilt"]):
        # With a rim, the gap is infinite outside and first contact is on the rim.
        smooth = bool(np.all(np.isfinite(gap)))
        lowest = float(np.min(gap)) + (lowest_point(gap)[0] if smooth else 0.0)
    dissipated = before.dissipated_energy or 0.0
    found |= {"gap": gap - lowest, "approach": lowest, "status": ContactStatus.SEPARATED}
    for name, (actuator, _) in MOTIONS.items():
        if getattr(before, actuator) is not None:
            found[actuator] = found[name]
    found |= dict.fromkeys(STIFFNESSES)
    found |= {"elastic_energy": 0.0, "input_work": None, "unresolved_work": None, **place}
    for name, source in (("slip_before", "slip"), ("dissipation_before", "dissipation")):
        if name in found:
            found[name] = getattr(before, source)
    worked = before.trapezoidal_work
    if worked is not None:
        worked += sum(
            0.5 * float(np.dot(getattr(before, force), np.subtract(found[motion], start)))
            for force, motion in _CONJUGATE.items()
            if (start := getattr(before, motion)) is not None and getattr(before, force) is not None
        )
        found |= {"input_work": dissipated, "unresolved_work": worked - dissipated}
    return cast(Reported, replace(before, **found))


def virgin_increment(increment: Reported) -> Reported:
    """Return the results of an increment before the bodies have been in contact: all values are 0.

    Used for separated bodies before the first contact of a load history. The coordinates of the
    points and the position in the history are kept.

    increment  results of an increment in contact, which determine the shapes of the fields
    """
    of: Any = increment
    values = {f.name: _zero_of_type(getattr(of, f.name)) for f in fields(of) if f.init}
    zero = {name: value for name, value in values.items() if name not in _PLACES}
    return cast(Reported, replace(of, **zero))


def position(last: Any, ramp: LoadRamp, fraction: float) -> dict[str, Any]:
    """Determine tangential shift, twist and tilt of the indenter while the bodies are separated.

    A prescribed displacement has its value on the load ramp, the linear change of the loads in the
    load step. Other displacements keep their last value.

    last      results of the preceding increment
    ramp      load ramp of the load step
    fraction  fraction of the ramp
    returns   shift, twist and tilt by name; None if the results do not contain them
    """
    controls: tuple[Any, ...] = (ramp.tangential, ramp.twisting, ramp.tilting)
    motions = {}
    for name, control in zip(("tangential_shift", "twist", "tilt"), controls, strict=True):
        motion = getattr(last, name)
        if motion is not None and control.kind is ControlKind.DISPLACEMENT:
            values = control.prescribed(fraction, (motion, motion))[1]
            motion = np.array(values) if isinstance(motion, np.ndarray) else values
        motions[name] = motion
    return motions


def ramp_since_separation(ramp: LoadRamp, apart: Any) -> LoadRamp:
    """Return a load ramp whose shift, twist and bulk strain are counted from the separation.

    A load ramp is the linear change of the loads in a load step. A contact after a separation of
    the bodies starts without memory of earlier contacts. Its solve therefore counts these
    quantities from their values at separation.

    ramp   load ramp of the load step
    apart  results of the last increment without contact
    """
    return replace(
        ramp,
        tangential=_control_since_separation(
            ramp.tangential, apart.tangential_shift, from_zero=True
        ),
        twisting=_control_since_separation(ramp.twisting, apart.twist, from_zero=True),
        tilting=_control_since_separation(ramp.tilting, apart.tilt, from_zero=False),
        stretch=None if ramp.stretch is None else _strain_since_separation(ramp.stretch, apart),
    )


def _strain_since_separation(stretch: tuple[Strain, Strain], apart: Any) -> Any:
    at_touch = (*apart.bulk_strain, apart.bulk_shear)
    return tuple(tuple(map(float, np.subtract(strain, at_touch))) for strain in stretch)


def _control_since_separation(control: Any, motion: Any, *, from_zero: bool) -> Any:
    if control.kind is ControlKind.FORCE or motion is None:
        return control
    ends = motion if control.start is None else control.start, control.end
    origin = motion if from_zero else np.zeros_like(motion)
    return Control(control.kind, *(plain(np.subtract(end, origin)) for end in ends))


def add_values_at_separation(apart: Any, increment: Reported) -> Reported:
    """Add the displacements and energies at a separation to the results of a later contact.

    The solve of a later contact counts shift, twist, work and dissipation from the separation of
    the bodies. The results count them from the start of the history.

    apart      results of the last increment without contact
    increment  results of the increment as solved
    """
    values = {
        name: _add_values(getattr(apart, source), getattr(increment, name))
        for name, source in _CONTINUED.items()
        if hasattr(increment, name)
    }
    return cast(Reported, replace(cast(Any, increment), **values))


def _add_values(first: Any, second: Any) -> Any:
    if first is None or second is None:
        return None
    total = np.add(first, second)
    return total if isinstance(second, np.ndarray) else plain(total)


def _zero_of_type(value: Any) -> Any:
    """Return the zero of the type of a reported value, for the results of separated bodies.

    The types are numbers, arrays, pairs and residuals. The result is None for other types.

    value  reported value of an increment in contact
    """
    if isinstance(value, Residuals):
        return Residuals(**{name: _zero_of_type(size) for name, size in vars(value).items()})
    if isinstance(value, np.ndarray):
        return np.zeros_like(value)
    if isinstance(value, tuple):
        return 0.0, 0.0
    return type(value)(0) if isinstance(value, int | float) else None
