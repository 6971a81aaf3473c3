"""Writer of all files of a result: first the solved fields, then what is computed from them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from contact_results.cycles import fretting_cycles
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
from contact_results.key_numbers import SHOWN, cycle_columns
from contact_results.number_text import doubt_texts
from contact_results.omitted_parts import OmittedParts
from contact_results.radial_method import radial_advice
from contact_results.result_warnings import warnings_of
from contact_scene.quantities.stated_error import AccuracyReached, StatedErrors
from contact_scene.quantities.summary import RunSummary

if TYPE_CHECKING:
    from contact_results.cycles import FrettingCycle
    from contact_results.surface import Result

Figures = Literal["none", "overview", "all"]


@dataclass(frozen=True)
class WrittenResult:
    """Summary and texts of a written result.

    summary   summary as in `summary.json`, without warnings
    cycles    table of load cycles, see `cycle_columns`; empty without load cycles
    warnings  warnings about the result, as in `summary.json`
    """

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
    write_fields(result, directory, all_fields=all_fields)
    write_computed(result, directory, omitted, figures=figures, errors=errors)
    return omitted


def write_computed(
    result: Result,
    directory: Path,
    omitted: OmittedParts,
    *,
    figures: Figures,
    errors: StatedErrors | None,
    accuracy: AccuracyReached | None = None,
    by_inputs: Mapping[str, Sequence[str]] | None = None,
) -> WrittenResult:
    """Write the files of what is computed from the fields of a result: tables, figures, summary.

    The file of fields must exist already. A part that cannot be computed has no file; the summary
    lists it as a warning.

    omitted    record of the parts that cannot be computed
    figures    see `write_result`
    errors     stated errors; None if they were not computed
    accuracy   requested and reached accuracy; None if none was requested
    by_inputs  table of the uncertainty by inputs, as columns by heading; None without
    """
    warnings: tuple[str, ...] = omitted.compute("the warnings", lambda: warnings_of(result), ())
    none: tuple[FrettingCycle, ...] = ()
    cycles = omitted.compute("the load cycles", lambda: fretting_cycles(result), none)
    summary = omitted.compute(
        "the summary of load cycles and errors",
        lambda: summary_of(result, cycles, errors, accuracy),
        None,
    )
    if summary is None:
        cycles, errors = none, None
        summary = summary_of(result, cycles, errors, accuracy)
    if cycles:
        add_cycle_fields(result, cycles[-1], directory)
    stated = errors.steps if errors else None
    shown: dict[str, list[str]] = omitted.compute(
        "the table of load cycles",
        lambda: cycle_columns(cycles, stated, line=result.scene.indenter.is_line) if cycles else {},
        {},
    )
    omitted.write(
        "the tables",
        [directory / name for name in (PROFILES, INCREMENTS, CYCLES, COLUMNS)],
        lambda: write_tables(result, cycles, directory, stated),
    )
    if figures != "none":
        from contact_results.figures.figure_files import write_figures
        from contact_results.figures.run_page import write_page

        of_last, everything = stated[-1] if stated else None, figures == "all"
        omitted.write(
            "the figures",
            [directory / name for name in FIGURES],
            lambda: write_figures(result, cycles, directory, of_last, everything=everything),
        )
        told = warnings + omitted.warnings
        doubts = doubt_texts(stated or (), SHOWN)
        doubts += radial_advice(result.scene, result.solver, doubted=bool(doubts))
        omitted.write(
            "the page",
            [directory / PAGE],
            lambda: write_page(result, directory, of_last, shown, told, doubts, by_inputs),
        )
    warnings += omitted.warnings
    # The summary is last: it has the digest of the fields and the list of omitted parts.
    write_summary(summary, directory, warnings)
    return WrittenResult(summary, shown, warnings)
