"""Histories without a closed form: only the equations themselves can judge them."""

from __future__ import annotations

from contact_scene import LoadStep, Scene
from verification.cases.turned import difference_after_quarter, difference_of_motion, turned
from verification.judging.case import Case, Comparison, Level
from verification.judging.run import SOLVER_TOLERANCE, Run
from verification.problems import paper_scene as paper
from verification.problems.paper_scene import STEEL

CELLS = 64
TURNING = "turning"
QUARTER, OBLIQUE = 90.0, 30.0  # degrees

ISOTROPY = 3e-4  # on the quick grid
ISOTROPY_WHY = (
    "set by hand: about four times what square cells leave at the edges of contact and stick on "
    "64 of them, in proportion to the cell on others"
)


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
            "for ν = 0.3. Nobody has a formula for them; the laws of contact and friction at every "
            "increment are judged, and that no direction is better than another."
        ),
        runs=tuple(Run(name, scene, grid) for name, scene in _scenes().items()),
        quantities=(),
        comparisons=(
            Comparison(
                "turned_by_90", "difference of pressure, shear and shift after a right angle",
                (turned_label(QUARTER), TURNING), difference_after_quarter,
                10 * SOLVER_TOLERANCE,
                "square cells turn into themselves; residuals of two solves, which tractions "
                "answer a few times over",
                "isotropic bodies and friction",
            ),
            Comparison(
                "turned_by_30", "difference of shift and energy lost after 30°",
                (turned_label(OBLIQUE), TURNING), difference_of_motion(OBLIQUE),
                ISOTROPY * CELLS / cells, ISOTROPY_WHY, "isotropic bodies and friction",
            ),
        ),
        limits=("Small residuals say that the equations are solved, not that they are right.",),
    )  # fmt: skip


def turned_label(degrees: float) -> str:
    """Label of the turning history, turned as a whole."""
    return f"{TURNING}, turned by {degrees:g}°"


def _scenes() -> dict[str, Scene]:
    def scene(title: str, *loading: LoadStep) -> Scene:
        return paper.frictional(title, paper.paraboloid(STEEL), STEEL, *loading)

    half = 0.5 * paper.FRICTION_LIMIT
    turning = (
        LoadStep(tangential_force=(half, 0.0), increments=2),
        LoadStep(tangential_force=(half, half), increments=3),
        LoadStep(tangential_force=(-half, half), increments=4),
    )
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
        TURNING: scene("Tangential force turning by a right angle", *turning),
        **{
            turned_label(degrees): scene(
                f"Tangential force turning, as a whole turned by {degrees:g}°",
                *turned(turning, degrees),
            )
            for degrees in (QUARTER, OBLIQUE)
        },
    }
