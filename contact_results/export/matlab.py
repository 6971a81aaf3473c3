"""A MAT-file: a struct per group, and beside the numbers their units, meanings and indices."""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any

from numpy.typing import NDArray
from scipy.io import savemat

from contact_results.directory.atomic_file import atomic_file
from contact_results.directory.refusal import Refused
from contact_results.export.sheets import Stored, arrays_of, title_of
from contact_results.files.stored_run import StoredRun

HEADER = 116  # bytes of text, where `savemat` puts the time of day
NO_TIME = b"MATLAB 5.0 MAT-file, slipstick"
MOST_BYTES = 2**31 - 1  # of a variable in a MAT-file of version 5


def write_matlab(stored: Stored, path: Path) -> None:
    """Write `title`, `convention`, of a run the `direction` where angles start, the structs of
    arrays, and `unit`, `meaning` and `indices` with the same fields. Raises Refused for an array
    that the format cannot hold."""
    sheets = arrays_of(stored)
    contents: dict[str, Any] = {"title": title_of(stored), "convention": stored.convention}
    if isinstance(stored, StoredRun):
        contents["direction"] = stored.direction
    told: dict[str, dict[str, dict[str, str]]] = {"unit": {}, "meaning": {}, "indices": {}}
    for group, sheet in sheets.items():
        contents[group] = {}
        for mark in told.values():
            mark[group] = {}
        for name, values in sheet.items():
            if values.array.nbytes > MOST_BYTES:
                raise Refused(
                    f"{group}.{name} has {values.array.nbytes / 1e9:.1f} GB, and a MAT-file holds "
                    "2.1 GB in an array; MATLAB reads the fields of result.h5 by h5read"
                )
            contents[group][name] = _cells(values.array)
            told["unit"][group][name] = values.unit or "1"
            told["meaning"][group][name] = values.meaning
            told["indices"][group][name] = ", ".join(values.indices)
    file = io.BytesIO()
    savemat(file, contents | told, do_compression=True, long_field_names=True, oned_as="column")
    with atomic_file(path) as temporary:
        temporary.write_bytes(NO_TIME.ljust(HEADER) + file.getvalue()[HEADER:])


def _cells(array: NDArray[Any]) -> NDArray[Any]:
    """Words become a cell array."""
    return array.astype(object) if array.dtype.kind == "U" else array
