"""All files of the stress below a contact, in one call."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from contact_results.stress.extremes import Extreme
from contact_results.stress.loaded_bodies import LoadedBodies
from contact_results.stress.mesh_file import SECTION, VOLUME, write_mesh
from contact_results.stress.points import StressField
from contact_results.stress.tables import (
    SUMMARY,
    write_axis,
    write_interfaces,
    write_maxima,
    write_stress_summary,
)
from contact_scene.accuracy_reached import AccuracyReached
from contact_scene.stated_error import StatedError


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
    """Write tables, meshes, figures and summary of the `body` or the `indenter`.

    errors    of what was found; None where they were left out
    accuracy  that was asked for and reached; None where none was asked for
    """
    body = state.indenter if which == "indenter" else state.body
    # Last to come and first to go: a directory with a summary is complete.
    (directory / SUMMARY).unlink(missing_ok=True)
    write_maxima(found, errors, directory)
    write_axis(field, body, directory)
    write_interfaces(field, body, directory)
    write_mesh(field.section, directory / SECTION)
    if field.volume is not None:
        write_mesh(field.volume, directory / VOLUME)
    if with_figures:
        from contact_results.figures.stress_plot import write_stress_figures

        title = f"{state.title or 'Stress'}: {which}, step {state.step}"
        write_stress_figures(field, body, directory, title)
    write_stress_summary(state, which, field, found, errors, accuracy, directory)
