"""Print the errors of cases in solves on few cells, elements and rings, which are large.

python coarse_cases.py        all cases of the full level: judged numbers, numbers behind orders
                              of convergence, and charts
python coarse_cases.py PLANTED    a case under each defect that is planted to test the verdicts
"""

import sys
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import replace
from typing import Any

import numpy as np

from contact_scene.solver_errors import SolverError
from semi_analytical.grid import SurfaceGrid
from verification.cases.catalogue import choose
from verification.defects.defect import Defect, planted
from verification.defects.registry import DEFECTS
from verification.judging.case import AnyRun, Case, Level, Run, SectionRun
from verification.observed.observed_laws import observed

FEWEST = 8  # cells, elements per radius and rings
MAX_RUNS = 10  # that differ within a case
ROUND_OFF = 1e-6  # relative to the scale of an error
LARGEST = 1e9  # some scales vanish with a defect
SLOW = ("radial_turning",)  # stresses on the whole circle, which take 35 s
# Cases of defects that `computed.py` judges, or whose answer depends on no solve.
JUDGED = "hertz_unloading no_slip_indentation tilted_punch dissimilar_bodies hertz_approach_control"


def few(count: int) -> int:
    """A small even number that grows with the given number."""
    return min(count, max(FEWEST, 2 * round(count**0.5 / 2)))


def coarse(run: AnyRun) -> AnyRun:
    """The same problem with few cells, elements or rings, and increments."""
    steps = [
        step.model_copy(update={"increments": max(2, round(step.increments ** (1 / 3)))})
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


def solved(case: Case, most: int = MAX_RUNS) -> dict[str, Any]:
    """Results of the coarse runs by label; runs that become equal are solved once."""
    known: dict[str, Any] = {}
    results = {}
    for run in case.runs:
        made = coarse(run)
        key = repr(replace(made, label="", problem=""))
        if key not in known and len(known) < most:
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
    found = np.where(np.abs(found) > ROUND_OFF, np.clip(found, -LARGEST, LARGEST), 0.0)
    for start in range(0, len(found), 50):
        print("judged on few", title, *found[start : start + 50].tolist())


def show_with_defect(defect: Defect, case: Case) -> None:
    """Print violations of laws and errors in the first solve of a case with a defect."""
    with planted(defect):
        try:
            results = solved(case, 1)
            laws = [size for one in results.values() for size in observed(one)[:2]]
            show(f"{defect.name} {case.name}", iter([*laws, *errors(case, results)]))
        except (ArithmeticError, LookupError, ValueError) as failed:
            print(defect.name, case.name, type(failed).__name__)


if sys.argv[1:]:
    cases = {case.name: case for case in choose(Level.QUICK)}
    for defect in DEFECTS.values():
        if not {*defect.cases} & {*JUDGED.split()} and cases[defect.cases[0]].runs:
            show_with_defect(defect, cases[defect.cases[0]])
else:
    for case in choose(Level.FULL):
        if case.runs and case.name not in SLOW:
            results = solved(case)
            show(case.name, errors(case, results))
            show(f"{case.name} drawn", drawn(case, results))
