"""What a challenge asks for, what is right, and how near is near enough."""

from __future__ import annotations

import hashlib
import json
from dataclasses import dataclass
from enum import StrEnum
from math import nan
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from contact_scene import Body, Scene
from contact_scene.stepping.load_path import (
    Control,
    ControlKind,
    LoadRamp,
)
from verification.challenge.half_ellipsoids import HalfEllipsoids
from verification.challenge.round_table import RoundTable
from verification.problems.reference import ROUNDING

Value = TypeVar("Value", float, tuple[float, float])
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
    since    the loading step from whose end it counts; None where it is a state
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
    since: int | None = None


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
    traction: HalfEllipsoids | RoundTable
    norm: str
    scale: float
    total: float
    par: Grade = Grade.C
    uncertainty: float = ROUNDING
    limit: float | None = 1.0


@dataclass(frozen=True, eq=False)
class AskedPoints:
    """Numbers at given places at the end of a loading step: the largest error is judged.

    places       (points, 3): x, y and depth z [length]
    values       there [unit]
    scale        what errors are divided by, and `over` in words
    uncertainty  standard, over the scale
    """

    quantity: str
    step: int
    unit: str
    meaning: str
    places: NDArray[np.float64]
    values: NDArray[np.float64]
    scale: float
    over: str
    par: Grade = Grade.C
    required: bool = True
    uncertainty: float = ROUNDING


@dataclass(frozen=True)
class Patch:
    """No contact: a uniform traction on a square of a body's surface around the origin.

    side      [length]
    traction  [force/length²]
    """

    body: Body
    side: float
    traction: float

    def document(self, *, exclude_defaults: bool = False) -> dict[str, Any]:
        """As tables of a file."""
        body = self.body.model_dump(mode="json", exclude_defaults=exclude_defaults)
        return {"body": body, "patch": {"side": self.side, "traction": self.traction}}


@dataclass(frozen=True)
class Challenge:
    """A problem for others.

    problem  in words
    scene    a contact, or a body under a given traction
    window   side of a square in which all of it happens, with room [length]
    shares   what its reference has in common with our own solvers; empty: nothing
    """

    name: str
    title: str
    problem: str
    scene: Scene | Patch
    source: str
    values: tuple[AskedValue, ...]
    fields: tuple[AskedField, ...]
    window: float
    shares: str = ""
    points: tuple[AskedPoints, ...] = ()

    @property
    def version(self) -> str:
        """Digest of what is asked and of what is right, to digits that all machines agree on."""
        text = json.dumps([self.document, self.reference()], sort_keys=True)
        return hashlib.sha256(text.encode()).hexdigest()[:16]

    def reference(self) -> dict[str, Any]:
        """What is right, as it is written for others."""
        answers = {
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
                    "scale": _digits(f.scale), **_digits(f.traction.document()),
                }
                for f in self.fields
            ],
        }  # fmt: skip
        if not self.points:
            return answers
        return answers | {
            "points": [
                {
                    "quantity": p.quantity, "load_step": p.step, "unit": p.unit,
                    "values": _digits(p.values.tolist()), "u": _digits(p.uncertainty * p.scale),
                    "scale": _digits(p.scale), "places": _digits(p.places.tolist()),
                }
                for p in self.points
            ]
        }  # fmt: skip

    @property
    def document(self) -> dict[str, Any]:
        """The scene as in a scene file, with all that is usual."""
        if isinstance(self.scene, Patch):
            return self.scene.document()
        return self.scene.model_dump(mode="json")

    @property
    def ramps(self) -> tuple[LoadRamp, ...]:
        """The loading steps; none where the tractions are given."""
        return self.scene.load_path() if isinstance(self.scene, Scene) else ()

    @property
    def loads(self) -> list[tuple[float, tuple[float, float]]]:
        """Normal and tangential force at the end of every loading step, NaN where a motion is
        prescribed [force]."""
        return [(_force(r.normal, nan), _force(r.tangential, (nan, nan))) for r in self.ramps]

    def one(self, quantity: str, step: int) -> AskedValue | AskedPoints | None:
        """The number or numbers that are asked under this name; None where none are."""
        found = (v for v in self.numbers if (v.quantity, v.step) == (quantity, step))
        return next(found, None)

    @property
    def numbers(self) -> tuple[AskedValue | AskedPoints, ...]:
        """All that is asked but fields."""
        return (*self.values, *self.points)


def _force(control: Control[Value], unknown: Value) -> Value:
    return control.end if control.kind is ControlKind.FORCE else unknown


def _digits(value: Any) -> Any:
    """To DIGITS digits, through lists and records."""
    if isinstance(value, float):
        return float(f"{value:.{DIGITS}g}")
    if isinstance(value, list):
        return [_digits(one) for one in value]
    if isinstance(value, dict):
        return {name: _digits(one) for name, one in value.items()}
    return value
