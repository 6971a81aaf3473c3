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

from contact_scene import Body, Scene
from contact_scene.array_types import Vector
from contact_scene.stepping.load_path import (
    Control,
    ControlKind,
    LoadRamp,
)
from verification.challenge.answer import Key
from verification.problems.problem import ROUNDING

# Gauss points between two kinks of a traction.
NODES = 64
# Number of table intervals between two kinks.
INTERVALS = 200


@dataclass(frozen=True, eq=False)
class Traction:
    """Exact traction over an ellipse or a circle around the origin.

    values     traction as a function of the distance from the origin along x; curves of equal
               traction are similar ellipses [force/length²]
    semi_axes  semi-axes of the ellipse along x and y [length]
    kinks      distances along x between 0 and the edge at which the traction or its slope jumps, in
               increasing order [length]
    """

    values: Callable[[Vector], Vector]
    semi_axes: tuple[float, float]
    kinks: tuple[float, ...] = ()

    def at(self, x: Vector, y: Vector) -> Vector:
        """Compute the traction at points of the surface; it is zero outside the ellipse.

        x, y  coordinates of the points, arrays of one shape [length]
        """
        edge = self.semi_axes[0]
        r = np.hypot(x, y / self._ratio)
        return np.where(r < edge, self.values(np.minimum(r, edge)), 0.0)

    @property
    def total(self) -> float:
        """Force that the traction carries: its integral over the ellipse [force]."""
        return 2 * np.pi * self._ratio * self._integral(1)

    @property
    def spread(self) -> float:
        """Second moment of the traction: the integral of (x² + y²) times the traction
        [force*length²].

        An answer to a challenge must have the same second moment.
        """
        return np.pi * self._ratio * (1 + self._ratio**2) * self._integral(3)

    @property
    def torque(self) -> float:
        """Torque about the axis of a circumferential traction over a circle [force*length]."""
        return 2 * np.pi * self._integral(2)

    @property
    def _ratio(self) -> float:
        return self.semi_axes[1] / self.semi_axes[0]

    def _between_kinks(self, parts: Vector) -> tuple[Vector, Vector]:
        """Return distances along x between adjacent kinks, and the distances of these kinks.

        Distances are dense near the kinks: root functions of the distance from a kink are smooth
        functions of the part. The shape is (kinks, parts).

        parts  positions from 0 at one kink to 1 at the next
        """
        ends = np.array([0.0, *self.kinks, self.semi_axes[0]])
        width = np.diff(ends)[:, None]
        return ends[:-1, None] + width * 0.5 * (1 - np.cos(np.pi * parts)), width

    def _integral(self, power: int) -> float:
        """Integrate values · r^power over the distance r along x by Gauss quadrature."""
        nodes, weights = np.polynomial.legendre.leggauss(NODES)
        parts = 0.5 * (nodes + 1)
        r, width = self._between_kinks(parts)
        steps = 0.25 * np.pi * width * np.sin(np.pi * parts) * weights
        return float(np.sum(steps * self.values(r) * r**power))

    def document(self) -> dict[str, Any]:
        """Return the traction as a table in a JSON record for the file `reference.json`.

        Values are rounded to a millionth of the largest: next to the root at the edge the last
        digits differ between machines.
        """
        r, _ = self._between_kinks(np.arange(1, INTERVALS + 1) / INTERVALS)
        radii = np.append(0.0, r)
        values = self.values(radii)
        largest = float(np.max(np.abs(values)))
        return {
            "semi_axes": list(self.semi_axes),
            "radii": radii.tolist(),
            "values": (np.round(values / largest, 6) * largest).tolist(),
        }


def round_traction(values: Callable[[Vector], Vector], radius: float, *kinks: float) -> Traction:
    """Create an exact traction over a circle.

    values  traction as a function of the distance from the axis [force/length²]
    radius  radius of the circle [length]
    kinks   radii at which the traction or its slope jumps, in any order; zeros do not count
    """
    return Traction(values, (radius, radius), tuple(sorted({one for one in kinks if one > 0})))


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
    traction: Traction
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
