"""Units of figures, and the size below which a number is round-off."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Protocol

from contact_scene.engineering_units import EngineeringUnit, engineering_unit

# What makes a number negligible, beside the size that the load gives it.
ROUND_OFF = 1e-9


class Loaded(Protocol):
    """The end of a loading step."""

    @property
    def normal_force(self) -> float: ...
    @property
    def approach(self) -> float: ...
    @property
    def contact_radius(self) -> float: ...


@dataclass(frozen=True)
class Units:
    """The units of figures.

    sizes  those of kinds of quantities that are not SI with a prefix
    note   what they are, for a caption
    """

    sizes: Mapping[str, EngineeringUnit] = field(default_factory=dict)
    note: str = ""

    def of(self, kind: str, magnitude: float, unit: str) -> EngineeringUnit:
        """The unit of a kind of quantity, or the SI unit with the prefix that suits it."""
        return self.sizes.get(kind) or engineering_unit(magnitude, unit)


SI = Units()


def natural_size(ends: Iterable[Loaded], unit: str) -> float:
    """The size that a quantity of a unit has under these loads; 0 where they do not tell."""
    ends = list(ends)
    force, radius, approach = (
        max((abs(getattr(end, name)) for end in ends), default=0.0)
        for name in ("normal_force", "contact_radius", "approach")
    )
    sizes = {"N": force, "N m": force * radius, "m": approach, "J": force * approach}
    slope = approach / radius if radius else 0.0
    return (sizes | {"rad": slope}).get(unit, 0.0)


def without_round_off(value: float, ends: Iterable[Loaded], unit: str) -> float:
    """The value, or 0 where it is round-off beside the load."""
    return 0.0 if abs(value) <= ROUND_OFF * natural_size(ends, unit) else value
