"""Output radii over the largest contact, targets of the history, and checks of the contact area."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import ceil, log10
from typing import Any

import numpy as np

from contact_scene import ControlKind, Scene
from contact_scene.array_types import Array
from contact_scene.rig import compliances
from contact_scene.solver_errors import UnsupportedScene
from radial.fields import Increment
from radial.normal.disc import Disc
from radial.normal.pressing import (
    NormalContact,
    Target,
)
from radial.plan import ELSEWHERE

# Ratio of rings inside to rings outside, and outermost radius over that of the largest contact.
OUTSIDE, REACH = 4, 2.0
# Limit for round-off in p over the largest pressure, and in the gap over the approach.
NO_DISC = 1e-9


def largest_targets(scene: Scene) -> Iterator[Target]:
    """Return the largest force and the largest approach prescribed at the end of a load step."""
    for kind in ControlKind:
        ends = [ramp.normal.end for ramp in scene.load_path() if ramp.normal.kind is kind]
        if any(ends):
            force = kind is ControlKind.FORCE
            yield target(scene, max(ends) if force else None, None if force else max(ends))


def targets(scene: Scene) -> Iterator[Target]:
    """Return the normal force or approach prescribed at the end of each load step."""
    for ramp in scene.load_path():
        force = ramp.normal.kind is ControlKind.FORCE
        if ramp.normal.end:
            end = ramp.normal.end
            yield target(scene, end if force else None, None if force else end)


def target(scene: Scene, force: float | None, approach: float | None) -> Target:
    """Return a target in the scene's rig: a force, or an approach of the far end of its spring."""
    return Target(force, approach, compliances(scene.rig)[0])


def output_radii(count: int, largest: Sequence[NormalContact], rim: float | None) -> Array:
    """Return output radii, denser towards the edge of the largest contact, up to twice its radius
    [length].

    Radii of infinite pressure (an apex, a rim) are omitted.
    """
    widest = max((found.contact for found in largest), key=lambda contact: contact.radius)
    inside = np.sin(0.5 * np.pi * np.arange(count + 1) / count)
    inside = inside[1 if widest.profile.apex else 0 : None if rim is None else -1]
    outside = np.arange(1, count // OUTSIDE + 1) / (count // OUTSIDE)
    return np.asarray(widest.radius * np.concatenate([inside, 1 + (REACH - 1) * outside**2]))


@dataclass(frozen=True)
class StepsOnRings:
    """Base of the solvers of load steps whose work does not limit the bisection."""

    scene: Scene

    @property
    def most_spent(self) -> float:
        """Work above which an increment that does not converge is not bisected any further."""
        return 0.0

    def spent(self) -> float:
        """Return the work so far."""
        return 0.0

    def undeformed_gap(self, last: Increment, tilt: Any) -> Array:
        """Return the gap without tractions at the rings of an increment [length]."""
        gap = np.asarray(self.scene.indenter.initial_gap(last.radii, 0.0))
        return np.array(np.broadcast_to(gap, last.gap.T.shape).T)


def refuse_no_disc(radii: Array, p: Array, gap: Array) -> None:
    """Raise UnsupportedScene if the surfaces separate within the contact or touch outside.

    gap  divided by the approach
    """
    for wrong, what in (
        (p < -NO_DISC * np.max(p), "separate within the contact"),
        (gap < -NO_DISC, "touch again outside the contact"),
    ):
        if np.any(wrong):
            raise UnsupportedScene(
                f"the surfaces {what}, {radii[np.argmax(wrong)]:.4g} m from the axis. This solver "
                f"requires one circular contact area; {ELSEWHERE}"
            )


def refuse_round_off(contact: Disc, tolerance: float) -> None:
    """Raise UnsupportedScene if the error of the contact equation exceeds the tolerance.

    The error is due to round-off: `disc` has increased the number of polynomials until it
    stagnates.
    """
    if contact.residual > tolerance:
        enough = 10.0 ** ceil(log10(contact.residual))
        raise UnsupportedScene(
            f"round-off limits the accuracy for these thin layers of different stiffness: the "
            f"error is {contact.residual:.1g} of the approach and the tolerance is "
            f"{tolerance:.1g}. Use [radial] tolerance = {enough:.0e}, or {ELSEWHERE}"
        )
