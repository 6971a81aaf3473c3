"""The window of the surface grid: the convolution is not periodic, so its size must not matter."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from contact_scene.description import Description
from contact_scene.solver_errors import SolverError
from fem_reference import Method
from semi_analytical import ContactAtWindowEdge, SurfaceGrid
from verification.convergence.level_record import LevelRecord
from verification.exhibits.chart import Chart, Look, Panel, curve
from verification.exhibits.numbers import plain
from verification.exhibits.table import Table
from verification.judging.outcome import Status
from verification.running.study import Conclusion, Records, Settings, Statement, Study
from verification.studies.refinement import page
from verification.studies.refinement.fit import ABOVE_TOLERANCE, distance
from verification.studies.refinement.refinement import count_of
from verification.studies.refinement.studied_scene import StudiedScene
from verification.studies.refinement.surface_level import (
    SurfaceLevel,
    SurfaceStart,
    refuse_fixed_window,
)

GROWTH = 0.25  # by so much of the scene's own the window grows from level to level
SMALLER = (0.25, 0.4, 0.55, 0.7, 0.85)  # of the scene's own: which of them hold the contact is seen
DRAWN = 1e-12
REFUSED = ContactAtWindowEdge.__name__
LIMITS = (
    "The cells about the centre are the same in every window; a larger one has more around them. "
    "Coefficients are exact at any distance, and the convolution is padded to twice the window: "
    "nothing repeats itself.",
    "Fields are compared on the scene's own window. What is compared goes through the solver's "
    f"tolerance, so changes of up to {ABOVE_TOLERANCE:g} tolerances are its own.",
)


class WindowRecord(Description):
    """How the solve on one window ended."""

    found: LevelRecord | None
    error: str
    """The kind of error that refused it, empty if none did."""

    message: str

    @property
    def seconds(self) -> float:
        """CPU time."""
        return 0.0 if self.found is None else self.found.seconds


@dataclass(frozen=True)
class Window:
    """The scene on one window."""

    record_type: ClassVar[type[Description]] = WindowRecord
    solved: SurfaceLevel

    @property
    def name(self) -> str:
        return f"window-{self.solved.name}"

    def compute(self) -> WindowRecord:
        """Solve, or say by what that was refused."""
        try:
            return WindowRecord(found=self.solved.compute(), error="", message="")
        except SolverError as error:
            return WindowRecord(found=None, error=type(error).__name__, message=str(error))


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
        own = SurfaceGrid(start.cells(settings), start.grid.window)
        larger = (1 + GROWTH * number for number in range(count_of(settings)))
        grids = [_about_the_centre(own, factor) for factor in (*SMALLER, *larger)]
        return tuple(
            Window(start.level(grid, own.cells[0] / grid.cells[0], _words(grid), kept=own.cells))
            for grid in grids
        )

    def ends(settings: Settings, records: Records) -> list[tuple[str, WindowRecord]]:
        """Smallest window first."""
        known = [(case.solved.level, records.get(case.name)) for case in cases(settings)]
        return [(words, record) for words, record in known if isinstance(record, WindowRecord)]

    def conclude(settings: Settings, records: Records) -> Conclusion:
        known = ends(settings, records)
        solved = [record.found for _, record in known if record.found is not None]
        statements = [_refused(known)]
        if len(solved) > 1:
            statements = [_unchanged(solved, start.tolerance), *statements]
        tables = [_refusals(known)]
        if not solved:
            return Conclusion(statements=tuple(statements), tables=tuple(tables), remarks=LIMITS)
        return Conclusion(
            statements=(*statements, page.converged(solved, start.tolerance)),
            tables=(page.level_table(solved, tuple(solved[-1].values)), *tables),
            charts=(_chart(solved, start.tolerance),) if len(solved) > 2 else (),
            remarks=LIMITS,
        )

    def exports(settings: Settings, records: Records) -> dict[str, str]:
        solved = [end.found for _, end in ends(settings, records) if end.found is not None]
        return {"levels.csv": page.level_csv(solved)} if solved else {}

    return Study(
        "window",
        f"Window of {scene.title}",
        f"Does the result at the end of step {scene.step} depend on the window? It is made larger "
        "and smaller around the same cells, down to some that do not hold the contact.",
        cases,
        conclude,
        exports,
    )


def _about_the_centre(grid: SurfaceGrid, factor: float) -> SurfaceGrid:
    """So many times as large, by whole pairs of cells: those that stay do not move."""
    nx, ny = (cells + 2 * round(cells * (factor - 1) / 2) for cells in grid.cells)
    dx, dy = grid.spacing
    return SurfaceGrid((nx, ny), (nx * dx, ny * dy))


def _words(grid: SurfaceGrid) -> str:
    sides = " x ".join(f"{1e3 * side:.4g}" for side in grid.window)
    return "{} x {} cells, {} mm".format(*grid.cells, sides)


def _unchanged(solved: Sequence[LevelRecord], tolerance: float) -> Statement:
    *others, largest = solved
    changes = [(d, name) for other in others for name, d in distance(other, largest).items()]
    worst, name = max(changes)
    return Statement(
        claim="a window that holds the contact does not matter",
        outcome=Status.PASS if worst <= ABOVE_TOLERANCE * tolerance else Status.FAIL,
        measured=f"largest change {plain(worst, 2)}, of the {page.label(name)}, "
        f"over {len(solved)} windows",
        because=f"allowed {ABOVE_TOLERANCE:g} tolerances of {tolerance:g}: the convolution is not "
        "periodic",
    )


def _chart(solved: Sequence[LevelRecord], tolerance: float) -> Chart:
    """Changes from the largest window, over the size of the window."""
    *others, largest = solved
    sizes = [1 / record.size for record in others]
    changes = [distance(record, largest) for record in others]
    curves = [
        curve(page.label(name), sizes, [max(d[name], DRAWN) for d in changes], Look.POINTS, series)
        for series, name in enumerate(changes[0])
        if any(d[name] > DRAWN for d in changes)
    ]
    bound = 2 * (ABOVE_TOLERANCE * tolerance,)
    panel = Panel(
        x_label="window over the scene's own",
        y_label="relative change",
        curves=(*curves, curve("allowed", (sizes[0], sizes[-1]), bound, Look.BOUND)),
        logarithmic=True,
        height=2.2,
    )
    return Chart(
        name="window_changes",
        title="Changes with the window",
        caption="Distance of every window that holds the contact from the largest one, relative to "
        f"the value, for fields to Σp or Σµp; changes below {DRAWN:g} are drawn there, and "
        "quantities that change by less everywhere are left out.",
        rows=((panel,),),
    )


def _refusals(ends: Sequence[tuple[str, WindowRecord]]) -> Table:
    return Table(
        title="Windows that do not hold the contact",
        columns=("window", "error"),
        rows=tuple((words, end.error) for words, end in ends if end.error),
    )


def _refused(ends: Sequence[tuple[str, WindowRecord]]) -> Statement:
    """Too small a window is refused by name, as are all smaller ones."""
    errors = [record.error for _, record in ends if record.error]
    first = [bool(record.error) for _, record in ends]
    largest = next(((words, r) for words, r in reversed(ends) if r.error), None)
    in_order = first == sorted(first, reverse=True)
    if largest is None:
        outcome, measured = Status.INCONCLUSIVE, "none of the windows was too small"
    else:
        words, record = largest
        right = in_order and set(errors) == {REFUSED}
        outcome = Status.PASS if right else Status.FAIL
        measured = f"{len(errors)} windows, up to {words}: {record.error}: {record.message}"
    return Statement(
        claim="a window that does not hold the contact is refused by name",
        outcome=outcome,
        measured=measured,
        because=f"tractions that are cut off are no result: {REFUSED} is raised, for every window "
        "below the first that holds the contact",
    )
