"""Stress below tractions on the cells of a surface grid."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import partial
from math import ceil
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from contact_results.stress.loaded_bodies import LoadedBodies
from contact_results.stress.points import FittedEdge, StressField, StressPoints
from contact_results.stress.stress_maxima import extremes
from contact_scene.array_types import Field, Indices
from contact_scene.machine import one_thread
from contact_scene.solver_errors import ResourceRefused

if TYPE_CHECKING:
    from contact_scene import Body
    from semi_analytical import SurfaceGrid
    from semi_analytical.frf.depth import Level
    from semi_analytical.stress import NearEdge, SubsurfaceField


# Half width of the window in half extents of the contact. It includes the contact edge, where the
# tensile stress is largest, and the deflection of a coating outside the contact.
MARGIN = 1.6
# Half width for levels whose largest stress lies at the edge of the first window. Behind a contact
# with tangential load the largest interface stress is about two radii from the centre.
WIDE_MARGIN = 2.4
# Distance of chosen points from the origin in half windows: the window is extended to them.
MAX_REACH = 10.0
NEIGHBOURS = 4  # adjacent cells of a point that the interpolation uses
LEVEL = ("depth", "layer")
# Numbers per point of the volume: displacement and stress by level and joined, cells; coordinates,
# tensors and invariants in the file.
COMPUTED, WRITTEN = 9 + 9 + 8, 3 + 3 + 9 + 4


def estimated_bytes(grid: SurfaceGrid) -> int:
    """Estimate the largest memory of the stress below a contact that fills the grid [byte]."""
    from semi_analytical.stress.field import FIXED, required_bytes

    nx, ny = (round(MARGIN * cells) for cells in grid.cells)
    return required_bytes((nx, ny), 1) - FIXED


@one_thread()
def stress_at_cells(
    state: LoadedBodies, x: Field, y: Field, levels: Sequence[Level], *, indenter: bool = False
) -> StressPoints:
    """Interpolate the stress at points (n,) cubically between the cells of their levels."""
    from semi_analytical.stress import subsurface

    body = state.indenter if indenter else state.body
    reach = [float(np.max(np.abs(places))) for places in (x, y)]
    far, half = max(reach), max(float(np.max(state.axes[axis])) for axis in "xy")
    if far > MAX_REACH * half:
        raise ResourceRefused(
            f"a point is {far:.3g} m from the origin, expected at most {MAX_REACH:g} half windows "
            f"of {half:.3g} m; check the units of the points, or use a larger window"
        )
    grid, pressure, shear = _with_margin(state, 0.0, reach)
    if indenter and shear is not None:
        shear = -shear
    tractions = _far_field_tractions(state, pressure, shear)
    fields = {level: subsurface(body, grid, *tractions, [level]) for level in set(levels)}
    found = [fields[level].below(*at) for *at, level in zip(x, y, levels, strict=True)]
    displacement, stress = (np.concatenate(parts).T for parts in zip(*found, strict=True))
    depth, layer = (np.array([getattr(level, name) for level in levels]) for name in LEVEL)
    points = StressPoints(x, y, depth, layer, displacement, stress, at_edge=x != x)
    return state.strained(points, indenter)


@one_thread()
def stress_on_cells(
    state: LoadedBodies,
    *,
    indenter: bool = False,
    depths: Sequence[float] | None = None,
    volume: bool = False,
    see_edge: bool = True,
    section_only: bool = False,
) -> StressField:
    """Compute the stress on levels below a window that extends beyond the contact.

    Near the edge of a smooth contact, the tractions fall like the root of the distance from the
    edge, and the field has points on the fitted edge. `how` of the field states the cause if no
    edge was fitted.

    depths    [length], without both sides of every interface, which are always included; None
              chooses them from the contact and the layers
    volume    return the points and cells of the volume as well
    see_edge  fit the contact edge
    section_only  restrict the largest values to the section

    Raises ValueError for a depth outside the body, and ResourceRefused.
    """
    below = partial(_below, state, indenter)
    field = below(depths, MARGIN, volume=volume, see_edge=see_edge, section_only=section_only)
    if section_only or not np.any(state.tractions.get("shear", 0.0)):
        return field
    found = extremes(field, state.indenter if indenter else state.body)
    far = sorted({e.depth for e in found if e.at_window_edge and e.value > 0})
    if not far:
        return field
    with suppress(ResourceRefused):  # then the largest values keep the mark `at_window_edge`
        beyond = below(far, WIDE_MARGIN, see_edge=False)
        wide = below(depths, WIDE_MARGIN, see_edge=see_edge, section_only=True)
        points = StressPoints.joined([beyond.points, field.points])
        return replace(wide, points=points, edge=field.edge, volume=field.volume)
    return field


def _below(
    state: LoadedBodies,
    indenter: bool,
    depths: Sequence[float] | None,
    margin: float,
    *,
    volume: bool = False,
    see_edge: bool = True,
    section_only: bool = False,
) -> StressField:
    """Compute the stress on a window of at least `margin` half extents of the contact."""
    from semi_analytical.stress import SubsurfaceField, refuse_beyond_memory

    body = state.indenter if indenter else state.body
    grid, pressure, shear = _with_margin(state, margin)
    radius = state.contact_radius
    if radius is None:
        radius = float(np.sqrt(np.count_nonzero(pressure) * grid.cell_area / np.pi))
    levels = _levels(body, depths, radius)
    if volume:
        refuse_beyond_memory(grid.cells, len(levels), COMPUTED + WRITTEN)
    if indenter and shear is not None:
        shear = -shear
    edge, why = None, "not looked for"
    if see_edge:
        edge, why = _edge(state, body, grid, levels, pressure, shear)
    how = _how(edge, why)
    rows = None if volume else _rows(grid, pressure, shear, section_only)
    if edge is not None and rows is not None and not section_only:
        edge = replace(edge, phi=edge.phi.chosen(edge.phi.y >= rows[0]))
    sections, largest, planes = [], [], []
    for field in _each_level(
        state, body, grid, levels, pressure, shear, None if why else edge, rows
    ):
        if state.strain is not None:
            bulk = state.bulk_stress(field.levels[0].layer, indenter)
            field = replace(field, stress=field.stress + bulk[:, None, None])
        sections.append(field.along_x())
        points = _points(field, grid)
        largest.append(points.with_largest())
        planes += [field] if volume else []
    plane = SubsurfaceField.joined(sections)
    fitted = None
    if edge is not None:
        on_edge = _on_edge(edge, edge.stress() + state.bulk_stress(0, indenter)[:, None])
        fitted = FittedEdge(on_edge, edge.apart * edge.size, not why)
    return StressField(
        StressPoints.joined(largest),
        fitted,
        _points(plane, grid).with_cells(),
        _axis(plane),
        _points(SubsurfaceField.joined(planes), grid).with_cells() if volume else None,
        "x at y = 0",
        (float(plane.x[-1]), float(plane.depths[-1])),
        {
            "contact_radius": radius,
            "cells": list(grid.cells),
            "window": list(grid.window),
            "edge": how,
            "levels": [{"depth": float(s.depth), "layer": s.layer} for s in levels],
        },
    )


def _rows(
    grid: SurfaceGrid, pressure: Field, shear: Field | None, section_only: bool
) -> Indices | None:
    """Return the rows of cells for the section, and for y > 0 if y = 0 is a mirror plane."""
    from semi_analytical.stress.convolution import mirror_planes
    from semi_analytical.stress.depths import line_weights

    at_section = np.flatnonzero(line_weights(grid.y, 0.0))
    if section_only:
        return at_section
    tractions = pressure[None] if shear is None else np.stack([*shear, pressure])
    return np.arange(at_section[0], grid.cells[1]) if mirror_planes(tractions)[1] else None


def _edge(
    state: LoadedBodies,
    body: Body,
    grid: SurfaceGrid,
    levels: Sequence[Level],
    pressure: Field,
    shear: Field | None,
) -> tuple[NearEdge | None, str]:
    """Fit the edge of the contact. If it is not determined, return the fit so far and the cause."""
    from semi_analytical.frf.stack import stack_of
    from semi_analytical.stress import EdgeNotSeen, near_edge, near_surface

    if state.no_root is not None:
        return None, state.no_root
    if not any(level.layer == 0 and near_surface(level.depth, grid.spacing) for level in levels):
        return None, "no depth is near the surface"
    try:
        return near_edge(stack_of(body), grid, pressure, shear, corrected=state.edges), ""
    except EdgeNotSeen as cause:
        return cause.candidate, str(cause)


def _each_level(
    state: LoadedBodies,
    body: Body,
    grid: SurfaceGrid,
    levels: tuple[Level, ...],
    pressure: Field,
    shear: Field | None,
    edge: NearEdge | None,
    rows: Indices | None,
) -> Iterator[SubsurfaceField]:
    """Yield the fields level by level, with the stress near a fitted edge."""
    from semi_analytical.stress import fields_by_level

    far = _far_field_tractions(state, pressure, shear)
    reached = [level for level in levels if edge is not None and edge.reaches(level)]
    # Adjacent to a corrected edge, the tractions themselves give the field.
    exact = reached if state.edges else []
    near = fields_by_level(body, grid, pressure, shear, exact, rows)
    for field in fields_by_level(body, grid, *far, levels, rows):
        if edge is None or field.levels[0] not in reached:
            yield field
        elif exact:
            beside = edge.beside if rows is None else edge.beside[:, rows]
            there = edge.corrected(next(near)).stress
            yield replace(field, stress=np.where(beside, there, field.stress))
        else:
            yield edge.corrected(field)


def _far_field_tractions(
    state: LoadedBodies, pressure: Field, shear: Field | None
) -> tuple[Field, Field | None]:
    """Return constant tractions on cells with the far field of the tractions.

    Tractions of a solver on cells are returned unchanged; cell means are sharpened.
    """
    if not state.edges:
        return pressure, shear
    loaded = pressure > 0
    return _sharpened(pressure, loaded), None if shear is None else _sharpened(shear, loaded)


def _sharpened(means: Field, loaded: NDArray[np.bool_]) -> Field:
    """Subtract 1/12 of the second differences from cell means, within the loaded cells.

    Cell means as constants act like the tractions times sinc²(kh/2) = 1 - k²h²/12 + … per axis. The
    correction is a flux between loaded cells, so that the sum is unchanged.
    """
    found = means.copy()
    for axis in (-2, -1):
        f, both = np.moveaxis(found, axis, -1), np.moveaxis(loaded, axis, -1)
        flow = np.diff(np.moveaxis(means, axis, -1)) / 12 * (both[..., 1:] & both[..., :-1])
        f[..., :-1] -= flow
        f[..., 1:] += flow
    return found


def _how(edge: NearEdge | None, why: str) -> dict[str, object]:
    """Return the record of the edge fit for `stress.json`."""
    if edge is None or why:
        return {"fitted": False, "because": why}
    return {"fitted": True, "points": len(edge.x), "fits_apart": edge.apart}


def _on_edge(edge: NearEdge, stress: Field) -> StressPoints:
    """Return points (n,) on the edge at the surface, with displacements NaN."""
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


def _with_margin(
    state: LoadedBodies, margin: float, reach: Sequence[float] = (0.0, 0.0)
) -> tuple[SurfaceGrid, Field, Field | None]:
    """Return grid, pressure and shear on a window that contains the given one.

    margin  smallest half width of the window in half extents of the contact
    reach   smallest half widths of the window along x and y [length]
    """
    from semi_analytical import SurfaceGrid

    x, y = state.axes["x"], state.axes["y"]
    pressure, shear = state.tractions["pressure"], state.tractions.get("shear")
    sides = [float(c[-1] - c[0]) / (len(c) - 1) for c in (x, y)]
    halves = [ceil(r / side) - len(c) // 2 for r, side, c in zip(reach, sides, (x, y), strict=True)]
    widths = [max(_margin(pressure, axis, margin), halves[axis] + NEIGHBOURS) for axis in (0, 1)]
    pad = [(width, width) for width in widths]
    cells = (len(x) + 2 * widths[0], len(y) + 2 * widths[1])
    grid = SurfaceGrid(cells, (cells[0] * sides[0], cells[1] * sides[1]))
    return grid, np.pad(pressure, pad), None if shear is None else np.pad(shear, [(0, 0), *pad])


def _margin(pressure: Field, axis: int, margin: float) -> int:
    """Return the number of cells to add on each side."""
    cells = pressure.shape[axis]
    loaded = np.flatnonzero(np.any(pressure > 0, axis=1 - axis))
    reach = np.abs(loaded - (cells - 1) / 2).max() + 0.5 if loaded.size else 0.0
    return max(0, int(np.ceil(margin * reach - cells / 2)))


def _levels(body: Body, depths: Sequence[float] | None, radius: float) -> tuple[Level, ...]:
    """Return the levels of the given depths and of both sides of every interface, downward."""
    from semi_analytical.frf.stack import stack_of
    from semi_analytical.stress import default_depths, interfaces
    from semi_analytical.stress.depths import levels_of

    if depths is None:
        return default_depths(body, radius)
    sides = [side for pair in interfaces(body) for side in pair]
    asked = levels_of(stack_of(body), depths)
    return tuple(sorted({*asked, *sides}, key=lambda level: (level.depth, level.layer)))


def _points(field: SubsurfaceField, grid: SurfaceGrid) -> StressPoints:
    """Return the points (levels, nx, ny); `at_edge` marks the edge of the window."""
    places = np.meshgrid(field.depths, field.x, field.y, indexing="ij", copy=False)
    depth, x, y = places
    layers = np.array([level.layer for level in field.levels])
    return StressPoints(
        x,
        y,
        depth,
        np.broadcast_to(layers[:, None, None], x.shape),
        np.moveaxis(field.displacement, 1, 0),
        np.moveaxis(field.stress, 1, 0),
        at_edge=np.isin(x, grid.x[[0, -1]]) | np.isin(y, grid.y[[0, -1]]),
    )


def _axis(section: SubsurfaceField) -> StressPoints:
    """Interpolate the section on the z axis (levels,)."""
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
