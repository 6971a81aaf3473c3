"""Memory of a factorisation, compared with the available memory."""

import numpy as np

from contact_scene.machine import available_bytes
from contact_scene.solver_errors import ResourceRefused

# Entries of both factors per component, unknown and bisection of the mesh; with unknown pressures.
FILL, FILL_WITH_PRESSURE = 5.0, 11.0
BYTES_PER_ENTRY = 24  # values and indices, and a copy during the condensation on the contact zone
COPIES_OF_ELEMENTS = 8
# Of a whole run: libraries, figures, and the measured fraction of the bound that factors use, for
# sections from 2000 to 13 000 elements.
LIBRARIES = 85 << 20
DRAWING = 60 << 20
PART_IN_USE = 0.62
NODES_PER_ELEMENT = 4  # biquadratic: about one corner, two midsides and one centre


def required_bytes(elements: int, unknowns: int, components: int, with_pressure: bool) -> float:
    """Estimate the memory of assembly and factorisation of a section, within a factor of two
    [byte]."""
    fill = FILL_WITH_PRESSURE if with_pressure else FILL
    entries = fill * components * unknowns * np.log2(max(unknowns, 2))
    matrices = 8.0 * elements * (9 * components) ** 2
    return float(BYTES_PER_ENTRY * entries + COPIES_OF_ELEMENTS * matrices)


def run_bytes(factoring: float) -> float:
    """Estimate the largest memory of a run, with libraries and figures [byte].

    factoring  `required_bytes` of its largest section, an upper bound
    """
    return LIBRARIES + max(DRAWING, PART_IN_USE * factoring)


def largest_bytes(elements: int, several_motions: bool) -> int:
    """Estimate the memory for the factors of the largest section [byte].

    elements         of the section
    several_motions  true for motions with a circumferential component
    """
    unknowns, components = NODES_PER_ELEMENT * elements, 3 if several_motions else 2
    return int(required_bytes(elements, unknowns * components, components, False))


def require_memory(needed: float) -> None:
    """Raise ResourceRefused if this number of bytes exceeds the available memory."""
    free = available_bytes()
    if needed > free:
        raise ResourceRefused(
            f"the finite-element matrix needs about {needed / 1e9:.1f} GB of memory, and "
            f"{free / 1e9:.1f} GB are available. Use fewer elements_per_radius"
        )
