"""Mesh of one body: its meridional section in the (r, z) plane, with z into the body."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from skfem import MeshQuad

from contact_scene.body import Body
from contact_scene.solver_errors import SolverError
from fem_reference.mesh.element_order import ELEMENTS
from fem_reference.mesh.section_outline import (
    CONTACT_ZONE,
    SectionOutline,
    graded_lines,
    section_outline,
)

SHRINK = 1 / 4
SHRINKS = 8
"""Ratio of successive distances of mesh lines from an edge of the tractions, and number of lines.

The stress varies like the root of the distance from the edge. A smallest element of 4^-8 = 1.5e-5
of the regular size has 0.4 % (the root) of the error of a regular element."""

CLOSEST = 0.25
"""Least spacing of adjacent mesh lines, over their distance from the nearest edge of tractions."""


@dataclass(frozen=True, eq=False)
class SectionMesh:
    """Mesh of quadrilaterals in a meridional section of a body.

    The unit of length is the expected contact radius. The constructor raises SolverError if the sum
    of the element areas differs from the area of the section, that is if elements are missing or
    overlap.

    points   corners (r, z) of the elements (2, n), exact on an outer edge, an interface or the axis
    quads    indices of the 4 corners of every element (4, e), in order around the element
    outline  outer edges, interfaces and element sizes of the section
    """

    points: NDArray[np.float64]
    quads: NDArray[np.int64]
    outline: SectionOutline

    def __post_init__(self) -> None:
        whole = self.outline.box * self.outline.depth
        if not abs(self.areas.sum() / whole - 1.0) < 1e-9:
            raise SolverError(
                f"{self.quads.shape[1]} elements cover an area of {self.areas.sum():.9g} in a "
                f"section of {whole:.9g}: the mesh has holes or overlaps"
            )

    @property
    def mesh(self) -> MeshQuad:
        """Mesh of the section for scikit-fem, with the boundaries "axis", "contact" and "far".

        "contact" is the surface of the contact zone. "far" is the outer edge and the base, where
        the displacement is zero or that of a half-space.
        """
        outline = self.outline
        boundaries = {
            "axis": lambda x: x[0] == 0.0,
            "contact": lambda x: (x[1] == 0.0) & (x[0] <= outline.zone),
            "far": lambda x: (x[0] == outline.box) | (x[1] == outline.depth),
        }
        return MeshQuad(self.points, self.quads).with_boundaries(boundaries)

    @cached_property
    def areas(self) -> NDArray[np.float64]:
        """Area of every element of the mesh in the (r, z) plane (e,).

        The unit of length is the contact radius. Used to detect holes and overlaps of the mesh.
        """
        (r0, r1, r2, r3), (z0, z1, z2, z3) = self.points[:, self.quads]
        return np.abs((r2 - r0) * (z3 - z1) - (r3 - r1) * (z2 - z0)) / 2.0

    @cached_property
    def layer(self) -> NDArray[np.int64]:
        """Index of the material of every element of the mesh (e,), 0 for the outermost layer.

        The index refers to `outline.materials`. An elastic substrate has the last index.
        """
        middle = self.points[1, self.quads].mean(axis=0)
        return np.searchsorted(np.asarray(self.outline.interfaces), middle)

    @cached_property
    def radii(self) -> NDArray[np.float64]:
        """Radii of the surface nodes in the contact zone (m,), corners and those between them.

        The unit of length is the contact radius.
        """
        r, z = self.points
        return ELEMENTS.nodes(np.sort(r[(z == 0.0) & (r <= self.outline.zone)]))

    def refined(self) -> "SectionMesh":
        """Return a finer mesh in which every element of this mesh is divided into 4 elements.

        Every finite-element field of this mesh can be represented on the finer mesh.
        """
        mesh = self.mesh.refined()
        finer = replace(self.outline, size=self.outline.size / 2.0)
        return SectionMesh(np.asarray(mesh.p), np.asarray(mesh.t), finer)

    def refine_towards(self, edges: NDArray[np.float64]) -> "SectionMesh":
        """Return a mesh of rectangles that is refined towards given radii and towards the surface.

        The radii are mesh lines. The distance of the adjacent mesh lines from a radius, and of the
        first lines from the surface, decreases by the factor SHRINK from line to line. Return this
        mesh unchanged if there are no radii. Used for the stress below the edges of the tractions.

        edges  radii of the edges of the tractions, in units of the contact radius
        """
        if not edges.size:
            return self
        r, z = self.points
        r, z = np.sort(r[z == 0.0]), np.sort(z[r == 0.0])
        size = self.outline.size
        finest = size * SHRINK**SHRINKS
        apart = np.unique(edges)
        apart = apart[np.diff(apart, prepend=-np.inf) > finest]
        steps = size * SHRINK ** np.arange(SHRINKS + 1)
        lines = np.unique(np.concatenate([r, apart, *(apart + s for s in (*steps, *-steps))]))
        room = np.min(np.abs(lines[:, None] - apart), axis=1, initial=size)
        free = (room == 0.0) | (room > 0.5 * finest)
        lines, room = lines[free], room[free]
        chosen = [0]
        for line in range(1, len(lines)):
            if lines[line] - lines[chosen[-1]] >= CLOSEST * min(room[line], room[chosen[-1]]):
                chosen.append(line)
        below = z[1] * SHRINK ** np.arange(int(np.log(finest / z[1]) / np.log(SHRINK)), 0, -1)
        mesh = MeshQuad.init_tensor(lines[chosen], np.concatenate([z[:1], below, z[1:]]))
        return SectionMesh(np.asarray(mesh.p), np.asarray(mesh.t), self.outline)


def section_mesh(
    body: Body,
    elements_per_radius: int,
    box: float | None = None,
    zone: float = CONTACT_ZONE,
    *,
    plane: bool = False,
) -> SectionMesh:
    """Create the graded mesh of rectangles for the meridional section of a body.

    Elements are equal squares along the surface of the contact zone and grow with the distance from
    it.

    body    layers and substrate; the unit of length is the contact radius
    elements_per_radius
            number of elements per contact radius in the contact zone
    box     outer radius and depth of the section, in contact radii; None for a sufficient value
    zone    least outer radius of the contact zone, in contact radii
    plane   True for a body in plane strain
    raises  errors of `section_outline`, such as UnsupportedScene for layers that are too thin
    """
    outline = section_outline(body, elements_per_radius, box, zone, plane=plane)
    h = outline.size
    uniform = np.arange(round(outline.zone / h) + 1) * h
    r = np.concatenate([uniform, graded_lines(uniform[-1], outline.box, uniform[-1], h)[1:]])
    pieces = [graded_lines(top, base, 0.0, h) for top, base in outline.pieces]
    z = np.concatenate([[0.0], *(piece[1:] for piece in pieces)])
    mesh = MeshQuad.init_tensor(r, z)
    return SectionMesh(np.asarray(mesh.p), np.asarray(mesh.t), outline)
