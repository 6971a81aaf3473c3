"""Memory of the fields at depth, estimated before anything is allocated."""

from contact_scene.free_memory import available_bytes
from contact_scene.solver_errors import ResourceRefused
from semi_analytical.stress.components import FIELDS, TRACTIONS

DOUBLE = 8
# Arrays of the size of the window at the peak besides the fields: two sets of coefficients,
# the closed form's potentials, spectra of the padded grid.
WORK = 3 * len(FIELDS) * len(TRACTIONS) + 40
FIXED = 100 << 20


def required_bytes(cells: tuple[int, int], levels: int) -> int:
    """Peak memory of fields on whole planes [byte]."""
    return DOUBLE * cells[0] * cells[1] * (WORK + len(FIELDS) * levels) + FIXED


def refuse_beyond_memory(cells: tuple[int, int], levels: int) -> None:
    """Raise ResourceRefused if fields at so many levels do not fit into the free memory."""
    required, available = required_bytes(cells, levels), available_bytes()
    if required > available:
        raise ResourceRefused(
            f"fields at {levels} depths on {cells[0]} x {cells[1]} cells need "
            f"{required / 2**30:.2g} GiB of memory, {available / 2**30:.2g} GiB are available; "
            "take fewer cells or depths, or the section alone"
        )
