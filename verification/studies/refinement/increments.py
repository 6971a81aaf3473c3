"""Refinement of the load path."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from fem_reference import Method
from semi_analytical import SurfaceGrid
from verification.running.study import Settings, Study, StudyCase
from verification.studies.refinement.expected import Expected, by_increments
from verification.studies.refinement.refinement import Refinement, count_of, study_of
from verification.studies.refinement.section_start import SectionStart
from verification.studies.refinement.studied_scene import StudiedScene
from verification.studies.refinement.surface_level import SurfaceStart

# The coarsest path has so many times fewer increments than the scene would take.
COARSER = 2

Counts = tuple[int, ...]


def increments_study(
    path: Path, overrides: Sequence[str], step: int | None, method: Method | None
) -> Study:
    """Refinement of the load path, by finite elements where a method of theirs is named.

    Raises SceneError, CannotRefine for a step that is not there.
    """
    scene = StudiedScene.of(path, overrides, step)
    on = "grid" if method is None else "mesh"
    return study_of(
        _on_surface(scene) if method is None else _on_section(scene, method),
        f"Increments of {scene.title}",
        f"What do finite increments cost at the end of step {scene.step}? All steps whose path "
        f"matters are cut into twice as many increments from level to level, on one {on}.",
    )


def _on_surface(scene: StudiedScene) -> Refinement:
    start = SurfaceStart.of(scene)

    def level(settings: Settings, counts: Counts, size: float, words: str) -> StudyCase:
        grid = SurfaceGrid(start.cells(settings), start.grid.window)
        return start.level(grid, size, words, counts)

    matters = [step.path_matters for step in start.plan.path]
    expected = by_increments(start.contents.scene, start.couples)
    return _refinement(start.plan.increments, matters, level, expected, start.tolerance)


def _on_section(scene: StudiedScene, method: Method) -> Refinement:
    start = SectionStart.of(scene, method)

    def level(settings: Settings, counts: Counts, size: float, words: str) -> StudyCase:
        return start.level(size, words, increments=counts, elements=settings.cells)

    expected = by_increments(start.contents.scene, start.couples)
    tolerance = start.asked.tolerance
    return _refinement(start.increments, start.path_matters, level, expected, tolerance)


def _refinement(
    increments: Counts,
    matters: Sequence[bool],
    level: Callable[[Settings, Counts, float, str], StudyCase],
    expected: Mapping[str, Expected],
    tolerance: float,
) -> Refinement:
    """Of steps that are cut into so many increments, where that matters."""
    steps = list(zip(increments, matters, strict=True))

    def levels(settings: Settings) -> tuple[StudyCase, ...]:
        if not any(matters):
            return ()
        found = []
        for number in range(count_of(settings)):
            counts = tuple(
                max(1, round(count / COARSER)) * 2**number if cut else count for count, cut in steps
            )
            most = max(count for count, cut in zip(counts, matters, strict=True) if cut)
            found.append(level(settings, counts, 1 / most, f"{most} in a step"))
        return tuple(found)

    axis = "1 / increments of the step with most"
    return Refinement("increments", levels, expected, axis, tolerance)
