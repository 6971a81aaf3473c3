"""Command `slipstick sweep`: solve a scene for every combination of values of its keys."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from itertools import product
from math import isnan
from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from contact_results.directory.atomic_file import atomic_file
from contact_results.directory.run_lock import in_sole_use
from contact_results.number_text import Uncertainty, number_text
from contact_results.radial_method import radial_method
from contact_results.solvers import SolverName
from contact_scene import read_scene_file
from contact_scene.quantities.per_length import ATTRIBUTES, SHOWN_NAMES
from contact_scene.solver_errors import SolverError
from slipstick.cli.errors import ExitCode
from slipstick.cli.expect_option import ExpectOption, SaveExpectedOption, read_expectation
from slipstick.cli.options import (
    OutputOption,
    SceneArgument,
    SchedulerOption,
    SetOption,
    SolverOption,
    refuse_unknown,
    workers_at,
)
from slipstick.cli.progress import outcome_text, run_with_progress
from slipstick.cli.terminal import print_message, print_pairs, print_table
from slipstick.cli.time_estimate import estimated_time
from slipstick.expected import Source, scene_keys, sweep_numbers
from slipstick.sweep import SweepError, Variation, quantities, sweep_points
from slipstick.sweep_chart import (
    MAX_KEYS,
    PERCENTILES,
    SweptQuantity,
    write_sweep_chart,
)
from verification.running.case_pool import CaseStore
from verification.running.study import ROWS, CaseRecord, row_files

TABLE = "sweep.csv"
CHART = "sweep.png"
CASES = "points"
# Number of points from which a trial solve takes less than a tenth of the sweep.
LONG_SWEEP = 10


def sweep(
    scene: SceneArgument,
    output: OutputOption,
    vary: Annotated[
        list[str],
        typer.Option(
            "--vary",
            metavar="KEY=VALUES",
            help="Spaced values a..b [unit] [log] N, such as indenter.radius=9..18 mm log 4, "
            "or a sample normal(mean,deviation) [unit] N. The option may be repeated.",
        ),
    ],
    get: Annotated[
        str,
        typer.Option(
            "--get",
            metavar="NAME,...",
            help="Scalars of summary.json at the end of the last step, vectors by component, or "
            "largest stresses MEASURE@REGION: max_principal@body, interface_shear@1.",
        ),
    ] = "peak_pressure",
    overrides: SetOption = None,
    solver: SolverOption = SolverName.SEMI_ANALYTICAL,
    error: Annotated[
        bool,
        typer.Option(
            "--error/--no-error", help="State an error for every number, or omit the errors."
        ),
    ] = True,
    workers: Annotated[
        int, typer.Option("--workers", metavar="N", min=1, help="Processes at a time.")
    ] = 2,
    scheduler: SchedulerOption = None,
    save_expected: SaveExpectedOption = None,
    expect: ExpectOption = None,
) -> None:
    """Solve a scene for every combination of values of its keys; write a table and a chart.

    DIR receives sweep.csv, with numbers, errors and scene of every point, and sweep.png. Every
    finished point is stored in DIR/points: after the command was killed, the same command computes
    the missing points. Exit code 3 if a point has no result; with --expect, 7 if a number is worse
    than expected.
    """
    try:
        variations = [Variation.of(text) for text in vary]
        names = tuple(name.strip() for name in get.split(","))
        made = sweep_points(
            scene, overrides or (), variations, names, solver.value, with_error=error
        )
    except SweepError as refused:
        raise typer.BadParameter(str(refused)) from None
    valid = next(point for point in made if not point.invalid)
    contents = read_scene_file(scene, valid.overrides)
    first = contents.scene
    listing = "slipstick maintain schema summary"
    line = first.indenter.is_line
    known = quantities(first.body, line=line)
    refuse_unknown("quantity", names, known, listing, SHOWN_NAMES if line else ATTRIBUTES)
    expectation = read_expectation(
        expect,
        save_expected,
        lambda: Source("sweep", scene_keys(first), solver.value),
        error=error,
    )
    described = [("points", str(len(made))), ("solver", solver.value)]
    if len(made) >= LONG_SWEEP:
        with suppress(SolverError):  # which the points report
            text = estimated_time(solver.solver.of_file(contents))
            stresses = ", without that of the stresses" if any("@" in one for one in names) else ""
            described.append(("time", f"for each point {text}{stresses}"))
    if solver is not SolverName.RADIAL and (how := radial_method(first)):
        described.append(("radial", f"--solver radial can solve this: {how}"))
    print_pairs(described)
    output.mkdir(parents=True, exist_ok=True)
    with in_sole_use(output):
        store, cases = CaseStore(output / CASES), {point.name: point for point in made}
        pool = workers_at(scheduler, workers)
        ends = run_with_progress(tuple(cases.values()), store, pool, outcome_text)
        found = {end.case.name: end.record for end in ends if isinstance(end.record, CaseRecord)}
        lost = {
            end.lost.name: cases[end.lost.name].record(end.lost.reason) for end in ends if end.lost
        }
        records = [(found | lost)[point.name] for point in made]
        title = first.title or scene.name
        _write_table_and_chart(records, variations, names, output, title)
    typer.echo(f"results in {output}")
    worse = 0
    if expectation is not None:
        places = (" ".join(point.overrides[-len(variations) :]) for point in made)
        worse = expectation.settle(sweep_numbers(zip(places, records, strict=True), names))
    if missing := sum(bool(record.words["refused"]) for record in records):
        print_message(
            f"{missing} of {len(records)} points have no result; see the column refused of {TABLE}"
        )
        raise typer.Exit(ExitCode.NOT_CONVERGED)
    if worse:
        raise typer.Exit(worse)


def _write_table_and_chart(
    records: Sequence[CaseRecord],
    variations: Sequence[Variation],
    names: Sequence[str],
    directory: Path,
    title: str,
) -> None:
    """Write table and chart of a parameter sweep, and print percentiles of distributed keys.

    records     solved points of the sweep
    variations  varied keys
    names       requested quantities
    """
    with atomic_file(directory / TABLE) as path:
        numbered = {str(number): record for number, record in enumerate(records, 1)}
        path.write_text(row_files(numbered)[ROWS], encoding="utf-8")
    spaced = [each for each in variations if not each.is_sample]
    shape = (*(len(each.values) for each in spaced), -1)
    swept = []
    for name in names:
        values, errors = (
            np.array([record.measures.get(column) for record in records], dtype=float)
            for column in (name, f"{name} error")
        )
        unit = next((record.units[name] for record in records if record.units), "")
        swept.append(SweptQuantity(name, unit, values.reshape(shape), errors.reshape(shape)))
    if len(spaced) < len(variations):
        _print_percentiles(spaced, swept)
    if len(spaced) > MAX_KEYS:
        print_message(
            f"no chart: got {len(spaced)} spaced keys, expected at most {MAX_KEYS}; see {TABLE}"
        )
    else:
        write_sweep_chart(spaced, swept, directory / CHART, title)


def _print_percentiles(spaced: Sequence[Variation], swept: Sequence[SweptQuantity]) -> None:
    """Print a table of percentiles of quantities, for keys with a normal distribution.

    The table has a row for every quantity at every combination of the spaced keys.
    """
    heads = [*(each.label for each in spaced), "quantity", *(f"{p:g} %" for p in PERCENTILES)]
    rows = []
    for each in swept:
        flat = each.percentiles.reshape(3, len(PERCENTILES), -1)
        for n, at in enumerate(product(*(key.values for key in spaced))):
            texts = [
                number_text(
                    value,
                    Uncertainty(None if isnan(high) else max(value - low, high - value), True),
                    1.0,
                )
                for value, low, high in flat[:, :, n].T.tolist()
            ]
            rows.append([*(f"{v:.6g}" for v in at), each.suited.labelled(each.name), *texts])
    print_table(heads, rows)
