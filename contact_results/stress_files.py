"""Writer of all files of the stress below a contact."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from contact_results.directory.file_names import STRESS
from contact_results.directory.run_directory import files_at_once
from contact_results.stress.files import VOLUME, write_files
from contact_results.stress.loaded_bodies import LoadedBodies
from contact_results.stress.points import StressField
from contact_results.stress.stress_maxima import Extreme
from contact_scene.quantities.stated_error import AccuracyReached, StatedError


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
    """Write tables, their meanings, meshes, figures and summary atomically.

    which     "body" or "indenter"
    found     largest stresses
    errors    stated errors of `found`; None if they were left out
    accuracy  requested and reached accuracy; None if none was requested
    """
    with files_at_once(directory, STRESS, (VOLUME,)) as staging:
        write_files(state, which, field, found, staging, errors, accuracy)
        if with_figures:
            from contact_results.figures.stress_plot import write_stress_figures

            title = f"{state.title or 'Stress'}: {which}, step {state.step}"
            body = state.indenter if which == "indenter" else state.body
            write_stress_figures(field, body, staging, title)
