"""All files of the stress below a contact, in one call."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from contact_results.directory.file_names import STRESS
from contact_results.directory.run_directory import files_at_once
from contact_results.files import surface_file
from contact_results.files.csv_file import write_meanings
from contact_results.files.surface_file import write_surface
from contact_results.natural_sizes import SI
from contact_results.stress.extremes import Extreme
from contact_results.stress.loaded_bodies import LoadedBodies
from contact_results.stress.points import StressField
from contact_results.stress.section_file import (
    POINT_ARRAYS,
    SECTION,
    SURFACE,
    VOLUME,
    write_points,
)
from contact_results.stress.tables import (
    AXIS,
    INTERFACES,
    LARGEST_COLUMNS,
    MAXIMA,
    MEANINGS,
    POINT_COLUMNS,
    SIDE_COLUMNS,
    write_axis,
    write_interfaces,
    write_maxima,
    write_stress_summary,
)
from contact_scene.accuracy_reached import AccuracyReached
from contact_scene.convention import CONVENTION, OF_THE_INDENTER
from contact_scene.stated_error import StatedError


def write_stress(
    state: LoadedBodies,
    which: str,
    field: StressField,
    found: Sequence[Extreme],
    directory: Path,
    *,
    with_figures: bool,
    normalised: bool = False,
    errors: Sequence[StatedError] | None = None,
    accuracy: AccuracyReached | None = None,
) -> None:
    """Write tables, their meanings, meshes, figures and summary of the `body` or the `indenter`,
    all or none.

    normalised  figures over the sizes of the contact; tables stay in SI
    errors      of what was found; None where they were left out
    accuracy    that was asked for and reached; None where none was asked for
    """
    with files_at_once(directory, STRESS, (VOLUME,)) as staging:
        _write_all(state, which, field, found, staging, errors, accuracy)
        if with_figures:
            from contact_results.figures.stress_plot import write_stress_figures

            title = f"{state.title or 'Stress'}: {which}, step {state.step}"
            body = state.indenter if which == "indenter" else state.body
            units = state.units if normalised else SI
            write_stress_figures(field, body, staging, title, units)


def _write_all(
    state: LoadedBodies,
    which: str,
    field: StressField,
    found: Sequence[Extreme],
    directory: Path,
    errors: Sequence[StatedError] | None,
    accuracy: AccuracyReached | None,
) -> None:
    of_indenter = which == "indenter"
    body = state.indenter if of_indenter else state.body
    convention = OF_THE_INDENTER if of_indenter else CONVENTION
    write_maxima(found, errors, directory)
    write_axis(field, body, directory)
    write_interfaces(field, body, directory)
    write_points(field.section.turned(field.direction), directory / SECTION, convention)
    files = {
        MAXIMA: LARGEST_COLUMNS,
        AXIS: POINT_COLUMNS,
        INTERFACES: SIDE_COLUMNS,
        SECTION: POINT_ARRAYS,
        SURFACE: surface_file.columns(state.tractions),
    }
    if field.volume is not None:
        write_points(field.volume.turned(field.direction), directory / VOLUME, convention)
        files[VOLUME] = POINT_ARRAYS
    sense = -1.0 if of_indenter else 1.0
    write_surface(state.surface, state.tractions, directory / SURFACE, convention, sense)
    write_meanings(directory / MEANINGS, files, convention)
    write_stress_summary(state, which, field, found, errors, accuracy, convention, directory)
