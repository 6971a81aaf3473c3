"""Stress at the edge of a sliding contact, where it is largest and tractions on cells miss it."""

from __future__ import annotations

from functools import cache, partial

import numpy as np
from numpy.typing import NDArray

import semi_analytical
from contact_results.stress.invariants import principal_stresses
from contact_scene import Body, Paraboloid
from semi_analytical.frf.stack import stack_of
from semi_analytical.grid import SurfaceGrid
from semi_analytical.stress.field import subsurface
from semi_analytical.stress.near_edge import NearEdge, near_edge
from verification.closed_forms.hamilton_stress import hamilton_stress
from verification.closed_forms.huber_stress import huber_stress
from verification.closed_forms.sheared_surface import (
    stress_by_hertz_pressure,
    stress_by_hertz_shear,
    trailing_edge_tension,
)
from verification.judging.case import Case, Check, Level, Required
from verification.problems import paper_scene as paper
from verification.problems.layered_scene import coated, film, pressed, rigid_ball
from verification.problems.paper_scene import HERTZ, STEEL, hertz_grid
from verification.problems.reference import Reference, ReferenceKind, closed_form
from verification.problems.shifted_grid import ShiftedGrid

Field = NDArray[np.float64]

MU, NU = paper.FRICTION, STEEL.poisson_ratio
OFFSET = (0.31, 0.17)  # of the grid in cells: the edge cuts cells in every way
NEAR = 4.0  # cells to either side of the edge on the line, and three elsewhere
DEPTH = 1.0  # in cells
TOLERANCE = 1e-8
POINTS = 16  # per cell and side
# σ1 on the trailing edge under the same sliding, over Hertz's p0 of the substrate: the pressure of
# `paraboloid_under`, the edge value by rays, the layer's part by its Hankel transforms.
COATED = {(2.0, 1.0): 0.375456, (0.5, 1.0): 0.223980, (4.0, 0.3): 0.442676}


def edge_stress(level: Level = Level.QUICK) -> Case:
    """The case; the quick level leaves out two coatings and the surface."""
    required = "required of stress at the edge by the project's accuracy targets"
    own = "a tenth of what the tension on the edge may be wrong: what is fitted is exact here"
    exact = trailing_edge_tension(1.0, MU, NU)
    hamilton = "Hamilton and Goodman 1966; Johnson 1985, section 7.1"
    quick = level is Level.QUICK
    surface = Check(
        "surface",
        "largest error of all components at the surface within 3 cells of the "
        "edge, without shear, over p₀",
        "",
        "128x128",
        _surface_error,
        Reference(0.0, ReferenceKind.CLOSED_FORM, "Huber 1904"),
        Required(5e-4, own),
        1.0,
        "p₀",
    )
    return Case(
        name="edge_stress",
        title="Stress at the edge of a sliding contact",
        problem=(
            "A ball that slides on steel and on coated bodies, its pressure solved on cells that "
            "lie anyhow on the contact and its shear 0.1 of that: the tension on the trailing "
            "edge. Then Hertz's own pressure, its means over cells given: the line "
            "through the edge, and all components beside and below it."
        ),
        runs=(),
        quantities=(),
        checks=(
            *(
                Check(
                    f"trailing_edge_{cells}", "σ₁ on the trailing edge over p₀", "",
                    f"{cells}x{cells}", partial(_tension_on_steel, cells),
                    closed_form(exact, hamilton), Required(allowed, required), exact, "its value",
                )
                for cells, allowed in ((128, 5e-3), (256, 2e-3))
            ),
            Check(
                "line", "largest error of σ_xx(x, 0) within 4 cells of either edge, over p₀", "",
                "128x128", _line_error,
                Reference(0.0, ReferenceKind.CLOSED_FORM, "Hamilton and Goodman 1966; Cerruti"),
                Required(5e-4, own), 1.0, "p₀",
            ),
            Check(
                "below", "largest error of all components a cell below, within 3 "
                "cells of the edge, over p₀", "", "128x128", _error_below,
                Reference(0.0, ReferenceKind.SEMI_CLOSED, "Hamilton 1983, as one integral"),
                Required(5e-4, own), 1.0, "p₀",
            ),
            *(() if quick else (surface,)),
            *(
                Check(
                    f"coated_{ratio:g}_{thickness:g}", "σ₁ on the trailing edge over Hertz's p₀",
                    "", "128x128", partial(_tension_on_coat, ratio, thickness),
                    Reference(
                        value, ReferenceKind.SEMI_CLOSED, "rays over the pressure of "
                        "`paraboloid_under`, and the layer by its Hankel transforms", 1e-6,
                    ),
                    Required(1e-2, required), value, "its value",
                )
                for (ratio, thickness), value in COATED.items()
                if thickness < 1 or not quick
            ),
        ),
    )  # fmt: skip


def _tension_on_steel(cells: int) -> float:
    return _tension(Body(material=STEEL), paper.paraboloid(STEEL), cells)


def _tension_on_coat(ratio: float, thickness: float) -> float:
    return _tension(coated(film(ratio, thickness)), rigid_ball(), 128)


def _tension(body: Body, indenter: Paraboloid, cells: int) -> float:
    """Largest on the edge, under the paper's force, over p0."""
    grid = _grid(cells)
    result = semi_analytical.solve(pressed("Sliding", indenter, body), grid, TOLERANCE)
    found = _sliding(body, grid, result.steps[-1].pressure)
    return float(np.max(principal_stresses(found.stress())[0])) / HERTZ.peak_pressure


def _sliding(body: Body, grid: SurfaceGrid, pressure: Field) -> NearEdge:
    """With the shear of full sliding along x."""
    shear = np.stack([MU * pressure, np.zeros_like(pressure)])
    return near_edge(stack_of(body), grid, pressure, shear)


@cache
def _means() -> Field:
    """Of Hertz's pressure over the cells, by Gauss points."""
    grid = _grid(128)
    x, y = grid.coordinates()
    nodes, weights = (half / 2 for half in np.polynomial.legendre.leggauss(POINTS))
    dx, dy = grid.spacing
    return np.asarray(
        sum(
            weight * other * HERTZ.pressure(np.hypot(x + s * dx, y + t * dy))
            for s, weight in zip(nodes, weights, strict=True)
            for t, other in zip(nodes, weights, strict=True)
        )
    )


@cache
def _exact() -> NearEdge:
    return _sliding(Body(material=STEEL), _grid(128), _means())


def _grid(cells: int) -> ShiftedGrid:
    of = hertz_grid(cells)
    return ShiftedGrid(of.cells, of.window, OFFSET)


def _line_error() -> float:
    """At 32 places beside either edge, none nearer to it than an eighth of a cell."""
    found, a, p0 = _exact(), HERTZ.contact_radius, HERTZ.peak_pressure
    beside = (np.arange(32) / 32 - 0.5 + 1 / 64) * 2 * NEAR * found.grid.spacing[0]
    x = np.concatenate([-a + beside, a + beside])
    exact = stress_by_hertz_pressure(x, a, p0, NU) + stress_by_hertz_shear(x, a, MU * p0, NU)
    return float(np.max(np.abs(found.at(x, np.zeros_like(x))[0] - exact))) / p0


def _surface_error() -> float:
    """At cell centres, of the pressure alone."""
    of, (x, y) = _exact(), _grid(128).coordinates()
    found = near_edge(of.stack, of.grid, of.tractions.cells[2], None)
    stress = found.corrected(subsurface(of.stack, of.grid, of.tractions.cells[2], None, (0.0,)))
    r = np.hypot(x, y)
    exact = huber_stress(r, 0.0, HERTZ.contact_radius, HERTZ.peak_pressure, NU)
    c, s = x / r, y / r
    xx = exact.radial * c * c + exact.hoop * s * s
    yy = exact.radial * s * s + exact.hoop * c * c
    xy = (exact.radial - exact.hoop) * c * s
    return _largest(stress.stress[0] - np.stack([xx, yy, exact.axial, 0 * r, 0 * r, xy]))


def _error_below() -> float:
    """At cell centres, sliding."""
    found, (x, y) = _exact(), _grid(128).coordinates()
    depth = DEPTH * found.grid.spacing[0]
    cells = found.tractions.cells
    field = found.corrected(subsurface(found.stack, found.grid, cells[2], cells[:2], (depth,)))
    near = _near(x, y)
    exact = hamilton_stress(
        x[near], y[near], depth, HERTZ.contact_radius, HERTZ.peak_pressure,
        MU * HERTZ.peak_pressure, NU,
    )  # fmt: skip
    return float(np.max(np.abs(field.stress[0][:, near] - exact))) / HERTZ.peak_pressure


def _near(x: Field, y: Field) -> NDArray[np.bool_]:
    away = np.abs(np.hypot(x, y) - HERTZ.contact_radius)
    return np.asarray(away < (NEAR - 1) * _grid(128).spacing[0])


def _largest(error: Field) -> float:
    """Of all components near the edge, over p0."""
    near = _near(*_grid(128).coordinates())
    return float(np.max(np.abs(error[:, near]))) / HERTZ.peak_pressure
