"""Numbers that many challenges ask for, and windows that fit."""

from __future__ import annotations

from verification.challenge.requested_quantities import (
    AskedValue,
    Grade,
)
from verification.problems.paper_scene import HERTZ

# Sides of windows in which all of it fits, round on purpose: what is a multiple of the contact
# radius knows the answer [length].
SMALL, LARGE = 1.2e-3, 2.4e-3
CLOSED = 1e-12  # of closed and semi-closed forms, relative


def approach(value: float, uncertainty: float = CLOSED, step: int = 1) -> AskedValue:
    """Relative to itself."""
    meaning = "approach of points far from the contact in both bodies; positive when pressed"
    return AskedValue("approach", step, "m", meaning, value, value, "itself",
                      uncertainty=uncertainty, limit=2)  # fmt: skip


def contact_radius(value: float, uncertainty: float = CLOSED) -> AskedValue:
    """Relative to itself."""
    meaning = "radius of the contact, or √(contact area / π)"
    return AskedValue("contact_radius", 1, "m", meaning, value, value, "itself",
                      uncertainty=uncertainty, limit=1)  # fmt: skip


def stick_radius(value: float, step: int, uncertainty: float = CLOSED) -> AskedValue:
    """Relative to Hertz's contact radius."""
    return AskedValue(
        "stick_radius", step, "m", "radius of the zone that has not slipped since the last turn",
        value, HERTZ.contact_radius, "the contact radius", Grade.C, required=False,
        uncertainty=uncertainty, limit=1,
    )  # fmt: skip
