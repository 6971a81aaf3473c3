"""Writers of all files of a result, or of the stress below a contact, in one call."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from contact_results.cycles import fretting_cycles
from contact_results.directory.file_names import STRESS, STRESS_PAGE
from contact_results.directory.run_directory import files_at_once
from contact_results.files.field_file import write_fields
from contact_results.files.summary_file import write_summary
from contact_results.files.tables import write_tables
from contact_results.key_numbers import cycle_columns
from contact_scene.quantities.stated_error import AccuracyReached, StatedError, StatedErrors

if TYPE_CHECKING:
    from contact_results.stress.loaded_bodies import LoadedBodies
    from contact_results.stress.points import StressField
    from contact_results.stress.stress_maxima import Extreme
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


def write_stress(
    state: LoadedBodies,
    which: str,
    field: StressField,
    found: Sequence[Extreme],
    directory: Path,
    *,
    with_figures: bool,
    errors: Sequence[StatedError] | None = None,
    accuracy: AccuracyReached | None = None,
) -> None:
    """Write all files of the stress below a contact.

    These are tables, column descriptions, meshes, figures, HTML page and summary. The files replace
    earlier ones atomically.

    state         bodies and tractions that cause the stress
    which         "body" for the lower body, or "indenter"
    field         computed stress
    found         largest stresses
    directory     output directory
    with_figures  also write figures and page
    errors        stated errors of `found`; None if they were not computed
    accuracy      requested and reached accuracy; None if none was requested
    """
    from contact_results.stress.files import VOLUME, write_files
    from contact_results.stress.stress_maxima import maxima_columns

    with files_at_once(directory, STRESS, (VOLUME, STRESS_PAGE)) as staging:
        write_files(state, which, field, found, staging, errors, accuracy)
        if with_figures:
            from contact_results.figures.run_page import write_stress_page
            from contact_results.figures.stress_plot import write_stress_figures

            title = f"{state.title or 'Stress'}: {which}, step {state.step}"
            body = state.indenter if which == "indenter" else state.body
            names = write_stress_figures(field, body, staging, title)
            write_stress_page(maxima_columns(found, errors), title, names, staging)
