"""Required quantities of a challenge, their references and classes of error."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from math import nan
from typing import Any, TypeVar

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray

from contact_scene import Body, Scene
from contact_scene.stepping.load_path import (
    Control,
    ControlKind,
    LoadRamp,
)
from verification.problems.paper_scene import HERTZ
from verification.problems.problem import ROUNDING

Field = NDArray[np.float64]

NODES = 64


@dataclass(frozen=True)
class Half:
    """One term.

    semi_axes    b_x, b_y [length]
    coefficient  of the traction [force/length²]
    series       c_0, c_1, …
    """

    semi_axes: tuple[float, float]
    coefficient: float
    series: tuple[float, ...] = (1.0,)

    def __call__(self, x: Field, y: Field) -> Field:
        """Return the traction at positions [length]."""
        b_x, b_y = self.semi_axes
        s = np.minimum((x / b_x) ** 2 + (y / b_y) ** 2, 1.0)
        shape = np.sqrt(1 - s) * chebyshev.chebval(2 * s - 1, self.series)
        return np.asarray(self.coefficient * shape)

    @property
    def total(self) -> float:
        """Its integral [force]."""
        return self._integral(0)

    @property
    def spread(self) -> float:
        """Its integral times x² + y² [force*length²]."""
        return 0.5 * (self.semi_axes[0] ** 2 + self.semi_axes[1] ** 2) * self._integral(1)

    def _integral(self, power: int) -> float:
        """Return π b_x b_y ∫ s^(2 power) √(1 - s²) Σ c_k T_k ds²."""
        nodes, weights = np.polynomial.legendre.leggauss(NODES)
        root = 0.5 * (nodes + 1)  # √(1 - s²): smooth in it
        shape = 2 * root**2 * chebyshev.chebval(1 - 2 * root**2, self.series)
        shape *= (1 - root**2) ** power
        b_x, b_y = self.semi_axes
        return float(np.pi * b_x * b_y * self.coefficient * np.sum(0.5 * weights * shape))


@dataclass(frozen=True)
class HalfEllipsoids:
    """The sum of terms."""

    terms: tuple[Half, ...]

    def at(self, x: Field, y: Field) -> Field:
        """Return the traction at positions [length]."""
        return np.asarray(sum(term(x, y) for term in self.terms))

    @property
    def total(self) -> float:
        """The force carried."""
        return sum(term.total for term in self.terms)

    @property
    def spread(self) -> float:
        """The force carried, times the square of its distance from the axis [force*length²]."""
        return sum(term.spread for term in self.terms)

    @property
    def semi_axes(self) -> tuple[float, float]:
        """Semi-axes of the largest term, which contains the others [length]."""
        return max(term.semi_axes for term in self.terms)

    def document(self) -> dict[str, Any]:
        """As it is written for others."""
        terms = [
            {"b": list(t.semi_axes), "coef": t.coefficient, "cheb": list(t.series)}
            for t in self.terms
        ]
        return {"halves": terms}


def round_halves(*terms: tuple[float, float]) -> HalfEllipsoids:
    """Return half-ellipsoids from radii and coefficients."""
    return HalfEllipsoids(tuple(Half((b, b), coefficient) for b, coefficient in terms))


def fitted(pressure: Callable[[Field], Field], radius: float, terms: int) -> HalfEllipsoids:
    """Return a round pressure with a square-root edge as one term with a series, by interpolation.

    pressure  at distances from the axis [force/length²]
    """
    t = chebyshev.chebpts1(terms)
    r = radius * np.sqrt(0.5 * (t + 1))
    scale = float(pressure(np.zeros(1))[0])
    values = pressure(r) / (scale * np.sqrt(0.5 * (1 - t)))
    series = chebyshev.chebfit(t, values, terms - 1)
    return HalfEllipsoids((Half((radius, radius), scale, tuple(float(c) for c in series)),))


INTERVALS = 200  # of each part between two kinks


@dataclass(frozen=True, eq=False)
class RoundTable:
    """It stands for a `HalfEllipsoids` where no series of half-ellipsoids does.

    radii   from 0 to the edge [length]
    values  there [force/length²]
    """

    radii: Field
    values: Field

    def at(self, x: Field, y: Field) -> Field:
        """Return the traction at positions [length]."""
        return np.interp(np.hypot(x, y), self.radii, self.values, right=0.0)

    @property
    def total(self) -> float:
        """Its integral over the surface [force]."""
        return self._integral(1)

    @property
    def spread(self) -> float:
        """The same, times the square of the distance from the axis [force*length²]."""
        return self._integral(3)

    @property
    def torque(self) -> float:
        """The same, times the distance: of a traction around the axis [force*length]."""
        return self._integral(2)

    def _integral(self, power: int) -> float:
        """Return 2π ∫ q r^power dr by three points of Gauss, exact for a line times r³."""
        nodes, weights = np.polynomial.legendre.leggauss(3)
        width, middle = np.diff(self.radii), 0.5 * (self.radii[1:] + self.radii[:-1])
        r = middle[:, None] + 0.5 * width[:, None] * nodes
        q = np.interp(r, self.radii, self.values)
        return float(np.pi * np.sum(width[:, None] * weights * q * r**power))

    @property
    def semi_axes(self) -> tuple[float, float]:
        """The largest radius, twice [length]."""
        return float(self.radii[-1]), float(self.radii[-1])

    def document(self) -> dict[str, Any]:
        """As it is written for others."""
        return {"radii": self.radii.tolist(), "values": self.values.tolist()}


def tabulated(traction: Callable[[Field], Field], *kinks: float) -> RoundTable:
    """Tabulate a function of the radius, with dense points where it is steep.

    kinks  radii of jumps of the function or its slope; the last is the edge [length]
    """
    crowded = 0.5 * (1 - np.cos(np.pi * np.arange(INTERVALS + 1) / INTERVALS))  # at both ends
    parts, start = [np.zeros(1)], 0.0
    for end in kinks:
        parts.append((start + (end - start) * crowded)[1:])
        start = end
    radii = np.concatenate(parts)
    return RoundTable(radii, traction(radii))


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
        """Return the tables of the scene file."""
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
        """Digest of required quantities and references, rounded for all machines."""
        text = json.dumps([self.document, self.reference()], sort_keys=True)
        return hashlib.sha256(text.encode()).hexdigest()[:16]

    def reference(self) -> dict[str, Any]:
        """Return the references as written to `reference.json`."""
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
        """Return the required number or numbers of this name and step; None if there are none."""
        found = (v for v in self.numbers if (v.quantity, v.step) == (quantity, step))
        return next(found, None)

    @property
    def numbers(self) -> tuple[AskedValue | AskedPoints, ...]:
        """Required numbers and numbers at points, without fields."""
        return (*self.values, *self.points)


def _force(control: Control[Value], unknown: Value) -> Value:
    return control.end if control.kind is ControlKind.FORCE else unknown


def _digits(value: Any) -> Any:
    """Round the numbers of nested lists and records to DIGITS digits."""
    if isinstance(value, float):
        return float(f"{value:.{DIGITS}g}")
    if isinstance(value, list):
        return [_digits(one) for one in value]
    if isinstance(value, dict):
        return {name: _digits(one) for name, one in value.items()}
    return value


# Sides of windows in which all of it fits, round on purpose: what is a multiple of the contact
# radius knows the answer [length].
SMALL, LARGE = 1.2e-3, 2.4e-3
CLOSED = 1e-12  # of closed and semi-closed forms, relative


def approach(value: float, uncertainty: float = CLOSED, step: int = 1) -> AskedValue:
    """Return the approach as a required number, relative to itself."""
    meaning = "approach of points far from the contact in both bodies; positive when pressed"
    return AskedValue("approach", step, "m", meaning, value, value, "itself",
                      uncertainty=uncertainty, limit=2)  # fmt: skip


def contact_radius(value: float, uncertainty: float = CLOSED) -> AskedValue:
    """Return the contact radius as a required number, relative to itself."""
    meaning = "radius of the contact, or √(contact area / π)"
    return AskedValue("contact_radius", 1, "m", meaning, value, value, "itself",
                      uncertainty=uncertainty, limit=1)  # fmt: skip


def stick_radius(value: float, step: int, uncertainty: float = CLOSED) -> AskedValue:
    """Return the stick radius as a required number, relative to the Hertz contact radius."""
    return AskedValue(
        "stick_radius", step, "m", "radius of the zone that has not slipped since the last turn",
        value, HERTZ.contact_radius, "the contact radius", Grade.C, required=False,
        uncertainty=uncertainty, limit=1,
    )  # fmt: skip
