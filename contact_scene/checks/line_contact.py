"""Checks of line contacts: loads per length, motions with a reference length, plane strain."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from contact_scene.accuracy import AccuracyRequest
from contact_scene.body import Body
from contact_scene.discretisation import SurfaceDiscretisation
from contact_scene.friction import CoulombFriction
from contact_scene.geometry import Indenter, LineShape, ShapedBody
from contact_scene.loading import LoadStep
from contact_scene.material import RIGID
from contact_scene.quantities.per_length import ATTRIBUTES, SHOWN_NAMES
from contact_scene.reading.quantity import PerLength, WithUnit
from contact_scene.reading.scene_error import Path, Problem
from contact_scene.rig import Rig

# Examples of loads per length and of loads, by their keys.
_EXAMPLES: Mapping[str, tuple[str, str]] = {
    **dict.fromkeys(("normal_force", "tangential_force"), ('"100 N/mm"', '"100 N"')),
    "moment": ('"20 N"', '"20 N m"'),
    **dict.fromkeys(("normal_stiffness", "tangential_stiffness"), ('"50 N/mm^2"', '"50 N/um"')),
}
# Loads that strain the bodies along y: index of the component that does not, and expected value.
_OUT_OF_PLANE: Mapping[str, tuple[int | None, str]] = {
    "torque": (None, "no torque"),
    "twist": (None, "no twist"),
    **dict.fromkeys(("moment", "tilt"), (1, "(0, value)")),
    **dict.fromkeys(("bulk_strain", "bulk_stress"), (0, "(value, 0, 0)")),
}
# Examples along x, and along x and y.
_DIMENSIONS: Mapping[str, tuple[str, str]] = {
    "cells": ("1024", "[128, 128]"),
    "window": ('"2 mm"', "[2e-3, 2e-3]"),
}
_NEED_REFERENCE = ("approach", "tangential_shift")


def lacks_reference(indenter: ShapedBody, body: Body) -> bool:
    """Determine if rigid motions of a line contact are undefined, for lack of a reference length.

    In plane strain the displacement of an elastic half-space is known up to a constant.

    indenter, body  the two bodies
    """
    elastic = any(one.material is not RIGID for one in (indenter, body))
    return isinstance(indenter, LineShape) and indenter.reference_length is None and elastic


def wrong_units(
    indenter: Indenter, loading: Sequence[LoadStep], rig: Rig | None
) -> Iterator[Problem]:
    """Find loads with the unit of a force on a line contact, or per length on another contact."""
    line = indenter.is_line
    steps: list[tuple[Path, Any]] = [(("loading", n), step) for n, step in enumerate(loading)]
    for path, table in [*steps, (("rig",), rig)]:
        for name, examples in _EXAMPLES.items():
            parts = np.atleast_1d(np.array(getattr(table, name, None), dtype=object))
            if any(isinstance(p, WithUnit) and isinstance(p, PerLength) is not line for p in parts):
                load, per = f"a {name.replace('_', ' ')}", " per length"
                yield Problem(
                    (*path, name),
                    f"got {load}{'' if line else per} on a {indenter.shape.replace('_', ' ')}",
                    f"{load}{per if line else ''} such as {examples[not line]}",
                )


def loads_out_of_plane(indenter: Indenter, loading: Sequence[LoadStep]) -> Iterator[Problem]:
    """Find loads that a line contact in plane strain cannot have."""
    for index, step in enumerate(loading if indenter.is_line else ()):
        for name, (allowed, expected) in _OUT_OF_PLANE.items():
            parts = np.atleast_1d(getattr(step, name) or 0.0)
            if np.any(np.delete(parts, allowed if allowed is not None and len(parts) > 1 else [])):
                yield Problem(
                    ("loading", index, name), "the load acts out of the plane of strain", expected
                )


def undefined_motions(
    indenter: Indenter, body: Body, loading: Sequence[LoadStep], rig: Rig | None
) -> Iterator[Problem]:
    """Find prescribed displacements and springs of a line contact without a reference length."""
    if not lacks_reference(indenter, body):
        return
    prescribed = [
        ("loading", index, name)
        for index, step in enumerate(loading)
        for name in _NEED_REFERENCE
        if getattr(step, name) is not None
    ]
    for path in [*prescribed, *([("rig",)] if rig is not None else [])]:
        yield Problem(
            path,
            "displacements of a line contact depend on the distance at which the surface is fixed",
            hint='add indenter.reference_length, such as "20 mm"',
        )


def wrong_dimension(
    indenter: ShapedBody, semi_analytical: SurfaceDiscretisation
) -> Iterator[Problem]:
    """Find cells and windows along x and y on a line contact, or along x alone on another one.

    The window of a profile must not extend beyond its points.
    """
    line = indenter.is_line
    for name, examples in _DIMENSIONS.items():
        value = getattr(semi_analytical, name)
        if value is not None and isinstance(value, tuple) is line:
            wanted = "one number, along x" if line else "an array of 2, for x and y"
            yield Problem(
                ("semi_analytical", name),
                f"got {list(value) if line else value} for a "
                f"{'line contact' if line else 'contact that is no line contact'}",
                f"{wanted}, such as {examples[not line]}",
            )
        elif name == "window" and line and value and value > 2 * indenter.known_radius:
            yield Problem(
                ("semi_analytical", name),
                f"the window is {value:.6g} m long, and the profile is known on both sides of 0 "
                f"to {indenter.known_radius:.6g} m",
                f"at most {2 * indenter.known_radius:.6g} m",
            )


def friction_map_on_line(indenter: Indenter, friction: CoulombFriction | None) -> Iterator[Problem]:
    """Find a map of the coefficient of friction on a line contact."""
    if indenter.is_line and friction is not None and friction.extent is not None:
        yield Problem(
            ("friction", "coefficient"),
            "the coefficient of friction of a line contact is a map",
            "one number",
        )


def names_of_accuracy(indenter: Indenter, accuracy: AccuracyRequest | None) -> Iterator[Problem]:
    """Find requested accuracies of widths by names that the results of the contact do not have."""
    line = indenter.is_line
    for wrong, right in (SHOWN_NAMES if line else ATTRIBUTES).items():
        if getattr(accuracy, wrong, None) is not None:
            yield Problem(
                ("accuracy", wrong),
                f"the results of a {indenter.shape.replace('_', ' ')} do not have this name",
                right,
            )
