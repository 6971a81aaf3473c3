"""Coarse solves of a semi-analytical result: half of the cells, and other increments."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from math import ceil

import numpy as np
from scipy.ndimage import distance_transform_edt

from contact_errors.coarse_solves import CoarseSolves
from contact_errors.error_formula import PEAK, Comparison, Features, SolvedRun
from contact_results.remarks import left_out
from contact_scene import HeightMap
from contact_scene.increment_error import with_error
from contact_scene.solver_errors import ContactAtWindowEdge, ResourceRefused
from contact_scene.stated_error import Companion, StatedErrors
from contact_scene.summary import ContactStatus
from semi_analytical import Increment, Result, SurfaceGrid, solve
from semi_analytical.edge.corrected import EdgeReport
from semi_analytical.edge.film import film_law
from semi_analytical.edge.fit import WIDE
from semi_analytical.plan import Coupling
from semi_analytical.resolution import Resolution, resolution

Progress = Callable[[Increment], None]
Cells = tuple[int, int]

# Cells over the contact radius of the solves that estimate the increment error. The effect of
# increments on 24² and on 64² cells differs by at most 7 %.
PER_RADIUS = 11
# Cells times increments of a run up to which a third coarse solve is made.
SMALL = 100_000
# Convolutions of a coarse solve, on a quarter of the cells, over those of the run; and those that
# each increment may take in any case.
MOST_CONVOLUTIONS, FEW_CONVOLUTIONS = 4, 200
# Largest height of a random surface in root mean squares: one place in a thousand exceeds it.
HIGHEST = 3.0
# Enlargement of a fitted window where the coarse contact reaches its edge.
ROOM = 1.25


def stated_errors(result: Result, *, progress: Progress | None = None) -> StatedErrors:
    """Estimate the errors of all numbers at the ends of all steps, by coarse solves."""
    run, companions = coarse_solves(result, progress=progress)
    return StatedErrors(tuple(run.errors()), companions)


def coarse_solves(
    result: Result, *, progress: Progress | None = None
) -> tuple[SolvedRun, tuple[Companion, ...]]:
    """Solve the scene of a result on fewer cells and with other increments."""
    coarse = CoarseSolves(result)
    matters, resolved = with_error(result.scene), resolution(result)

    def solved(differs: str, cells: Cells, increments: tuple[int, ...]) -> Result | None:
        record = Companion(differs=differs, cells=cells, increments=increments)
        found: Result | None = coarse.solved(
            (cells, increments), lambda: _coarse(result, cells, increments, progress), record
        )
        return found

    comparisons: list[Comparison] = []
    all_cells, counts = result.grid.cells, result.plan.increments
    half = _part(all_cells, 0.5)
    ways = {"half the cells": half, "half the cells and two": (half[0] + 2, half[1] + 2)}
    rough = isinstance(result.scene.indenter, HeightMap)
    if rough or np.prod(all_cells) * len(result.increments) <= SMALL:
        ways["two thirds of the cells"] = _part(all_cells, 2 / 3)
    for differs, cells in ways.items():
        ratio = min(n / m for n, m in zip(all_cells, cells, strict=True))
        if ratio > 1:
            comparisons += coarse.compared("cells", solved(differs, cells, counts), ratio)
    largest = max(step.contact for step in resolved)
    few = min(_part(all_cells, min(PER_RADIUS / max(largest, 1.0), 1.0)), half)
    comparisons += coarse.by_increments(
        matters, lambda others: solved("few cells, other increments", few, others)
    )
    run = SolvedRun(
        scene=result.scene,
        values=coarse.values(result),
        tolerance=[result.tolerance] * len(resolved),
        features=_features(result, resolved),
        comparisons=comparisons,
        required={"cells": [True] * len(resolved), "increments": matters},
        neglected={PEAK: HIGHEST * left_out(result)},
    )
    return run, tuple(coarse.made)


def _features(result: Result, resolved: Sequence[Resolution]) -> tuple[Features, ...]:
    """Resolution at the end of each step."""
    indenter, coupled = result.scene.indenter, result.plan.coupling is not Coupling.NONE
    law = film_law(result.scene.body, result.scene.indenter, result.grid.spacing)
    found: list[Features] = []
    for end, cells in zip(result.steps, resolved, strict=True):
        if end.contact_area == 0:
            found.append(found[-1])
            continue
        fitted = end.edge_report is not None and end.edge_report.cause is None
        report = end.edge_report if fitted else None
        # The square root of a half-space is fitted to more cells than the film is thick.
        if cells.layer is not None and cells.layer < WIDE.reach and (coupled or law is None):
            fitted = False
        features = Features(
            contact=cells.contact,
            cell=max(result.grid.spacing),
            layer=cells.layer,
            wave=cells.wave,
            stick=cells.stick,
            annulus=cells.annulus,
            fitted=fitted,
            stick_fitted=report is not None and report.border and not coupled,
            sharp=indenter.rim is not None,
            infinite=indenter.rim is not None or indenter.gap_exponent == 1,
            cusp=coupled,
            ridge=(report is not None and report.ridge) or _to_edge(end) < cells.contact / 2,
            slides=end.status is ContactStatus.GROSS_SLIDING,
        )
        found.append(features if report is None else replace(features, changes=_changes(report)))
    return tuple(found)


def _changes(report: EdgeReport) -> Mapping[str, float]:
    """Relative changes of numbers in the last iteration of the edge correction."""
    motions = dict.fromkeys(("approach", "normal_force", "tilt", "moment"), report.response)
    radii = {"contact_radius": report.radius, "contact_area": 2 * report.radius}
    return {**motions, **radii, PEAK: report.peak}


def _to_edge(end: Increment) -> float:
    """Distance of the largest pressure from the edge of the contact, in cells."""
    place = np.unravel_index(np.argmax(end.pressure), end.pressure.shape)
    return float(distance_transform_edt(end.in_contact)[place])


def _coarse(
    run: Result, cells: Cells, increments: tuple[int, ...], progress: Progress | None
) -> Result:
    """Solve the scene of a run on other cells, on a larger window if a fitted one is too small."""
    spent, plan = 0, run.plan.cut_into(increments)
    most = MOST_CONVOLUTIONS * sum(i.convolutions for i in run.increments)
    most = max(most, sum(increments) * FEW_CONVOLUTIONS)

    def observe(increment: Increment) -> None:
        nonlocal spent
        spent += increment.convolutions
        if spent > most:
            raise ResourceRefused(f"the coarse solve would take more than {most} convolutions")
        if progress is not None:
            progress(increment)

    grid = SurfaceGrid(cells, run.grid.window)
    try:
        return solve(run.scene, grid, run.tolerance, observe, plan)
    except ContactAtWindowEdge:
        if run.scene.indenter.extent is not None:
            raise
        nx, ny = _part(cells, ROOM)
        hx, hy = grid.spacing
        larger = SurfaceGrid((nx, ny), (nx * hx, ny * hy))
        return solve(run.scene, larger, run.tolerance, observe, plan)


def _part(cells: Cells, part: float) -> Cells:
    """A part of the cells along each side, rounded up to an even number."""
    nx, ny = (2 * ceil(part * n / 2) for n in cells)
    return nx, ny
