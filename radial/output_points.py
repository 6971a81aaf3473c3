"""Where fields are told: rings over the largest contact of a history; and what no disc is."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import ceil, log10

import numpy as np

from contact_scene import ControlKind, Scene
from contact_scene.array_types import Array
from contact_scene.rig import compliances
from contact_scene.solver_errors import UnsupportedScene
from radial.fields import Increment
from radial.normal.disc import Disc
from radial.normal.pressing import (
    Pressed,
    Target,
)
from radial.plan import ELSEWHERE

# Rings outside over those inside, out to so many radii of the largest contact.
OUTSIDE, REACH = 4, 2.0
# Of the largest pressure, or of the approach: less tension or overlap is round-off.
NO_DISC = 1e-9


def largest_targets(scene: Scene) -> Iterator[Target]:
    """The largest force and the largest approach that steps of the history end with."""
    for kind in ControlKind:
        ends = [ramp.normal.end for ramp in scene.load_path() if ramp.normal.kind is kind]
        if any(ends):
            force = kind is ControlKind.FORCE
            yield target(scene, max(ends) if force else None, None if force else max(ends))


def targets(scene: Scene) -> Iterator[Target]:
    """What the steps of a history press to."""
    for ramp in scene.load_path():
        force = ramp.normal.kind is ControlKind.FORCE
        if ramp.normal.end:
            end = ramp.normal.end
            yield target(scene, end if force else None, None if force else end)


def target(scene: Scene, force: float | None, approach: float | None) -> Target:
    """What a scene prescribes: a force, or an approach with the normal spring of its rig."""
    return Target(force, approach, compliances(scene.rig)[0])


def shown_radii(count: int, largest: Sequence[Pressed], rim: float | None) -> Array:
    """Radii, denser towards the edge of the widest contact and out to twice its radius; none where
    the pressure is infinite [length]."""
    widest = max((found.contact for found in largest), key=lambda contact: contact.radius)
    inside = np.sin(0.5 * np.pi * np.arange(count + 1) / count)
    inside = inside[1 if widest.profile.apex else 0 : None if rim is None else -1]
    beside = np.arange(1, count // OUTSIDE + 1) / (count // OUTSIDE)
    return np.asarray(widest.radius * np.concatenate([inside, 1 + (REACH - 1) * beside**2]))


def undeformed_gap(scene: Scene, last: Increment) -> Array:
    """Return the gap without tractions at the rings, and angles, of an increment [length]."""
    gap = np.asarray(scene.indenter.initial_gap(last.radii, 0.0))
    return np.array(np.broadcast_to(gap, last.gap.T.shape).T)


def refuse_no_disc(radii: Array, p: Array, gap: Array) -> None:
    """Raise UnsupportedScene where the surfaces part within the contact or meet again outside.

    gap  over the approach
    """
    for wrong, what in (
        (p < -NO_DISC * np.max(p), "part within the contact"),
        (gap < -NO_DISC, "touch again outside the contact"),
    ):
        if np.any(wrong):
            raise UnsupportedScene(
                f"the surfaces {what}, {radii[np.argmax(wrong)]:.4g} m from the axis, and this "
                f"solver takes contacts on one disc; {ELSEWHERE}"
            )


def refuse_round_off(contact: Disc, tolerance: float) -> None:
    """Raise UnsupportedScene where round-off leaves more of the approach than the tolerance: no
    number of polynomials has made it less."""
    if contact.missed > tolerance:
        enough = 10.0 ** ceil(log10(contact.missed))
        raise UnsupportedScene(
            f"layers as thin and unlike as these leave {contact.missed:.1g} of the approach to "
            f"round-off, and the tolerance is {tolerance:.1g}; ask for [radial] tolerance = "
            f"{enough:.0e}, or {ELSEWHERE}"
        )
