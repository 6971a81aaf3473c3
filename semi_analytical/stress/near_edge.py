"""Stress near the edge of a contact, where tractions on cells do not give it, and whether the edge
can be seen in them at all.

Tension is largest on the edge itself, and the values at cell centres fall away from it with the
root of the distance to both sides: at 128 cells they are a tenth too low.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.ndimage import binary_erosion, distance_transform_edt

from contact_scene.array_types import Field, Mask
from semi_analytical.edge.fit import NARROW, WIDE, WIDER, Stencil
from semi_analytical.edge.quadratic import Quadratic
from semi_analytical.frf.depth import Level
from semi_analytical.frf.stack import Stack
from semi_analytical.grid import SurfaceGrid
from semi_analytical.stress.at_edge import change_at_depth, stress_at_surface
from semi_analytical.stress.edge_tractions import EdgedTractions, edged_tractions
from semi_analytical.stress.field import SubsurfaceField, subsurface
from semi_analytical.stress.patch import NODES

# The fit, and one to other cells, the difference of which measures the error; of tractions that are
# constant on cells, and of those with a corrected edge, of which only the cut cells are left out.
STENCILS = ((WIDE, 2), (WIDER, 3))
CORRECTED_STENCILS = ((NARROW, 1), (Stencil(4, 2.2), 1))
# Points at which the two are compared, where the tension is less than the largest by 1 less this
# part of the size of stress at the most; and the part of that size that is too far apart.
COMPARED, LARGE, TOO_FAR_APART = 32, 0.8, 0.02
# A cell slips if its shear over pressure is this part of the largest; rings that all have to.
SLIPPING, SLIPPING_RINGS = 0.999, 2.5
# How far beside and below the edge stress is evaluated anew, in cells; and from which depth on.
BESIDE, BELOW, SHALLOWEST = 4.0, 4.0, 0.25
# Shear that is round-off, over the largest pressure.
NO_SHEAR = 1e-9

NOT_SMOOTH = "the square of the pressure is no smooth function at {} of the edge"


class EdgeNotSeen(Exception):
    """The tractions do not determine the stress at the edge; the message states the cause.

    candidate  surface with the edge as far as it could be fitted: the stress there may still be the
               largest; None where nothing could be fitted
    """

    def __init__(self, cause: str, candidate: NearEdge | None = None) -> None:
        super().__init__(cause)
        self.candidate = candidate


@dataclass(frozen=True)
class NearEdge:
    """A loaded surface with its edge.

    tractions  with their edge
    phi        about points of the edge (n,)
    apart      difference of the largest principal stress there by another fit, over `size`
    size       largest of that stress and of the pressure of border cells [force/length²]: its
               error follows from that of the tractions, also where the stress is nearly 0
    plane      stress at z = 0 at the cell centres by the cells (6, nx, ny)
    """

    stack: Stack
    grid: SurfaceGrid
    tractions: EdgedTractions
    phi: Quadratic
    apart: float
    size: float
    plane: Field

    @property
    def x(self) -> Field:
        """Of the points of the edge (n,) [length]."""
        return np.asarray(self.grid.x[0] + self.phi.x * self.grid.spacing[0])

    @property
    def y(self) -> Field:
        """Of the points of the edge (n,) [length]."""
        return np.asarray(self.grid.y[0] + self.phi.y * self.grid.spacing[1])

    def stress(self) -> Field:
        """On the edge (6, n) [force/length²], its limit from within."""
        return _at_surface(self, self.phi)

    def at(self, x: Field, y: Field) -> Field:
        """At places of the surface near the edge (6, n) [force/length²]; x, y (n,) [length]."""
        of_cells = (
            (p - c[0]) / side
            for p, c, side in zip(
                (x, y), (self.grid.x, self.grid.y), self.grid.spacing, strict=True
            )
        )
        return _at_surface(self, self.tractions.shape.about(*of_cells)[0])

    @property
    def beside(self) -> Mask:
        """Cells (nx, ny) below which stress is evaluated anew."""
        return _beside(self.tractions)

    def corrected(self, field: SubsurfaceField) -> SubsurfaceField:
        """Return a field, on all or some rows of cells, with the stress near the edge by the
        tractions with their edge."""
        rows = np.searchsorted(self.grid.y, field.y)
        i, k = np.nonzero(self.beside[:, rows])
        x, y = i.astype(float), rows[k].astype(float)
        stress = field.stress.copy()
        for index, level in enumerate(field.levels):
            if level.depth == 0:
                phi, safe = self.tractions.shape.about(x, y)
                stress[index][:, i[safe], k[safe]] = _at_surface(self, phi.chosen(safe))
            elif self.reaches(level):
                stress[index][:, i, k] += change_at_depth(
                    self.tractions, x, y, level.depth, self.stack.outer, self.grid.spacing
                )
        return replace(field, stress=stress)

    def reaches(self, level: Level) -> bool:
        """Whether stress at a level is evaluated anew."""
        return level.layer == 0 and near_surface(level.depth, self.grid.spacing)


def near_surface(depth: float, spacing: tuple[float, float]) -> bool:
    """Whether stress at a depth feels the edge, and can be given it."""
    cells = depth / max(spacing)
    return depth == 0 or SHALLOWEST <= cells < BELOW


def near_edge(
    stack: Stack,
    grid: SurfaceGrid,
    pressure: Field,
    shear: Field | None,
    *,
    corrected: bool = False,
) -> NearEdge:
    """What `NearEdge` says of a body under tractions whose pressure falls like a root towards the
    edge of a smooth contact; arguments as of `subsurface`.

    corrected  whether the tractions are means over cells with a corrected edge

    Raises EdgeNotSeen, and what `subsurface` raises.
    """
    if shear is not None and np.max(np.abs(shear)) <= NO_SHEAR * np.max(pressure):
        shear = None
    region = pressure > 0
    stuck = None if shear is None else _stuck(pressure, shear)
    stencils = CORRECTED_STENCILS if corrected else STENCILS
    try:
        one, other = (edged_tractions(pressure, shear, stuck, *stencil) for stencil in stencils)
    except ValueError as error:
        raise EdgeNotSeen(str(error)) from None
    i, j = np.nonzero(region & ~binary_erosion(region))
    phi, safe = one.shape.edge_points(i, j)
    again, safe_again = other.shape.points_near(phi.x, phi.y)
    both = safe & safe_again
    if not np.any(both):
        raise EdgeNotSeen(NOT_SMOOTH.format("any point"))
    for at, count in zip((phi.x[both], phi.y[both]), grid.cells, strict=True):
        if not (np.min(at) >= NODES and np.max(at) <= count - 1 - NODES):
            raise EdgeNotSeen(f"the contact comes within {NODES} cells of the border of the window")
    plane = subsurface(stack, grid, pressure, shear, (0.0,)).stress[0]
    depth = distance_transform_edt(np.pad(region, 1))[1:-1, 1:-1]
    slipping = np.inf if stuck is None or not np.any(stuck) else np.min(depth[stuck])
    found = NearEdge(stack, grid, one, _on_edge(phi), 0.0, 0.0, plane)
    some = np.flatnonzero(both)[:: max(1, np.count_nonzero(both) // COMPARED)]
    tension, by_other = (
        _largest(_at_surface(replace(found, tractions=tractions), _on_edge(points.chosen(some))))
        for tractions, points in ((one, phi), (other, again))
    )
    most = np.max(tension)
    size = max(float(np.max(np.abs(tension))), float(np.max(pressure[i, j])))
    large = tension >= most - (1 - LARGE) * size  # or all of the edge is compressed
    apart = float(np.max(np.abs(tension - by_other)[large]) / size)
    found = replace(found, phi=found.phi.chosen(both), apart=apart, size=size)
    cause = None
    if slipping <= SLIPPING_RINGS:
        cause = (
            f"cells within {SLIPPING_RINGS:g} cells of the edge stick: the shear there is no "
            "multiple of the pressure"
        )
    elif not np.all(both):
        cause = NOT_SMOOTH.format(f"{np.count_nonzero(~both)} of {len(both)} points")
    elif not apart <= TOO_FAR_APART:
        cause = (
            f"two fits of the edge leave the tension there {apart:.2g} of the stress apart, more "
            f"than {TOO_FAR_APART:g}: take smaller cells"
        )
    if cause is not None:
        raise EdgeNotSeen(cause, found)
    return found


def _stuck(pressure: Field, shear: Field) -> Mask:
    """Cells of the contact that stick."""
    region = pressure > 0
    size = np.hypot(*shear)
    ratio = np.divide(size, pressure, out=np.zeros_like(size), where=region)
    return np.asarray(region & (ratio < SLIPPING * np.max(ratio)))


def _on_edge(phi: Quadratic) -> Quadratic:
    """Without the rounding of zero."""
    return replace(phi, f=np.zeros_like(phi.f))


def _at_surface(found: NearEdge, phi: Quadratic) -> Field:
    return stress_at_surface(
        found.tractions, phi, found.plane, found.stack.outer, found.grid.spacing
    )


def _beside(tractions: EdgedTractions) -> Mask:
    """Cells within BESIDE of the edge, to both sides."""
    shape = tractions.shape
    away = distance_transform_edt(shape.depth == 0)
    beside = (shape.depth <= BESIDE + 0.5) & (away <= BESIDE)
    inner = np.zeros_like(beside)
    inner[NODES:-NODES, NODES:-NODES] = True
    return np.asarray(beside & inner)


def _largest(stress: Field) -> Field:
    """Largest principal stress in the surface, which carries nothing on the edge (n,)."""
    xx, yy, xy = stress[0], stress[1], stress[5]
    return np.asarray((xx + yy) / 2 + np.hypot((xx - yy) / 2, xy))
