"""Results of one increment for bodies of revolution, with fields on concentric rings."""

from dataclasses import dataclass, field
from math import pi
from typing import Annotated

import numpy as np

from contact_scene.array_types import Field, Mask
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

    radii     radii of the rings [length]
    angles    angles from the direction of the tangential load [radian]: from 0 to π for fields that
              are symmetric about that direction, else below 2π; None for functions of the radius
    in_stick  rings in contact that do not slip in this increment
    """

    radii: Field
    pressure: Annotated[Field, Reported("Pa", "Normal traction, positive in contact.", F)]
    gap: Annotated[
        Field,
        Reported("m", "Distance of the deformed surfaces, inf outside of the indenter.", F),
    ]
    status: ContactStatus = ContactStatus.FRICTIONLESS
    approach: float
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

    def __post_init__(self) -> None:
        stuck = None if self.stick_radius is None else pi * self.stick_radius**2
        object.__setattr__(self, "contact_area", pi * self.contact_radius**2)
        object.__setattr__(self, "stick_area", stuck)
        super().__post_init__()

    @property
    def covers_circle(self) -> bool:
        """True if the angles cover the whole circle; False for a half circle or without angles."""
        # The last angle of a half circle is π, that of a whole circle at least 3π/2.
        return self.angles is not None and bool(self.angles[-1] > 1.25 * pi)

    @property
    def in_contact(self) -> Mask:
        """Mask of the rings in contact, circles around the axis with a positive pressure."""
        return np.asarray(self.pressure > 0)
