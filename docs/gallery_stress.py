"""Quantities of the gallery that no result contains: deflection by a uniform pressure, and largest
stresses of a sliding contact."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

import numpy as np
from made_reference import table
from scipy.special import ellipe, ellipk, j0, j1

from contact_results.stress.invariants import principal_stresses
from contact_scene import SurfaceDiscretisation, read_scene_file
from semi_analytical import solve_discretised
from semi_analytical.frf.stack import stack_of
from semi_analytical.frf.surface import half_space_scalars, scalars
from semi_analytical.stress.field import subsurface
from semi_analytical.stress.near_edge import EdgeNotSeen, near_edge

if TYPE_CHECKING:
    from gallery_claims import Entry, Ours, Solved

PANELS = 100  # of the integral over wavenumbers
DEEPEST = 30.0  # wavenumber times the outermost thickness where the layers have no effect
HERTZ = 3.1684041e9, 0.388196803830797e-3  # p_H and a_H of the ball on the bare substrate
CLOSE = 2.4  # side of the window over the contact radius
CUT = 2e-3  # of a tension: as much as it varies with where the edge lies in its cells
MU = 0.1
CELLS = (96, 144)
THICKNESSES = (0.125, 0.25, 0.5, 1.0, 2.0)  # over a_H
RATIOS = (0.5, 2.0, 4.0)  # E1/E2


def deflection(at: float, radius: float, pressure: float) -> Ours:
    """Compare the surface displacement under a uniform pressure on a disc [length].

    at        distance of the point from the middle of the disc; not equal to the radius
    radius    radius of the disc
    pressure  uniform pressure
    """

    def displacement(solved: Solved) -> tuple[float, float]:
        stack = stack_of(solved.result.scene.body)
        fine, coarse = (_by_layers(stack, at, radius, panels) for panels in (PANELS, PANELS // 2))
        G, nu = stack.outer
        there = _by_half_space(at / radius) * 2 * (1 - nu) * radius / (np.pi * G)
        return pressure * (there + fine), pressure * abs(fine - coarse)

    return displacement


def _by_half_space(at: float) -> float:
    """Return the displacement of a half-space of the outermost material, in units of
    2 (1 - ν) p a / (π G) (Johnson 1985, eqs. 3.29).

    at  distance from the middle over the radius a of the disc
    """
    if at <= 1:
        return float(ellipe(at**2))
    return at * float(ellipe(at**-2) - (1 - at**-2) * ellipk(at**-2))


def _by_layers(stack, at: float, radius: float, panels: int) -> float:
    """Return the change of the displacement by the layers, per unit of pressure.

    The integral a ∫ ΔC22 J1(αa) J0(αr) dα is computed by Gauss's rule on `panels` intervals.
    ΔC22 is the normal compliance of the layered body less that of its outermost material.
    """
    nodes, weights = np.polynomial.legendre.leggauss(16)
    ends = np.linspace(0.0, DEEPEST / stack.layers[0].thickness, panels + 1)
    half = np.diff(ends)[:, None] / 2
    alpha = ends[:-1, None] + half * (1 + nodes)
    change = scalars(stack, alpha).c22 - half_space_scalars(stack.outer, alpha).c22
    waves = change * j1(alpha * radius) * j0(alpha * at)
    return radius * float(np.sum(half * weights * waves))


@cache
def _sliding(changes: tuple[str, ...], cells: int) -> tuple[float, float]:
    """Return the largest tensile stress at the edge of the contact, and the largest shear stress
    at the interface, over p_H.

    The tractions are the pressure of frictionless pressing and the shear µp along x.
    """
    from gallery_claims import SCENES

    contents = read_scene_file(SCENES / "torn_coating.toml", changes)
    rough = solve_discretised(contents.scene, SurfaceDiscretisation(cells=(32, 32)))
    side = CLOSE * rough.steps[-1].contact_radius
    fineness = SurfaceDiscretisation(cells=(cells, cells), window=(side, side))
    result = solve_discretised(contents.scene, fineness)
    pressure = result.steps[-1].pressure
    shear = np.stack([MU * pressure, np.zeros_like(pressure)])
    stack = stack_of(contents.scene.body)
    edge = near_edge(stack, result.grid, pressure, shear)
    depth = contents.scene.body.layers[0].thickness
    at_interface = subsurface(stack, result.grid, pressure, shear, (depth,)).stress[0]
    return (
        float(np.max(principal_stresses(edge.stress())[0])) / HERTZ[0],
        float(np.max(np.abs(at_interface[4]))) / HERTZ[0],
    )


def _with_error(changes: tuple[str, ...], which: int) -> tuple[float, float]:
    """Return one of the stresses of `_sliding` on the finer cells, and its error.

    The error is twice the difference between both grids, at least `CUT` of the value.
    """
    coarse, fine = (_sliding(changes, cells)[which] for cells in CELLS)
    return fine, max(2 * abs(fine - coarse), CUT * fine)


def coating(ratio: float, thickness: float) -> tuple[str, ...]:
    """Return the changes of the scene for E1/E2 = `ratio` and the layer thickness over a_H."""
    return (
        f'body.layers[1].material.young_modulus="{210 * ratio:g} GPa"',
        f'body.layers[1].thickness="{thickness * HERTZ[1] * 1e3:.12g} mm"',
    )


def edge_tension(solved: Solved) -> tuple[float, float]:
    """Return the largest tensile stress at the trailing edge over p_H, and its error."""
    return _with_error(solved.changes, 0)


def _text(ratio: float, thickness: float, which: int) -> str:
    try:
        value, error = _with_error(coating(ratio, thickness), which)
    except EdgeNotSeen:
        return "–"
    return f"{value:.4f} ± {error:.4f}"


def tensions_by_thickness(_: Entry) -> str:
    """Return a table of the tensile stress at the trailing edge and of the shear stress at the
    interface, by modulus and thickness of the coating."""
    rows = [
        (f"{thickness:g}", *(_text(ratio, thickness, n) for n in (0, 1) for ratio in RATIOS))
        for thickness in THICKNESSES
    ]
    heads = [f"{name}, E₁/E₂ = {ratio:g}" for name in ("σ₁ / p_H", "τ / p_H") for ratio in RATIOS]
    return (
        "Largest tension σ₁ on the trailing edge and largest shear τ_xz at the interface while the "
        f"ball slides with µ = {MU:g}, by thickness (–: the pressure near the edge of so thin a "
        f"film is not resolved by these cells):\n\n{table(('h / a_H', *heads), rows)}"
    )
