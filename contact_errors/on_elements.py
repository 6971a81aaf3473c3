"""Coarse solves of a finite-element result: half of the elements, other increments, half of the
section, ten times the overlap, two thirds of the harmonics."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from math import ceil
from typing import Any

import numpy as np

from contact_errors.coarse_solves import CoarseSolves
from contact_errors.error_formula import Comparison, Features, SolvedRun
from contact_scene import FiniteElementDiscretisation, Scene
from contact_scene.increment_error import with_error
from contact_scene.solver_errors import SurfacesOverlap
from contact_scene.stated_error import Companion, Part, StatedErrors
from contact_scene.summary import ContactStatus
from fem_reference import Increment, Method, Path, Result, solve

Progress = Callable[[Increment], None]

# Friction acts back on the pressure, which has a cusp on the axis.
CUSPED = (Path.PRESSING_WITH_FRICTION, Path.HARMONICS)
FEWEST_ELEMENTS, SMALLEST_BOX, FEWEST_HARMONICS, LARGEST_OVERLAP = 4, 5.0, 2, 1.0
# Elements over the radius times increments of a run up to which a third coarse solve is made.
SMALL = 640
LINEAR = 2.0  # linear elements resolve a feature like twice as many cells


def stated_errors(result: Result, *, progress: Progress | None = None) -> StatedErrors:
    """Estimate the errors of all numbers at the ends of all steps, by coarse solves."""
    run, companions = coarse_solves(result, progress=progress)
    return StatedErrors(tuple(run.errors()), companions)


def coarse_solves(
    result: Result, *, progress: Progress | None = None
) -> tuple[SolvedRun, tuple[Companion, ...]]:
    """Solve the scene of a result on coarse meshes and with other increments."""
    coarse, asked = CoarseSolves(result), result.discretisation
    matters, features = with_error(result.scene), _features(result)

    def solved(differs: str, update: Mapping[str, float], others: Sequence[int] = ()) -> Any:
        mesh, counts = (
            asked.model_copy(update=dict(update)),
            tuple(others or result.plan.increments),
        )
        scene = with_increments(result.scene, others) if others else result.scene
        record = Companion(
            differs=differs, elements_per_radius=mesh.elements_per_radius, increments=counts
        )
        key = tuple(sorted(update.items())), counts
        return coarse.solved(key, lambda: _coarse(scene, mesh, result.method, progress), record)

    half = max(FEWEST_ELEMENTS, ceil(asked.elements_per_radius / 2))
    largest = max(increment.contact_radius for increment in result.increments)
    # The edge of the contact lies in the middle of an element.
    base = {"elements_per_radius": half, "contact_radius": largest * half / (half + 0.5)}
    ways = {"half the elements": base}
    counts = {"half the elements and two": half + 2}
    if asked.elements_per_radius * len(result.increments) <= SMALL:
        counts["two thirds of the elements"] = ceil(2 * asked.elements_per_radius / 3)
    for differs, count in counts.items():
        ways[differs] = {"elements_per_radius": count, "contact_radius": result.radius}
    comparisons: list[Comparison] = []
    side = result.radius / asked.elements_per_radius
    for differs, update in ways.items():
        if update["elements_per_radius"] < asked.elements_per_radius:
            found = solved(differs, update)
            ratio = found and found.radius / found.discretisation.elements_per_radius / side
            comparisons += coarse.compared("elements", found, ratio)
    first = solved("half the elements", base)
    for part, update, ratio, order in () if first is None else _of_mesh(first):
        found = solved(f"half the elements, coarser {part}", base | update)
        comparisons += coarse.compared(part, found, ratio, order, first)
    comparisons += coarse.by_increments(
        matters, lambda others: solved("half the elements, other increments", base, others)
    )
    always = [True] * len(features)
    needed: dict[Part, Sequence[bool]] = {"elements": always, "increments": matters}
    if result.plan.path is Path.HARMONICS:
        needed["harmonics"] = always
    run = SolvedRun(
        scene=result.scene,
        values=coarse.values(result),
        tolerance=[result.tolerance] * len(features),
        features=features,
        comparisons=comparisons,
        required=needed,
        neglected=dict.fromkeys(_ACROSS, _slip_across(result)),
    )
    return run, tuple(coarse.made)


def _of_mesh(base: Result) -> Iterator[tuple[Part, dict[str, float], float, float]]:
    """Other parameters of a mesh, coarsened: part, values, coarsening factor and order."""
    asked = base.discretisation
    box = max(section.outline.box for section in base.sections if section is not None)
    if box / 2 >= SMALLEST_BOX:
        yield "section", {"box": box / 2}, 2.0, 2.0
    if base.method is Method.PENALTY:
        overlap = min(LARGEST_OVERLAP, 10 * asked.overlap)
        yield "penalty", {"overlap": overlap}, overlap / asked.overlap, 1.0
    if base.plan.path is Path.HARMONICS:
        few = max(FEWEST_HARMONICS, 2 * asked.harmonics // 3)
        yield "harmonics", {"harmonics": few}, asked.harmonics / few, 2.0


def _features(result: Result) -> tuple[Features, ...]:
    """Resolution at the end of each step; an element counts as two cells."""
    scene, side = result.scene, result.radius / result.discretisation.elements_per_radius
    thinnest = min(scene.body.thinnest, scene.indenter.thinnest)
    per_length, found = LINEAR / side, list[Features]()
    for end in result.steps:
        if end.contact_area == 0:
            found.append(found[-1])
            continue
        stick = None if end.stick_radius is None else per_length * end.stick_radius
        slips = stick is not None and end.status is not ContactStatus.FULL_STICK
        found.append(
            Features(
                contact=per_length * end.contact_radius,
                cell=side,
                layer=per_length * thinnest if thinnest < float("inf") else None,
                stick=stick,
                annulus=per_length * end.contact_radius - (stick or 0.0) if slips else None,
                whole_rings=result.plan.path is Path.HARMONICS,
                sharp=scene.indenter.rim is not None,
                infinite=scene.indenter.rim is not None or scene.indenter.gap_exponent == 1,
                cusp=result.plan.path in CUSPED,
                ridge=_peak_radius(end) > end.contact_radius / 2,
                slides=end.status is ContactStatus.GROSS_SLIDING,
            )
        )
    return tuple(found)


def _peak_radius(end: Increment) -> float:
    """Radius of the largest pressure [length]."""
    largest = end.pressure.reshape(len(end.radii), -1).max(axis=1)
    return float(end.radii[np.argmax(largest)])


_ACROSS = ("tangential_shift", "tangential_force", "stick_radius", "stick_area",
           "dissipated_energy", "energy_per_cycle")  # fmt: skip


def _slip_across(result: Result) -> float:
    """Relative error by slip across the load, which the path with shear along the load neglects.

    In Mindlin's solution the slip is inclined to the load by at most α = ν/(4 - 2ν) (Johnson 1985,
    section 7.2). Shear of that inclination carries 1 - α²/2 of the load. Layers respond differently
    along and across a wave for any ν: the largest α counts, that of ν = ½.
    """
    if result.plan.path is not Path.SHEARING:
        return 0.0
    bodies = result.scene.body, result.scene.indenter
    ratios_ = [m.poisson_ratio for body in bodies for m in body.elastic_materials]
    layered = any(body.layers for body in bodies)
    nu = 0.5 if layered else max(ratios_)
    return (nu / (4 - 2 * nu)) ** 2 / 2


def _coarse(
    scene: Scene, mesh: FiniteElementDiscretisation, method: Method, progress: Progress | None
) -> Result:
    """Solve a scene, with more overlap where coarse elements leave more than the run may."""
    try:
        return solve(scene, mesh, method, progress)
    except SurfacesOverlap:
        looser = mesh.model_copy(update={"overlap": LARGEST_OVERLAP})
        return solve(scene, looser, method, progress)


def with_increments(scene: Scene, increments: Sequence[int]) -> Scene:
    """Return a scene with other increments."""
    steps = [
        step.model_copy(update={"increments": count})
        for step, count in zip(scene.loading, increments, strict=True)
    ]
    return scene.model_copy(update={"loading": tuple(steps)})
