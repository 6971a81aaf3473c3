"""Writer of all files of a result: first the solved fields, then what is computed from them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from contact_results.directory.file_names import (
    COLUMNS,
    CYCLES,
    FIGURES,
    INCREMENTS,
    PAGE,
    PROFILES,
)
from contact_results.files.field_file import add_cycle_fields, write_fields
from contact_results.files.summary_file import summary_of, write_summary
from contact_results.files.tables import write_tables
from contact_results.key_numbers import cycle_columns
from contact_results.omitted_parts import OmittedParts
from contact_results.result_report import ResultReport
from contact_results.result_warnings import warnings_of
from contact_scene.quantities.stated_error import StatedErrors
from contact_scene.quantities.summary import RunSummary

if TYPE_CHECKING:
    from contact_results.surface import Result

Figures = Literal["none", "overview", "all"]


@dataclass(frozen=True)
class WrittenResult:
    """Report, summary and texts of a written result.

    report    the result with the cycles and the errors that were written
    summary   summary as in `summary.json`, without warnings
    cycles    table of load cycles, see `cycle_columns`; empty without load cycles
    warnings  warnings about the result, as in `summary.json`
    """

    report: ResultReport
    summary: RunSummary
    cycles: dict[str, list[str]]
    warnings: tuple[str, ...]


def write_result(
    result: Result,
    directory: Path,
    *,
    figures: Figures = "overview",
    errors: StatedErrors | None = None,
    all_fields: bool = False,
) -> OmittedParts:
    """Write all files of a result into an empty directory; return the parts without a file.

    figures     "overview": one figure and the page; "all": all figures and the page; "none"
    errors      stated errors; None if they were not computed
    all_fields  store the fields of all increments, not only of the last one of each load step
    """
    omitted = OmittedParts()
    report = ResultReport.of(result, errors)
    write_fields(report, directory, all_fields=all_fields)
    write_computed(report, directory, omitted, figures=figures)
    return omitted


def write_computed(
    report: ResultReport, directory: Path, omitted: OmittedParts, *, figures: Figures
) -> WrittenResult:
    """Write the files of what is computed from the fields of a result: tables, figures, summary.

    The file of fields must exist already. A part that cannot be computed has no file; the summary
    lists it as a warning.

    report   result without load cycles, which are computed first
    omitted  record of the parts that cannot be computed
    figures  see `write_result`
    """
    warnings: tuple[str, ...] = omitted.compute(
        "the warnings", partial(warnings_of, report.result), ()
    )
    report = omitted.compute("the load cycles", report.with_cycles, report)
    part = "the summary of load cycles and errors"
    summary = omitted.compute(part, partial(summary_of, report), None)
    if summary is None:
        report = replace(report, cycles=(), errors=None)
        summary = summary_of(report)
    if report.cycles:
        add_cycle_fields(report, directory)
    cycles: dict[str, list[str]] = omitted.compute(
        "the table of load cycles", partial(cycle_columns, report), {}
    )
    omitted.write(
        "the tables",
        [directory / name for name in (PROFILES, INCREMENTS, CYCLES, COLUMNS)],
        partial(write_tables, report, directory),
    )
    if figures != "none":
        from contact_results.figures.figure_files import write_figures
        from contact_results.figures.run_page import write_page

        omitted.write(
            "the figures",
            [directory / name for name in FIGURES],
            partial(write_figures, report, directory, everything=figures == "all"),
        )
        told = warnings + omitted.warnings
        omitted.write(
            "the page", [directory / PAGE], partial(write_page, report, directory, cycles, told)
        )
    warnings += omitted.warnings
    # The summary is last: it has the digest of the fields and the list of omitted parts.
    write_summary(summary, directory, warnings, line=report.scene.indenter.is_line)
    return WrittenResult(report, summary, cycles, warnings)
