"""Work as operations that follow from counters alone: the same on every machine and at every run.

Each is the count of an idealised algorithm, and an upper bound of what is in proportion to it: a
convolution is taken as one on the whole window, though the solver crops it to the contact.
"""

from __future__ import annotations

from math import log2

import numpy as np

import radial
from contact_scene import Scene
from fem_reference import Result as Section
from radial.bodies import Bodies
from radial.largest_contact import wavenumbers
from radial.pressing import Target, pressed
from radial.rubbing import COUNT
from semi_analytical import Result as Surface

TRANSFORM = 2.5  # operations per value and doubling of a real fast transform
# Multiplications of the nested dissection of n unknowns in the plane, and of a solve with its
# factor: 829/84 n^3/2 and 31/4 n log2 n (George 1973); two operations each.
FACTORISATION = 2 * 829 / 84
SUBSTITUTION = 2 * 31 / 4
DENSE = 2 / 3  # of a dense system of m unknowns: 2/3 m³


def transforms(values: int, count: float) -> float:
    """Operations of real transforms of so many values."""
    return count * TRANSFORM * values * log2(values)


def of_convolutions(cells: tuple[int, int], count: int) -> float:
    """Operations of convolutions: two transforms of a grid padded to twice the window."""
    nx, ny = cells
    return transforms(4 * nx * ny, 2 * count)


def convolutions(result: Surface) -> int:
    """Of all increments."""
    return sum(i.convolutions for i in result.increments)


def unknowns(result: Section) -> int:
    """Displacements of the quadratic elements, of the larger section: two per node, three where a
    tangential load bends the section. Corners, edges and quadrangles carry a node each."""
    sections = [section for section in result.sections if section is not None]
    corners, elements = max((s.points.shape[1], s.quads.shape[1]) for s in sections)
    edges = corners + elements - 1  # Euler's formula for a section without holes
    return _components(result) * (corners + edges + elements)


def contact_unknowns(result: Section) -> int:
    """Tractions of the rings of the contact zone: pressure, and shear with friction."""
    rings = len(result.increments[-1].radii)
    return rings * (1 if result.scene.friction is None else 2)


def of_section(result: Section) -> float:
    """Operations of the factorisations, of the substitutions that condense the section to its
    contact zone, and of the linear systems of the contact."""
    n, rings = unknowns(result), len(result.increments[-1].radii)
    columns = _components(result) * (2 * rings - 1)
    factored = FACTORISATION * n**1.5 + columns * SUBSTITUTION * n * log2(n)
    dense = DENSE * contact_unknowns(result) ** 3
    return factorisations(result) * factored + systems(result) * dense


def factorisations(result: Section) -> int:
    """Sparse ones without a cache: of every different section, for pressing and for shearing."""
    sections = {id(section) for section in result.sections if section is not None}
    return len(sections) * (2 if _sheared(result) else 1)


def ring_unknowns(result: radial.Result, fineness: float) -> int:
    """Of a dense system of the radial solver: all tractions of rings and angles, shear on rings, or
    polynomials."""
    if result.plan.circle:
        return 3 * result.steps[-1].pressure.size
    return round(COUNT * fineness) if result.plan.coupled else _orders(result.scene, fineness)


def of_rings(result: radial.Result, fineness: float) -> float:
    """Operations of dense systems. At points these are of what does not stick, beside a product
    with the inverse of the whole, which is set-up; else each is of another contact radius, whose
    entries are integrals over the wavenumbers."""
    n = ring_unknowns(result, fineness)
    if not result.plan.circle:
        made = 2 * fineness * wavenumbers(result.scene) * n**2
        return systems(result) * (made + DENSE * n**3)
    return sum(i.iterations * (2 * n**2 + DENSE * _loose(i) ** 3) for i in result.increments)


def _loose(increment: radial.Increment) -> int:
    """Tractions where nothing sticks."""
    assert increment.in_stick is not None
    return 3 * int(np.sum(~increment.in_stick))


def _orders(scene: Scene, fineness: float) -> int:
    force = scene.loading[-1].normal_force
    found = pressed(Bodies.of(scene), scene.indenter, Target(force, None), round(fineness))
    return len(found.contact.layers)


def systems(result: Section | radial.Result) -> int:
    """Linear systems of the contact, of all increments."""
    return sum(i.iterations for i in result.increments)


def _components(result: Section) -> int:
    return 3 if _sheared(result) else 2


def _sheared(result: Section) -> bool:
    return any(i.shear_along_load is not None for i in result.increments)
