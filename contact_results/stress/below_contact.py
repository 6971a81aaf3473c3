"""Response of a body to the surface tractions of any solver."""

from contact_results.stress.body_response import BodyResponse
from contact_results.stress.loaded_bodies import LoadedBodies
from contact_results.stress.on_cells import OnCells
from contact_results.stress.on_disc import OnDisc
from contact_results.stress.on_section import OnSection


def body_response(state: LoadedBodies, *, indenter: bool = False) -> BodyResponse:
    """Return the response of a body below a contact, by the solver of the contact.

    state     bodies and surface tractions
    indenter  True for the indenter, False for the lower body
    """
    if state.pressed is not None:
        return OnDisc(state, indenter)
    return OnSection(state, indenter) if state.on_rings else OnCells(state, indenter)
