"""Answers of other codes to challenges: numbers and tractions on one refinement level.

The module imports little, as the child process of a solver function imports it. Values are in SI.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from contact_scene.array_types import Vector

Key = tuple[str, int]  # quantity and load step, from 1


@dataclass(frozen=True)
class Field:
    """Traction that another code computed, given at points that this code has chosen.

    x, y   coordinates of the points (points,) [m]
    value  one traction component at the points (points,) [Pa]
    area   area of the surface that each point represents (points,) [m²]

    Raises ValueError for arrays of unequal lengths, complex or without points, or areas that are
    not positive.
    """

    x: Vector
    y: Vector
    value: Vector
    area: Vector

    def __post_init__(self) -> None:
        for name in ("x", "y", "value", "area"):
            given = np.asarray(getattr(self, name))
            if np.iscomplexobj(given):
                raise ValueError(f"{name} is complex, expected real numbers")
            flat = np.ravel(np.asarray(given, dtype=np.float64))
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
    """Answer of another code to a challenge, computed on one refinement level.

    Numbers are identified by a key: the pair of quantity name and load step, counted from 1.

    h         side of a cell or element at the contact edge, or √area if its sides differ [m]
    scalars   numbers by key; a value, or a pair of the value and its standard uncertainty [SI]
    fields    tractions on the lower body by key [Pa]
    gave_up   reason for a missing answer, by load step; step 0 stands for all steps
    unknowns  number of unknowns of the discrete problem; None if it is not given
    seconds   computing time of this level [s]; None if it is not given
    label     name of the level
    points    numbers at the points that the challenge prescribes, in their order, by key [SI]
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
        """Return the value that the answer gives for a required number; None if the number is
        missing.

        key  name of the quantity, and load step
        """
        found = self.scalars.get(key)
        return found[0] if isinstance(found, tuple) else found

    def has(self, key: Key) -> bool:
        """Return True if the answer contains a number, numbers at points, or a field for a
        quantity.

        key  name of the quantity, and load step
        """
        return key in self.scalars or key in self.points or key in self.fields

    def uncertainty(self, key: Key) -> float | None:
        """Return the standard uncertainty that the other code states for a number.

        The result is None if the code states no uncertainty or the number is missing.

        key  name of the quantity, and load step
        """
        found = self.scalars.get(key)
        return found[1] if isinstance(found, tuple) else None


@dataclass(frozen=True)
class Solver:
    """Description of a code that answers challenges, and of the accuracy that it claims.

    sampling         meaning of the values of a traction field: "point" for values at points, "cell"
                     for means over squares around the points
    claimed_grade    accuracy class "A", "B" or "C" that the code claims; None: no claim
    claimed_orders   convergence orders that the code claims, by quantity
    """

    name: str
    version: str = ""
    url: str = ""
    sampling: str = "point"
    claimed_grade: str | None = None
    claimed_orders: Mapping[str, float] = field(default_factory=dict)

    def document(self) -> dict[str, Any]:
        """Return name, version and address of a code that answers challenges, as a JSON record.

        The record is part of a result sheet.
        """
        return {"solver": self.name, "version": self.version, "url": self.url}
