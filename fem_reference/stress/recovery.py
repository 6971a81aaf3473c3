"""Recovery of the stress at the nodes from the strains in the elements.

Strains of biquadratic elements are most accurate at their 2 x 2 Gauss points (Barlow 1976), those
of another order at the places of its record. The stress is computed at these points, which are a
grid in each material, and interpolated to the nodes by cubic polynomials in r and in z. The
extrapolation from one biquadratic element would have an error of h^2/12 times the second derivative
of the stress.

Cubic polynomials do not cross a mesh line between elements of different growth, as near the edges
of the tractions. The strains are less accurate there: they are extrapolated in each element, and a
node has the mean of its elements (Hinton and Campbell 1974).

A node on an interface has one value for each material. The jump of the in-plane stress at an
interface is therefore preserved.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array, diags_array, hstack, vstack
from skfem import Basis

from contact_scene.array_types import Field
from fem_reference.elasticity.motion import Motion
from fem_reference.elasticity.section_basis import displacement_basis
from fem_reference.elasticity.weak_form import (
    NORMAL,
    dilatation,
    shear_moduli,
    strains,
    volume_strain,
    volume_strain_at,
)
from fem_reference.mesh.element_order import ELEMENTS, lagrange_polynomials
from fem_reference.mesh.section_mesh import SectionMesh
from fem_reference.mesh.section_outline import LARGEST_GROWTH
from fem_reference.scales import Scales
from fem_reference.stress.section_field import Amplitude

Indices = NDArray[np.int64]

ORDER = ("rr", "tt", "zz", "tz", "rz", "rt")
"""Order of the stress components. At theta = 0 it is the order of CONVENTIONS."""

GAUSS = np.array(ELEMENTS.strains)
PER_ELEMENT = len(GAUSS)
CUBIC = 4  # number of Gauss points that a polynomial interpolates
# Ratio of the sizes of neighbouring elements up to which a polynomial crosses their common line:
# that of graded elements, but for round-off errors.
SIMILAR = 1.001 * LARGEST_GROWTH


@dataclass(frozen=True, eq=False)
class Recovery:
    """Method that computes the stress at the nodes from the strains at Gauss points.

    A node on an interface is represented by several points, one for each material. There are n
    points. Levels are the depths of the nodes of each material in turn.

    section, basis  mesh of rectangles, and basis of one displacement component
    at              the same basis, evaluated at the g Gauss points of every element
    places          column and row of the Gauss points in their grid (2, e, g)
    across          matrix from the radii of the Gauss points to those of the nodes
    down            matrix from the depths of the Gauss points to the levels
    cells           type of the cells, and the points of every cell
    node            node of every point (n,)
    material        index of the material of every point (n,)
    found           index of the radius and of the level of every point (2, n)
    points          r and z of every point (2, n), the same number at each place of a column or row
    """

    section: SectionMesh
    basis: Basis
    at: Basis
    places: Indices
    across: csr_array
    down: csr_array
    cells: tuple[str, Indices]
    node: Indices
    material: Indices
    found: Indices
    points: Field

    def amplitude(self, of: Motion, u: Field, scales: Scales, *, turned: bool) -> Amplitude:
        """Compute displacement and stress at the nodes of a section from nodal displacements.

        The nodal displacements belong to one angular harmonic. A node on an interface has one
        stress for each material.

        of      motion: angular harmonic and components of the displacement
        u       dimensionless nodal displacement (c, nodes) for c components
        scales  units of length and stress of the result
        turned  True for a harmonic turned by a quarter wave
        """
        strain = dict.fromkeys(ORDER, np.zeros_like(self.at.dx))
        for component, values in zip(of.components, u, strict=True):
            found = strains(self.at.interpolate(values), component, of.in_strains)
            strain |= {name: strain[name] + part for name, part in found.items()}
        # The volume strain enters with its projection onto linear functions.
        expansion = volume_strain(self.basis, of.in_strains, of.components)
        local = u[:, self.basis.element_dofs].reshape(-1, len(expansion))
        volume = volume_strain_at(self.basis, self.at, np.einsum("eip,ie->ep", expansion, local))
        pressing = dilatation(self.section).resistance[:, None] * volume
        mu = shear_moduli(self.section)[:, None]
        total = np.zeros((6, len(self.node)))
        for row, name in zip(total, ORDER, strict=True):
            stress = 2.0 * mu * strain[name] + pressing if name in NORMAL else mu * strain[name]
            grid = np.zeros((self.across.shape[1], self.down.shape[1]))
            grid[tuple(self.places)] = stress
            row[:] = (self.across @ grid @ self.down.T)[tuple(self.found)]
        displacement = np.zeros((3, len(self.node)))
        displacement[list(of.components)] = u[:, self.node] * scales.length
        return Amplitude(of, displacement, total * scales.modulus, turned)


def recovery_of(section: SectionMesh) -> Recovery:
    """Create the stress recovery for the mesh of a body, for use with all angular harmonics.

    The recovery computes the stress at the nodes from the strains at the Gauss points of the
    elements.

    section  mesh of rectangles in the meridional section of the body
    """
    xi, eta = (part.ravel() for part in np.meshgrid(GAUSS, GAUSS, indexing="ij"))
    basis = displacement_basis(section)
    at = displacement_basis(section, (np.stack([xi, eta]), np.full(len(xi), 1 / len(xi))))
    count = len(section.outline.materials)
    key = basis.element_dofs.T * count + section.layer[:, None]
    unique, cells = np.unique(key, return_inverse=True)
    node, material = unique // count, unique % count
    # Mesh lines from one row and one column: coordinates of the others differ by round-off.
    r, z = section.points
    r, z = np.sort(r[z == 0.0]), np.sort(z[r == 0.0])
    radii, depths = np.asarray(at.global_coordinates())
    places = np.stack([_nearest(_gauss_points(r), radii), _nearest(_gauss_points(z), depths)])
    down = [_interpolate_piece(z, *piece) for piece in section.outline.pieces]
    level = np.empty_like(node)
    for index, (depth, _) in enumerate(down):
        of = material == index
        level[of] = _nearest(depth, basis.doflocs[1, node[of]])
        level[of] += sum(len(above) for above, _ in down[:index])
    nodes, across = _interpolate_piece(r, r[0], r[-1])
    column = _nearest(nodes, basis.doflocs[0, node])
    return Recovery(
        section,
        basis,
        at,
        places,
        across,
        vstack([matrix for _, matrix in down]).tocsr(),
        (ELEMENTS.kind, np.concatenate(cells.reshape(key.shape)[:, list(ELEMENTS.cells)])),
        node,
        material,
        np.stack([column, level]),
        np.stack([nodes[column], np.concatenate([depth for depth, _ in down])[level]]),
    )


def _gauss_points(lines: Field) -> Field:
    """Compute the coordinates of the Gauss points between mesh lines."""
    return (lines[:-1, None] + np.diff(lines)[:, None] * GAUSS).ravel()


def _nearest(increasing: Field, values: Field) -> Indices:
    """Return the indices of the nearest of increasing coordinates."""
    return np.searchsorted(0.5 * (increasing[:-1] + increasing[1:]), values)


def _interpolate_piece(lines: Field, start: float, end: float) -> tuple[Field, csr_array]:
    """Return the nodes (n,) between two mesh lines, and the matrix (n, Gauss points between all
    lines) of the interpolation from the Gauss points between these two."""
    first, last = np.searchsorted(lines, (start, end))
    within = lines[first : last + 1]
    nodes = ELEMENTS.nodes(within)
    known = _gauss_points(within)
    left = np.clip(np.searchsorted(known, nodes) - CUBIC // 2, 0, len(known) - CUBIC)
    growth = np.abs(np.diff(np.log(np.diff(within))))
    unlike = within[1:-1][growth > np.log(SIMILAR)]
    crossed = np.diff(np.searchsorted(unlike, known[[left, left + CUBIC - 1]]), axis=0)[0] > 0
    elements = np.searchsorted(within, nodes) - 1, np.searchsorted(within, nodes, "right") - 1
    found = diags_array(1.0 - crossed) @ _lagrange_matrix(known, nodes, left, CUBIC)
    for element in elements:
        points = PER_ELEMENT * np.clip(element, 0, len(within) - 2)
        by_element = _lagrange_matrix(known, nodes, points, PER_ELEMENT)
        found = found + diags_array(0.5 * crossed) @ by_element
    outside = (first, len(lines) - 1 - last)
    before, after = (csr_array((len(nodes), PER_ELEMENT * n)) for n in outside)
    return nodes, hstack([before, found, after]).tocsr()


def _lagrange_matrix(known: Field, wanted: Field, left: Indices, points: int) -> csr_array:
    """Create the matrix (wanted, known) of the polynomials through `points` known coordinates,
    the first of which has the index `left` (wanted,)."""
    chosen = left[:, None] + np.arange(points)
    weights = lagrange_polynomials(known[chosen], wanted)
    rows = np.repeat(np.arange(len(wanted)), points)
    return csr_array((weights.ravel(), (rows, chosen.ravel())), (len(wanted), len(known)))
