"""A two-dimensional view of the stability map."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import product
from typing import Any

from verification.studies.stability.cell import LoadingPath, Solver, StabilityCell, Surface

# Names of coordinates as people read them.
NAMES = {
    "friction": "µ", "push": "T / µW", "modulus_ratio": "E1/E2", "thickness": "h/a",
    "poisson_ratio": "ν of the layer", "path": "path", "surface": "surface", "load": "W / W(a)",
    "length": "a (m)", "modulus": "E2 (Pa)", "base_ratio": "ν of the base", "cells": "cells",
    "solver": "solver",
}  # fmt: skip

ORDINARY = StabilityCell()
# Nothing is as coupled as ν = 0 below a rigid ball: β = ½.
BARE = replace(ORDINARY, modulus_ratio=1.0, poisson_ratio=0.0, base_ratio=0.0)
HARD_PUSH = 0.95
BEYOND = 1.001  # of T/µW


@dataclass(frozen=True)
class View:
    """A map over two coordinates.

    name     for files
    x, y     names of coordinates
    cells    every cell of it; several at one place differ in other coordinates
    """

    name: str
    title: str
    x: str
    y: str
    cells: tuple[StabilityCell, ...]

    def values(self, axis: str) -> tuple[Any, ...]:
        """The values of a coordinate, in order."""
        found = {getattr(cell, axis) for cell in self.cells}
        members = [*LoadingPath, *Surface, *Solver]
        return tuple(sorted(found, key=lambda v: members.index(v) if v in members else v))

    @property
    def wide(self) -> bool:
        """Whether there is more than one place to see."""
        return len(self.values(self.x)) * len(self.values(self.y)) > 1

    @property
    def by_elements(self) -> bool:
        """Whether finite elements solve its cells."""
        return self.cells[0].solver.by_elements

    def at(self, x: Any, y: Any) -> tuple[StabilityCell, ...]:
        """The cells at one place."""
        return tuple(c for c in self.cells if getattr(c, self.x) == x and getattr(c, self.y) == y)


def grid(base: StabilityCell, **axes: Sequence[Any]) -> tuple[StabilityCell, ...]:
    """All combinations of the values."""
    names = tuple(axes)
    combinations = product(*axes.values())
    return tuple(replace(base, **dict(zip(names, c, strict=True))) for c in combinations)
