"""Memory that the coefficients of a layered body take, refused before it is allocated."""

from __future__ import annotations

from contact_scene.free_memory import available_bytes
from contact_scene.solver_errors import ResourceRefused

# Arrays of the size of the window alive at the peak (six results, three point responses and
# the work space of one average), and everything that does not grow with the window.
ARRAYS = 13
FIXED = 20 << 20


def required_bytes(shape: tuple[int, int]) -> int:
    """Peak memory of all `LayeredCoefficients` for offsets of this shape."""
    return 8 * ARRAYS * (shape[0] + 9) * (shape[1] + 9) + FIXED


def refuse_beyond_memory(shape: tuple[int, int]) -> None:
    """Raise ResourceRefused if coefficients of this shape do not fit into the free memory."""
    required, available = required_bytes(shape), available_bytes()
    if required > available:
        raise ResourceRefused(
            f"influence coefficients for {shape[0]} x {shape[1]} offsets need "
            f"{required / 2**30:.2g} GiB of memory, {available / 2**30:.2g} GiB are available; "
            "take fewer cells"
        )
