"""Mesh of one body by gmsh, a second mesher that verifies the tensor-product mesh.

Layers are structured blocks. An elastic substrate is filled with unstructured quadrilaterals, whose
sizes are interpolated from its edges.
"""

import signal
import threading
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from contact_scene.body import Body
from contact_scene.solver_errors import SolverError
from fem_reference.mesh.section_mesh import SectionMesh
from fem_reference.mesh.section_outline import (
    CONTACT_ZONE,
    SectionOutline,
    graded_lines,
    section_outline,
)

DEBIAN_PACKAGES = (
    "libglu1-mesa libgl1 libopengl0 libglx0 libx11-6 libxext6 libxrender1 libxcursor1 libxfixes3 "
    "libxft2 libfontconfig1 libxinerama1 libgomp1 zlib1g"
)

FAR_ELEMENTS = 8
"""Number of elements along a far side of the box. Graded elements have about this size there."""

_FRONTAL_FOR_QUADS = 8
_SIMPLE_WITH_QUADS_ONLY = 2
OPTIONS = {
    "General.Terminal": 0,
    "Mesh.Algorithm": _FRONTAL_FOR_QUADS,
    "Mesh.RecombinationAlgorithm": _SIMPLE_WITH_QUADS_ONLY,
}
_QUADRILATERAL = 3  # gmsh's number for the type of the quadrilateral with 4 nodes


class GmshMissing(SolverError):
    """Exception: the library gmsh cannot be loaded on this machine."""


def gmsh_section_mesh(
    body: Body,
    elements_per_radius: int,
    box: float | None = None,
    zone: float = CONTACT_ZONE,
    *,
    plane: bool = False,
) -> SectionMesh:
    """Create the mesh of the meridional section of a body by gmsh.

    The result verifies the mesh of rectangles by `section_mesh`.

    body    layers and substrate; the unit of length is the contact radius
    elements_per_radius
            number of elements per contact radius on the surface of the contact zone
    box     outer radius and depth of the section, in contact radii; None for a sufficient value
    zone    least outer radius of the contact zone, in contact radii
    plane   True for a body in plane strain
    raises  GmshMissing if gmsh or a library that it requires is not installed; SolverError if gmsh
            does not fill the section with quadrilaterals; errors of `section_outline`
    """
    outline = section_outline(body, elements_per_radius, box, zone, plane=plane)
    with _gmsh_model() as gmsh:
        _draw(gmsh.model.geo, outline)
        gmsh.model.geo.synchronize()
        gmsh.model.mesh.generate(2)
        tags, coordinates, _ = gmsh.model.mesh.getNodes()
        kinds, cells, corners = gmsh.model.mesh.getElements(2)
    found = {int(kind): len(cell) for kind, cell in zip(kinds, cells, strict=True)}
    if set(found) != {_QUADRILATERAL}:
        # Other elements would be omitted below and leave holes in the section.
        raise SolverError(f"gmsh made elements other than quadrilaterals, by type: {found}")
    place = np.zeros(int(tags.max()) + 1, dtype=np.int64)
    place[tags] = np.arange(tags.size)
    points = coordinates.reshape(-1, 3)[:, :2].T.copy()
    for axis, lines in ((0, (0.0, outline.box)), (1, (0.0, *outline.interfaces))):
        for line in lines:  # gmsh places points on a line with round-off errors
            points[axis, np.abs(points[axis] - line) < 1e-12 * outline.box] = line
    contact = (points[1] == 0.0) & (points[0] < outline.zone + outline.size / 2.0)
    points[0, contact] = np.round(points[0, contact] / outline.size) * outline.size
    used, quads = np.unique(place[corners[0].astype(np.int64)], return_inverse=True)
    quads = np.ascontiguousarray(quads.reshape(-1, 4).T)
    return SectionMesh(np.ascontiguousarray(points[:, used]), quads, outline)


@contextmanager
def _gmsh_model() -> Iterator[Any]:
    """Provide the gmsh library with a new empty model, as a context manager.

    Used to mesh the section of a body. On exit the model is removed and the previous gmsh options
    are restored. Raise GmshMissing if gmsh cannot be loaded.
    """
    try:
        import gmsh
    except (ImportError, OSError) as error:
        raise GmshMissing(
            f"gmsh cannot be loaded ({error}): install slipstick[mesh] and, on Debian, the "
            f'packages {DEBIAN_PACKAGES}; or choose the mesher "tensor"'
        ) from error
    mine = not gmsh.isInitialized()
    if mine:
        gmsh.initialize(readConfigFiles=False, interruptible=False)
        _restore_broken_pipes()
    current = gmsh.model.getCurrent()
    before = {name: gmsh.option.getNumber(name) for name in OPTIONS}
    gmsh.model.add("section")
    try:
        _set(gmsh, OPTIONS)
        yield gmsh
    finally:
        gmsh.model.remove()
        _set(gmsh, before)
        if mine:
            gmsh.finalize()
        else:
            gmsh.model.setCurrent(current)


def _restore_broken_pipes() -> None:
    """Restore Python's handler of SIGPIPE, which gmsh replaces:
    a broken pipe would end the process."""
    # Python permits a change of signal handlers in the main thread only.
    if threading.current_thread() is threading.main_thread():
        signal.signal(signal.SIGPIPE, signal.getsignal(signal.SIGPIPE))


def _set(gmsh: Any, options: Mapping[str, float]) -> None:
    for name, value in options.items():
        gmsh.option.setNumber(name, value)


def _draw(geometry: Any, outline: SectionOutline) -> None:
    """Create the lines and surfaces of the meridional section of a body in gmsh.

    The lines are divided into elements. Layers become structured blocks of quadrilaterals; an
    elastic substrate becomes one unstructured block. Curve loops start along r, then follow z.

    geometry  gmsh geometry kernel of the current model
    outline   edges, interfaces and element sizes of the section
    """
    h = outline.size
    across = (0.0, outline.zone, outline.box)
    depths = (0.0, *outline.interfaces)
    points = [[geometry.addPoint(r, z, 0.0) for r in across] for z in depths]
    rows = [[geometry.addLine(*ends) for ends in pairwise(row)] for row in points]
    columns = [[geometry.addLine(*ends) for ends in pairwise(c)] for c in zip(*points, strict=True)]
    sides = [np.arange(round(outline.zone / h) + 1) * h, graded_lines(*across[1:], outline.zone, h)]
    down = [graded_lines(top, base, 0.0, h) for top, base in outline.pieces]
    structured = len(down) if outline.rigid_base else len(down) - 1

    for row in rows[: structured + 1]:
        for line, elements in zip(row, sides, strict=True):
            _divide(geometry, line, elements)
    for block in range(structured):
        for column in columns:
            _divide(geometry, column[block], down[block])
        for side in range(2):
            loop = [rows[block][side], columns[side + 1][block]]
            loop += [-rows[block + 1][side], -columns[side][block]]
            surface = geometry.addPlaneSurface([geometry.addCurveLoop(loop)])
            geometry.mesh.setTransfiniteSurface(surface)
            geometry.mesh.setRecombine(2, surface)
    if not outline.rigid_base:
        axis, _, edge = (column[-1] for column in columns)
        _divide(geometry, axis, down[-1])
        geometry.mesh.setTransfiniteCurve(edge, FAR_ELEMENTS + 1)
        bottom = geometry.addLine(points[-1][0], points[-1][2])
        geometry.mesh.setTransfiniteCurve(bottom, FAR_ELEMENTS + 1)
        loop = [*rows[-2], edge, -bottom, -axis]
        surface = geometry.addPlaneSurface([geometry.addCurveLoop(loop)])
        geometry.mesh.setRecombine(2, surface)


def _divide(geometry: Any, line: int, elements: NDArray[np.floating[Any]]) -> None:
    """Divide a gmsh line in geometric progression like `elements`, into an even number of elements,
    because quadrilaterals cannot fill a surface with an odd boundary."""
    sizes = np.diff(elements)
    count = sizes.size + sizes.size % 2
    ratio = (sizes[-1] / sizes[0]) ** (1.0 / max(count - 1, 1))
    geometry.mesh.setTransfiniteCurve(line, count + 1, "Progression", ratio)
