"""Writer of all files of a result in one call."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Literal

from contact_results.cycles import fretting_cycles
from contact_results.files.field_file import write_fields
from contact_results.files.summary_file import write_summary
from contact_results.files.tables import write_tables
from contact_results.key_numbers import cycle_columns
from contact_scene.quantities.stated_error import AccuracyReached, StatedErrors

if TYPE_CHECKING:
    from contact_results.surface import Result


def write_result(
    result: Result,
    directory: Path,
    *,
    figures: Literal["none", "overview", "all"] = "overview",
    errors: StatedErrors | None = None,
    accuracy: AccuracyReached | None = None,
    all_fields: bool = False,
) -> dict[str, list[str]]:
    """Write summary, fields, tables, figures and their HTML page into an empty directory.

    figures     "overview": one figure and the page; "all": all figures and the page; "none"
    errors      stated errors; None if they were not computed
    accuracy    requested and reached accuracy; None if none was requested
    all_fields  store the fields of all increments, not only of the last one of each load step

    Returns the table of load cycles, see `cycle_columns`; empty without load cycles.
    """
    cycles = fretting_cycles(result)
    stated = errors.steps if errors else None
    shown = cycle_columns(cycles, stated) if cycles else {}
    write_tables(result, cycles, directory, stated)
    write_fields(result, cycles, directory, all_fields=all_fields)
    write_summary(result, cycles, directory, errors, accuracy)
    if figures != "none":
        from contact_results.figures.figure_files import write_figures
        from contact_results.figures.run_page import write_page

        of_last = stated[-1] if stated else None
        write_figures(result, cycles, directory, of_last, everything=figures == "all")
        write_page(result, directory, of_last, shown)
    return shown
