"""Answers of another code: levels with values and fields, in SI."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

Vector = NDArray[np.float64]
Key = tuple[str, int]  # quantity and loading step, from 1
SAMPLINGS = ("point", "cell")


@dataclass(frozen=True)
class Field:
    """A traction at own points.

    x, y   where [m]
    value  [Pa]
    area   that each point stands for [m²]
    Raises ValueError for arrays of unequal lengths, without points, or areas that are not positive.
    """

    x: Vector
    y: Vector
    value: Vector
    area: Vector

    def __post_init__(self) -> None:
        for name in ("x", "y", "value", "area"):
            flat = np.ravel(np.asarray(getattr(self, name), dtype=np.float64))
            object.__setattr__(self, name, flat)
        sizes = {name: getattr(self, name).size for name in ("x", "y", "value", "area")}
        if len(set(sizes.values())) > 1:
            told = ", ".join(f"{size} of {name}" for name, size in sizes.items())
            raise ValueError(f"a field needs as many numbers of each: {told}")
        if not self.x.size:
            raise ValueError("no points; leave out a field that has none")
        if not np.all(self.area > 0):
            raise ValueError("areas must be positive")


@dataclass(frozen=True)
class Answer:
    """One level.

    h         size of a cell or element at the contact's edge; √area where it is oblong [m]
    scalars   a value [SI], or a value with its standard uncertainty
    fields    tractions on the lower body [Pa]
    points    numbers at the places that are asked, in their order [SI]
    gave_up   reasons by loading step, where there is no answer
    unknowns  of the whole level; None where nobody counted
    seconds   likewise
    """

    h: float
    scalars: Mapping[Key, float | tuple[float, float]] = field(default_factory=dict)
    fields: Mapping[Key, Field] = field(default_factory=dict)
    gave_up: Mapping[int, str] = field(default_factory=dict)
    unknowns: int | None = None
    seconds: float | None = None
    label: str = ""
    points: Mapping[Key, Vector] = field(default_factory=dict)

    def value(self, key: Key) -> float | None:
        """Return the value of a number; None if it is not answered."""
        found = self.scalars.get(key)
        return found[0] if isinstance(found, tuple) else found

    def has(self, key: Key) -> bool:
        """Return True if a number, the numbers at places, or a field are answered."""
        return key in self.scalars or key in self.points or key in self.fields

    def uncertainty(self, key: Key) -> float | None:
        """Return the claimed standard uncertainty; None without one."""
        found = self.scalars.get(key)
        return found[1] if isinstance(found, tuple) else None


@dataclass(frozen=True)
class Solver:
    """Solver that answers a challenge.

    sampling      of fields: "point", or "cell" for means over squares of the areas
    knows_answer  quantities that the discretisation contains, such as a radius at a mesh node
    meshless      True if numbers may be exact to rounding on every level, as those of series
    claims        grade, and orders by quantity
    """

    name: str
    version: str = ""
    url: str = ""
    sampling: str = "point"
    knows_answer: tuple[str, ...] = ()
    claimed_grade: str | None = None
    claimed_orders: Mapping[str, float] = field(default_factory=dict)
    meshless: bool = False

    def document(self) -> dict[str, Any]:
        """As a sheet shows it."""
        return {"solver": self.name, "version": self.version, "url": self.url}
