"""Computation of the stress below tractions on the cells of a surface grid.

The semi-analytical solver computes such tractions.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from itertools import pairwise
from math import ceil, log, log1p
from typing import TYPE_CHECKING, ClassVar

import numpy as np
from numpy.typing import NDArray

from contact_results.largest import index_of_largest
from contact_results.stress.body_response import BodyResponse, are_layers_thin
from contact_results.stress.loaded_bodies import LoadedBodies
from contact_results.stress.points import (
    MEASURES,
    FittedEdge,
    StressField,
    StressPoints,
)
from contact_results.stress.stress_maxima import (
    excess_between_depths,
    extremes,
)
from contact_scene.array_types import Field, Indices
from contact_scene.machine import one_thread
from contact_scene.quantities.stated_error import Part
from contact_scene.solver_errors import ResourceRefused

if TYPE_CHECKING:
    from contact_scene import Body
    from semi_analytical import SurfaceGrid
    from semi_analytical.frf.depth import Level
    from semi_analytical.stress import NearEdge, SubsurfaceField


# Half width of the window, in half extents of the contact, for depths whose largest stress lies at
# the edge of the first window. Behind a contact with tangential load the largest interface stress
# is about two radii from the centre.
WIDE_MARGIN = 2.4
# Cells along a side up to which a wider window has more cells, not wider ones. With 64 cells in the
# former window, a place beyond it, at the distance r from the axis, lies within r / 20 of the
# centre of a wider cell: below a point force the largest shear is then found to 0.2 %.
FEW_CELLS = 64
# Distance between adjacent places beyond the window of a line contact, relative to their distance
# from the origin. It resolves the stress, which varies over this distance; around its largest
# values, places are added as dense as the outermost strips.
GRADING = 0.02
# Distance of chosen points from the origin in half windows: the window is extended to them.
MAX_REACH = 10.0
# Excess of a parabola between depths, relative to a largest stress, up to which no further depth is
# computed: errors of this size remain at fitted edges, too.
EXCESS = 1e-3
# Ratio of a further depth to the deepest one, if the largest stress lies there, and largest number
# of times that depths are added: they reach to 77 contact radii, where nothing is largest.
DEEPER = 1.5
MORE_DEPTHS = 8
# Largest number of cells along a side for the overview, whose stress then takes less than a second,
# and interval of the default depths that it uses.
MAX_DRAWN = 64
EVERY = 2
NEIGHBOURS = 4  # adjacent cells of a point that the interpolation uses
LEVEL = ("depth", "layer")
# Numbers in memory per point of the volume. Computed: displacement and stress by depth, the same
# for all depths, corners of cells. Written: coordinates, displacement, full tensor, invariants.
COMPUTED = 9 + 9 + 8
WRITTEN = 3 + 3 + 9 + 4


@dataclass(frozen=True, eq=False)
class CellWindow:
    """One body below a window of cells that contains the contact, with the tractions on this body.

    state            bodies and tractions that cause the stress
    indenter         True for the indenter, False for the lower body
    grid             cells of the window
    pressure, shear  tractions of the cells (nx, ny), (2, nx, ny) [force/length^2]; None is no shear
    """

    state: LoadedBodies
    indenter: bool
    grid: SurfaceGrid
    pressure: Field
    shear: Field | None

    @classmethod
    def around_contact(
        cls,
        state: LoadedBodies,
        indenter: bool,
        margin: float,
        reach: Sequence[float] = (0.0, 0.0),
    ) -> CellWindow:
        """Extend the window of the contact solve by cells without traction.

        margin  smallest half width of the window in half extents of the contact
        reach   smallest half widths of the window along x and y [length]
        """
        from semi_analytical import SurfaceGrid

        x, y = state.axes["x"], state.axes["y"]
        pressure, shear = state.tractions["pressure"], state.tractions.get("shear")
        sides = [float(c[-1] - c[0]) / (len(c) - 1) if len(c) > 1 else 1.0 for c in (x, y)]
        halves = [
            ceil(r / side) - len(c) // 2 for r, side, c in zip(reach, sides, (x, y), strict=True)
        ]
        widths = [
            max(_margin_cells(pressure, axis, margin), halves[axis] + NEIGHBOURS) for axis in (0, 1)
        ]
        if len(y) == 1:
            widths[1] = 0
        pad = [(width, width) for width in widths]
        cells = (len(x) + 2 * widths[0], len(y) + 2 * widths[1])
        grid = SurfaceGrid(cells, (cells[0] * sides[0], cells[1] * sides[1]))
        if shear is not None:
            shear = np.pad(-shear if indenter else shear, [(0, 0), *pad])
        return cls(state, indenter, grid, np.pad(pressure, pad), shear)

    def widened(self) -> CellWindow:
        """Extend the window to three times its width.

        In a window of many cells, 3 × 3 cells are combined into one with their force: far from the
        contact the stress is the same.
        """
        from semi_analytical import SurfaceGrid

        nx, ny = self.grid.cells
        joined = 3 if max(nx, ny) > FEW_CELLS else 1
        cells = (3 * nx // joined, 3 * ny // joined)

        def combined(tractions: Field) -> Field:
            pad = [(0, 0)] * (tractions.ndim - 2) + [(nx, nx), (ny, ny)]
            blocks = (*tractions.shape[:-2], cells[0], joined, cells[1], joined)
            return np.asarray(np.pad(tractions, pad).reshape(blocks).mean(axis=(-3, -1)))

        side_x, side_y = self.grid.window
        grid = SurfaceGrid(cells, (3 * side_x, 3 * side_y))
        shear = None if self.shear is None else combined(self.shear)
        return replace(self, grid=grid, pressure=combined(self.pressure), shear=shear)

    def largest_at(
        self, levels: Sequence[Level], outside: Sequence[float] | None = None
    ) -> StressPoints:
        """Find the points with the largest stresses on each depth.

        levels   depths, each with its layer
        outside  half widths along x and y of a rectangle without these points [length]
        """
        columns, rows = self.computed_cells(section_only=False)
        found = []
        for field in self.stress_by_level(tuple(levels), None, rows):
            points = _stress_points(field, self.grid, columns)
            if outside is not None:
                beyond = (np.abs(points.x) > outside[0]) | (np.abs(points.y) > outside[1])
                points = points.select(beyond)
            found.append(points.select_largest())
        return StressPoints.concatenate(found)

    @property
    def body(self) -> Body:
        """Layers and base of the body in which the stress is computed."""
        return self.state.loaded_body(self.indenter)

    @property
    def far_tractions(self) -> tuple[Field, Field | None]:
        """Constant pressure and shear on cells that cause the true stress far from the cells.

        Tractions of a solver with constant tractions on cells are returned unchanged. Cell means of
        tractions that vary within the cells are sharpened, see `_sharpen_cell_means`.
        """
        if not self.state.edges:
            return self.pressure, self.shear
        loaded = self.pressure > 0
        shear = None if self.shear is None else _sharpen_cell_means(self.shear, loaded)
        return _sharpen_cell_means(self.pressure, loaded), shear

    def fit_edge(self, levels: Sequence[Level]) -> tuple[NearEdge | None, str]:
        """Fit the edge of the contact, near which the tractions fall like a square root.

        levels  depths of the stress; without a depth near the surface no edge is fitted

        Returns the fitted edge and an empty text. If the tractions do not determine the stress at
        the edge, returns the edge as far as it was fitted, or None, and the cause.
        """
        from semi_analytical.frf.stack import stack_of
        from semi_analytical.stress import EdgeNotSeen, near_edge, near_surface

        spacing = self.grid.spacing
        if self.grid.of_strips:
            return None, "strips of a line contact are narrow beside their edges"
        if self.state.no_root is not None:
            return None, self.state.no_root
        if not any(level.layer == 0 and near_surface(level.depth, spacing) for level in levels):
            return None, "no depth is near the surface"
        stack, corrected = stack_of(self.body), self.state.edges
        try:
            return near_edge(stack, self.grid, self.pressure, self.shear, corrected=corrected), ""
        except EdgeNotSeen as cause:
            return cause.candidate, str(cause)

    def points_beyond(self, levels: Sequence[Level]) -> Iterator[StressPoints]:
        """Yield the stress beyond the window on both sides of a line contact, by depth.

        The places form a geometric series from the outermost strip to the distance where the body
        deforms like its base: a layer has its largest tension where it bends.

        levels  depths, each with its layer
        """
        from semi_analytical.frf.stack import stack_of
        from semi_analytical.stress.strips import Jumps, spread

        stack, outermost = stack_of(self.body), float(self.grid.x[-1])
        pressure, shear = self.far_tractions
        jumps = Jumps.of_strips(self.grid, np.stack([*([] if shear is None else shear), pressure]))

        def points(level: Level, x: Field, farthest: float) -> StressPoints:
            bulk = self.state.bulk_stress(level.layer, self.indenter)[:, None]
            return StressPoints(
                x,
                np.zeros_like(x),
                np.full_like(x, level.depth),
                np.full(len(x), level.layer),
                np.full((3, len(x)), np.nan),
                jumps.stresses(stack, level, x) + bulk,
                at_edge=np.abs(x) == farthest,
            )

        dense = ceil(2 * GRADING * outermost / self.grid.spacing[0])
        for level in levels:
            reach = max(outermost, spread(stack, outermost, level.depth))
            steps = 1 + ceil(log(reach / outermost) / log1p(GRADING))
            distances = outermost * (1 + GRADING) ** np.arange(1, steps + 1)
            x = np.concatenate([-distances[::-1], distances])
            sparse = points(level, x, x[-1])
            largest = {index_of_largest(values) for values in sparse.measures.values()}
            around = [
                np.linspace(x[k - 1], x[k + 1], dense)
                for k in largest
                if 0 < k < len(x) - 1 and x[k - 1] * x[k + 1] > 0
            ]
            more = [points(level, one, x[-1]) for one in around]
            yield StressPoints.concatenate([sparse, *more])

    def computed_cells(self, section_only: bool) -> tuple[slice, Indices | None]:
        """Return the cells where maxima are searched, and the rows where the stress is computed.

        The maxima are searched in a slice of the cells along x: those up to x = 0 if this is a
        mirror plane of the tractions, otherwise all. The rows of cells along y are those next to y
        = 0 for the section alone, and the rows from there to the largest y if y = 0 is a mirror
        plane of the tractions. None means all rows.

        section_only  compute the stress in the section y = 0 only
        """
        from semi_analytical.stress.convolution import mirror_planes
        from semi_analytical.stress.depths import line_weights

        if self.grid.of_strips:
            return slice(None), None
        at_section = np.flatnonzero(line_weights(self.grid.y, 0.0))
        if section_only:
            return slice(None), at_section
        tractions = self.pressure[None]
        if self.shear is not None:
            tractions = np.concatenate([self.shear, tractions])
        along_x, along_y = mirror_planes(tractions)
        columns = slice((self.grid.cells[0] + 1) // 2 if along_x else None)
        return columns, np.arange(at_section[0], self.grid.cells[1]) if along_y else None

    def stress_by_level(
        self, levels: tuple[Level, ...], edge: NearEdge | None, rows: Indices | None
    ) -> Iterator[SubsurfaceField]:
        """Yield displacement and stress at all positions of the cells, one depth after the other.

        Near the fitted contact edge, the stress is corrected for tractions that vary within the
        cells. The stress from a bulk strain is included.

        levels  depths, each with its material
        edge    fitted contact edge; None without correction
        rows    indices of the rows of cells along y; None for all
        """
        from semi_analytical.stress import fields_by_level

        reached = [level for level in levels if edge is not None and edge.reaches(level)]
        # Adjacent to a corrected edge, the tractions themselves give the field.
        below = [level for level in reached if level.depth > 0] if self.state.edges else []
        near = fields_by_level(self.body, self.grid, self.pressure, self.shear, below, rows)
        for field in fields_by_level(self.body, self.grid, *self.far_tractions, levels, rows):
            if edge is not None and field.levels[0] in reached:
                if self.state.edges:
                    some = slice(None) if rows is None else rows
                    there = next(near).stress if field.depths[0] else edge.plane[None, ..., some]
                    corrected = edge.corrected(replace(field, stress=there)).stress
                    stress = np.where(edge.beside[:, some], corrected, field.stress)
                    field = replace(field, stress=stress)
                else:
                    field = edge.corrected(field)
            bulk = self.state.bulk_stress(field.levels[0].layer, self.indenter)
            yield replace(field, stress=field.stress + bulk[:, None, None])


@dataclass(frozen=True, eq=False)
class OnCells(BodyResponse):
    """One body below tractions on the cells of a surface grid.

    see_edge      fit the contact edge
    section_only  compute the section alone, without the search for the largest values
    """

    see_edge: bool = True
    section_only: bool = False

    part: ClassVar[Part] = "cells"

    @one_thread()
    def stress(self, depths: Sequence[float] | None = None, *, volume: bool = False) -> StressField:
        """Compute the stress at depths below a window of the surface that contains the contact.

        Near the edge of a smooth contact, the tractions fall like the square root of the distance
        from the edge. The contact edge is then fitted between the cells, and the result has
        additional points on the fitted edge. `how` of the result states the cause if no edge was
        fitted. If a maximum under tangential load lies at the edge of the window, its depth is
        computed again below a wider window; if a maximum still lies at the edge, below windows of
        wider cells. Below a line contact, the largest values are searched beyond the window as
        well, see `CellWindow.points_beyond`. Both sides of every interface are always included.
        """
        from semi_analytical.stress.field import MARGIN

        def below(depths: Sequence[float] | None, margin: float, **how: bool) -> StressField:
            window = CellWindow.around_contact(self.state, self.indenter, margin)
            return _stress_in_window(window, depths, **how)

        field = below(
            depths, MARGIN, volume=volume, see_edge=self.see_edge, section_only=self.section_only
        )
        if len(self.state.axes["y"]) == 1:
            return field
        if self.section_only:
            return field
        margin, far = MARGIN, _depths_at_edge(field, MEASURES)
        if far and np.any(self.state.tractions.get("shear", 0.0)):
            with suppress(ResourceRefused):  # then the first window counts
                beyond = below(sorted(far), WIDE_MARGIN, see_edge=False)
                wide = below(depths, WIDE_MARGIN, see_edge=self.see_edge, section_only=True)
                points = StressPoints.concatenate([beyond.points, field.points])
                field = replace(wide, points=points, edge=field.edge, volume=field.volume)
                margin = WIDE_MARGIN
        field = self._beyond_window(field, margin)
        return field if depths is not None else self._between_depths(field, margin)

    def _between_depths(self, field: StressField, margin: float) -> StressField:
        """Add points next to the depth of a largest stress that may be exceeded there.

        These depths are halfway to the next depths, until the excess of a parabola is at most
        `EXCESS` of the stress, and below the deepest one. Depths near the surface are dense
        already.

        margin  smallest half width of the window in half extents of the contact
        """
        from semi_analytical.frf.depth import Level
        from semi_analytical.stress import near_surface

        window = CellWindow.around_contact(self.state, self.indenter, margin)
        for _ in range(MORE_DEPTHS):
            points, measures = field.points, field.points.measures
            levels = set()
            for one in extremes(field):
                values = measures[one.measure]
                layer = int(points.material[np.argmax(values == one.value)])
                excess, three = excess_between_depths(points, values, one)
                depths: list[float] = []
                if excess > EXCESS * one.value:
                    depths = [(a + b) / 2 for a, b in pairwise(three)]
                elif layer == len(self.body.layers) and one.depth == np.max(points.depth):
                    depths = [DEEPER * one.depth]
                levels |= {
                    Level(depth, layer)
                    for depth in depths
                    if not near_surface(depth, window.grid.spacing)
                }
            if not levels:
                break
            more = window.largest_at(sorted(levels, key=lambda level: level.depth))
            field = replace(field, points=StressPoints.concatenate([points.flattened, more]))
        return field

    def _beyond_window(self, field: StressField, margin: float) -> StressField:
        """Add points beyond the window at interfaces, and where a largest stress lies at its edge.

        The shear at the interface of a thick layer is largest at about half its thickness from the
        axis. The tension of an interface may begin farther out only: a first wider window looks for
        it. The window grows until the largest stresses that decay lie within it, see
        `CellWindow.widened`.

        margin  smallest half width of the window in half extents of the contact
        """
        from semi_analytical.frf.stack import stack_of
        from semi_analytical.stress.strips import spread

        window = CellWindow.around_contact(self.state, self.indenter, margin)
        contact = max(window.grid.window) / 2
        far = {level.depth for level in _stress_levels(window.body, [], contact)}
        while far := far | _depths_at_edge(field, self.decaying):
            half = [side / 2 for side in window.grid.window]
            if max(half) > spread(stack_of(window.body), contact, max(far)):
                break
            window = window.widened()
            levels = [
                s for s in _stress_levels(window.body, sorted(far), contact) if s.depth in far
            ]
            beyond = window.largest_at(levels, outside=half)
            followed = field.points.at_edge & np.isin(field.points.depth, [*far])
            inner = replace(field.points, at_edge=field.points.at_edge & ~followed)
            points = StressPoints.concatenate([inner.flattened, beyond])
            field = replace(field, points=points)
            far = set()
        return field

    @one_thread()
    def stress_at(self, x: Field, y: Field, levels: Sequence[Level]) -> StressPoints:
        """Compute the stress at given points.

        It is interpolated cubically between the positions of the cells at the depth of a point.
        """
        from semi_analytical.stress import subsurface

        state = self.state
        reach = [float(np.max(np.abs(places))) for places in (x, y)]
        far, half = max(reach), max(float(np.max(state.axes[axis])) for axis in "xy")
        if far > MAX_REACH * half:
            raise ResourceRefused(
                f"a point is {far:.3g} m from the origin, expected at most {MAX_REACH:g} half "
                f"windows of {half:.3g} m; check the units of the points, or use a larger window"
            )
        window = CellWindow.around_contact(state, self.indenter, 0.0, reach)
        grid, tractions = window.grid, window.far_tractions
        fields = {
            level: subsurface(window.body, grid, *tractions, [level]) for level in set(levels)
        }
        rows = np.zeros_like(y) if grid.of_strips else y  # the same at every y
        found = [fields[level].below(*at) for *at, level in zip(x, rows, levels, strict=True)]
        displacement, stress = (np.concatenate(parts).T for parts in zip(*found, strict=True))
        depth, layer = (np.array([getattr(level, name) for level in levels]) for name in LEVEL)
        points = StressPoints(x, y, depth, layer, displacement, stress, at_edge=x != x)
        return state.add_bulk_stress(points, self.indenter)

    def compared(self) -> Sequence[OnCells]:
        return [self.on_wide_cells(shift) for shift in (0, 1)]

    def on_wide_cells(self, shift: int = 0) -> OnCells:
        """Return the response to tractions that are means over two by two cells.

        Strips are combined in pairs. The total force is preserved.

        shift  0 or 1, number of empty cells before the first pair of cells along each side; it
               selects the position of the coarse cells
        """
        state = self.state
        sides = [state.axes[axis] for axis in ("x", "y")]
        line = len(sides[1]) == 1
        pads = [(shift, (len(side) + shift) % 2) for side in sides]
        axes, counts = (
            {},
            [(len(side) + sum(pad)) // 2 for side, pad in zip(sides, pads, strict=True)],
        )
        if line:
            axes["y"], pads[1], counts[1] = sides[1], (0, 0), 1
        for axis, side, count in list(zip(("x", "y"), sides, counts, strict=True))[: 2 - line]:
            h = side[1] - side[0]
            axes[axis] = side[0] + h * (2 * np.arange(count) + 1 / 2 - shift)
        tractions = {}
        for name, field in state.tractions.items():
            even = np.pad(field, [*[(0, 0)] * (field.ndim - 2), *pads])
            pairs = even.reshape(*field.shape[:-2], counts[0], 2, counts[1], 2 - line)
            tractions[name] = np.asarray(pairs.mean(axis=(-3, -1)))
        return replace(self, state=replace(state, axes=axes, tractions=tractions))

    def drawn_stress(self) -> StressField | None:
        """Compute the stress on the section, with tractions on at most `MAX_DRAWN` cells a side.

        The result is None if the numbers of cells have no small common divisor.
        """
        from semi_analytical.stress import default_depths

        state = self.state
        if len(state.axes["y"]) > 1:
            state = coarser(state, MAX_DRAWN)
            if max(state.tractions["pressure"].shape) > MAX_DRAWN:
                return None
        assert state.contact_radius is not None
        levels = default_depths(self.body, state.contact_radius)
        depths = {level.depth for level in levels[::EVERY]}
        if are_layers_thin(self.body, levels[-1].depth):
            depths |= {level.depth for level in levels if level.layer < len(self.body.layers)}
        return replace(self, state=state, section_only=True).stress(sorted(depths))


def coarser(state: LoadedBodies, most: int) -> LoadedBodies:
    """Compute means of the tractions over blocks of cells, for up to `most` cells along a side.

    The averages preserve the forces. The result has more cells if the cell numbers have no common
    divisor 2, 3, 5 or 7.

    state  bodies and tractions on cells
    most   requested largest number of cells along a side
    """
    while max(shape := state.tractions["pressure"].shape) > most:
        by = next((p for p in (2, 3, 5, 7) if not any(n % p for n in shape)), None)
        if by is None:
            break
        nx, ny = (n // by for n in shape)
        axes = {name: c.reshape(-1, by).mean(axis=1) for name, c in state.axes.items()}
        tractions = {
            name: f.reshape(*f.shape[:-2], nx, by, ny, by).mean(axis=(-3, -1))
            for name, f in state.tractions.items()
        }
        state = replace(state, axes=axes, tractions=tractions)
    return state


def _depths_at_edge(field: StressField, measures: Collection[str]) -> set[float]:
    """Return the depths where a measure is largest at the edge of the window, and positive."""
    largest = [one for one in extremes(field) if one.measure in measures]
    return {one.depth for one in largest if one.at_window_edge and one.value > 0}


def _stress_in_window(
    window: CellWindow,
    depths: Sequence[float] | None,
    *,
    volume: bool = False,
    see_edge: bool = True,
    section_only: bool = False,
) -> StressField:
    """Compute the stress below a window of the surface, see `OnCells.stress`."""
    from semi_analytical.stress import SubsurfaceField, refuse_beyond_memory
    from semi_analytical.stress.depths import DEFAULT_DEPTHS

    state, grid, radius = window.state, window.grid, window.state.contact_radius
    if radius is None:
        radius = float(np.sqrt(np.count_nonzero(window.pressure) * grid.cell_area / np.pi))
    levels = _stress_levels(window.body, depths, radius)
    if volume:
        refuse_beyond_memory(grid.cells, len(levels), COMPUTED + WRITTEN)
    edge, why = window.fit_edge(levels) if see_edge else (None, "not looked for")
    how: dict[str, object] = {"fitted": False, "because": why}
    if edge is not None and not why:
        how = {"fitted": True, "points": len(edge.x), "fits_apart": edge.apart}
    columns, rows = window.computed_cells(section_only)
    rows = None if volume else rows
    if edge is not None and rows is not None:
        shown = (edge.phi.y >= rows[0]) & (edge.phi.y <= rows[-1])
        if np.any(shown):  # an edge that is fitted in part may have points on one side only
            edge = replace(edge, phi=edge.phi.chosen(shown))
    outside = window.points_beyond(levels)
    sections, largest, planes = [], [], []
    for field in window.stress_by_level(levels, None if why else edge, rows):
        sections.append(field.along_x())
        if not section_only:
            below = _stress_points(field, grid, columns)
            if grid.of_strips:
                inside = replace(below.flattened, at_edge=np.zeros(below.x.size, dtype=bool))
                below = StressPoints.concatenate([inside, next(outside)])
            largest.append(below.select_largest())
        planes += [field] if volume else []
    plane = SubsurfaceField.joined(sections)
    section = _stress_points(plane, grid)
    deepest = float(plane.depths[-1])
    if depths is None:  # those in the base below thick layers are for the largest stresses
        deepest = min(deepest, DEFAULT_DEPTHS[-1] * radius)
    fitted = None
    if edge is not None:
        on_edge = _edge_points(edge, edge.stress() + state.bulk_stress(0, window.indenter)[:, None])
        fitted = FittedEdge(on_edge, edge.apart * edge.size, not why)
    return StressField(
        window.body,
        StressPoints.concatenate(largest) if largest else section.flattened,
        fitted,
        section.add_cells(),
        _axis_points(plane),
        _stress_points(SubsurfaceField.joined(planes), grid).add_cells() if volume else None,
        "x at y = 0",
        (float(plane.x[-1]), deepest),
        {
            "contact_radius": radius,
            "cells": list(grid.cells),
            "window": list(grid.window),
            "edge": how,
            "levels": [{"depth": float(s.depth), "layer": s.layer} for s in levels],
        },
    )


def _sharpen_cell_means(means: Field, loaded: NDArray[np.bool_]) -> Field:
    """Subtract 1/12 of the second differences from cell means (…, nx, ny), within the loaded cells.

    Constant tractions on cells act like the true ones times sinc²(kh/2) = 1 - k²h²/12 + … per axis,
    with wavenumber k and cell width h. The subtraction compensates the term k²h². It is a flux
    between loaded cells, so that the total force is unchanged.
    """
    found = means.copy()
    for axis in (-2, -1):
        f, both = np.moveaxis(found, axis, -1), np.moveaxis(loaded, axis, -1)
        flow = np.diff(np.moveaxis(means, axis, -1)) / 12 * (both[..., 1:] & both[..., :-1])
        f[..., :-1] -= flow
        f[..., 1:] += flow
    return found


def _edge_points(edge: NearEdge, stress: Field) -> StressPoints:
    nothing = np.zeros(len(edge.x))
    return StressPoints(
        edge.x,
        edge.y,
        nothing,
        np.zeros(len(nothing), dtype=np.int64),
        np.full((3, len(nothing)), np.nan),
        stress,
        at_edge=nothing > 0,
    )


def _margin_cells(pressure: Field, axis: int, margin: float) -> int:
    """Return the number of cells to add on each side along an axis:
    half the window is at least `margin` times the half extent of the contact."""
    cells = pressure.shape[axis]
    loaded = np.flatnonzero(np.any(pressure > 0, axis=1 - axis))
    reach = np.abs(loaded - (cells - 1) / 2).max() + 0.5 if loaded.size else 0.0
    return max(0, int(np.ceil(margin * reach - cells / 2)))


def _stress_levels(body: Body, depths: Sequence[float] | None, radius: float) -> tuple[Level, ...]:
    """Return the depths at which the stress is computed, each with its material, downward.

    The result contains the given depths and both sides of every interface.

    depths  depths [length]; None chooses them from the contact radius and the layers
    radius  contact radius [length]
    """
    from semi_analytical.frf.stack import stack_of
    from semi_analytical.stress import default_depths, interfaces
    from semi_analytical.stress.depths import levels_of

    if depths is None:
        return default_depths(body, radius)
    sides = [side for pair in interfaces(body) for side in pair]
    asked = levels_of(stack_of(body), depths)
    return tuple(sorted({*asked, *sides}, key=lambda level: (level.depth, level.layer)))


def _stress_points(
    field: SubsurfaceField, grid: SurfaceGrid, columns: slice = slice(None)
) -> StressPoints:
    """Convert displacement and stress below the cells to stress points (levels, nx, ny).

    `at_edge` marks the points below the edge of the window.

    field    displacement and stress at several depths, the levels
    grid     surface grid of the window
    columns  slice of the cells along x
    """
    places = np.meshgrid(field.depths, field.x[columns], field.y, indexing="ij", copy=False)
    depth, x, y = places
    layers = np.array([level.layer for level in field.levels])
    at_edge = np.isin(x, grid.x[[0, -1]])
    if not grid.of_strips:
        at_edge |= np.isin(y, grid.y[[0, -1]])
    return StressPoints(
        x,
        y,
        depth,
        np.broadcast_to(layers[:, None, None], x.shape),
        np.moveaxis(field.displacement, 1, 0)[:, :, columns],
        np.moveaxis(field.stress, 1, 0)[:, :, columns],
        at_edge=at_edge,
    )


def _axis_points(section: SubsurfaceField) -> StressPoints:
    displacement, stress = section.below()
    nothing = np.zeros(len(section.levels))
    return StressPoints(
        nothing,
        nothing,
        section.depths,
        np.array([level.layer for level in section.levels]),
        displacement.T,
        stress.T,
        at_edge=np.zeros(len(nothing), dtype=bool),
    )
