"""Stress at and near the edge of a contact, from tractions that are fitted near the edge.

The tensile stress is largest at the edge and falls with the square root of the distance on both
sides. If the tractions are uniform in each cell, the stress at cell centres is 10 % too low at 128
cells. Two fits are compared in order to reject edges that cannot be fitted.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from contact_scene.array_types import Field, Mask
from semi_analytical.edge.fit import NARROW, WIDE, WIDER, Stencil
from semi_analytical.edge.quadratic import Quadratic
from semi_analytical.edge.shape import distance_to
from semi_analytical.frf.depth import Level
from semi_analytical.frf.stack import Stack
from semi_analytical.grid import SurfaceGrid
from semi_analytical.stress.at_edge import change_at_depth, stress_at_surface
from semi_analytical.stress.components import FIELDS, STRESS
from semi_analytical.stress.convolution import mirror_planes
from semi_analytical.stress.edge_tractions import EdgedTractions, fit_edge_tractions
from semi_analytical.stress.field import SubsurfaceField, subsurface
from semi_analytical.stress.patch import NODES

# Stencil and rejected rings of two fits, whose difference estimates the error: for tractions that
# are constant on cells, and for tractions with edge correction (only cut cells rejected).
STENCILS = ((WIDE, 2), (WIDER, 3))
CORRECTED_STENCILS = ((NARROW, 1), (Stencil(4, 2.2), 1))
# Comparison of the fits: number of points; they count where the tensile stress is within 1 - LARGE
# of its maximum, relative to the size of stress; and the largest accepted difference. Beyond it the
# stress at cell centres is nearer to the true one, as at a stiff film about one cell thick.
COMPARED = 32
LARGE = 0.8
TOO_FAR_APART = 0.1
# Least ratio of shear to pressure in slipping cells, relative to the largest; and the width in
# cells of the annulus in which all cells must slip.
SLIPPING = 0.999
SLIPPING_RINGS = 2.5
# Region of the correction in cells: distance from the edge, depth below it, and least depth > 0.
BESIDE = 4.0
BELOW = 4.0
SHALLOWEST = 0.25
# Signs of the components of stress at the mirror image about x = 0.
SIGNS_ALONG_X = np.array([-1.0 if axes.count("x") == 1 else 1.0 for axes in FIELDS[STRESS]])[
    :, None, None
]
# Largest shear that is round-off, relative to the largest pressure.
NO_SHEAR = 1e-9

NOT_SMOOTH = "the square of the pressure is not smooth at {} of the edge"


class EdgeNotSeen(Exception):
    """Error raised if the tractions do not determine the stress at the contact edge.

    The message states the cause.

    candidate  fitted edge, where the tensile stress may still be largest; None where the fit failed
               or two fits differ too much
    """

    def __init__(self, cause: str, candidate: NearEdge | None = None) -> None:
        super().__init__(cause)
        self.candidate = candidate


@dataclass(frozen=True)
class NearEdge:
    """Surface stress of a body near the contact edge, from tractions that are fitted near the edge.

    stack      layers and base of the body
    grid       cells that carry the tractions
    tractions  tractions with their variation within the edge cells
    phi        quadratics of φ about points of the edge (n,), with the pressure √φ
    apart      largest difference between two fits of the largest principal stress at the edge, over
               `size`
    size       scale of stress [force/length²]: the larger of that principal stress and the pressure
               of border cells; not small where the stress is nearly zero
    plane      surface stress at the cell centres by the uniform tractions `tractions.cells` (6, nx,
               ny)
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
        """Coordinate x of the fitted points of the contact edge (n,) [length]."""
        return np.asarray(self.grid.x[0] + self.phi.x * self.grid.spacing[0])

    @property
    def y(self) -> Field:
        """Coordinate y of the fitted points of the contact edge (n,) [length]."""
        return np.asarray(self.grid.y[0] + self.phi.y * self.grid.spacing[1])

    def stress(self) -> Field:
        """Compute the surface stress (6, n) [force/length^2] at the fitted points of the contact
        edge.

        The stress at an edge point is the limit from within the contact.
        """
        return _surface_stress(self, self.phi)

    def at(self, x: Field, y: Field) -> Field:
        """Compute the surface stress (6, n) [force/length^2] at n points near the contact edge.

        x, y  coordinates of the points (n,) [length]
        """
        of_cells = (
            (p - c[0]) / side
            for p, c, side in zip(
                (x, y), (self.grid.x, self.grid.y), self.grid.spacing, strict=True
            )
        )
        return _surface_stress(self, self.tractions.shape.about(*of_cells)[0])

    @property
    def beside(self) -> Mask:
        """Mask (nx, ny) of the cells near the contact edge whose stress is corrected.

        The stress of these cells uses the variation of the tractions within the edge cells.
        """
        shape = self.tractions.shape
        away = distance_to(shape.depth > 0)
        beside = (shape.depth <= BESIDE + 0.5) & (away <= BESIDE)
        inner = np.zeros_like(beside)
        inner[NODES:-NODES, NODES:-NODES] = True
        return np.asarray(beside & inner)

    def corrected(self, field: SubsurfaceField) -> SubsurfaceField:
        """Replace the stress near the contact edge by the stress of the fitted tractions.

        field  displacement and stress by tractions uniform in each cell, on all or some rows of
               cells
        """
        rows = np.searchsorted(self.grid.y, field.y)
        beside = self.beside[:, rows]
        mirrored, half = mirror_planes(self.tractions.cells)[0], len(field.x) // 2
        beside[:half] &= not mirrored
        i, k = np.nonzero(beside)
        x, y = i.astype(float), rows[k].astype(float)
        stress = field.stress.copy()
        for index, level in enumerate(field.levels):
            if level.depth == 0:
                phi, safe = self.tractions.shape.about(x, y)
                stress[index][:, i[safe], k[safe]] = _surface_stress(self, phi.chosen(safe))
            elif self.reaches(level):
                stress[index][:, i, k] += change_at_depth(
                    self.tractions, x, y, level.depth, self.stack.outer, self.grid.spacing
                )
        if mirrored:
            stress[:, :, :half] = SIGNS_ALONG_X * stress[:, :, : -half - 1 : -1]
        return replace(field, stress=stress)

    def reaches(self, level: Level) -> bool:
        """Return True if the stress at a depth includes the variation at the contact edge.

        The depth must be in the outermost layer and near the surface.

        level  depth with the index of its layer
        """
        return level.layer == 0 and near_surface(level.depth, self.grid.spacing)


def near_surface(depth: float, spacing: tuple[float, float]) -> bool:
    """Return True if the stress at a depth includes the variation within edge cells.

    The surface is corrected. Other depths are not corrected if they are too deep for an effect, or
    so close to the surface that the subcells are too coarse.

    depth    z >= 0 [length]
    spacing  cell sides [length]
    """
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
    """Fit the pressure at the edge of a smooth contact, for the surface stress near it.

    The pressure must fall like a square root towards the edge. Raises EdgeNotSeen, and the errors
    of `subsurface`.

    stack            layers and base of the body
    grid             cells that carry the tractions
    pressure, shear  tractions on the body, (nx, ny) and (2, nx, ny) [force/length^2]; None is no
                     shear
    corrected        True if the tractions are cell means with edge correction
    """
    if shear is not None and np.max(np.abs(shear)) <= NO_SHEAR * np.max(pressure):
        shear = None
    stuck = None if shear is None else _stick_cells(pressure, shear)
    stencils = CORRECTED_STENCILS if corrected else STENCILS
    try:
        one, other = (fit_edge_tractions(pressure, shear, stuck, *stencil) for stencil in stencils)
    except ValueError as error:
        raise EdgeNotSeen(str(error)) from None
    depth = one.shape.depth
    i, j = np.nonzero(depth == 1)
    phi, safe = one.shape.edge_points(i, j)
    again, safe_again = other.shape.edge_points(phi.x, phi.y)
    both = safe & safe_again
    if not np.any(both):
        raise EdgeNotSeen(NOT_SMOOTH.format("any point"))
    for points in (phi, again):
        edge = _set_on_edge(points.chosen(both))
        for at, count in zip((edge.x, edge.y), grid.cells, strict=True):
            if not (np.min(at) >= NODES and np.max(at) <= count - 1 - NODES):
                raise EdgeNotSeen(f"the contact is within {NODES} cells of the window's border")
    plane = subsurface(stack, grid, pressure, shear, (0.0,)).stress[0]
    slipping = np.inf if stuck is None or not np.any(stuck) else np.min(depth[stuck])
    found = NearEdge(stack, grid, one, _set_on_edge(phi), 0.0, 0.0, plane)
    some = np.flatnonzero(both)[:: max(1, np.count_nonzero(both) // COMPARED)]
    tension, by_other = (
        _largest_principal_stress(
            _surface_stress(replace(found, tractions=tractions), _set_on_edge(points.chosen(some)))
        )
        for tractions, points in ((one, phi), (other, again))
    )
    most = np.max(tension)
    size = max(float(np.max(np.abs(tension))), float(np.max(pressure[i, j])))
    large = tension >= most - (1 - LARGE) * size  # or all of the edge is compressed
    apart = float(np.max(np.abs(tension - by_other)[large]) / size)
    found = replace(found, phi=found.phi.chosen(both), apart=apart, size=size)
    cause, alike = None, apart <= TOO_FAR_APART
    if slipping <= SLIPPING_RINGS:
        cause = (
            f"cells within {SLIPPING_RINGS:g} cells of the edge stick, where the shear is not "
            "proportional to the pressure"
        )
    elif not np.all(both):
        cause = NOT_SMOOTH.format(f"{np.count_nonzero(~both)} of {len(both)} points")
    elif not alike:
        cause = (
            f"two fits of the edge differ by {apart:.2g} of the stress in the tensile stress, more "
            f"than {TOO_FAR_APART:g}. Use smaller cells"
        )
    if cause is not None:
        raise EdgeNotSeen(cause, found if alike else None)
    return found


def _stick_cells(pressure: Field, shear: Field) -> Mask:
    """Return a mask (nx, ny) of cells with shear over pressure below SLIPPING of its maximum."""
    region = pressure > 0
    size = np.hypot(*shear)
    ratio = np.divide(size, pressure, out=np.zeros_like(size), where=region)
    return np.asarray(region & (ratio < SLIPPING * np.max(ratio)))


def _set_on_edge(phi: Quadratic) -> Quadratic:
    """Set φ, the squared pressure, to exactly zero at edge points: it is zero up to rounding."""
    return replace(phi, f=np.zeros_like(phi.f))


def _surface_stress(found: NearEdge, phi: Quadratic) -> Field:
    """Compute the surface stress (6, n) at points with the squared pressure `phi`
    [force/length^2]."""
    return stress_at_surface(
        found.tractions, phi, found.plane, found.stack.outer, found.grid.spacing
    )


def _largest_principal_stress(stress: Field) -> Field:
    """Compute the largest in-plane stress (n,) of xx, yy, zz, yz, xz, xy (6, n), without
    traction."""
    xx, yy, xy = stress[0], stress[1], stress[5]
    return np.asarray((xx + yy) / 2 + np.hypot((xx - yy) / 2, xy))
