"""Histories without a closed form: only the equations themselves can judge them."""

from __future__ import annotations

from contact_scene import LoadStep, Scene
from verification.cases import paper_scene as paper
from verification.cases.case import Case, Level, Run
from verification.cases.paper_scene import STEEL

CELLS = 64


def load_paths(level: Level = Level.QUICK) -> Case:
    """The case, on finer grids above the quick level."""
    return load_paths_on(CELLS if level is Level.QUICK else 2 * CELLS)


def load_paths_on(cells: int) -> Case:
    """The case on a square grid of this many cells per side."""
    grid = paper.hertz_grid(cells)
    return Case(
        name="load_paths",
        title="Load histories without a closed form",
        problem=(
            "Histories in which normal and tangential load change together or in two directions, "
            "for ν = 0.3. Nobody has a formula for them; the residuals of contact and friction at "
            "every increment are judged."
        ),
        runs=tuple(Run(name, scene, grid) for name, scene in _scenes().items()),
        quantities=(),
        limits=("Small residuals say that the equations are solved, not that they are right.",),
    )


def _scenes() -> dict[str, Scene]:
    def scene(title: str, *loading: LoadStep) -> Scene:
        return paper.frictional(title, paper.paraboloid(STEEL), STEEL, *loading)

    half = 0.5 * paper.FRICTION_LIMIT
    return {
        "unloading at constant T": scene(
            "Normal force reduced at constant tangential force",
            LoadStep(tangential_force=(half, 0.0), increments=2),
            LoadStep(normal_force=0.6 * paper.NORMAL_FORCE, increments=4),
        ),
        "loading at constant T": scene(
            "Normal force raised at constant tangential force",
            LoadStep(tangential_force=(half, 0.0), increments=2),
            LoadStep(normal_force=1.4 * paper.NORMAL_FORCE, increments=4),
        ),
        "turning": scene(
            "Tangential force turning by a right angle",
            LoadStep(tangential_force=(half, 0.0), increments=2),
            LoadStep(tangential_force=(half, half), increments=3),
            LoadStep(tangential_force=(-half, half), increments=4),
        ),
    }
