"""Compute cases of the studies that take little time, and print their records.

A record consists of errors, which are differences of solves, of counted work and of words.
"""

from collections.abc import Sequence

import numpy as np

from verification.problems.drawn.families import drawn
from verification.running.study import Row, StudyCase
from verification.studies.coated_tractions import CELLS, RINGS, TractionRun
from verification.studies.error_coverage import CoverageCase, LimitedLevels, RequestCase
from verification.studies.seeded_defects import DefectRun
from verification.studies.stability.contacts import Solver, StabilityCell, Surface
from verification.studies.work_precision import Method, PrecisionCase

CASES: tuple[StudyCase, ...] = (
    PrecisionCase("hertz", Method.SURFACE, 16),
    PrecisionCase("hertz", Method.ELEMENTS, 8),
    PrecisionCase("cattaneo", Method.EDGES, 16),
    PrecisionCase("cattaneo", Method.RADIAL, 6),
    PrecisionCase("cattaneo", Method.PENALTY, 8, penalty=10.0),
    PrecisionCase("indentation", Method.RADIAL, 6),
    PrecisionCase("loop", Method.SURFACE, 16, tolerance=1e-4, increments=4),
    TractionRun(CELLS, 2.0, 16, 0.25),
    TractionRun(RINGS, 2.0, 0.25, 0.25),
    *(CoverageCase(family, 2, 0) for family in ("shapes", "tilted", "twisted", "elements")),
    *(RequestCase(2, number) for number in (1, 2)),
    *(StabilityCell(surface=surface, cells=16) for surface in Surface),
    *(StabilityCell(solver=solver, push=push) for solver in Solver for push in (0.6, 2.0)),
    DefectRun("coupling-0p99", "no_slip_indentation"),
    DefectRun("nan", "hertz_approach_control"),
)


def show_rows(rows: Sequence[Row]) -> None:
    """Print two sums of each measure over the rows of a record."""
    for name in rows[0].measures:
        values = np.array([row.measures[name] for row in rows], float)
        weights = np.sin(1 + 1.7 * np.arange(len(rows)))
        print("error of rows", name, len(rows), np.nansum(values), np.nansum(weights * values))


for case in CASES:
    record = case.compute()
    print("computed", case.name, *record.words.values(), *record.units.values())
    for name, value in record.measures.items():
        print("residual" if name == "observed" else "error", name, value)
    for name, count in record.counters.items():
        print(f"counted {name}: {count}")
    if record.parts:
        show_rows(record.parts)
        print(*[row.words[name] for row in record.parts for name in row.words if name != "reason"])

twisted = drawn("twisted", 2, 0).solver
run = twisted.run_fineness()
work = np.prod(run.space.cells) * sum(run.increments)
for most in (0.99 * work, 1.01 * work):
    print("beyond the limit:", LimitedLevels(twisted, most=most).beyond_limit(run))
