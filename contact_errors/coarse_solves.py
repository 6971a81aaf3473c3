"""Coarse solves of a contact result for its error estimate: one procedure for all solvers.

`compare_with_coarse_solves` runs the coarse solves of a result. To save time, coarse solves have a
looser tolerance than the result, where its effect on the compared differences is negligible. They
also have fewer increments, where the effect of the increments is known from a separate comparison.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from math import log
from typing import Any, TypeAlias

import numpy as np

from contact_errors.error_formula import (
    BELIEVED,
    ORDERS,
    SHEAR,
    Comparison,
    SolvedRun,
    Values,
    prescribed_scalars,
    values_of,
)
from contact_errors.known_pressing import known_pressing
from contact_results.solvers import solver_of
from contact_results.surface import surface_of
from contact_scene import Scene
from contact_scene.contact_features import Features
from contact_scene.discretised import (
    SHARES,
    DiscretisedSolver,
    Fineness,
    change_increments,
    change_settings,
    coarse_tolerance,
)
from contact_scene.quantities.stated_error import (
    CoarseSolveRecord,
    Part,
    StatedErrors,
)
from contact_scene.solver_errors import ContactNotResolved, SolverError
from contact_scene.stepping.increment_error import has_increment_error

# The increments of a load step are compared with twice their number, at least MANY. If a load step
# has fewer than FEW, its error follows no power of their number: FEW are compared, too. The coarse
# solves that measure the error by the cells have at most FEW: with 4, the part by the cells of the
# stick radius in the gallery's scene spence is 2.7 times that with 8.
MANY = 32
FEW = 8
# Largest number of refinements until the cells resolve the contact, and their factor.
MAX_DOUBLINGS = 5
DOUBLING = 2.0
# A result with its scalars at the end of each load step.
Solved: TypeAlias = tuple[Any, Sequence[Values]]
# Scalars of two solves that differ in one parameter: of the finer and of the coarser solve.
Effect: TypeAlias = tuple[Sequence[Values], Sequence[Values]]


def compare_with_coarse_solves(
    solver: DiscretisedSolver, result: Any, *, by_references: bool = True
) -> tuple[SolvedRun, tuple[CoarseSolveRecord, ...]]:
    """Run the coarse solves of a result, and collect the comparisons for its error estimate.

    Scalars with an independent reference (`known_pressing`) need no coarse solve. For the others,
    each discretisation parameter is changed in a separate comparison:

    - Increments, if a load step has an increment error: two solves on few cells, with the
      increments of the result and with twice as many, at least 32. If a load step has fewer than 8,
      also a solve with 8 increments, and the limit that 32 and 8 extrapolate to.
    - Cells, elements or rings: two or three solves with coarser discretisations, compared with the
      result. For small grids one of them is finer.
    - Other parameters of a mesh: one solve each, compared on the first coarse mesh.
    - Points of a measured indenter: one solve with half of them along a side, compared on the first
      coarse grid or mesh.

    Later coarse solves use the cheaper value of a parameter that has been compared. Its measured
    effect on the scalars is added before a coarse solve is compared with the result.

    Returns the scalars of the result with all comparisons, and the records of the coarse solves.

    solver         solver of the scene with variable discretisation
    result         result whose errors are estimated
    by_references  false to run the coarse solves for scalars with an independent reference, too
    """
    values, matters = values_of(result), has_increment_error(result.scene)
    features = solver.features(result)
    run = solver.fineness_of(result)
    most = max(step.contact for step in features)
    run = replace(run, tolerance=max(run.tolerance, coarse_tolerance(most / 2)))
    references = _references(solver) if by_references else ()
    known_all = _all_known(result.scene, values, references)
    shares = () if known_all else solver.shares_of(run.space)
    spaces = {text: solver.coarser(result, share, more) for text, share, more in shares}
    half = solver.with_half_the_points()

    solves = _CoarseSolves(solver)
    every_step = [True] * len(values)
    required: dict[Part, Sequence[bool]] = {solver.part: every_step, "increments": matters}
    comparisons: list[Comparison] = []
    if half is not None:
        required["map"] = every_step
        if references and (fewer := _references(half)):
            comparisons.append(Comparison("map", references[0], fewer[0], (2.0,) * len(values)))
    effects: list[Effect] = []
    if any(matters):
        few = (solver.few(replace(run, space=space), result) for space in spaces.values())
        run, by_increments, effects = _compare_increments(solves, few, run, matters)
        comparisons += by_increments
    by_cells, mesh_parts = _compare_cells(solves, result, run, spaces, effects, half)
    required |= dict.fromkeys(mesh_parts, every_step)
    return SolvedRun(
        scene=result.scene,
        values=values,
        tolerance=solver.residuals(result),
        features=features,
        comparisons=comparisons + by_cells,
        required=required,
        neglected=solver.neglected_errors(result),
        part=solver.part,
        references=references,
    ), tuple(solves.records)


class _CoarseSolves:
    """Coarse solves of a scene and their records. Each discretisation is solved once."""

    def __init__(self, solver: DiscretisedSolver) -> None:
        self.solver = solver
        self.records: list[CoarseSolveRecord] = []
        self._known: dict[tuple[bool, Fineness], Solved | None] = {}

    def solve(
        self, differs: str, coarse: Fineness, by: DiscretisedSolver | None = None
    ) -> Solved | None:
        """Solve the scene with a coarse discretisation; return the result and its scalars.

        None is returned if the solver raised an error.

        differs  text that describes the coarse discretisation in its record
        coarse   grid or mesh, increments and tolerance
        by       solver of the scene with a coarser indenter; None for the scene as it is
        """
        key = by is None, coarse
        if key not in self._known:
            shown, increments = self.solver.record_entry(coarse.space), coarse.increments
            record = CoarseSolveRecord(differs=differs, increments=increments, **shown)
            try:
                found = (by or self.solver).solve(coarse)
                self._known[key] = found, values_of(found)
                self.records.append(record.model_copy(update=_solver_work(found)))
            except SolverError as error:
                self._known[key] = None
                self.records.append(record.model_copy(update={"refused": str(error)}))
        return self._known[key]


def _compare_increments(
    solves: _CoarseSolves, few: Iterable[Fineness], run: Fineness, matters: Sequence[bool]
) -> tuple[Fineness, list[Comparison], list[Effect]]:
    """Compare solves with other numbers of increments, on the first coarse grid or mesh.

    Grids and meshes that cannot be solved are passed over.

    solves   coarse solves of the scene
    few      coarse discretisations with the increments of the result
    run      discretisation of the later coarse solves
    matters  for each load step, true if it has an increment error
    returns  discretisation of the later coarse solves, with fewer increments if their effect is
             known; comparisons; effects of the fewer increments on the scalars
    """
    cells = solves.solver.cells
    for coarse in few:
        if first := solves.solve(f"few {cells}", coarse):
            break
    else:
        return run, [], []
    differs = f"few {cells}, other increments"
    base = _with_shear(first)
    others = [
        (count, _with_shear(other))
        for count in coarse_increment_counts(run.increments, matters)
        if (other := solves.solve(differs, replace(coarse, increments=count)))
    ]
    comparisons = [
        Comparison("increments", base, values, ratios(coarse.increments, count, matters))
        for count, values in others
    ]
    if len(others) > 1:
        comparisons.append(compare_with_limit(base, coarse.increments, others, matters))
    fewest = fewest_increments(run.increments, matters)
    if not (other := solves.solve(differs, replace(coarse, increments=fewest))):
        return run, comparisons, []
    return replace(run, increments=fewest), comparisons, [(first[1], other[1])]


def _with_shear(solved: Solved) -> Sequence[Values]:
    """Add the shear on the surface to the scalars of a coarse solve at the end of each load step.

    The traction is multiplied by the root of the area of each point, so that sums of its squares
    are integrals over the surface.
    """
    result, values = solved
    surface = surface_of(result)
    root = np.sqrt(surface.weights)
    found = []
    for here, end in zip(values, result.steps, strict=True):
        shear = surface.vector(end, "shear")
        found.append(here if shear is None else {**here, SHEAR: np.ravel(root * shear)})
    return found


def _compare_cells(
    solves: _CoarseSolves,
    result: Any,
    run: Fineness,
    spaces: Mapping[str, Any],
    effects: Sequence[Effect],
    half: DiscretisedSolver | None,
) -> tuple[list[Comparison], list[Part]]:
    """Compare the result with solves on coarser cells, elements or rings.

    The other parameters of a mesh and the points of a measured indenter are compared on the first
    of them. The later ones have the cheaper values of these parameters.

    solves   coarse solves of the scene
    result   result whose errors are estimated
    run      discretisation of the result, with the increments and tolerance of coarse solves
    spaces   coarse grids or meshes, by their descriptions
    effects  effects of the fewer increments on the scalars
    half     solver of the scene with half the points of the indenter, if points give its shape
    returns  comparisons, and the parts of the error that the other parameters of the mesh cause
    """
    solver, values = solves.solver, values_of(result)
    effects = list(effects)
    comparisons: list[Comparison] = []
    changes: dict[str, Any] | None = None
    parts: list[Part] = []
    meshes: dict[float, tuple[Sequence[Values], Sequence[Features]]] = {}
    for text, space in spaces.items():
        here = replace(run, space=change_settings(space, **(changes or {})))
        found = solves.solve(text.format(solver.cells), here)
        if not found:
            continue
        sides = zip(solver.cell_sides(found[0]), solver.cell_sides(result), strict=True)
        of_cells = add_effects(found[1], effects), solver.features(found[0])
        meshes[min(b / a for b, a in sides)] = of_cells
        if changes is None:
            changes = {}
            for coarse in solver.mesh_coarse_solves(space, result):
                parts.append(coarse.part)
                further = {**changes, coarse.key: coarse.value}
                changed = replace(run, space=change_settings(space, **further))
                if other := solves.solve(coarse.differs, changed):
                    factors = (coarse.ratio,) * len(values)
                    comparisons.append(Comparison(coarse.part, found[1], other[1], factors))
                    effects.append((found[1], other[1]))
                    found, changes, here = other, further, changed
        if half is not None and (
            other := solves.solve("every second point of the indenter", here, half)
        ):
            comparisons.append(Comparison("map", found[1], other[1], (2.0,) * len(values)))
            half = None
    for ratio, (coarse_values, coarse_features) in meshes.items():
        factors = (ratio,) * len(values)
        comparisons.append(Comparison(solver.part, values, coarse_values, factors, coarse_features))
    return comparisons, parts


def stated_errors(result: Any) -> StatedErrors:
    """Estimate the errors of all scalars of a result at the end of each load step.

    Scalars are, for example, forces and the contact radius. The scene is solved again with coarser
    discretisations. The errors follow from the differences between these solves and the result.
    """
    run, coarse = compare_with_coarse_solves(solver_of(result), result)
    return run.stated_errors(coarse)


def _references(solver: DiscretisedSolver) -> Sequence[Sequence[Values]]:
    """Return scalars of the pressing of a scene by methods other than that of its solver."""
    return () if solver.is_reference else known_pressing(solver.scene)


def _all_known(
    scene: Scene, values: Sequence[Values], references: Sequence[Sequence[Values]]
) -> bool:
    """Return true if all scalars of a result are prescribed or known by another method."""
    return bool(references) and all(
        here.keys() <= known.keys() | prescribed_scalars(ramp, scene.rig)
        for ramp, here, known in zip(scene.load_path(), values, references[0], strict=True)
        if here["contact_area"].any()
    )


def solve_coarsest(
    solver: DiscretisedSolver, fineness: Fineness, solve: Callable[[Fineness], Any]
) -> Any:
    """Solve a scene with the coarsest discretisation whose cells resolve the contact.

    While the solve raises ContactNotResolved, the cells are doubled, at most `MAX_DOUBLINGS` times.
    The error of the last solve, and any other SolverError, is raised.

    solver    solver of the scene with variable discretisation
    fineness  discretisation of the first attempt
    solve     function that solves the scene with a discretisation
    """
    for _ in range(MAX_DOUBLINGS):
        try:
            return solve(fineness)
        except ContactNotResolved:
            fineness = solver.refine_fineness(fineness, {solver.part: DOUBLING})
    return solve(fineness)


def add_effects(found: Sequence[Values], effects: Sequence[Effect]) -> Sequence[Values]:
    """Correct the scalars of a coarse solve by the effects of parameters other than the cells.

    For example, a coarse solve may have fewer increments than the result. The change of each scalar
    by the number of increments is known from two other solves (a finer and a coarser one) and is
    added. After the correction, the scalars differ from those of the result by the effect of the
    cells only. Scalars that are absent in one of the solves are omitted.

    found    scalars of the coarse solve at the end of each load step, by name
    effects  scalars of a finer and of a coarser solve, one pair for each corrected parameter
    returns  corrected scalars at the end of each load step, by name
    """
    for effect in effects:
        found = [
            {n: x + fine[n] - coarse[n] for n, x in here.items() if n in fine and n in coarse}
            for here, fine, coarse in zip(found, *effect, strict=True)
        ]
    return found


def compare_with_limit(
    values: Sequence[Values],
    increments: Sequence[int],
    others: Sequence[tuple[Sequence[int], Sequence[Values]]],
    matters: Sequence[bool],
) -> Comparison:
    """Compare a solve of few increments with the limit of infinitely many increments.

    The limit is extrapolated from two solves with more increments, assuming an error proportional
    to a power of their number. The solve of few increments is not used for the extrapolation,
    because its error does not follow this power: two balls pushed to 0.9 µW by 1, 8 and 32
    increments have errors of the shift like 4.3 : 2.8 : 1. Load steps whose other solves have fewer
    increments are not compared here.

    values, increments  scalars of the solve at the end of each load step, and its increments
    others              increments and scalars of the two other solves, the one with most increments
                        first
    matters             for each load step, true if it has an increment error
    """
    (most, finest), (more, finer) = others
    powers = [r ** (BELIEVED * ORDERS["increments"]) for r in ratios(most, more, matters)]
    limit = [
        {n: x + (x - less[n]) / (power - 1) for n, x in here.items() if n in less and power > 1}
        for here, less, power in zip(finest, finer, powers, strict=True)
    ]
    # The coarsening factor of a solve without error is 0; 1 leaves the step out.
    factors = [float(r >= 1) for r in ratios(increments, most, matters)]
    return Comparison("increments", values, limit, factors)


def _solver_work(found: Any) -> Mapping[str, int]:
    """Sum iterations and convolutions of all increments, if the solver counts them."""
    names = ("iterations", "convolutions")
    return {
        name: sum(getattr(increment, name) for increment in found.increments)
        for name in names
        if getattr(found.increments[0], name, None) is not None
    }


def coarse_increment_counts(
    counts: Sequence[int], matters: Sequence[bool]
) -> list[tuple[int, ...]]:
    """Choose the numbers of increments of the coarse solves that measure the increment error.

    The first solve has twice the increments of the result in each load step, and at least 32. With
    more increments than the result, the difference is nearer to its error than with fewer. If a
    load step has fewer than 8, a second solve has 8 in each load step. Load steps without an
    increment error keep their number, because their result does not depend on the increments.

    counts   number of increments of each load step of the result
    matters  for each load step, true if it has an increment error
    """
    found = [change_increments(counts, matters, lambda count: max(MANY, 2 * count))]
    if any(matter and count < FEW for count, matter in zip(counts, matters, strict=True)):
        found.append(change_increments(counts, matters, lambda _: FEW))
    return found


def fewest_increments(counts: Sequence[int], matters: Sequence[bool]) -> tuple[int, ...]:
    """Choose the numbers of increments of the coarse solves that measure the error by the cells.

    With other numbers than the result, one more solve on few cells measures their effect. They are
    chosen if they save more increments than this solve takes, in the three solves of the cells.

    counts   number of increments of each load step of the result
    matters  for each load step, true if it has an increment error
    """
    few = change_increments(counts, matters, lambda count: min(FEW, count))
    return few if len(SHARES) * (sum(counts) - sum(few)) > sum(few) else tuple(counts)


def ratios(
    counts: Sequence[int], others: Sequence[int], matters: Sequence[bool]
) -> tuple[float, ...]:
    """Compute the coarsening factor of the increments between two solves, for each load step.

    The error at the end of a load step includes the errors of earlier load steps. The factor is
    therefore chosen among all load steps up to this one that have an increment error: it is the
    ratio of the two numbers of increments nearest to 1, which gives the largest error estimate.
    Without such a load step, the factor is 1.

    counts, others  numbers of increments of each load step in the two solves
    matters         for each load step, true if it has an increment error
    """
    found, nearest = [], 1.0
    for count, other, matter in zip(counts, others, matters, strict=True):
        ratio = count / other
        if matter and (nearest == 1 or abs(log(ratio)) < abs(log(nearest))):
            nearest = ratio
        found.append(nearest)
    return tuple(found)
