"""The fields and scalars of an increment on a section: names, units, meanings."""

from __future__ import annotations

from contact_results.files.dataset import LOADS_AND_MOTIONS, Dataset
from fem_reference import Increment

# (rings,) or (rings, angles).
FIELD_QUANTITIES: tuple[Dataset[Increment], ...] = (
    Dataset("pressure", "Pa", "normal traction, positive in contact", lambda i: i.pressure),
    Dataset("gap", "m", "distance of the deformed surfaces", lambda i: i.gap),
    Dataset("shear_radial", "Pa", "traction on the lower body, outward", lambda i: i.shear_radial),
    Dataset("shear_circumferential", "Pa", "traction on the lower body, around z",
            lambda i: i.shear_circumferential),
    Dataset("shear_along_load", "Pa", "traction on the lower body along the load",
            lambda i: i.shear_along_load),
    Dataset("slip_radial", "m", "of the lower body relative to the indenter, outward",
            lambda i: i.slip_radial),
    Dataset("slip_circumferential", "m", "the same around z", lambda i: i.slip_circumferential),
    Dataset("slip_along_load", "m", "the same along the load", lambda i: i.slip_along_load),
    Dataset("in_stick", "", "whether the ring is in contact and sticks", lambda i: i.in_stick),
)  # fmt: skip

SCALAR_QUANTITIES: tuple[Dataset[Increment], ...] = (
    *LOADS_AND_MOTIONS,
    Dataset("contact_radius", "m", "where the pressure ends", lambda i: i.contact_radius),
    Dataset("stick_radius", "m", "where stick ends", lambda i: i.stick_radius),
    Dataset("peak_pressure", "Pa", "largest pressure of a ring", lambda i: i.peak_pressure),
    Dataset("dissipated_energy", "J", "by friction, since the start",
            lambda i: i.dissipated_energy),
    Dataset("worst_residual", "", "largest dimensionless residual", lambda i: i.residuals.worst),
    Dataset("iterations", "", "linear systems of the contact solver", lambda i: i.iterations),
)  # fmt: skip
