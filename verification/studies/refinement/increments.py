"""Refinement of the load path."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from fem_reference import Method
from verification.running.study import Settings, Study, StudyCase
from verification.studies.refinement.expected import by_increments
from verification.studies.refinement.refinement import Refinement, count_of, study_of
from verification.studies.refinement.section_start import SectionStart
from verification.studies.refinement.studied_scene import StudiedScene
from verification.studies.refinement.surface_start import SurfaceStart

# The coarsest path has so many times fewer increments than the scene would take.
COARSER = 2


def increments_study(
    path: Path, overrides: Sequence[str], step: int | None, method: Method | None
) -> Study:
    """Refinement of the load path, by finite elements where a method of theirs is named.

    Raises SceneError, CannotRefine for a step that is not there.
    """
    scene = StudiedScene.of(path, overrides, step)
    start = SurfaceStart.of(scene) if method is None else SectionStart.of(scene, method)
    steps = list(zip(start.increments, start.path_matters, strict=True))

    def levels(settings: Settings) -> tuple[StudyCase, ...]:
        if not any(start.path_matters):
            return ()
        found = []
        for number in range(count_of(settings)):
            counts = tuple(
                max(1, round(count / COARSER)) * 2**number if cut else count for count, cut in steps
            )
            most = max(count for count, (_, cut) in zip(counts, steps, strict=True) if cut)
            words = f"{most} in a step"
            found.append(start.level(1 / most, words, fineness=settings.cells, increments=counts))
        return tuple(found)

    refinement = Refinement(
        "increments",
        levels,
        by_increments(start.contents.scene, start.couples),
        "1 / increments of the step with most",
        start.tolerance,
    )
    return study_of(
        refinement,
        f"Increments of {scene.title}",
        f"What do finite increments cost at the end of step {scene.step}? All steps whose path "
        "matters are cut into twice as many increments from level to level, on one "
        f"{'grid' if method is None else 'mesh'}.",
    )
