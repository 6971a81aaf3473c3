"""Writers of all files of the stress below a contact, and of its history at chosen points."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from contact_results.directory.file_names import STRESS, STRESS_PAGE
from contact_results.directory.run_directory import files_at_once
from contact_results.files.csv_file import STEP, Column, write_meanings, write_table
from contact_results.stress.files import INVARIANTS, PLACE, VOLUME, write_files
from contact_results.stress.loaded_bodies import LoadedBodies
from contact_results.stress.points import COMPONENTS, StressField, StressIncrement
from contact_results.stress.stress_maxima import Extreme, maxima_columns
from contact_scene import Body
from contact_scene.quantities.stated_error import AccuracyReached, StatedError

TABLE = "stress_history.csv"
MEANINGS = "stress_history_columns.csv"
FIGURE = "stress_history.png"
COLUMNS = (
    Column("point", None, "Number of the point, in the order of the options."),
    *PLACE,
    Column("material", None, "layer 1 is the outermost; base is below all layers."),
    STEP,
    Column("increment", None, "Increment within the step, from 1."),
    *(Column(f"sigma_{k}", "Pa", "Component of stress, tension positive.") for k in COMPONENTS),
    Column(
        "error", "Pa", "Error of every component by cells or rings, without that of increments."
    ),
    *INVARIANTS,
)


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
    doubts: Sequence[str] = (),
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
    doubts        lines below the table of the page, about errors that have not converged
    """
    with files_at_once(directory, STRESS, (VOLUME, STRESS_PAGE)) as staging:
        write_files(state, which, field, found, staging, errors, accuracy)
        if with_figures:
            from contact_results.figures.run_page import write_stress_page
            from contact_results.figures.stress_plot import write_stress_figures

            title = f"{state.title or 'Stress'}: {which}, step {state.step}"
            names = write_stress_figures(field, staging, title)
            write_stress_page(maxima_columns(found, errors), title, names, staging, doubts)


def write_history(
    history: Sequence[StressIncrement],
    body: Body,
    directory: Path,
    convention: str,
    title: str,
    *,
    with_figures: bool,
) -> None:
    """Write the table and the figure of the stress at chosen points over all increments.

    The files replace earlier ones atomically; without a figure, an earlier one is removed.

    history       stress at the points at the end of each increment
    body          lower body or indenter, which contains the points
    directory     output directory
    convention    text about axes and signs, for the table of columns
    title         title of the figure
    with_figures  false to write no figure
    """
    layers, count = len(body.layers), len(history[0].errors)
    rows = (
        (
            n + 1,
            *(float(field[n]) for field in (p.x, p.y, p.depth)),
            p.material_name(n, layers),
            each.step,
            each.index,
            *p.stress[:, n].tolist(),
            None if np.isnan(each.errors[n]) else float(each.errors[n]),
            *(float(field[n]) for field in (p.von_mises, *p.principal)),
        )
        for n in range(count)
        for each in history
        for p in [each.points]
    )
    with files_at_once(directory, TABLE, (FIGURE,)) as staging:
        write_table(staging / TABLE, COLUMNS, rows)
        write_meanings(staging / MEANINGS, {TABLE: COLUMNS}, convention)
        if with_figures:
            from contact_results.figures.stress_plot import write_history_figure

            write_history_figure(history, layers, staging / FIGURE, title)
