"""Largest slip amplitude and largest F2 of a load cycle, near the edge of the contact.

The slip amplitude δ is largest at the contact edge, which lies anywhere within a cell, and Ruiz's
F2 = σ_T τ δ just inside the edge, where the shear τ falls to zero and the tensile stress σ_T rises.
Both are found on a line from a cell inside the edge (x = 0) to the edge, with fits to the cells
around this cell:

    p² ≈ q_0 + q·x + x·Q x,  δ^(2/3) ≈ d_0 + d·x,  τ ≈ m p,  σ_T ≈ s_0 + s·x + s_p p

The pressure p of a paraboloid and Hertz's stress at the surface have these forms. At the distance s
from the edge of the stick zone, δ grows like s^(3/2) (Johnson 1985, section 7.2). The line leads
along -q to the zero of p². In loops of Cattaneo and Mindlin with 0.4, 0.7 and 0.9 µW, the largest
errors of the values of the cells and of the fits are:

    cells per contact radius     13    19    24    36    47    71
    δ of the cells [%]          5.1   7.2   3.1   3.4   2.4   1.3
    δ of the fit [%]            2.1   1.6   0.3   0.4   0.6   0.3
    F2 of the cells [%]          29    20    20     6     2     2
    F2 of both [%]                9     5     8     2     2     2

On rings, whose outermost slipping one lies up to an element inside the edge, δ^(2/3) is continued
along the radius to the radius of the contact.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from contact_results.surface import Cells, Rings, Surface
from contact_scene.array_types import Field, Mask

# Reach of the fits around a cell, in cells: two more cells, and three for the square of the
# pressure, whose curvature is fitted, too.
NEAR = 2.3
FAR = 3.2
# Smallest contact in cells, 7 per radius (FITTED_SLIP of semi_analytical.discretised): in smaller
# ones the fits reach across the slip zone.
LEAST_CONTACT = 150
# Smallest numbers of cells of the fits: two above the numbers of coefficients.
LEAST_NEAR = 6
LEAST_FAR = 8
# Largest change of the amplitude by a fit: the errors of resolved cells are below 15 %.
LARGEST_CHANGE = 0.15
POWER = 2 / 3
# Points of a line, so that a parabola between them is off by 1e-4 of its largest value.
POINTS = 101
# Points of a line between two rings, so that a parabola is off by 1e-3 of its change.
BETWEEN = 16
# Cells from which lines to the edge are drawn: those of two rows of four on both sides.
CANDIDATES = 16


@dataclass(frozen=True, eq=False)
class CycleEdge:
    """Fields of a load cycle on cells, (nx, ny), for fits towards the edge of the contact.

    surface    cells or rings
    corrected  true if the edge of the contact cuts cells; pressure and slip near an edge along
               cells have errors that a fit would enlarge
    pressure   pressure at an end of a load step in the cycle [force/length^2]
    amplitude  slip amplitude [length]
    shear      largest shear [force/length^2]
    tension    largest tensile stress along the surface [force/length^2]; None if unknown
    radius     contact radius at an end of a load step in the cycle [length]
    """

    surface: Surface
    corrected: bool
    pressure: Field
    amplitude: Field
    shear: Field
    tension: Field | None
    radius: float

    def largest_amplitude(self) -> float:
        """Compute the largest slip amplitude, at the edge if the largest cell is close to it.

        Without fit, it is the largest value of the points.
        """
        largest = float(np.max(self.amplitude))
        if (on_rings := self._line_on_rings(self.amplitude)) is not None:
            return max(largest, float(on_rings[0][-1]))
        for cell in self._best_inner_cells(self.amplitude, 1):
            line = self._line_to_edge(cell)
            if line is not None:
                fitted = max(float(line[0][-1]), float(self.amplitude[cell]))
                return fitted if abs(fitted - largest) <= LARGEST_CHANGE * largest else largest
        return largest

    def largest_f2(self) -> float | None:
        """Compute the largest F2 of the points, and of lines from the largest cells to the edge.

        It is None if the tensile stress is.
        """
        if self.tension is None:
            return None
        of_cells = self.tension * self.shear * self.amplitude
        found = [0.0, float(np.max(of_cells))]
        for cell in self._best_inner_cells(of_cells, CANDIDATES):
            line = self._line_to_edge(cell)
            if line is not None:
                found.append(float(np.max(np.prod(line, axis=0))))
        return max(found)

    def largest_f1(self) -> float:
        """Compute the largest F1 = τ δ: of the cells, or along the radius on rings."""
        of_points = self.shear * self.amplitude
        line = self._line_on_rings(of_points)
        return float(np.max(of_points if line is None else np.prod(line, axis=0)))

    def _line_on_rings(self, values: Field) -> tuple[Field, Field] | None:
        """Return amplitude and shear along a radius to the edge, at the angle of a largest value.

        Between the rings, δ^(2/3) and τ/√(a² - r²) are linear, with the radius a of the contact.
        The line through δ^(2/3) on the two outermost rings in contact leads on to the edge. The
        shear of the outermost one is left out: it exceeds that of the edge, because it carries the
        load of the element up to the edge.

        None is returned on cells, with fewer than three rings in contact, and for a rim.

        values  field whose largest value is sought
        """
        if not isinstance(self.surface, Rings):
            return None
        by_angle = values.reshape(len(self.surface.radii), -1)
        _, angle = np.unravel_index(np.argmax(by_angle), by_angle.shape)
        pressure, amplitude, shear = (
            each.reshape(by_angle.shape)[:, angle]
            for each in (self.pressure, self.amplitude, self.shear)
        )
        touching = pressure > 0
        radii, powers = self.surface.radii[touching], amplitude[touching] ** POWER
        if len(radii) < 3 or radii[-1] >= self.radius:
            return None
        slope = (powers[-1] - powers[-2]) / (radii[-1] - radii[-2])
        at_edge = max(powers[-1] + slope * (self.radius - radii[-1]), 0.0)
        ends = np.append(radii, self.radius)
        along = np.linspace(0, len(radii), BETWEEN * len(radii) + 1)
        line = np.interp(along, np.arange(len(ends)), ends)
        inner = radii[:-1]
        ratio = shear[touching][:-1] / np.sqrt(self.radius**2 - inner**2)
        root = np.sqrt(np.maximum(self.radius**2 - line**2, 0.0))
        slip = np.interp(line, ends, np.append(powers, at_edge)) ** (1 / POWER)
        return slip, np.interp(line, inner, ratio) * root

    def _best_inner_cells(self, values: Field, count: int) -> list[tuple[int, int]]:
        """Return slipping cells inside the edge with the largest values, largest first.

        They lie within the reach of the fits around the largest value of all cells.
        """
        small = np.count_nonzero(self.pressure) < LEAST_CONTACT or self.pressure.shape[-1] == 1
        if small or not self.corrected or not isinstance(self.surface, Cells):
            return []
        largest = np.unravel_index(np.argmax(values), values.shape)
        away = [
            axis - place
            for axis, place in zip(
                np.ogrid[: values.shape[0], : values.shape[1]], largest, strict=True
            )
        ]
        inner = _with_all_neighbours(self.pressure > 0) & (self.amplitude > 0)
        inner &= np.hypot(*away) <= FAR
        order = np.argsort(np.where(inner, values, -np.inf), axis=None)[::-1][:count]
        rows, columns = np.unravel_index(order, values.shape)
        pairs = [(int(i), int(j)) for i, j in zip(rows, columns, strict=True)]
        return [pair for pair in pairs if inner[pair]]

    def _line_to_edge(self, cell: tuple[int, int]) -> tuple[Field, ...] | None:
        """Fit amplitude, shear and tensile stress on the line from a cell to the edge.

        Each has `POINTS` values; the tensile stress is omitted if it is None. None is returned
        without enough cells, or if the edge is further away than the fit of the pressure reaches.
        """
        assert isinstance(self.surface, Cells)
        axes = zip((self.surface.x, self.surface.y), cell, strict=True)
        away = np.stack(np.meshgrid(*((x - x[i]) / (x[1] - x[0]) for x, i in axes), indexing="ij"))
        distance, inner = np.hypot(*away), _with_all_neighbours(self.pressure > 0)
        far, near = inner & (distance <= FAR), inner & (distance <= NEAR)
        slips = near & (self.amplitude > 0)
        if np.count_nonzero(far) < LEAST_FAR or np.count_nonzero(slips) < LEAST_NEAR:
            return None
        squares = _fit(_quadratic(away[:, far]), self.pressure[far] ** 2)
        edge = _edge_of(squares)
        if edge is None or np.hypot(*edge) > FAR:
            return None
        line = np.linspace(0.0, 1.0, POINTS) * edge[:, None]
        pressure = np.sqrt(np.maximum(_quadratic(line) @ squares, 0.0))
        powers = _fit(_plane(away[:, slips]), self.amplitude[slips] ** POWER)
        amplitude = np.maximum(_plane(line) @ powers, 0.0) ** (1 / POWER)
        (limit,) = _fit(self.pressure[slips][:, None], self.shear[slips])
        if self.tension is None:
            return amplitude, limit * pressure
        terms = np.column_stack([_plane(away[:, near]), self.pressure[near]])
        stress = np.column_stack([_plane(line), pressure]) @ _fit(terms, self.tension[near])
        return amplitude, limit * pressure, np.maximum(stress, 0.0)


def _fit(terms: Field, values: Field) -> Field:
    """Return the coefficients of a least-squares fit."""
    return np.asarray(np.linalg.lstsq(terms, values, rcond=None)[0])


def _plane(places: Field) -> Field:
    """Return the terms 1, x and y at places (2, n) as a matrix (n, 3)."""
    return np.column_stack([np.ones(places.shape[1]), *places])


def _quadratic(places: Field) -> Field:
    """Return the terms of a quadratic at places (2, n) as a matrix (n, 6)."""
    x, y = places
    return np.column_stack([_plane(places), x * x, x * y, y * y])


def _edge_of(squares: Field) -> Field | None:
    """Find the nearest zero of a quadratic along its steepest descent at x = 0, in cells (2,).

    None is returned if the quadratic does not fall to zero.
    """
    slope = float(np.hypot(squares[1], squares[2]))
    if not slope or squares[0] <= 0:
        return None
    x, y = along = -squares[1:3] / slope
    bend = squares[3] * x * x + squares[4] * x * y + squares[5] * y * y
    root = slope**2 - 4 * bend * squares[0]
    return None if root < 0 else np.asarray(2 * squares[0] / (slope + np.sqrt(root)) * along)


def _with_all_neighbours(inside: Mask) -> Mask:
    """Return the cells of a set whose eight neighbours are in the set, too (nx, ny)."""
    framed = np.pad(inside, 1)
    along = framed[:-2] & framed[1:-1] & framed[2:]
    return np.asarray(along[:, :-2] & along[:, 1:-1] & along[:, 2:])
