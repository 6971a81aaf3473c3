"""Checks for contradictions between the tables of a scene, each of which is valid alone.

Each check yields problems with the key to change.
"""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from inspect import signature
from typing import Any

from contact_scene.body import Body
from contact_scene.checks.line_contact import (
    friction_map_on_line,
    loads_out_of_plane,
    names_of_accuracy,
    undefined_motions,
    wrong_dimension,
    wrong_units,
)
from contact_scene.discretisation import SurfaceDiscretisation
from contact_scene.friction import CoulombFriction
from contact_scene.friction_limit import exceeds_limit, limit_of_step, load_text, reaches_limit
from contact_scene.geometry import Indenter
from contact_scene.loading import LoadStep
from contact_scene.material import RIGID
from contact_scene.reading.scene_error import (
    Path,
    Problem,
)
from contact_scene.stepping.load_path import (
    ControlKind,
    LoadRamp,
    load_path,
)

_SHEARING = {
    "tangential_force": "a tangential load",
    "tangential_shift": "a tangential load",
    "torque": "a torque",
    "twist": "a twist",
}


def inconsistencies(tables: Mapping[str, Any]) -> tuple[Problem, ...]:
    """Find the contradictions between the tables of a scene file, each of which is valid alone.

    A check runs if all tables that its parameters name are valid. The parameter `ramps` contains
    the load steps, resolved into load ramps (linear changes of all loads), `unit` that of forces.

    tables  valid tables of the scene file by their keys
    """
    known, loading = dict(tables), tables.get("loading")
    known["unit"] = "N/m" if getattr(tables.get("indenter"), "is_line", False) else "N"
    if loading and loading[0].prescribes_normal:
        known["ramps"] = load_path(loading)
    found: list[Problem] = []
    for check in _CHECKS:
        needed = signature(check).parameters
        if needed.keys() <= known.keys():
            found += check(**{name: known[name] for name in needed})
    return tuple(found)


def _both_rigid(indenter: Body, body: Body) -> Iterator[Problem]:
    if not indenter.deforms and not body.deforms:
        yield Problem(
            ("body", "material"),
            "both bodies are rigid and carry no layer",
            "at least one elastic material or layer",
        )


def _first_step_without_normal_load(loading: Sequence[LoadStep]) -> Iterator[Problem]:
    if not (loading[0].normal_force or loading[0].approach):
        yield Problem(
            ("loading", 0),
            "the first step does not press the bodies together",
            "normal_force or approach above 0 in the first step",
        )


def _loads_without_contact(ramps: Sequence[LoadRamp]) -> Iterator[Problem]:
    """Find load steps that separate the bodies but prescribe a tangential force, torque or moment.

    Separated bodies carry none of these loads. A tilted indenter at an approach of 0 may still
    touch the body and is also refused.

    ramps  load ramps of all load steps
    """
    for index, ramp in enumerate(ramps):
        if ramp.normal.end != 0:
            continue
        for key, control in (
            ("tangential_force", ramp.tangential),
            ("torque", ramp.twisting),
            ("moment", ramp.tilting),
        ):
            if control.kind is ControlKind.FORCE and control.end not in (0.0, (0.0, 0.0)):
                yield Problem(
                    ("loading", index),
                    f"the step separates the bodies under a {key} other than 0",
                    f"{key} = 0 in this step or before it",
                )
        tilted = ramp.tilting.kind is ControlKind.DISPLACEMENT and any(ramp.tilting.end)
        if tilted and ramp.normal.kind is ControlKind.DISPLACEMENT:
            yield Problem(
                ("loading", index),
                "at an approach of 0 a tilted indenter may touch",
                "normal_force = 0 to separate the bodies",
            )


def _shear_without_friction(
    friction: CoulombFriction | None, loading: Sequence[LoadStep]
) -> Iterator[Problem]:
    for index, step in enumerate(loading if friction is None else ()):
        for key, load in _SHEARING.items():
            if getattr(step, key) not in (None, 0.0, (0.0, 0.0)):
                yield Problem(
                    ("loading", index, key),
                    f"{load} on a frictionless contact",
                    hint="add [friction] with a coefficient, or remove the load",
                )


def _gross_sliding(
    friction: CoulombFriction | None,
    loading: Sequence[LoadStep],
    ramps: Sequence[LoadRamp],
    unit: str,
) -> Iterator[Problem]:
    """Find load steps whose prescribed tangential force exceeds the friction limit mu W.

    Only steps under force control are checked. A force at the limit is refused if another load step
    follows, since the shift is then undefined. |T| - mu W, with the tangential force T, the
    coefficient mu and the normal force W, is convex along a ramp. The ends of the ramps therefore
    suffice.

    friction  friction law of the scene; None without friction
    loading   load steps as written in the scene
    ramps     load ramps of all load steps
    unit      unit of the forces
    """
    for index, ramp in enumerate(ramps):
        limit = limit_of_step(friction, ramp)
        if limit is None or not ramp.normal.end:
            continue
        force = math.hypot(*ramp.tangential.end)
        product = f"{limit / ramp.normal.end:.6g} * {ramp.normal.end:.6g} {unit}"
        named_limit = f"the friction limit {limit:.6g} {unit} (= {product})"
        if exceeds_limit(force, limit):
            yield Problem(
                _key_of_shear(index, loading[index]),
                f"tangential force {load_text(force, limit)} {unit} exceeds {named_limit}: gross "
                "sliding",
                hint="prescribe tangential_shift instead",
            )
        elif limit and reaches_limit(force, limit) and index + 1 < len(ramps):
            yield Problem(
                _key_of_shear(index, loading[index]),
                f"tangential force {force:.6g} {unit} is at {named_limit}, where the shift is "
                "undefined, and a further step follows",
                hint="stay below the limit, or prescribe tangential_shift instead",
            )
            return


def _key_of_shear(index: int, step: LoadStep) -> Path:
    """Return the key of the tangential load,
    or else of the normal force, to change at gross sliding."""
    names = ("tangential_force", "tangential_shift", "normal_force")
    named = [name for name in names if getattr(step, name) is not None]
    return ("loading", index, *named[:1])


def _moment_beyond_the_contact(
    indenter: Indenter, loading: Sequence[LoadStep], ramps: Sequence[LoadRamp]
) -> Iterator[Problem]:
    """Find load steps whose moment moves the normal force beyond the indenter, which tips over.

    Only steps under force control are checked. |M| - W reach, with the moment M, the normal force W
    and the half width `reach` of the indenter, is convex along a ramp. The ends of the ramps
    therefore suffice.

    indenter  indenter with its rim or extent
    loading   load steps as written in the scene
    ramps     load ramps of all load steps
    """
    half_x, half_y = (side / 2 for side in indenter.extent or (math.inf, math.inf))
    for index, ramp in enumerate(ramps):
        if ControlKind.DISPLACEMENT in (ramp.normal.kind, ramp.tilting.kind) or not ramp.normal.end:
            continue
        y, x = (abs(moment) / ramp.normal.end for moment in ramp.tilting.end)
        arms = ((math.hypot(x, y), indenter.rim or math.inf), (x, half_x), (y, half_y))
        distance, reach = max(arms, key=lambda arm: arm[0] / arm[1])
        if distance >= reach:
            moved = "normal_force" if loading[index].moment is None else "moment"
            yield Problem(
                ("loading", index, moved),
                f"the moment moves the normal force {distance:.6g} m from the origin, and the "
                f"indenter ends at {reach:.6g} m: it tips over",
                hint="use a smaller moment, or prescribe tilt instead",
            )


def _window_beyond_a_map(
    indenter: Indenter, friction: CoulombFriction | None, semi_analytical: SurfaceDiscretisation
) -> Iterator[Problem]:
    extents = {
        "the height map": indenter.extent,
        "the friction map": friction and friction.extent,
    }
    for name, extent in extents.items():
        for index, known in enumerate(extent or ()):
            window = semi_analytical.window
            length = window[index] if isinstance(window, tuple) else 0.0
            if length > known * (1.0 + 1e-9):
                yield Problem(
                    ("semi_analytical", "window", index),
                    f"the window is {length:.6g} m long, {name} only {known:.6g} m",
                    f"a window of at most {known:.6g} m along {'xy'[index]}",
                )


def _rigid_base_strained(body: Body, loading: Sequence[LoadStep]) -> Iterator[Problem]:
    for index, step in enumerate(loading if body.material is RIGID else ()):
        for key in ("bulk_strain", "bulk_stress"):
            if getattr(step, key):
                yield Problem(
                    ("loading", index, key),
                    "the substrate of the lower body is rigid and has no bulk strain",
                    "an elastic substrate",
                )


_CHECKS: tuple[Callable[..., Iterator[Problem]], ...] = (
    _both_rigid,
    _first_step_without_normal_load,
    _shear_without_friction,
    _loads_without_contact,
    _gross_sliding,
    _moment_beyond_the_contact,
    _window_beyond_a_map,
    _rigid_base_strained,
    wrong_units,
    loads_out_of_plane,
    undefined_motions,
    wrong_dimension,
    friction_map_on_line,
    names_of_accuracy,
)
