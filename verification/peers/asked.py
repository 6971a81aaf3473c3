"""What ours and other codes are asked: the same contacts on the same grids, dimensionless."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from verification.closed_forms.hertz import PointContact

TOLERANCE = 1e-8
# Contact radius, modulus and radius of the ball are one. tamaas is sensitive to it.
FORCE = 4 / 3
UNIT = PointContact.under_load(FORCE, 1.0, 1.0)
WINDOW = 3.0
CELLS = (32, 64, 128, 256, 512, 1024)


@dataclass(frozen=True)
class AskedContact:
    """A paraboloid on a half-space.

    title       for people
    cells       along a side, coarse to fine
    friction    coefficient; 0: none
    part        tangential force over µW
    others      whether other codes are asked: only what some of them can do
    poisson_ratio, coating  of the body; modulus and thickness of a layer on it
    increments  pressing, then pushing
    depths      at which stress is wanted below all cells [length]
    """

    name: str
    title: str
    cells: tuple[int, ...]
    friction: float = 0.0
    part: float = 0.0
    others: bool = False
    poisson_ratio: float = 0.0
    coating: tuple[float, float] | None = None
    increments: tuple[int, int] = (1, 1)
    depths: tuple[float, ...] = ()

    def request(self, cells: int) -> dict[str, Any]:
        """What a driver reads."""
        return {
            "cells": cells,
            "window": WINDOW * UNIT.contact_radius,
            "radius": 1.0,
            "modulus": 1.0,
            "poisson_ratio": self.poisson_ratio,
            "coating": self.coating,
            "force": FORCE,
            "friction": self.friction,
            "tangential_force": self.part * self.friction * FORCE,
            "increments": self.increments,
            "depths": self.depths,
            "tolerance": TOLERANCE,
        }


HERTZ = AskedContact("hertz", "Hertz", CELLS, others=True)
CATTANEO = AskedContact(
    "cattaneo", "Cattaneo-Mindlin, ν = 0, T = 0.9 µW", CELLS, 0.1, 0.9, others=True,
)  # fmt: skip
COATED = AskedContact(
    "coated", "coated, E1/E2 = 2, pressed and pushed with friction in 5 + 5 increments",
    CELLS, 0.1, 0.6, poisson_ratio=0.3, coating=(2.0, 1.0), increments=(5, 5),
)  # fmt: skip
STRESS = AskedContact(
    "stress", "the stress below Hertz's contact at eight depths",
    CELLS, poisson_ratio=0.3, depths=(0.1, 0.2, 0.3, 0.5, 0.7, 1.0, 1.5, 2.0),
)  # fmt: skip
ASKED = {contact.name: contact for contact in (HERTZ, CATTANEO, COATED, STRESS)}
