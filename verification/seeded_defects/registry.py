"""All defects, in the order of the report."""

from verification.seeded_defects.contact_and_friction import CONTACT_AND_FRICTION
from verification.seeded_defects.defect import Defect
from verification.seeded_defects.finite_elements import FINITE_ELEMENTS
from verification.seeded_defects.histories import HISTORIES
from verification.seeded_defects.outputs import OUTPUTS
from verification.seeded_defects.surface_response import SURFACE_RESPONSE

DEFECTS: dict[str, Defect] = {
    defect.name: defect
    for defect in (
        *SURFACE_RESPONSE,
        *CONTACT_AND_FRICTION,
        *HISTORIES,
        *FINITE_ELEMENTS,
        *OUTPUTS,
    )
}
