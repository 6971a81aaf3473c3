"""Reader of the directory of a run: summary, scene, and arrays with units and meanings."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from os import PathLike
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import h5py
import numpy as np
from numpy.typing import NDArray

from contact_results.directory.file_names import (
    FIELDS,
    STRESS,
    SUMMARY,
)
from contact_results.files.stored_values import (
    MAPS,
    MISREAD,
    ends_of_steps,
    fields_digest,
    open_hdf5,
    read_dataset,
    read_text,
    row_of,
)
from contact_results.surface import SURFACE_FIELDS, Surface, surface_on
from contact_scene import FiniteElementDiscretisation, Scene
from contact_scene.discretised import Fineness
from contact_scene.quantities.increment import SCALARS
from contact_scene.quantities.per_length import ATTRIBUTES
from contact_scene.quantities.summary import (
    RunSummary,
    load_summary,
)
from contact_scene.reading.scene_error import SceneError


@dataclass(frozen=True, eq=False)
class StoredValues:
    """Array read from a file, with unit and meaning.

    array    the values
    unit     SI unit; empty if dimensionless
    meaning  one sentence about the values
    indices  meaning of each array index: increment, step, component, or the name of a coordinate;
             empty if the file does not state them
    """

    array: NDArray[Any]
    unit: str
    meaning: str
    indices: tuple[str, ...] = ()


class StoredGroup(Mapping[str, StoredValues]):
    """Arrays in one group of an HDF5 file, by name; an array is read on access.

    path   path of the file
    group  name of the group, such as "increments"; "/" for the arrays outside of groups
    """

    def __init__(self, path: Path, group: str) -> None:
        self._path, self._group = path, group
        with open_hdf5(path) as file:
            found = file.get(group, {}).items()
            self._names = tuple(
                name for name, item in found if isinstance(item, h5py.Dataset) and item.shape
            )

    def __getitem__(self, name: str) -> StoredValues:
        if name not in self._names:
            raise KeyError(f"{self._path} has no {name!r} in {self._group}: {self._names}")
        with open_hdf5(self._path) as file:
            dataset = file[self._group][name]
            unit, meaning = (dataset.attrs.get(mark) for mark in ("unit", "description"))
            if not (isinstance(unit, str) and isinstance(meaning, str)):
                raise ValueError(
                    f"{self._path}: {dataset.name} has unit {unit!r} and description {meaning!r}, "
                    f"expected two texts as in the {FIELDS} of a run"
                )
            indices = tuple(dim.label for dim in dataset.dims)
            return StoredValues(
                read_dataset(dataset), unit, meaning, indices if all(indices) else ()
            )

    def arrays_at(self, increment: int) -> dict[str, NDArray[Any]]:
        """Read the values of all arrays of the group at one increment, by name.

        increment  index of the increment in the whole history, from 0

        Raises FieldsAtEndsOnly if the fields at this increment were not stored.
        """
        with open_hdf5(self._path) as file:
            group = file[self._group]
            return {
                name: read_dataset(group[name], row_of(group[name], increment)) for name in self
            }

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)


@dataclass(frozen=True)
class StoredRun:
    """Results of a run in a directory that `slipstick run` has written.

    summary         state at the end of every load step, effects, warnings
    scene           the solved scene
    coordinates     coordinates of the surface points: x and y of cells, or radii and angles of
                    rings
    increments      scalars of every increment; fields of every load step, or of every increment
                    with --all-fields
    last_cycle      fields of the last closed load cycle; empty if there is none
    direction       unit vector of the tangential load, at angle 0
    discretisation  settings of the finite elements; None for other solvers
    ring_factor     factor of the default number of rings of the radial solver; None for others, and
                    if the file does not state it
    """

    summary: RunSummary
    scene: Scene
    coordinates: StoredGroup
    increments: StoredGroup
    last_cycle: StoredGroup
    direction: tuple[float, float]
    discretisation: FiniteElementDiscretisation | None
    ring_factor: float | None

    @cached_property
    def surface(self) -> Surface:
        """Surface grid of the stored fields: cells or rings, read once."""
        axes = {name: values.array for name, values in self.coordinates.items()}
        return surface_on(axes, self.direction)

    @property
    def solver(self) -> str:
        """Name of the solver of the run."""
        return self.summary.solver

    @property
    def ring_fineness(self) -> Fineness | None:
        """Rings, increments and tolerance of the radial solver; None without `ring_factor`."""
        if self.ring_factor is None:
            return None
        counts = np.unique(self.increments["step"].array, return_counts=True)[1]
        return Fineness(float(self.ring_factor), tuple(counts.tolist()), self.summary.tolerance)

    def end_of_step(self, number: int) -> SimpleNamespace:
        """Read scalars and fields at the end of a load step, see `increment`.

        number  index of the load step, from 0
        """
        steps = self.increments["step"].array
        return self.increment(int(ends_of_steps(steps)[number]))

    def increment(self, number: int) -> SimpleNamespace:
        """Read scalars and fields of an increment; they are attributes, as in a result.

        Missing quantities are None.

        number  index of the increment in the whole history, from 0

        Raises FieldsAtEndsOnly if the fields at this increment were not stored, and ValueError if
        the shape of a field is not that of the surface.
        """
        found: dict[str, Any] = dict.fromkeys((*SCALARS, *SURFACE_FIELDS))
        shape = self.surface.weights.shape
        for name, value in self.increments.arrays_at(number).items():
            if name in SURFACE_FIELDS and value.shape not in (shape, (2, *shape)):
                raise ValueError(f"{name} has shape {value.shape}, expected {shape}")
            known = name in SURFACE_FIELDS or not np.any(np.isnan(value))
            attribute = "index" if name == "increment" else ATTRIBUTES.get(name, name)
            found[attribute] = value if known else None
        return SimpleNamespace(**found)


def load(directory: str | PathLike[str]) -> StoredRun:
    """Read the results of `slipstick run` or `slipstick.save` from a directory.

    Raises
    ------
    FileNotFoundError
        The directory is not the output of a run.
    ValueError
        A file is damaged, of an earlier version, or of another run.
    ResourceRefused
        An array does not fit into memory; raised on access as well.
    """
    summary, fields = Path(directory) / SUMMARY, Path(directory) / FIELDS
    for path in (summary, fields):
        if not path.is_file():
            stress = (Path(directory) / STRESS).is_file()
            instead = f"; it is the output of a stress: read its {STRESS}" if stress else ""
            raise FileNotFoundError(
                f"{directory} is not the output of a run: it has no {path.name}{instead}"
            )
    try:
        record = load_summary(summary.read_text(encoding="utf-8"))
    except ValueError as error:
        raise ValueError(f"{summary} is not the {SUMMARY} of a run: {error}") from None
    # Before HDF5 reads a byte: its library may raise any error, or crash, in a damaged file.
    if record.fields_digest != fields_digest(fields):
        raise ValueError(
            f"{fields} was changed or damaged, or is of another run: its digest is not that in "
            f"{summary}; run again"
        )
    try:
        with open_hdf5(fields) as file:
            arrays = {key: read_dataset(array) for key, array in file.get(MAPS, {}).items()}
            scene = Scene.model_validate_json(read_text(file["scene"]), context={"arrays": arrays})
            fineness = None
            if "discretisation" in file:
                asked = read_text(file["discretisation"])
                fineness = FiniteElementDiscretisation.model_validate_json(asked)
            if "increments" not in file:
                raise ValueError("it has no increments")
            x, y = file.attrs.get("direction", (1.0, 0.0))
            ring_factor = file.attrs.get("ring_factor")
        groups = [StoredGroup(fields, group) for group in ("/", "increments", "last_cycle")]
    except (*MISREAD, SceneError) as error:
        raise ValueError(f"{fields} is not the {FIELDS} of a run: {error}") from None
    places, increments, cycle = groups
    direction = float(x), float(y)
    return StoredRun(record, scene, places, increments, cycle, direction, fineness, ring_factor)
