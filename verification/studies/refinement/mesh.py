"""Refinement of what carries the tractions: cells of the surface, or elements of the section."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from fem_reference import Method
from semi_analytical import SurfaceGrid
from verification.judging.case import Level
from verification.running.row import Row
from verification.running.study import Settings, Study
from verification.studies.refinement.expected import by_cells, by_elements
from verification.studies.refinement.fit import FEWEST_LEVELS
from verification.studies.refinement.level_row import values_of
from verification.studies.refinement.refinement import Refinement, count_of, study_of
from verification.studies.refinement.section_level import SectionLevel
from verification.studies.refinement.section_start import SectionStart
from verification.studies.refinement.studied_scene import CannotRefine, StudiedScene
from verification.studies.refinement.surface_level import SurfaceLevel
from verification.studies.refinement.surface_start import SurfaceStart

# Neighbouring grids are not multiples of each other: how a round contact cuts the cells differs
# from grid to grid, and only that tells its scatter from the order.
RATIO = 2**0.5
ASKED_BY = "more --cells"  # more levels are coarser ones
FEWEST_CELLS = 16
FEWEST_ELEMENTS = 6
# How a circle cuts cells, and how many elements a layer's thickness takes, add a scatter of their
# own, which one level more tells from the order.
ONE_MORE = 1
# The finest mesh over the scene's: sections cost little, and coarse ones are not asymptotic.
FINER = {Level.QUICK: 2, Level.STANDARD: 3, Level.FULL: 4}


def mesh_study(
    path: Path, overrides: Sequence[str], step: int | None, method: Method | None
) -> Study:
    """Refinement of cells, or of elements where a method of the finite elements is named.

    Raises SceneError, CannotRefine for a step that is not there, UnsupportedScene where a friction
    map fixes the cells.
    """
    scene = StudiedScene.of(path, overrides, step)
    refinement, refined = _of_cells(scene), "The window stays, and so do the increments; cells"
    if method is not None:
        refinement, refined = _of_elements(scene, method), "Section and increments stay; elements"
    return study_of(
        refinement,
        f"{refined.split()[-1].capitalize()} of {scene.title}",
        f"What do finite {refined.split()[-1]} cost at the end of step {scene.step}? {refined} "
        "become smaller by √2 from level to level.",
    )


def _of_cells(scene: StudiedScene) -> Refinement:
    start = SurfaceStart.of(scene)

    def levels(settings: Settings) -> tuple[SurfaceLevel, ...]:
        finest = start.grid_of(settings.cells).cells
        counts = [
            tuple(2 * round(count / RATIO**number / 2) for count in finest)
            for number in reversed(range(count_of(settings, ONE_MORE)))
        ]
        if settings.levels is None:
            fine = [count for count in counts if min(count) >= FEWEST_CELLS]
            counts = max(fine, counts[-FEWEST_LEVELS:], key=len)
        if min(counts[0]) < FEWEST_CELLS:
            raise _too_coarse(f"{len(counts)} grids would have {counts[0]} cells", FEWEST_CELLS)
        grids = [SurfaceGrid((nx, ny), start.grid.window) for nx, ny in counts]
        return tuple(
            start.level(max(grid.spacing), "{} x {} cells".format(*grid.cells), grid=grid)
            for grid in grids
        )

    expected = by_cells(start.contents.scene, start.couples)
    return Refinement(
        "mesh", levels, expected, "cell side / contact radius", start.tolerance, _contact_radius,
        ASKED_BY,
    )  # fmt: skip


def _of_elements(scene: StudiedScene, method: Method) -> Refinement:
    start = SectionStart.of(scene, method)
    asked = start.asked

    def levels(settings: Settings) -> tuple[SectionLevel, ...]:
        finest = settings.cells or FINER[settings.level] * asked.elements_per_radius
        numbers = reversed(range(count_of(settings, ONE_MORE)))
        counts = [round(finest / RATIO**number) for number in numbers]
        if counts[0] < FEWEST_ELEMENTS:
            raise _too_coarse(f"{len(counts)} meshes would have {counts[0]}", FEWEST_ELEMENTS)
        return tuple(
            start.level(
                start.element(count) / start.radius, f"{count} elements per radius", fineness=count
            )
            for count in counts
        )

    augmentations = asked.augmentations if method is Method.PENALTY else None
    squares = asked.mesher == "tensor"
    expected = by_elements(start.contents.scene, start.couples, augmentations, squares=squares)
    return Refinement(
        "mesh", levels, expected, "element side / contact radius", start.tolerance, finer=ASKED_BY
    )


def _too_coarse(coarsest: str, fewest: int) -> CannotRefine:
    return CannotRefine(
        f"the coarsest of {coarsest}, fewer than {fewest}; use more --cells or fewer levels"
    )


def _contact_radius(finest: Row) -> float:
    return values_of(finest)["contact_radius"]
