"""Registry of all seeded defects by name, in the order of the report on seeded defects."""

from verification.defects.defect import Defect
from verification.defects.finite_elements import FINITE_ELEMENTS, RADII
from verification.defects.histories import CONTACT_AND_FRICTION, CONTROLS_AND_BODIES, HISTORIES
from verification.defects.outputs import OUTPUTS
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
    )
}
