"""Writer of `result.h5`: scalars of all increments, fields at the ends of load steps."""

from __future__ import annotations

import io
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import h5py
import numpy as np

from contact_results.directory.file_names import FIELDS
from contact_results.files.stored_values import MAPS, STEP
from contact_results.result_report import ResultReport
from contact_results.surface import Rings
from contact_scene.normal_form import with_bodies_of
from contact_scene.quantities.field_metadata import (
    CONVENTION,
    Kind,
    Reported,
    reported,
)
from contact_scene.quantities.increment import (
    SCALARS,
    columns,
    components,
)
from contact_scene.quantities.per_length import shown_mark, shown_name

if TYPE_CHECKING:
    from contact_results.cycles import FrettingCycle
    from contact_results.surface import Increment, Surface
    from contact_scene import Scene

# On these fields, level 1 with shuffled bytes takes at most 10 % more space than level 9.
COMPRESSION: dict[str, Any] = {"compression": "gzip", "compression_opts": 1, "shuffle": True}

AXES = {
    "x": ("m", "cell centres along x"),
    "y": ("m", "cell centres along y"),
    "radii": ("m", "radii of the rings"),
    "distances": ("m", "distances from the middle of a line contact, on both sides"),
    "angles": ("rad", "from the direction of the tangential load"),
}
PER_INCREMENT = ("increment",)
PER_STEP = (STEP,)
COMPONENT = ("component",)
PLACES = {"step": "loading step, from 1", "increment": "increment within the step, from 1"}


def write_fields(
    report: ResultReport,
    directory: Path,
    *,
    all_fields: bool = False,
    given: Scene | None = None,
) -> None:
    """Write `result.h5`: scene, coordinates, scalars and surface fields of a result.

    Equal results give equal bytes.

    The first array index is the increment for scalars. For fields, it is the load step, or the
    increment with `all_fields`. A field has one chunk per value of this index. Quantities of an
    effect that the solve omits, such as the shear without friction, have no dataset. If some
    increments have angles, fields that depend on the radius alone are repeated at every angle.

    directory   directory of the run
    all_fields  store the fields of all increments, not only of the last one of each load step
    given       scene of the user, whose bodies are stored; None for those of the result
    """
    result, surface = report.result, report.surface
    scene = result.scene if given is None else with_bodies_of(result.scene, given)
    increments: Sequence[Increment] = result.increments
    with _fields_file(directory / FIELDS, "w") as file:
        axes = ", ".join(surface.axes)
        file.attrs["description"] = f"slipstick, SI units; fields are [increment, (x, y), {axes}]"
        file.attrs["convention"] = CONVENTION
        file.attrs["solver"] = result.solver
        file.attrs["tolerance"] = result.tolerance
        _write_dataset(file, "scene", scene.model_dump_json(), Reported("", "scene (JSON)"))
        for key, stored in result.scene.array_files.items():
            mark = Reported("", f"values of the file that the key {key} of the scene names")
            _write_dataset(file.require_group(MAPS), key, stored.values, mark, **COMPRESSION)
        if isinstance(surface, Rings):
            file.attrs["direction"] = surface.direction
        if hasattr(result, "discretisation"):
            fineness = result.discretisation.model_dump_json()
            _write_dataset(file, "discretisation", fineness, Reported("", "discretisation (JSON)"))
        if hasattr(result, "ring_fineness"):
            file.attrs["ring_factor"] = result.ring_fineness.space
        for name, values in surface.axes.items():
            _write_dataset(file, name, values, Reported(*AXES[name]), (name,))
        group = file.create_group("increments", track_order=False)
        shown = increments if all_fields else result.steps
        counted = PER_INCREMENT if all_fields else PER_STEP
        for name, mark in reported(type(increments[0])).items():
            if mark.kind is Kind.FIELD:
                _write_field(group, name, mark, surface, shown, counted)
        _write_scalars(group, increments, line=result.scene.indenter.is_line)


def add_cycle_fields(report: ResultReport, directory: Path) -> None:
    """Add the surface fields of the last load cycle of a result to its `result.h5`.

    directory  directory of the run
    """
    with _fields_file(directory / FIELDS, "r+") as file:
        group = file.create_group("last_cycle", track_order=False)
        _write_cycle(group, report.cycles[-1], tuple(report.surface.axes))


class _NeverFull(io.FileIO):
    """File that records its first write error and reports success to the HDF5 library.

    The library may crash the process after a write error, such as that of a full disk.
    """

    full: OSError | None = None

    def write(self, content: Any) -> int:
        rest = memoryview(content).cast("B")
        while rest and self.full is None:
            try:
                rest = rest[super().write(rest) :]
            except OSError as error:
                self.full = error
        return len(memoryview(content).cast("B"))


@contextmanager
def _fields_file(path: Path, mode: Literal["w", "r+"]) -> Iterator[h5py.File]:
    """Open an HDF5 file for the `with` block; raise a recorded write error at its end.

    mode  "w" to create the file, "r+" to add to it
    """
    with _NeverFull(path, "w+" if mode == "w" else "r+") as disk:
        try:
            with h5py.File(disk, mode) as file:
                yield file
        finally:
            if disk.full is not None:
                raise disk.full


def _write_scalars(group: h5py.Group, increments: Sequence[Increment], *, line: bool) -> None:
    """Write the scalars of all increments to a group of an HDF5 file.

    An increment without a value gets NaN. A scalar without any value has no dataset. The scalars of
    a line contact have other names and units.
    """
    for name, meaning in PLACES.items():
        attribute = "index" if name == "increment" else name
        values = [getattr(i, attribute) for i in increments]
        _write_dataset(group, name, values, Reported("", meaning), PER_INCREMENT)
    for name, given in columns(increments, SCALARS).items():
        mark = shown_mark(name, SCALARS[name], line=line)
        nothing = np.full(len(components(name)), np.nan)
        found = np.array([nothing if value is None else np.ravel(value) for value in given])
        if np.all(np.isnan(found)):
            continue
        found = found if mark.kind is Kind.VECTOR else found[:, 0]
        shown = shown_name(name, line=line)
        _write_dataset(group, shown, found, mark, (*PER_INCREMENT, *COMPONENT)[: found.ndim])


def _write_field(
    group: h5py.Group,
    name: str,
    mark: Reported,
    surface: Surface,
    increments: Sequence[Increment],
    counted: tuple[str, ...],
) -> None:
    """Write a field of all given increments to one dataset of an HDF5 file.

    There is no dataset if no increment has the field.

    group    group of the dataset
    name     name of the field, also that of the dataset
    mark     unit and meaning of the field
    counted  label of the first array index: increment or step
    """
    dataset = None
    for index, increment in enumerate(increments):
        field = surface.scalar(increment, name)
        if field is None:
            continue
        if dataset is None:
            dataset = group.create_dataset(
                name,
                shape=(len(increments), *field.shape),
                chunks=(1, *field.shape),
                dtype=field.dtype,
                track_times=False,
                **COMPRESSION,
            )
            places = tuple(surface.axes)
            of_vector = COMPONENT * (field.ndim - len(places))
            _describe_dataset(dataset, mark, (*counted, *of_vector, *places))
        dataset[index] = field


def _write_cycle(group: h5py.Group, cycle: FrettingCycle, places: tuple[str, ...]) -> None:
    group.attrs["start_step"], group.attrs["end_step"] = cycle.cycle.start, cycle.cycle.end
    for name, mark in reported(type(cycle)).items():
        values = getattr(cycle, name)
        if mark.kind is Kind.FIELD and values is not None:
            _write_dataset(group, name, values, mark, places, **COMPRESSION)


def _write_dataset(
    group: h5py.Group,
    name: str,
    values: Any,
    mark: Reported,
    indices: tuple[str, ...] = (),
    **how: Any,
) -> None:
    _describe_dataset(
        group.create_dataset(name, data=values, track_times=False, **how), mark, indices
    )


def _describe_dataset(dataset: h5py.Dataset, mark: Reported, indices: tuple[str, ...]) -> None:
    dataset.attrs["unit"] = mark.unit
    dataset.attrs["description"] = mark.meaning
    for number, index in enumerate(indices):
        dataset.dims[number].label = index
