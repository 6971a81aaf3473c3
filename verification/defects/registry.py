"""All defects, in the order of the report."""

from verification.defects.contact_and_friction import CONTACT_AND_FRICTION
from verification.defects.controls_and_bodies import CONTROLS_AND_BODIES
from verification.defects.defect import Defect
from verification.defects.finite_elements import FINITE_ELEMENTS
from verification.defects.histories import HISTORIES
from verification.defects.outputs import OUTPUTS
from verification.defects.radii import RADII
from verification.defects.reporting_defects import TOLD
from verification.defects.surface_response import SURFACE_RESPONSE

DEFECTS: dict[str, Defect] = {
    defect.name: defect
    for defect in (
        *SURFACE_RESPONSE,
        *CONTACT_AND_FRICTION,
        *HISTORIES,
        *CONTROLS_AND_BODIES,
        *FINITE_ELEMENTS,
        *RADII,
        *OUTPUTS,
        *TOLD,
    )
}
