"""The fields and scalars of an increment on the surface grid: names, units, meanings."""

from __future__ import annotations

from contact_results.files.dataset import LOADS_AND_MOTIONS, Dataset
from semi_analytical import Increment

FIELD_QUANTITIES: tuple[Dataset[Increment], ...] = (
    Dataset("pressure", "Pa", "normal traction, positive in contact", lambda i: i.pressure),
    Dataset("gap", "m", "distance of the deformed surfaces", lambda i: i.gap),
    Dataset("in_contact", "", "whether the cell is in contact", lambda i: i.in_contact),
    Dataset("shear", "Pa", "tangential traction (x, y) on the lower body", lambda i: i.shear),
    Dataset("slip", "m", "slip (x, y) of the lower body relative to the indenter, since the start",
            lambda i: i.slip),
    Dataset("slip_increment", "m", "slip (x, y) within the increment", lambda i: i.slip_increment),
    Dataset("slip_distance", "m", "way slipped since the start", lambda i: i.slip_distance),
    Dataset("dissipation", "J/m^2", "energy per area lost to friction since the start",
            lambda i: i.dissipation),
    Dataset("dissipation_increment", "J/m^2", "the same within the increment",
            lambda i: i.dissipation_increment),
    Dataset("in_stick", "", "whether the cell is in contact and sticks", lambda i: i.in_stick),
)  # fmt: skip

SCALAR_QUANTITIES: tuple[Dataset[Increment], ...] = (
    *LOADS_AND_MOTIONS,
    Dataset("moment", "N m", "(x, y), sums of pressure times y and x", lambda i: i.moment),
    Dataset("tilt", "rad", "(x, y), slopes that close the gap at positive y and x",
            lambda i: i.tilt),
    Dataset("contact_area", "m^2", "with parts of cells", lambda i: i.contact_area),
    Dataset("contact_radius", "m", "sqrt(contact_area / pi)", lambda i: i.contact_radius),
    Dataset("stick_area", "m^2", "with parts of cells", lambda i: i.stick_area),
    Dataset("stick_radius", "m", "sqrt(stick_area / pi)", lambda i: i.stick_radius),
    Dataset("peak_pressure", "Pa", "largest pressure of a cell", lambda i: i.peak_pressure),
    Dataset("dissipated_energy", "J", "by friction, since the start",
            lambda i: i.dissipated_energy),
    Dataset("elastic_energy", "J", "stored in both bodies", lambda i: i.elastic_energy),
    Dataset("input_work", "J", "of forces and moments since the start, trapezoidal rule",
            lambda i: i.input_work),
    Dataset("unresolved_work", "J", "of the input work, what finite increments leave open",
            lambda i: i.unresolved_work),
    Dataset("energy_imbalance", "", "of the increment, over the largest energy so far",
            lambda i: i.energy_imbalance),
    Dataset("worst_residual", "", "largest dimensionless residual", lambda i: i.residuals.worst),
    Dataset("iterations", "", "of the increment", lambda i: i.iterations),
    Dataset("convolutions", "", "of the increment", lambda i: i.convolutions),
)  # fmt: skip
