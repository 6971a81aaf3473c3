"""Export of the surface at the end of every load step to ParaView, with a `.pvd` collection."""

from __future__ import annotations

from pathlib import Path

from contact_results.directory.run_directory import files_at_once
from contact_results.files.stored_run import StoredRun
from contact_results.files.stored_values import ends_of_steps
from contact_results.files.surface_file import POLAR, SCALARS, VECTORS, write_surface
from contact_results.surface import surface_on

COLLECTION = "surface.pvd"
NAMES = (*SCALARS, *VECTORS, *(f"{stem}_{part}" for stem in VECTORS for part in POLAR))


def write_paraview(run: StoredRun, directory: Path) -> None:
    """Write one file `surface_step_N.vtu` per load step, and `surface.pvd` with N as the time."""
    places = {name: values.array for name, values in run.coordinates.items()}
    surface, steps = surface_on(places, run.direction), run.increments["step"].array
    ends = ends_of_steps(steps)
    there = [name for name in NAMES if name in run.increments]
    entries = []
    with files_at_once(directory, COLLECTION, ()) as staging:
        for row in ends.tolist():
            step = int(steps[row])
            file = f"surface_step_{step}.vtu"
            fields = {name: run.increments.at(name, row) for name in there}
            write_surface(surface, fields, staging / file, run.convention)
            entries.append(f'<DataSet timestep="{step}" file="{file}"/>\n')
        (staging / COLLECTION).write_text(
            '<VTKFile type="Collection" version="0.1">\n<Collection>\n'
            f"{''.join(entries)}</Collection>\n</VTKFile>\n",
            encoding="ascii",
        )
