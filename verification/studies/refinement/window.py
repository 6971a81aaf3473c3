"""The window of the surface grid: the convolution is not periodic, so its size must not matter."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from contact_scene.solver_errors import SolverError
from fem_reference import Method
from semi_analytical import ContactAtWindowEdge, SurfaceGrid
from verification.exhibits.chart import Chart, Look, curve
from verification.exhibits.log_chart import log_chart, point_curves
from verification.exhibits.numbers import plain
from verification.exhibits.table import table_of
from verification.running.row import CaseRecord, Row, found
from verification.running.rules import converged, judged
from verification.running.study import Conclusion, Records, Settings, Statement, Study
from verification.studies.refinement import page
from verification.studies.refinement.fit import ABOVE_TOLERANCE, distance
from verification.studies.refinement.level_row import size_of, values_of
from verification.studies.refinement.refinement import count_of
from verification.studies.refinement.studied_scene import StudiedScene
from verification.studies.refinement.surface_level import SurfaceLevel
from verification.studies.refinement.surface_start import SurfaceStart, refuse_fixed_window

GROWTH = 0.25  # by so much of the scene's own the window grows from level to level
SMALLER = (0.25, 0.4, 0.55, 0.7, 0.85)  # of the scene's own: which of them hold the contact is seen
DRAWN = 1e-12
REFUSED = ContactAtWindowEdge.__name__
REFUSALS = "Windows that do not hold the contact"
LIMITS = (
    "The cells about the centre are the same in every window; a larger one has more around them. "
    "Coefficients are exact at any distance, and the convolution is padded to twice the window: "
    "nothing repeats itself.",
    "Fields are compared on the scene's own window. What is compared goes through the solver's "
    f"tolerance, so changes of up to {ABOVE_TOLERANCE:g} tolerances are its own.",
)


@dataclass(frozen=True)
class Window:
    """The scene on one window."""

    solved: SurfaceLevel

    @property
    def name(self) -> str:
        return f"window-{self.solved.name}"

    def compute(self) -> CaseRecord:
        """Solve, or say by what that was refused."""
        try:
            return self.solved.compute()
        except SolverError as error:
            return CaseRecord(
                parameters={"level": self.solved.level},
                words={"error": type(error).__name__, "message": str(error)},
            )


def window_study(
    path: Path, overrides: Sequence[str], step: int | None, method: Method | None = None
) -> Study:
    """Windows of several sizes with the same cells, some of them too small.

    Raises SceneError, CannotRefine for a step that is not there, UnsupportedScene where a height
    map or a friction map fixes the window.
    """
    scene = StudiedScene.of(path, overrides, step)
    start = SurfaceStart.of(scene)
    refuse_fixed_window(start.contents.scene)

    def cases(settings: Settings) -> tuple[Window, ...]:
        own = start.grid_of(settings.cells)
        larger = (1 + GROWTH * number for number in range(count_of(settings)))
        grids = [_about_the_centre(own, factor) for factor in (*SMALLER, *larger)]
        return tuple(
            Window(
                start.level(own.cells[0] / grid.cells[0], _words(grid), grid=grid, kept=own.cells)
            )
            for grid in grids
        )

    def conclude(settings: Settings, records: Records) -> Conclusion:
        known = list(found(cases(settings), records).values())  # smallest window first
        refused = [record for record in known if _error(record)]
        solved = [record for record in known if not _error(record)]
        said = [_refused(known)]
        tables = [table_of(REFUSALS, {"window": _level, "error": _error}, refused)]
        if solved:
            on = f"on {len(solved)} levels"
            said.append(converged(solved, start.tolerance, on))
            tables.insert(0, page.level_table(solved, tuple(values_of(solved[-1]))))
        if len(solved) > 1:
            said.insert(0, _unchanged(solved, start.tolerance))
        return Conclusion(
            statements=tuple(said),
            tables=tuple(tables),
            charts=(_chart(solved, start.tolerance),) if len(solved) > 2 else (),
            remarks=LIMITS,
        )

    return Study(
        "window",
        f"Window of {scene.title}",
        f"Does the result at the end of step {scene.step} depend on the window? It is made larger "
        "and smaller around the same cells, down to some that do not hold the contact.",
        cases,
        conclude,
    )


def _about_the_centre(grid: SurfaceGrid, factor: float) -> SurfaceGrid:
    """So many times as large, by whole pairs of cells: those that stay do not move."""
    nx, ny = (cells + 2 * round(cells * (factor - 1) / 2) for cells in grid.cells)
    dx, dy = grid.spacing
    return SurfaceGrid((nx, ny), (nx * dx, ny * dy))


def _words(grid: SurfaceGrid) -> str:
    sides = " x ".join(f"{1e3 * side:.4g}" for side in grid.window)
    return "{} x {} cells, {} mm".format(*grid.cells, sides)


def _unchanged(solved: Sequence[CaseRecord], tolerance: float) -> Statement:
    *others, largest = solved
    changes = [(d, name) for other in others for name, d in distance(other, largest).items()]
    worst, name = changes[int(np.argmax([change for change, _ in changes]))]
    return Statement(
        claim="a window that holds the contact does not matter",
        outcome=judged(worst <= ABOVE_TOLERANCE * tolerance),
        measured=f"largest change {plain(worst, 2)}, of the {page.label(name)}, "
        f"over {len(solved)} windows",
        because=f"allowed {ABOVE_TOLERANCE:g} tolerances of {tolerance:g}: the convolution is not "
        "periodic",
    )


def _chart(solved: Sequence[CaseRecord], tolerance: float) -> Chart:
    """Changes from the largest window, over the size of the window."""
    *others, largest = solved
    sizes = [1 / size_of(record) for record in others]
    changes = [distance(record, largest) for record in others]
    lines = []
    for name in changes[0]:
        line = [(x, max(d[name], DRAWN)) for x, d in zip(sizes, changes, strict=True)]
        lines.append((page.label(name), () if all(y <= DRAWN for _, y in line) else line))
    bound = 2 * (ABOVE_TOLERANCE * tolerance,)
    return log_chart(
        "window_changes",
        "Changes with the window",
        "Distance of every window that holds the contact from the largest one, relative to the "
        f"value, for fields to Σp or Σµp; changes below {DRAWN:g} are drawn there, and quantities "
        "that change by less everywhere are left out.",
        "window over the scene's own",
        "relative change",
        [*point_curves(lines), curve("allowed", (sizes[0], sizes[-1]), bound, Look.BOUND)],
        height=2.2,
    )


def _level(record: Row) -> str:
    return str(record.parameters["level"])


def _error(record: Row) -> str:
    return record.words.get("error", "")


def _refused(ends: Sequence[CaseRecord]) -> Statement:
    """Too small a window is refused by name, as are all smaller ones."""
    refused = [record for record in ends if _error(record)]
    measured = "none of the windows was too small"
    if refused:
        measured = (
            f"{len(refused)} windows, up to {_level(refused[-1])}: {_error(refused[-1])}: "
            f"{refused[-1].words['message']}"
        )
    in_order = refused == list(ends[: len(refused)])
    right = in_order and {_error(record) for record in refused} == {REFUSED}
    return Statement(
        claim="a window that does not hold the contact is refused by name",
        outcome=judged(right, complete=bool(refused)),
        measured=measured,
        because=f"tractions that are cut off are no result: {REFUSED} is raised, for every window "
        "below the first that holds the contact",
    )
