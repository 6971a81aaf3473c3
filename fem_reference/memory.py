"""What a factorisation will need, and whether this machine has it."""

import numpy as np

from contact_scene.machine.free_memory import available_bytes
from contact_scene.solver_errors import ResourceRefused

# Entries of both factors per component, unknown and halving of the mesh; with unknown pressures.
FILL, FILL_WITH_PRESSURE = 5.0, 11.0
BYTES_PER_ENTRY = 24  # values and indices, and a copy while the contact zone is cut out
COPIES_OF_ELEMENTS = 8
# Of a whole run: libraries, what figures take, and the part of the bound that factors have been
# measured to take of sections from 2000 to 13 000 elements.
LIBRARIES = 85 << 20
DRAWING = 60 << 20
PART_IN_USE = 0.62
NODES_PER_ELEMENT = 4  # biquadratic: about one corner, two midsides and one centre each


def required_bytes(elements: int, unknowns: int, components: int, with_pressure: bool) -> float:
    """Largest amount in use while a section is assembled and factored, within a factor of two."""
    fill = FILL_WITH_PRESSURE if with_pressure else FILL
    entries = fill * components * unknowns * np.log2(max(unknowns, 2))
    matrices = 8.0 * elements * (9 * components) ** 2
    return float(BYTES_PER_ENTRY * entries + COPIES_OF_ELEMENTS * matrices)


def run_bytes(factoring: float) -> float:
    """Largest memory of a process that runs, libraries and figures included [byte].

    factoring  `required_bytes` of its largest section, a bound that nothing is refused below
    """
    return LIBRARIES + max(DRAWING, PART_IN_USE * factoring)


def largest_bytes(elements: int, several_motions: bool) -> int:
    """Memory for the factors of the largest section [byte].

    elements         of the section
    several_motions  whether it moves along the angle, too
    """
    unknowns, components = NODES_PER_ELEMENT * elements, 3 if several_motions else 2
    return int(required_bytes(elements, unknowns * components, components, False))


def require_memory(needed: float) -> None:
    """Raise ResourceRefused unless so many bytes can be had without swapping."""
    free = available_bytes()
    if needed > free:
        raise ResourceRefused(
            f"the finite-element matrix needs about {needed / 1e9:.1f} GB of memory, of which "
            f"{free / 1e9:.1f} GB are free: take fewer elements_per_radius"
        )
