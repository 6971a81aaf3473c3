"""`result.h5` of a result on a section: all fields of all increments, in SI, with units."""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from contact_results.directory.file_names import FIELDS
from contact_results.files.dataset import describe, write_dataset, write_scalars
from contact_results.section.field_quantities import FIELD_QUANTITIES, SCALAR_QUANTITIES
from contact_results.section.summary_file import solver_name
from fem_reference import Method, Result

COMPRESSION: dict[str, Any] = {"compression": "gzip", "compression_opts": 4, "shuffle": True}


def write_section_fields(result: Result, method: Method, directory: Path) -> None:
    """Write scene, discretisation, rings, fields and scalars; equal results give equal bytes.

    Every dataset of `increments` has the increment as its first index. Where some increments have
    angles, all have: a field of the radius alone is the same at every angle.
    """
    # Made in memory: the HDF5 library may crash the process when the disk is full.
    contents = io.BytesIO()
    with h5py.File(contents, "w") as file:
        file.attrs["description"] = "slipstick, SI units; arrays are [increment, ring, angle]"
        file.attrs["solver"] = solver_name(method)
        file.attrs["tolerance"] = result.discretisation.tolerance
        file.attrs["direction"] = result.plan.direction
        write_dataset(file, "scene", result.scene.model_dump_json(), "", "what was solved (JSON)")
        fineness = result.discretisation.model_dump_json()
        write_dataset(file, "discretisation", fineness, "", "how finely (JSON)")
        write_dataset(file, "radii", result.increments[0].radii, "m", "radii of the rings")
        angles = next((i.angles for i in result.increments if i.angles is not None), None)
        if angles is not None:
            write_dataset(
                file, "angles", angles, "rad", "from the direction of the tangential load"
            )
        group = file.create_group("increments", track_order=False)
        for field in FIELD_QUANTITIES:
            parts = [field.of(increment) for increment in result.increments]
            _write_fields(group, field.name, parts, (field.unit, field.meaning), angles)
        write_scalars(group, SCALAR_QUANTITIES, result.increments)
    (directory / FIELDS).write_bytes(contents.getbuffer())


def _write_fields(
    group: Any, name: str, parts: list[Any], described: tuple[str, str], angles: Any
) -> None:
    first = next((part for part in parts if part is not None), None)
    if first is None:
        return
    shape = (len(first),) if angles is None else (len(first), len(angles))
    values = np.zeros((len(parts), *shape), dtype=first.dtype)
    for value, part in zip(values, parts, strict=True):
        if part is not None:
            value[...] = part if part.shape == shape else part[:, None]
    dataset = group.create_dataset(name, data=values, track_times=False, **COMPRESSION)
    describe(dataset, *described)
