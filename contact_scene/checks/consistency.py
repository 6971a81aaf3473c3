"""Whether parts of a scene that are valid alone make sense together."""

import math
from collections.abc import Iterator, Sequence
from typing import TypedDict

from contact_scene.body import Body
from contact_scene.discretisation import SurfaceDiscretisation
from contact_scene.friction import CoulombFriction
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

# |T| = mu W within round-off of a product of two decimal numbers is the limit itself.
_ROUND_OFF = 1e-12
# This close to the limit hardly anything sticks: the shift tends to the sliding limit, and
# nothing can start from it.
_AT_THE_LIMIT = 1e-6

_SHEARING = {
    "tangential_force": "a tangential load",
    "tangential_shift": "a tangential load",
    "torque": "a torque",
    "twist": "a twist",
}


class Parts(TypedDict, total=False):
    """Valid parts of a scene file; a part that is itself invalid is left out."""

    indenter: Indenter
    body: Body
    friction: CoulombFriction | None
    loading: Sequence[LoadStep]
    semi_analytical: SurfaceDiscretisation


def inconsistencies(parts: Parts) -> tuple[Problem, ...]:
    """Every contradiction between the parts."""
    return (
        *_nothing_deforms(parts),
        *_first_step_does_not_press(parts),
        *_shear_without_friction(parts),
        *_loads_without_contact(parts),
        *_gross_sliding(parts),
        *_moment_beyond_the_contact(parts),
        *_window_beyond_a_map(parts),
        *_rigid_base_strained(parts),
    )


def _nothing_deforms(parts: Parts) -> Iterator[Problem]:
    if "indenter" not in parts or "body" not in parts:
        return
    if not parts["indenter"].deforms and not parts["body"].deforms:
        yield Problem(
            ("body", "material"),
            "both bodies are rigid and carry no layer",
            "at least one elastic material or layer",
        )


def _first_step_does_not_press(parts: Parts) -> Iterator[Problem]:
    loading = parts.get("loading")
    if loading and not (loading[0].normal_force or loading[0].approach):
        yield Problem(
            ("loading", 0),
            "the first step does not press the bodies together",
            "normal_force or approach above 0 in the first step",
        )


def _loads_without_contact(parts: Parts) -> Iterator[Problem]:
    """Steps that end with a load other than 0 of separated bodies, or with an approach of 0 of
    tilted ones, which may touch."""
    loading = parts.get("loading")
    if not loading or not loading[0].names_normal:
        return
    for index, ramp in enumerate(load_path(loading)):
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


def _shear_without_friction(parts: Parts) -> Iterator[Problem]:
    if "friction" not in parts or parts["friction"] is not None:
        return
    for index, step in enumerate(parts.get("loading", ())):
        for key, load in _SHEARING.items():
            if getattr(step, key) not in (None, 0.0, (0.0, 0.0)):
                yield Problem(
                    ("loading", index, key),
                    f"{load} on a frictionless contact",
                    hint="add [friction] with a coefficient, or leave it out",
                )


def _gross_sliding(parts: Parts) -> Iterator[Problem]:
    """Steps under force control that exceed the limit mu W, or that leave from it.

    |T| - mu W is convex along a ramp of both, so it suffices to look at the ends; the start of a
    ramp is the end of the one before, or no load at all.
    """
    friction, loading = parts.get("friction"), parts.get("loading")
    if friction is None:
        return
    if not loading or not loading[0].names_normal:
        return
    left_from_limit = False
    for index, ramp in enumerate(load_path(loading)):
        if ControlKind.DISPLACEMENT in (ramp.normal.kind, ramp.tangential.kind):
            continue
        force, limit = math.hypot(*ramp.tangential.end), friction.carried(ramp.normal.end)
        if limit is None:
            return
        if ramp.normal.end == 0:
            continue
        named = f"tangential force {force:.6g} N"
        product = f"{friction.uniform:.6g} * {ramp.normal.end:.6g} N"
        named_limit = f"the friction limit {limit:.6g} N (= {product})"
        if force > limit * (1.0 + _ROUND_OFF):
            yield Problem(
                _key_of_shear(index, loading[index]),
                f"{named} exceeds {named_limit}: gross sliding",
                hint="prescribe tangential_shift instead",
            )
        elif not left_from_limit and 0.0 < limit * (1.0 - _AT_THE_LIMIT) <= force:
            left_from_limit = index + 1 < len(loading)
            if left_from_limit:
                yield Problem(
                    _key_of_shear(index, loading[index]),
                    f"{named} is at {named_limit}, where the shift is undefined, "
                    "and a further step follows",
                    hint="stay below the limit, or prescribe tangential_shift instead",
                )


def _moment_beyond_the_contact(parts: Parts) -> Iterator[Problem]:
    """Steps under force control whose normal force acts beyond the end of the indenter.

    |M| - W reach is convex along a ramp of both, so it suffices to look at the ends.
    """
    indenter, loading = parts.get("indenter"), parts.get("loading")
    if indenter is None or not loading or not loading[0].names_normal:
        return
    for index, ramp in enumerate(load_path(loading)):
        if ControlKind.DISPLACEMENT in (ramp.normal.kind, ramp.tilting.kind) or not ramp.normal.end:
            continue
        for distance, reach in _arms(indenter, ramp):
            if distance >= reach:
                moved = "normal_force" if loading[index].moment is None else "moment"
                yield Problem(
                    ("loading", index, moved),
                    f"the moment moves the normal force {distance:.6g} m from the origin, and the "
                    f"indenter ends at {reach:.6g} m: it tips over",
                    hint="take a smaller moment, or prescribe tilt instead",
                )
                break


def _arms(indenter: Indenter, ramp: LoadRamp) -> tuple[tuple[float, float], ...]:
    """Distances of the normal force from the origin, each with how far the indenter reaches that
    way; none for shapes without end."""
    M_x, M_y = ramp.tilting.end
    x, y = abs(M_y) / ramp.normal.end, abs(M_x) / ramp.normal.end
    ends = () if indenter.rim is None else ((math.hypot(x, y), indenter.rim),)
    if indenter.extent is None:
        return ends
    return *ends, (x, indenter.extent[0] / 2), (y, indenter.extent[1] / 2)


def _window_beyond_a_map(parts: Parts) -> Iterator[Problem]:
    """A window that is larger than the map of heights or of friction."""
    discretisation = parts.get("semi_analytical")
    if discretisation is None or discretisation.window is None:
        return
    indenter, friction = parts.get("indenter"), parts.get("friction")
    extents = {
        "the height map": indenter and indenter.extent,
        "the friction map": friction and friction.extent,
    }
    for name, extent in extents.items():
        for index, known in enumerate(extent or ()):
            length = discretisation.window[index]
            if length > known * (1.0 + 1e-9):
                yield Problem(
                    ("semi_analytical", "window", index),
                    f"the window is {length:.6g} m long, {name} only {known:.6g} m",
                    f"a window of at most {known:.6g} m along {'xy'[index]}",
                )


def _rigid_base_strained(parts: Parts) -> Iterator[Problem]:
    body = parts.get("body")
    for index, step in enumerate(parts.get("loading", ()) if body else ()):
        for key in ("bulk_strain", "bulk_stress"):
            if getattr(step, key) and body and body.material is RIGID:
                yield Problem(
                    ("loading", index, key),
                    "the substrate of the lower body is rigid and has no bulk strain",
                    "an elastic substrate",
                )


def _key_of_shear(index: int, step: LoadStep) -> Path:
    """The key a step should change: its tangential load, or else what made the limit fall."""
    for name in ("tangential_force", "tangential_shift", "normal_force"):
        if getattr(step, name) is not None:
            return ("loading", index, name)
    return ("loading", index)
