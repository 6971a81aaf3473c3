"""Stress below the contact in a body, from the surface tractions of any solver."""

from collections.abc import Sequence

from contact_results.stress.loaded_bodies import LoadedBodies
from contact_results.stress.on_cells import stress_on_cells
from contact_results.stress.on_disc import stress_on_disc
from contact_results.stress.on_section import stress_on_section
from contact_results.stress.points import StressField


def stress_below_contact(
    state: LoadedBodies,
    *,
    indenter: bool = False,
    depths: Sequence[float] | None = None,
    volume: bool = False,
) -> StressField:
    """Compute the stress in a body below the surface tractions of a contact result.

    The points are those of the solver: cells, radii of the radial solver, or nodes of elements.

    state     bodies and surface tractions
    indenter  True for the indenter, False for the lower body
    depths    depths at which the stress is computed [length]; None for those of the solver. Without
              effect on elements
    volume    True for the stress in the volume as well; on cells only

    Raises ValueError for a depth outside the body, and UnsupportedScene for shear that the radial
    solver does not resolve.
    """
    if state.pressed is not None:
        return stress_on_disc(state, indenter=indenter, depths=depths)
    if state.on_rings:
        return stress_on_section(state, indenter=indenter)
    return stress_on_cells(state, indenter=indenter, depths=depths, volume=volume)
