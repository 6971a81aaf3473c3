"""`result.h5`: every field at every increment, with units and meaning next to the numbers."""

import io
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import h5py

from contact_results.directory.file_names import FIELDS
from contact_results.files.dataset import (
    Dataset,
    describe,
    write_dataset,
    write_scalars,
)
from contact_results.files.field_quantities import FIELD_QUANTITIES, SCALAR_QUANTITIES
from semi_analytical import Increment, Result
from semi_analytical.fretting import FrettingCycle

# Level 1 with shuffled bytes is within a tenth of the size of level 9 on these fields, at a
# fraction of its time.
COMPRESSION: dict[str, Any] = {"compression": "gzip", "compression_opts": 1, "shuffle": True}

CYCLE_FIELDS = (
    ("dissipation", "J/m^2", "energy per area lost to friction in the cycle"),
    ("slip_amplitude", "m", "half the range of slip in the cycle"),
    ("largest_shear", "Pa", "largest shear in the cycle"),
    ("ruiz_f1", "Pa m", "largest shear times slip amplitude"),
    ("surface_tension", "Pa", "largest stress of the surface along the tangential force"),
    ("ruiz_f2", "Pa^2 m", "ruiz_f1 times the surface tension, zero under compression"),
)


def write_fields(result: Result, cycles: Sequence[FrettingCycle], directory: Path) -> None:
    """Write grid, scene, fields and scalars, and of the last cycle the fields; equal results give
    equal bytes.

    Every dataset of `increments` has the increment as its first index and one chunk per increment,
    so that one of them can be read without the others. Effects that are off have no dataset.
    """
    # Made in memory: the HDF5 library may crash the process when the disk is full.
    contents = io.BytesIO()
    with h5py.File(contents, "w") as file:
        file.attrs["description"] = "slipstick, SI units; arrays are [increment, (x, y), i, j]"
        file.attrs["tolerance"] = result.tolerance
        write_dataset(file, "scene", result.scene.model_dump_json(), "", "what was solved (JSON)")
        for name, values in (("x", result.grid.x), ("y", result.grid.y)):
            write_dataset(file, name, values, "m", f"cell centres along {name}")
        group = file.create_group("increments", track_order=False)
        for quantity in FIELD_QUANTITIES:
            _write_field(group, quantity, result.increments)
        write_scalars(group, SCALAR_QUANTITIES, result.increments)
        if cycles:
            _write_cycle(file.create_group("last_cycle", track_order=False), cycles[-1])
    (directory / FIELDS).write_bytes(contents.getbuffer())


def _write_cycle(group: Any, cycle: FrettingCycle) -> None:
    group.attrs["start_step"], group.attrs["end_step"] = cycle.cycle.start, cycle.cycle.end
    for name, unit, meaning in CYCLE_FIELDS:
        values = getattr(cycle, name)
        if values is not None:
            dataset = group.create_dataset(name, data=values, track_times=False, **COMPRESSION)
            describe(dataset, unit, meaning)


def _write_field(
    group: Any, quantity: Dataset[Increment], increments: tuple[Increment, ...]
) -> None:
    first = next(_present(quantity, increments), None)
    if first is None:
        return
    dataset = group.create_dataset(
        quantity.name,
        shape=(len(increments), *first.shape),
        chunks=(1, *first.shape),
        dtype=first.dtype,
        track_times=False,
        **COMPRESSION,
    )
    describe(dataset, quantity.unit, quantity.meaning)
    for index, increment in enumerate(increments):
        values = quantity.of(increment)
        if values is not None:
            dataset[index] = values


def _present(quantity: Dataset[Increment], increments: tuple[Increment, ...]) -> Iterator[Any]:
    return (values for values in map(quantity.of, increments) if values is not None)
