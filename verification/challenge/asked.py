"""What a challenge asks for, what is right, and how near is near enough."""

from __future__ import annotations

import hashlib
import json
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

from contact_scene import Scene
from verification.challenge.halves import Halves
from verification.problems.reference import ROUNDING

DIGITS = 10  # of the references, by which versions are told apart


class Grade(StrEnum):
    """Bounds of errors over their scale; they do not depend on who answers."""

    A = "A"
    B = "B"
    C = "C"

    @property
    def bound(self) -> float:
        """The largest error."""
        return {Grade.A: 1e-4, Grade.B: 1e-3, Grade.C: 1e-2}[self]


@dataclass(frozen=True)
class AskedValue:
    """A number at the end of a loading step.

    step     from 1
    scale    what its error is divided by, and `over` in words
    par      the grade that is asked where nothing else is
    between  the steps whose difference it is; None where it is a state
    """

    quantity: str
    step: int
    unit: str
    meaning: str
    value: float
    scale: float
    over: str
    par: Grade = Grade.B
    required: bool = True
    uncertainty: float = ROUNDING  # standard, over the scale
    limit: float | None = None  # order that collocated constants reach


@dataclass(frozen=True)
class AskedField:
    """A traction at the answerer's own points, with the area that each stands for.

    norm   "L2", relative to the field's own, or "L1", relative to the scale
    scale  [force]
    total  the force that it carries, which Σ value·area must give [force]
    """

    quantity: str
    step: int
    meaning: str
    halves: Halves
    norm: str
    scale: float
    total: float
    par: Grade = Grade.C
    uncertainty: float = ROUNDING
    limit: float | None = 1.0


@dataclass(frozen=True)
class Challenge:
    """A problem for others.

    problem  in words
    window   side of a square in which all of it happens, with room [length]
    shares   what its reference has in common with our own solvers; empty: nothing
    """

    name: str
    title: str
    problem: str
    scene: Scene
    source: str
    values: tuple[AskedValue, ...]
    fields: tuple[AskedField, ...]
    window: float
    shares: str = ""

    @property
    def version(self) -> str:
        """Digest of what is asked and of what is right, to digits that all machines agree on."""
        text = json.dumps([self.scene.model_dump(mode="json"), self.reference()], sort_keys=True)
        return hashlib.sha256(text.encode()).hexdigest()[:16]

    def reference(self) -> dict[str, Any]:
        """What is right, as it is written for others."""
        return {
            "case": self.name,
            "source": self.source,
            "shares": self.shares,
            "values": [
                {
                    "quantity": v.quantity, "load_step": v.step, "unit": v.unit,
                    "value": _digits(v.value), "u": _digits(v.uncertainty * v.scale),
                    "scale": _digits(v.scale),
                }
                for v in self.values
            ],
            "fields": [
                {
                    "quantity": f.quantity, "load_step": f.step, "unit": "Pa", "norm": f.norm,
                    "scale": _digits(f.scale), "halves": _digits(f.halves.document()),
                }
                for f in self.fields
            ],
        }  # fmt: skip

    @property
    def loads(self) -> list[tuple[float, tuple[float, float]]]:
        """Normal and tangential force at the end of every loading step [force]."""
        ramps = self.scene.load_path()
        return [(ramp.normal.end, ramp.tangential.end) for ramp in ramps]

    def value(self, quantity: str, step: int) -> AskedValue | None:
        """What is asked under this name; None where nothing is."""
        found = (v for v in self.values if (v.quantity, v.step) == (quantity, step))
        return next(found, None)


def _digits(value: Any) -> Any:
    """To DIGITS digits, through lists and records."""
    if isinstance(value, float):
        return float(f"{value:.{DIGITS}g}")
    if isinstance(value, list):
        return [_digits(one) for one in value]
    if isinstance(value, dict):
        return {name: _digits(one) for name, one in value.items()}
    return value
