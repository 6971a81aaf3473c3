"""Memory estimate of a sparse factorisation, and its comparison with the available memory."""

import numpy as np

from contact_scene.machine import require_memory
from fem_reference.mesh.element_order import ELEMENTS

# Entries of both factors, divided by components × unknowns × log2(unknowns): without, and with
# unknown pressures.
FILL = 5.0
FILL_WITH_PRESSURE = 11.0
# Copies of the compliance matrix of all contact points: two in its units, its rows, and their
# factors in zones.
COPIES_OF_MATRIX = 5
BYTES_PER_ENTRY = 24  # values and indices, and a copy during the condensation on the contact zone
COPIES_OF_ELEMENTS = 8
# Memory of a whole run: libraries [byte], figures [byte], and the measured ratio of the memory in
# use to the estimate for the factors, for sections of 2000 to 13 000 elements.
LIBRARIES = 85 << 20
DRAWING = 60 << 20
PART_IN_USE = 0.62
# About one corner; the others of two sides and of the inside.
NODES_PER_ELEMENT = ELEMENTS.degree**2


def required_bytes(elements: int, unknowns: int, components: int, with_pressure: bool) -> float:
    """Estimate the memory to assemble and factorise the stiffness of a body's mesh [byte].

    The estimate is correct within a factor of 2. Used to refuse a solve that would exceed the
    memory of the machine.

    elements       number of elements of the mesh
    unknowns       number of degrees of freedom
    components     number of displacement components in the motion, 1 to 3
    with_pressure  True if the pressures of nearly incompressible elements are unknowns
    """
    fill = FILL_WITH_PRESSURE if with_pressure else FILL
    entries = fill * components * unknowns * np.log2(max(unknowns, 2))
    matrices = 8.0 * elements * ((ELEMENTS.degree + 1) ** 2 * components) ** 2
    return float(BYTES_PER_ENTRY * entries + COPIES_OF_ELEMENTS * matrices)


def matrix_bytes(points: int) -> float:
    """Estimate the memory to solve a contact with the compliance matrix of all its points [byte].

    points  number of points of the surface, with three traction components each
    """
    return COPIES_OF_MATRIX * 8.0 * (3.0 * points) ** 2


def run_bytes(factoring: float, points: int = 0) -> float:
    """Estimate the peak memory of a whole run, including libraries and figures [byte].

    factoring  upper bound of the memory to factorise the stiffness of the largest mesh, from
               `required_bytes` [byte]
    points     number of contact points with coupled tractions
    """
    return LIBRARIES + max(DRAWING, PART_IN_USE * factoring) + matrix_bytes(points)


def largest_bytes(elements: int, several_motions: bool) -> int:
    """Estimate the memory to factorise the stiffness of a body from its number of elements [byte].

    Used for the cost estimate before a solve, when the number of unknowns is not determined yet.

    elements  number of elements of the mesh of one body
    several_motions
              True to assume motions with 3 displacement components, False for 2 components (normal
              loading)
    """
    unknowns, components = NODES_PER_ELEMENT * elements, 3 if several_motions else 2
    return int(required_bytes(elements, unknowns * components, components, False))


def refuse_if_too_large(needed: float) -> None:
    """Raise ResourceRefused if the finite-element matrices exceed the memory of this machine.

    needed  required memory [byte]
    """
    require_memory(needed, "the finite-element matrices", "Use fewer elements_per_radius")
