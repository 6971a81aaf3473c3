"""Results of one increment with fields on rings: bodies of revolution, and symmetric strips."""

from dataclasses import dataclass, field, replace
from math import pi
from typing import Annotated, TypeVar

import numpy as np

from contact_scene.array_types import Field, Mask, Vector
from contact_scene.quantities.field_metadata import (
    Kind,
    Reported,
)
from contact_scene.quantities.increment import ReportedIncrement
from contact_scene.quantities.summary import ContactStatus

Pair = tuple[float, float]
F = Kind.FIELD


@dataclass(frozen=True, kw_only=True)
class RingIncrement(ReportedIncrement):
    """Results of one converged increment for bodies of revolution, with scalars and fields on
    rings.

    Fields have the shape (rings,), or (rings, angles) with `angles`. Slip is cumulative since the
    start of the history: the displacement of the lower body's particles relative to the indenter's
    while they are in contact.

    In a line contact a ring is a pair of lines at equal distances from the middle of the contact;
    the fields are even in x.

    radii     radii of the rings [length]
    angles    angles from the direction of the tangential load [radian]: from 0 to π for fields that
              are symmetric about that direction, else below 2π; None for functions of the radius
    in_stick  rings in contact that do not slip in this increment
    strips    True for a line contact, whose forces, areas and energies are per unit length
    """

    radii: Field
    pressure: Annotated[Field, Reported("Pa", "Normal traction, positive in contact.", F)]
    gap: Annotated[
        Field,
        Reported("m", "Distance of the deformed surfaces, inf outside of the indenter.", F),
    ]
    status: ContactStatus = ContactStatus.FRICTIONLESS
    approach: float | None
    contact_area: float = field(init=False)
    stick_area: float | None = field(init=False)
    tangential_force: Pair | None = None
    tangential_shift: Pair | None = None
    angles: Field | None = None
    shear_radial: Annotated[
        Field | None, Reported("Pa", "Traction on the lower body, positive outward.", F)
    ] = None
    shear_circumferential: Annotated[
        Field | None,
        Reported("Pa", "Traction on the lower body, positive anticlockwise seen along z.", F),
    ] = None
    shear_along_load: Annotated[
        Field | None,
        Reported("Pa", "Traction on the lower body along the load, uniform on a ring.", F),
    ] = None
    slip_radial: Annotated[Field | None, Reported("m", "Slip, positive outward.", F)] = None
    slip_circumferential: Annotated[
        Field | None, Reported("m", "Slip, positive anticlockwise seen along z.", F)
    ] = None
    slip_along_load: Annotated[
        Field | None, Reported("m", "Slip along the load, uniform on a ring.", F)
    ] = None
    in_stick: Annotated[Mask | None, Reported("", "True for rings of the stick zone.", F)] = None
    strips: bool = False

    def __post_init__(self) -> None:
        for name, radius in (("contact", self.contact_radius), ("stick", self.stick_radius)):
            area = None
            if radius is not None:
                area = 2 * radius if self.strips else pi * radius**2
            object.__setattr__(self, f"{name}_area", area)
        super().__post_init__()

    @property
    def is_line(self) -> bool:
        """True for a line contact, with fields on strips."""
        return self.strips

    @property
    def covers_circle(self) -> bool:
        """True if the angles cover the whole circle; False for a half circle or without angles."""
        # The last angle of a half circle is π, that of a whole circle at least 3π/2.
        return self.angles is not None and bool(self.angles[-1] > 1.25 * pi)

    @property
    def in_contact(self) -> Mask:
        """Mask of the rings in contact, circles around the axis with a positive pressure."""
        return np.asarray(self.pressure > 0)


Rings = TypeVar("Rings", bound=RingIncrement)


def add_work(before: RingIncrement | None, increment: Rings, on_strain: float = 0.0) -> Rings:
    """Add the work of the loads to an increment that has its elastic and dissipated energy.

    The stored input work is elastic energy plus dissipated energy. Its difference from the
    trapezoidal work of the loads is stored as `unresolved_work`. Both are None as soon as a motion
    of the indenter is undefined.

    before     previous increment of the history; None for the first increment
    increment  increment without work
    on_strain  work of the shear on the imposed strain of the lower body in this increment [force
               length]
    """
    work = input_work(before, increment)
    assert increment.elastic_energy is not None
    known = increment.elastic_energy + (increment.dissipated_energy or 0.0)
    return replace(
        increment,
        input_work=None if work is None else known,
        unresolved_work=None if work is None else work - on_strain - known,
    )


def input_work(before: RingIncrement | None, increment: RingIncrement) -> float | None:
    """Compute the work of all loads since the start of the history by the trapezoidal rule.

    The work is Σ ½ (f₀ + f₁)(ω₁ - ω₀) over the increments [force length]. f are the normal force,
    tangential force and torque at the start (0) and end (1) of an increment. ω are the conjugate
    motions of the indenter: approach, shift and twist. Return None as soon as a motion is
    undefined, that is at the friction limit under force control.

    before     previous increment, whose work is continued; None for the first increment
    increment  increment whose contribution is added
    """
    worked = 0.0 if before is None else before.trapezoidal_work
    forces, motions = (np.zeros(4), np.zeros(4)) if before is None else _conjugate_loads(before)
    now, place = _conjugate_loads(increment)
    if worked is None or motions is None or place is None:
        return None
    return worked + float(np.sum(0.5 * (forces + now) * (place - motions)))


def _conjugate_loads(increment: RingIncrement) -> tuple[Vector, Vector | None]:
    """Return (W, T_x, T_y, M_z) and (approach, shift x, shift y, twist), for the work of the loads.

    The motions are None if the shift or the twist is undefined, as at the friction limit under
    force control.
    """
    force, shift = increment.tangential_force, increment.tangential_shift
    torque, twist = increment.torque, increment.twist
    now = np.array([increment.normal_force, *(force or (0.0, 0.0)), torque or 0.0])
    if (force is not None and shift is None) or (torque is not None and twist is None):
        return now, None
    return now, np.array([increment.approach, *(shift or (0.0, 0.0)), twist or 0.0])
