"""Measure the fraction of stated errors that cover, for several factors of the spread.

Usage: python docs/spread_factor.py SEED FAMILY...

The families are those of `slipstick maintain study error-coverage`. Stresses are left out, because
their errors have another number of coarse solves. The rows give the covered fraction and the
fraction of errors below ten times the true error, with two and with three coarse solves.
"""

import sys
from collections.abc import Iterator
from dataclasses import replace
from unittest.mock import patch

from contact_errors.coarse_solves import compare_with_coarse_solves
from contact_errors.error_formula import SolvedRun
from contact_results.solvers import solver_of
from verification.problems.drawn.drawing import STRESSES, KnownScene
from verification.problems.drawn.families import FAMILIES, drawn
from verification.running.study import Row
from verification.studies.error_coverage import Coverage, coverage_row

FACTORS = 2.0, 2.4, 2.8, 3.0, 3.5


def solved_scenes(seed: int, families: list[str]) -> Iterator[tuple[KnownScene, SolvedRun]]:
    """Solve the scenes of families with their coarse solves."""
    for family in families:
        for number in range(FAMILIES[family].count):
            known = drawn(family, seed, number)
            result = known.solver.run()
            yield known, compare_with_coarse_solves(solver_of(result), result)[0]


def error_rows(known: KnownScene, run: SolvedRun, solves: int) -> Iterator[Row]:
    """Yield true and stated error of each known number, by the last coarse solves of the cells."""
    of_cells = [one for one in run.comparisons if one.part == "cells"][-solves:]
    others = [one for one in run.comparisons if one.part != "cells"]
    errors = list(replace(run, comparisons=[*others, *of_cells]).errors())
    for truth in known.truths:
        value = None if truth.quantity in STRESSES else truth.read(run.values)
        if value is not None:
            yield coverage_row(truth, value, errors[truth.step - 1].get(truth.quantity))


if __name__ == "__main__":
    scenes = [*solved_scenes(int(sys.argv[1]), sys.argv[2:])]
    for solves in (2, 3):
        for factor in FACTORS:
            with patch("contact_errors.error_formula.SPREADS", factor):
                rows = [row for known, run in scenes for row in error_rows(known, run, solves)]
            found = Coverage.of("all", rows)
            print(solves, f"{factor:.1f}", found.covered.text, found.tight.text, found.covered.of)
