"""Data classes of a challenge: required quantities, references and accuracy classes.

The other codes get the description of a quantity; the judgement uses its reference. All values are
in SI.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from math import nan
from typing import Any, ClassVar, TypeVar

import numpy as np
from numpy.polynomial import chebyshev

from contact_scene import Body, Scene
from contact_scene.array_types import Vector
from contact_scene.stepping.load_path import (
    Control,
    ControlKind,
    LoadRamp,
)
from verification.challenge.answer import Key
from verification.problems.problem import ROUNDING

NODES = 64


@dataclass(frozen=True)
class Half:
    """Reference traction over an ellipse: a half-ellipsoid times a Chebyshev series.

    With s = (x/b_x)² + (y/b_y)², the traction is coefficient · √(1 - s) Σ c_k T_k(2 s - 1), with
    the Chebyshev polynomials T_k. A Hertz pressure has the single term c_0 = 1.

    semi_axes    semi-axes b_x, b_y of the ellipse [length]
    coefficient  amplitude of the traction [force/length²]
    series       coefficients c_0, c_1, …
    """

    semi_axes: tuple[float, float]
    coefficient: float
    series: tuple[float, ...] = (1.0,)

    def __call__(self, x: Vector, y: Vector) -> Vector:
        """Compute the reference traction at points of the surface; it is zero outside the ellipse.

        x, y  coordinates of the points, arrays of one shape [length]
        """
        b_x, b_y = self.semi_axes
        s = np.minimum((x / b_x) ** 2 + (y / b_y) ** 2, 1.0)
        shape = np.sqrt(1 - s) * chebyshev.chebval(2 * s - 1, self.series)
        return np.asarray(self.coefficient * shape)

    @property
    def total(self) -> float:
        """Force that the traction carries: its integral over the ellipse [force]."""
        return self._integral(0)

    @property
    def spread(self) -> float:
        """Second moment of the traction: the integral of (x² + y²) times the traction
        [force*length²].

        An answer to a challenge must have the same second moment.
        """
        return 0.5 * (self.semi_axes[0] ** 2 + self.semi_axes[1] ** 2) * self._integral(1)

    def _integral(self, power: int) -> float:
        """Integrate s^power times the traction over the ellipse, where s is 0 at the centre and 1
        at the edge.

        Computes π b_x b_y coefficient ∫ s^power √(1 - s) Σ c_k T_k(2 s - 1) ds by Gauss quadrature
        in √(1 - s). Power 0 gives the force; power 1 enters the second moment.
        """
        nodes, weights = np.polynomial.legendre.leggauss(NODES)
        root = 0.5 * (nodes + 1)  # √(1 - s); the integrand is smooth in it
        shape = 2 * root**2 * chebyshev.chebval(1 - 2 * root**2, self.series)
        shape *= (1 - root**2) ** power
        b_x, b_y = self.semi_axes
        return float(np.pi * b_x * b_y * self.coefficient * np.sum(0.5 * weights * shape))


@dataclass(frozen=True)
class HalfEllipsoids:
    """Reference traction that is a sum of half-ellipsoids, each times a Chebyshev series.

    Represents Hertz pressures and the shear of partial slip, in which the stick zone is one term.

    terms  half-ellipsoids, all centred at the origin
    """

    terms: tuple[Half, ...]

    def at(self, x: Vector, y: Vector) -> Vector:
        """Compute the reference traction at points of the surface [force/length²].

        x, y  coordinates of the points, arrays of one shape [length]
        """
        return np.asarray(sum(term(x, y) for term in self.terms))

    @property
    def total(self) -> float:
        """Force that the traction carries: its integral over the surface [force]."""
        return sum(term.total for term in self.terms)

    @property
    def spread(self) -> float:
        """Second moment of the traction: the integral of (x² + y²) times the traction
        [force*length²].

        An answer to a challenge must have the same second moment.
        """
        return sum(term.spread for term in self.terms)

    @property
    def semi_axes(self) -> tuple[float, float]:
        """Semi-axes along x and y of the largest of the half-ellipsoids, which contains all others
        [length]."""
        return max(term.semi_axes for term in self.terms)

    def document(self) -> dict[str, Any]:
        """Return the reference traction as a JSON record for the file `reference.json` of a
        challenge."""
        terms = [
            {"b": list(t.semi_axes), "coef": t.coefficient, "cheb": list(t.series)}
            for t in self.terms
        ]
        return {"halves": terms}


def round_halves(*terms: tuple[float, float]) -> HalfEllipsoids:
    """Create a reference traction as a sum of half-ellipsoids over circles around the origin.

    terms  pairs of radius [length] and amplitude [force/length²]
    """
    return HalfEllipsoids(tuple(Half((b, b), coefficient) for b, coefficient in terms))


def fitted(pressure: Callable[[Vector], Vector], radius: float, terms: int) -> HalfEllipsoids:
    """Fit a rotationally symmetric pressure by one half-ellipsoid times a Chebyshev series.

    The pressure must go to zero like a square root at the contact edge. The series interpolates the
    quotient of pressure and half-ellipsoid at Chebyshev points.

    pressure  pressure as a function of the distance from the axis [force/length²]
    radius    contact radius [length]
    terms     number of terms of the series
    """
    t = chebyshev.chebpts1(terms)
    r = radius * np.sqrt(0.5 * (t + 1))
    scale = float(pressure(np.zeros(1))[0])
    values = pressure(r) / (scale * np.sqrt(0.5 * (1 - t)))
    series = chebyshev.chebfit(t, values, terms - 1)
    return HalfEllipsoids((Half((radius, radius), scale, tuple(float(c) for c in series)),))


# Number of table intervals between two kinks.
INTERVALS = 200


@dataclass(frozen=True, eq=False)
class RoundTable:
    """Rotationally symmetric reference traction as a table over the radius, linear between the
    radii.

    Used for tractions that `HalfEllipsoids` cannot represent, such as the shear in torsion.

    radii   radii from 0 to the contact edge [length]
    values  traction at these radii [force/length²]
    """

    radii: Vector
    values: Vector

    def at(self, x: Vector, y: Vector) -> Vector:
        """Compute the reference traction at points of the surface; it is zero beyond the last
        radius.

        x, y  coordinates of the points, arrays of one shape [length]
        """
        return np.interp(np.hypot(x, y), self.radii, self.values, right=0.0)

    @property
    def total(self) -> float:
        """Force that the traction carries: its integral over the loaded circle [force]."""
        return self._integral(1)

    @property
    def spread(self) -> float:
        """Second moment of the traction: the integral of r² times the traction [force*length²].

        An answer to a challenge must have the same second moment.
        """
        return self._integral(3)

    @property
    def torque(self) -> float:
        """Torque about the axis, if the traction is circumferential: the integral of r times the
        traction.

        The unit is force*length.
        """
        return self._integral(2)

    def _integral(self, power: int) -> float:
        """Compute 2π ∫ q r^power dr of the tabulated traction q over the radius r, by Gauss
        quadrature.

        Power 1 gives the force, 2 the torque, 3 the second moment. Three points between two radii
        make the rule exact, because q is linear between the radii and power is at most 3.
        """
        nodes, weights = np.polynomial.legendre.leggauss(3)
        width, middle = np.diff(self.radii), 0.5 * (self.radii[1:] + self.radii[:-1])
        r = middle[:, None] + 0.5 * width[:, None] * nodes
        q = np.interp(r, self.radii, self.values)
        return float(np.pi * np.sum(width[:, None] * weights * q * r**power))

    @property
    def semi_axes(self) -> tuple[float, float]:
        """Semi-axes of the loaded circle along x and y, both equal to its radius [length]."""
        return float(self.radii[-1]), float(self.radii[-1])

    def document(self) -> dict[str, Any]:
        """Return the table of the reference traction as a JSON record for the file
        `reference.json`."""
        return {"radii": self.radii.tolist(), "values": self.values.tolist()}


def tabulated(traction: Callable[[Vector], Vector], *kinks: float) -> RoundTable:
    """Create a table of an axisymmetric traction over the radius, with dense radii near its kinks.

    traction  traction as a function of the distance from the axis [force/length²]
    kinks     radii at which the traction or its slope jumps, in increasing order; the last is the
              contact edge [length]
    """
    crowded = 0.5 * (1 - np.cos(np.pi * np.arange(INTERVALS + 1) / INTERVALS))  # at both ends
    parts, start = [np.zeros(1)], 0.0
    for end in kinks:
        parts.append((start + (end - start) * crowded)[1:])
        start = end
    radii = np.concatenate(parts)
    return RoundTable(radii, traction(radii))


Value = TypeVar("Value", float, tuple[float, float])
# Digits of the references in the digest that identifies a version of a challenge.
DIGITS = 10
# Sides of windows that contain the contact. They are round numbers, because a multiple of the
# contact radius would reveal the answer [length].
SMALL = 1.2e-3
LARGE = 2.4e-3


class Grade(StrEnum):
    """Accuracy classes A, B and C, by which the errors of an answer to a challenge are judged.

    The bounds of the relative errors are equal for all codes.
    """

    A = "A"
    B = "B"
    C = "C"

    @property
    def bound(self) -> float:
        """Largest relative error of the accuracy class: 1e-4 for A, 1e-3 for B, 1e-2 for C."""
        return {Grade.A: 1e-4, Grade.B: 1e-3, Grade.C: 1e-2}[self]


COMPONENTS = ("xx", "yy", "zz", "yz", "xz", "xy")
# Unit and definition of each number, as told to the other code.
QUANTITIES = {
    "approach": (
        "m",
        "approach of points far from the contact in both bodies; positive when pressed",
    ),
    "contact_radius": ("m", "radius of the contact, or √(contact area / π)"),
    "semi_axis_x": ("m", "semi-axis of the contact along x"),
    "semi_axis_y": ("m", "semi-axis of the contact along y"),
    "stick_radius": ("m", "radius of the zone that has not slipped since the last turn"),
    "central_pressure": ("Pa", "pressure at the centre, positive, extrapolated as you like"),
    "shift_x": (
        "m",
        "tangential shift of the indenter along +x, relative to far points of the body",
    ),
    "shift_y": (
        "m",
        "tangential shift of the indenter along +y, relative to far points of the body",
    ),
    "twist": (
        "rad",
        "rotation of the indenter about z relative to far points of the body, right-handed",
    ),
    "moment_x": ("N m", "Σ p y Δ, over all places"),
    "moment_y": ("N m", "Σ p x Δ, over all places"),
    "dissipated_energy": ("J", "energy lost to friction since the first touch"),
    "energy_per_cycle": (
        "J",
        "energy lost to friction between the ends of load steps {since} and {step}",
    ),
    "pressure": ("Pa", "pressure, positive in compression"),
    "shear_radial": ("Pa", "shear traction on the lower body, positive outward"),
    "u_z_by_pressure": ("m", "displacement along z under pressure on the patch"),
    "u_x_by_shear_x": ("m", "displacement along x under shear along x on the patch"),
    "u_y_by_shear_y": ("m", "displacement along y under shear along y on the patch"),
    "u_x_by_shear_y": ("m", "displacement along x under shear along y on the patch"),
    "u_z_by_shear_x": ("m", "displacement along z under shear along x on the patch"),
    **{f"stress_{name}": ("Pa", f"σ_{name}, tension positive") for name in COMPONENTS},
}


@dataclass(frozen=True, eq=False)
class Asked:
    """Quantity that a challenge requires at the end of a load step.

    quantity  name of the quantity
    step      number of the load step, from 1
    """

    quantity: str
    step: int

    @property
    def key(self) -> Key:
        """Quantity and load step, by which an answer names the number or the field."""
        return self.quantity, self.step


@dataclass(frozen=True, eq=False)
class AskedValue(Asked):
    """Number, or numbers at given points, that a challenge requires at the end of a load step.

    Errors are divided by the error scale, and compared with the bound of an accuracy class. Of
    numbers at points, the largest error counts.

    quantity     name of the quantity in QUANTITIES
    value        reference value, or array of reference values at the points (points,)
    scale        error scale, in the unit of the number
    over         description of the error scale
    par          accuracy class that the error must meet if the user selects no class
    places       array of points (points, 3): x, y and depth z [length]; None for one number
    required     False if the number is optional
    uncertainty  standard uncertainty of the reference, divided by the error scale
    since        load step from whose end the number counts; None: it counts from the beginning
    """

    value: Any
    scale: float
    over: str = "itself"
    par: Grade = Grade.B
    places: Any = None
    required: bool = True
    uncertainty: float = ROUNDING
    since: int | None = None

    @property
    def unit(self) -> str:
        """SI unit in which the number is required."""
        return QUANTITIES[self.quantity][0]

    @property
    def meaning(self) -> str:
        """Definition of the number for the other code."""
        return QUANTITIES[self.quantity][1].format(since=self.since, step=self.step)

    def document(self) -> dict[str, Any]:
        """Return the reference as a JSON record for the file `reference.json`."""
        known = {"quantity": self.quantity, "load_step": self.step, "unit": self.unit}
        certain = {"u": self.uncertainty * self.scale, "scale": self.scale}
        if self.places is None:
            return known | {"value": self.value} | certain
        return known | {"values": self.value.tolist()} | certain | {"places": self.places.tolist()}


@dataclass(frozen=True, eq=False)
class AskedField(Asked):
    """Traction field that a challenge may be answered by, at points that the other code chooses,
    each with an area.

    quantity     name of the traction component
    meaning      definition of the traction for the other code
    traction     exact traction
    norm         error norm: "L2", relative to the L2 norm of the exact field, or "L1", divided by
                 scale
    scale        scale of the L1 norm, and of the checked sums [force]
    total        force that the traction carries, which Σ value·area must equal [force]
    par          accuracy class that the error must meet if the user selects no class
    uncertainty  standard uncertainty of the reference, as a relative error
    """

    meaning: str
    traction: HalfEllipsoids | RoundTable
    norm: str
    scale: float
    total: float
    par: Grade = Grade.C
    uncertainty: float = ROUNDING
    required: ClassVar[bool] = False

    def document(self) -> dict[str, Any]:
        """Return the reference as a JSON record for the file `reference.json`."""
        known = {"quantity": self.quantity, "load_step": self.step, "unit": "Pa"}
        return known | {"norm": self.norm, "scale": self.scale} | self.traction.document()


@dataclass(frozen=True)
class Patch:
    """Layered body without contact, under a uniform traction on a square of its surface.

    Replaces the scene of a challenge that requires surface displacements. The square is centred at
    the origin.

    side      side of the square [length]
    traction  magnitude of the traction [force/length²]
    """

    body: Body
    side: float
    traction: float

    def document(self, *, exclude_defaults: bool = False) -> dict[str, Any]:
        """Return the body and its traction as the tables of a scene file.

        exclude_defaults  True if values that equal the defaults are left out
        """
        body = self.body.model_dump(mode="json", exclude_defaults=exclude_defaults)
        return {"body": body, "patch": {"side": self.side, "traction": self.traction}}


@dataclass(frozen=True)
class Challenge:
    """Problem for other contact codes: a scene, the required quantities, and their references.

    problem  description in words for the other code
    scene    contact scene, or body under a given traction
    source   origin of the references
    numbers  required numbers, and numbers at given points
    fields   required traction fields
    window   side of a square that contains the contact with a margin [length]
    shares   parts that the references have in common with our own solvers; empty: none
    """

    name: str
    title: str
    problem: str
    scene: Scene | Patch
    source: str
    numbers: tuple[AskedValue, ...]
    fields: tuple[AskedField, ...] = ()
    window: float = SMALL
    shares: str = ""

    @property
    def values(self) -> tuple[AskedValue, ...]:
        """Required single numbers."""
        return tuple(one for one in self.numbers if one.places is None)

    @property
    def asked(self) -> tuple[AskedValue | AskedField, ...]:
        """All required quantities: single numbers, traction fields, numbers at given points."""
        return (*self.values, *self.fields, *self.points)

    @property
    def points(self) -> tuple[AskedValue, ...]:
        """Required numbers at given points."""
        return tuple(one for one in self.numbers if one.places is not None)

    @property
    def version(self) -> str:
        """Digest of the scene, the required quantities and the references, which identifies a
        version.

        Numbers are rounded to 10 digits, so that the digest is equal on all machines.
        """
        text = json.dumps([self.document, self.reference()], sort_keys=True)
        return hashlib.sha256(text.encode()).hexdigest()[:16]

    def reference(self) -> dict[str, Any]:
        """Return the reference values of the challenge as a JSON record, the content of
        `reference.json`."""
        answers = {
            "case": self.name,
            "source": self.source,
            "shares": self.shares,
            "values": [_rounded(value.document()) for value in self.values],
            "fields": [_rounded(field.document()) for field in self.fields],
        }
        at_points = [_rounded(value.document()) for value in self.points]
        return answers | ({"points": at_points} if at_points else {})

    @property
    def document(self) -> dict[str, Any]:
        """Scene of the challenge as the tables of a scene file, with all default values.

        A body without contact has a table for the given traction.
        """
        if isinstance(self.scene, Patch):
            return self.scene.document()
        return self.scene.model_dump(mode="json")

    @property
    def ramps(self) -> tuple[LoadRamp, ...]:
        """Load steps of the scene of the challenge, as ramps; empty for a body without contact."""
        return self.scene.load_path() if isinstance(self.scene, Scene) else ()

    @property
    def loads(self) -> list[tuple[float, tuple[float, float]]]:
        """Normal force and tangential force (T_x, T_y) at the end of every load step [force].

        A force is NaN where the load step prescribes the motion instead.
        """
        return [
            (_end_force(r.normal, nan), _end_force(r.tangential, (nan, nan))) for r in self.ramps
        ]


def _end_force(control: Control[Value], unknown: Value) -> Value:
    return control.end if control.kind is ControlKind.FORCE else unknown


def _rounded(value: Any) -> Any:
    """Round all numbers in nested lists and records to 10 significant digits.

    Used for the digest of a challenge, which must not depend on the machine.
    """
    if isinstance(value, float):
        return float(f"{value:.{DIGITS}g}")
    if isinstance(value, list):
        return [_rounded(one) for one in value]
    if isinstance(value, dict):
        return {name: _rounded(one) for name, one in value.items()}
    return value
