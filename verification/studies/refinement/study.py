"""The studies of refinement that any scene file can have: of its cells, of its increments."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from contact_scene import FrictionMap
from semi_analytical import SurfaceGrid, UnsupportedScene, discretise
from verification.cases.case import Level
from verification.cases.outcome import Status
from verification.studies.refinement import page
from verification.studies.refinement.expected import Expected, by_increments, by_mesh
from verification.studies.refinement.fit import FEWEST_LEVELS, Fit, fits
from verification.studies.refinement.level_record import LevelRecord
from verification.studies.refinement.level_run import CannotRefine, LevelRun, StudiedScene
from verification.studies.running.study import (
    Conclusion,
    Records,
    Settings,
    Statement,
    Study,
    StudyCase,
)

LEVELS = {Level.QUICK: 4, Level.STANDARD: 5, Level.FULL: 6}
# The coarsest path has so many times fewer increments than the scene would take.
COARSER = 2
# Neighbouring grids are not multiples of each other: how a round contact cuts the cells differs
# from grid to grid, and only that tells its scatter from the order.
CELL_RATIO = 2**0.5
FEWEST_CELLS = 16


@dataclass(frozen=True)
class Refinement:
    """One kind of refinement of one scene.

    runs      the levels, coarse to fine; each computes a LevelRecord
    expected  orders by quantity
    axis      what sizes are, for people; unit: what they are divided by
    """

    name: str
    title: str
    question: str
    runs: Callable[[Settings], tuple[StudyCase, ...]]
    expected: Mapping[str, Expected]
    axis: str
    unit: Callable[[LevelRecord], float]
    tolerance: float


def increments_study(path: Path, overrides: Sequence[str], step: int | None) -> Study:
    """Refinement of the load path. Raises SceneError, CannotRefine for a step that is not there."""
    scene = StudiedScene.of(path, overrides, step)
    contents, planned = scene.read(), scene.plan()
    grid = discretise(contents.scene, contents.semi_analytical)

    def runs(settings: Settings) -> tuple[LevelRun, ...]:
        if not any(path_step.path_matters for path_step in planned.path):
            return ()
        cells = grid.cells if settings.cells is None else (settings.cells, settings.cells)
        levels = []
        for number in range(_levels(settings)):
            counts = tuple(
                max(1, round(s.count / COARSER)) * 2**number if s.path_matters else s.count
                for s in planned.path
            )
            refined = zip(planned.path, counts, strict=True)
            size = 1 / max(count for s, count in refined if s.path_matters)
            levels.append(LevelRun(scene, cells, grid.window, counts, size))
        return tuple(levels)

    return study_of(
        Refinement(
            "increments",
            f"Increments of {_title(path, contents.scene.title)}",
            f"What do finite increments cost at the end of step {scene.step}? All steps whose path "
            "matters are cut into twice as many increments from level to level, on one grid.",
            runs,
            by_increments(contents.scene, planned),
            "1 / increments of the step with most",
            lambda finest: 1.0,
            contents.semi_analytical.tolerance,
        )
    )


def mesh_study(path: Path, overrides: Sequence[str], step: int | None) -> Study:
    """Refinement of the surface grid. Raises SceneError, CannotRefine for a step that is not there,
    UnsupportedScene where a friction map fixes the cells."""
    scene = StudiedScene.of(path, overrides, step)
    contents, planned = scene.read(), scene.plan()
    friction = contents.scene.friction
    if friction is not None and isinstance(friction.coefficient, FrictionMap):
        raise UnsupportedScene("the friction map has one value per cell, which fixes the cells")
    grid = discretise(contents.scene, contents.semi_analytical)

    def runs(settings: Settings) -> tuple[LevelRun, ...]:
        finest = grid.cells if settings.cells is None else (settings.cells, settings.cells)
        levels = []
        for number in reversed(range(_levels(settings))):
            nx, ny = (2 * round(count / CELL_RATIO**number / 2) for count in finest)
            spacing = SurfaceGrid((nx, ny), grid.window).spacing
            levels.append(LevelRun(scene, (nx, ny), grid.window, planned.increments, max(spacing)))
        if min(levels[0].cells) < FEWEST_CELLS:
            raise CannotRefine(
                f"the coarsest of {len(levels)} grids would have {levels[0].cells} cells, fewer "
                f"than {FEWEST_CELLS}; use more cells or fewer levels"
            )
        return tuple(levels)

    return study_of(
        Refinement(
            "mesh",
            f"Cells of {_title(path, contents.scene.title)}",
            f"What do finite cells cost at the end of step {scene.step}? The window stays, and so "
            "do the increments; cells become smaller by √2 from level to level.",
            runs,
            by_mesh(contents.scene, planned),
            "cell side / contact radius",
            lambda finest: finest.values["contact_radius"],
            contents.semi_analytical.tolerance,
        )
    )


def study_of(refinement: Refinement) -> Study:
    """The study of one kind of refinement, whichever solver its levels are solved by."""

    def cases(settings: Settings) -> tuple[StudyCase, ...]:
        return refinement.runs(settings)

    def found(settings: Settings, records: Records) -> tuple[LevelRecord, ...]:
        by_name = (records.get(run.name) for run in refinement.runs(settings))
        return tuple(r for r in by_name if isinstance(r, LevelRecord))

    def fitted(levels: Sequence[LevelRecord]) -> tuple[Fit, ...]:
        if len(levels) < FEWEST_LEVELS:
            return ()
        return fits(levels, refinement.expected, refinement.tolerance)

    def conclude(settings: Settings, records: Records) -> Conclusion:
        if not refinement.runs(settings):
            return Conclusion(statements=(_one_is_exact(),))
        levels = found(settings, records)
        return _conclusion(refinement, levels, fitted(levels))

    def exports(settings: Settings, records: Records) -> Mapping[str, str]:
        levels = found(settings, records)
        if not levels:
            return {}
        of = fitted(levels)
        return {"levels.csv": page.level_csv(levels, of), "orders.json": page.order_json(of)}

    return Study(refinement.name, refinement.title, refinement.question, cases, conclude, exports)


def _conclusion(
    refinement: Refinement, levels: Sequence[LevelRecord], found: Sequence[Fit]
) -> Conclusion:
    if not found:
        return Conclusion(statements=(_nothing_to_fit(len(levels)),), remarks=page.LIMITS)
    chart = page.error_chart(
        f"{refinement.name}_errors", refinement.axis, found, refinement.unit(levels[-1])
    )
    return Conclusion(
        statements=(
            *(page.statement(fit) for fit in found),
            page.converged(levels, refinement.tolerance),
        ),
        tables=(page.order_table(found), page.level_table(levels, found)),
        charts=(chart,),
        remarks=page.LIMITS,
    )


def _one_is_exact() -> Statement:
    return Statement(
        claim="no step depends on how finely it is cut",
        outcome=None,
        measured="one increment per step is exact: nothing was computed",
        because="'slipstick plan' says why for each step",
    )


def _nothing_to_fit(levels: int) -> Statement:
    few = levels < FEWEST_LEVELS
    return Statement(
        claim="orders of convergence",
        outcome=Status.INCONCLUSIVE if few else None,
        measured=f"{levels} levels" if few else "nothing changes by more than the tolerance",
        because=f"at least {FEWEST_LEVELS} levels are needed",
    )


def _levels(settings: Settings) -> int:
    return LEVELS[settings.level] if settings.levels is None else settings.levels


def _title(path: Path, title: str) -> str:
    return title or path.name
