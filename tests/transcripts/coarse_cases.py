"""Print the errors of cases in solves on few cells, elements and rings, which are large.

These are the judged numbers of all cases of the full level, the numbers behind their orders of
convergence, and their charts.
"""

from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import replace
from typing import Any

import numpy as np

from contact_scene.solver_errors import SolverError
from semi_analytical.grid import SurfaceGrid
from verification.cases.catalogue import choose
from verification.judging.case import AnyRun, Case, Level, Run, SectionRun

FEWEST = 8  # cells, elements per radius and rings
INCREMENTS = 2  # of a load step
MAX_RUNS = 10  # that differ within a case
ROUND_OFF = 1e-6  # relative to the scale of an error
SLOW = ("radial_turning",)  # stresses on the whole circle, which take 35 s


def few(count: int) -> int:
    """A small even number that grows with the given number."""
    return min(count, max(FEWEST, 2 * round(count**0.5 / 2)))


def coarse(run: AnyRun) -> AnyRun:
    """The same problem with few cells, elements or rings, and increments."""
    steps = [
        step.model_copy(update={"increments": min(INCREMENTS, step.increments)})
        if step.increments
        else step
        for step in run.scene.loading
    ]
    run = replace(run, scene=run.scene.model_copy(update={"loading": tuple(steps)}))
    if isinstance(run, Run):
        cells = few(run.grid.cells[0]), few(run.grid.cells[1])
        return replace(run, grid=SurfaceGrid(cells, run.grid.window))
    if isinstance(run, SectionRun):
        mesh = run.discretisation.model_copy(update={"elements_per_radius": few(run.count)})
        return replace(run, discretisation=mesh)
    return replace(run, rings=few(run.rings), fineness=1)


def solved(case: Case) -> dict[str, Any]:
    """Results of the coarse runs by label; runs that become equal are solved once."""
    known: dict[str, Any] = {}
    results = {}
    for run in case.runs:
        made = coarse(run)
        key = repr(replace(made, label="", problem=""))
        if key not in known and len(known) < MAX_RUNS:
            try:
                known[key] = made.solve()
            except SolverError as refused:
                print("refused", case.name, type(refused).__name__)
                known[key] = None
        if known.get(key):
            results[run.label] = known[key]
    return results


def errors(case: Case, results: Mapping[str, Any]) -> Iterator[float]:
    """Errors of the judged numbers over their scales, and those behind orders of convergence."""
    for one in case.quantities:
        if all(label in results for label in one.labels):
            found = one.measure(*(results[label] for label in one.labels))
            known = one.reference.value
            yield (found - known) / (one.scale or abs(known))
    for order in case.orders:
        levels = [results[label] for label in order.levels if label in results]
        for pair in zip(levels, levels[order.apart :], strict=False):
            yield order.error(*pair) if order.apart else order.error(pair[0])


def drawn(case: Case, results: Mapping[str, Any]) -> Iterator[float]:
    """Sums of the curves of a chart; none if it needs a result that is lacking."""
    with suppress(KeyError):
        for chart in case.charts(results) if case.charts else ():
            for curve in (one for row in chart.rows for panel in row for one in panel.curves):
                weights = np.sin(1 + 1.7 * np.arange(len(curve.y)))
                yield from (float(weights @ curve.x), float(weights @ curve.y))


def show(title: str, numbers: Iterator[float]) -> None:
    found = np.array(list(numbers))
    found = np.where(np.abs(found) > ROUND_OFF, found, 0.0)
    for start in range(0, len(found), 50):
        print("judged on few", title, *found[start : start + 50].tolist())


for case in choose(Level.FULL):
    if case.runs and case.name not in SLOW:
        results = solved(case)
        show(case.name, errors(case, results))
        show(f"{case.name} drawn", drawn(case, results))
