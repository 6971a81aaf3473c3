"""A cell of the stability map: one contact, named by its coordinates."""

from __future__ import annotations

from dataclasses import dataclass, fields
from enum import StrEnum
from typing import Any


class Surface(StrEnum):
    """What is pressed on the body, and how friction varies over it."""

    BALL = "ball"
    ALIKE_BALL = "alike-ball"  # as elastic and coated as the body: nothing couples
    FLAT_PUNCH = "flat-punch"
    CONE = "cone"
    TWO_SPOTS = "two-spots"
    ROUGH = "rough"
    PATCHY = "patchy"  # a ball; friction varies from cell to cell and is zero in places
    GREASED = "greased"  # a ball; no friction in the middle of the contact


class LoadingPath(StrEnum):
    """The way to the end of the history."""

    PRESS = "press"  # no tangential load
    PUSH = "push"  # press, then T in one increment
    LOOP = "loop"  # T to and fro
    CIRCLE = "circle"  # T turns once round
    REVERSED = "reversed"  # T turned round while W falls
    RELOADED = "reloaded"  # W down to a hundredth and back
    SHEARED_RELOAD = "sheared-reload"  # the same together with T
    FALLING = "falling"  # W falls at constant T until T is 0.98 µW
    SLIDE = "slide"  # shift far beyond sliding and back
    APPROACH = "approach"  # approach and shift prescribed instead of forces


class Solver(StrEnum):
    """Who solves it."""

    SEMI_ANALYTICAL = "semi-analytical"
    COMPLEMENTARITY = "fem-complementarity"  # finite elements without a penalty
    PENALTY = "fem"  # finite elements with one

    @property
    def by_elements(self) -> bool:
        """Whether it takes sections of finite elements."""
        return self is not Solver.SEMI_ANALYTICAL


@dataclass(frozen=True)
class StabilityCell:
    """One contact. Its coordinates are plain values, so that any solver can be given it.

    friction        µ
    push            T/µW
    modulus_ratio   E1/E2 of coating and substrate
    thickness       h/a of the coating
    poisson_ratio   ν1 of the coating
    base_ratio      ν2 of the substrate; with E1/E2 = 1 and ν1 = ν2 there is no coating
    load            W over the force that makes the contact radius a
    length          contact radius a under that force [m]
    modulus         E2 [Pa]
    cells           of the surface grid along each side; of finite elements a quarter as many per
                    contact radius, which is about as fine
    """

    friction: float = 0.1
    push: float = 0.6
    modulus_ratio: float = 2.0
    thickness: float = 1.0
    poisson_ratio: float = 0.3
    base_ratio: float = 0.3
    path: LoadingPath = LoadingPath.PUSH
    surface: Surface = Surface.BALL
    load: float = 1.0
    length: float = 1e-3
    modulus: float = 210e9
    cells: int = 32
    solver: Solver = Solver.SEMI_ANALYTICAL

    @property
    def posable(self) -> bool:
        """Whether the solver takes such scenes: finite elements take what is of revolution, with
        friction the same everywhere and loads along a line."""
        uneven = self.surface in NOT_OF_REVOLUTION or self.path is LoadingPath.CIRCLE
        return not (self.solver.by_elements and uneven)

    @property
    def coordinates(self) -> dict[str, Any]:
        """Coordinates by name."""
        return {f.name: getattr(self, f.name) for f in fields(self)}

    @property
    def name(self) -> str:
        """For files: the coordinates that differ from those of the ordinary cell."""
        ordinary = StabilityCell()
        parts = [
            f"{SHORT[key]}{value:g}" if isinstance(value, float | int) else str(value)
            for key, value in self.coordinates.items()
            if value != getattr(ordinary, key)
        ]
        return "-".join(parts).replace(".", "p").replace("+", "") or "ordinary"


NOT_OF_REVOLUTION = (Surface.TWO_SPOTS, Surface.ROUGH, Surface.PATCHY, Surface.GREASED)
SHORT = {
    "friction": "mu", "push": "T", "modulus_ratio": "E", "thickness": "h", "poisson_ratio": "nu",
    "base_ratio": "base", "path": "", "surface": "", "load": "W", "length": "a", "modulus": "Pa",
    "cells": "N", "solver": "",
}  # fmt: skip
