"""An increment whose fields are functions of the radius, as bodies of revolution have them."""

from dataclasses import dataclass, field
from math import pi
from typing import Annotated

import numpy as np
from numpy.typing import NDArray

from contact_scene.quantities.field_metadata import (
    Kind,
    Reported,
)
from contact_scene.quantities.increment import ReportedIncrement
from contact_scene.quantities.summary import ContactStatus

Field = NDArray[np.float64]
Mask = NDArray[np.bool_]
Pair = tuple[float, float]
F = Kind.FIELD


@dataclass(frozen=True, kw_only=True)
class RingIncrement(ReportedIncrement):
    """The converged state at the end of one increment of the load history.

    Fields are (rings,), or (rings, angles) where `angles` is given. Slip is since the start of the
    history, of the lower body's particles relative to the indenter's while they were in contact.

    radii     of the rings [length]
    angles    from the direction of the tangential load [radian], from 0 to π, or to less than 2π
              where the halves of the circle are not alike; None where one function of the radius
              says all
    in_stick  rings in contact that did not slip in this increment
    """

    radii: Field
    pressure: Annotated[Field, Reported("Pa", "Normal traction, positive in contact.", F)]
    gap: Annotated[
        Field,
        Reported("m", "Distance of the deformed surfaces, inf where they never touch.", F),
    ]
    status: ContactStatus = ContactStatus.FRICTIONLESS
    contact_area: float = field(init=False)
    stick_area: float | None = field(init=False)
    tangential_force: Pair | None = None
    tangential_shift: Pair | None = None
    angles: Field | None = None
    shear_radial: Annotated[
        Field | None, Reported("Pa", "Traction on the lower body, outward.", F)
    ] = None
    shear_circumferential: Annotated[
        Field | None,
        Reported("Pa", "Traction on the lower body, anticlockwise seen along z.", F),
    ] = None
    shear_along_load: Annotated[
        Field | None,
        Reported("Pa", "Traction on the lower body along the load, on a whole ring.", F),
    ] = None
    slip_radial: Annotated[Field | None, Reported("m", "Slip, outward.", F)] = None
    slip_circumferential: Annotated[
        Field | None, Reported("m", "Slip, anticlockwise seen along z.", F)
    ] = None
    slip_along_load: Annotated[
        Field | None, Reported("m", "Slip along the load, on a whole ring.", F)
    ] = None
    in_stick: Annotated[
        Mask | None, Reported("", "Whether the ring is in contact and sticks.", F)
    ] = None

    def __post_init__(self) -> None:
        stuck = None if self.stick_radius is None else pi * self.stick_radius**2
        object.__setattr__(self, "contact_area", pi * self.contact_radius**2)
        object.__setattr__(self, "stick_area", stuck)
        super().__post_init__()

    @property
    def in_contact(self) -> Mask:
        """Rings that carry pressure."""
        return np.asarray(self.pressure > 0)
