"""Safe reader of values in an HDF5 file.

A file of a few bytes can declare a dataset of any size, because unwritten or compressed zeros take
no space on disk. Therefore a dataset is refused before reading if its declared size is too large
for the size of the file. Links and references to other files are refused as well.
"""

from __future__ import annotations

import hashlib
import math
from collections.abc import Iterator
from contextlib import contextmanager
from errno import EACCES, EAGAIN
from pathlib import Path
from typing import Any

import h5py
import numpy as np
from numpy.typing import NDArray

from contact_scene.machine import available_bytes
from contact_scene.solver_errors import ResourceRefused

# Largest ratio of declared bytes to bytes of the file. Deflate compresses at most 1032:1; the
# factor 4 admits fields that are partly empty.
LARGEST_RATIO = 4096
MAX_CHUNKS = 10_000  # largest number in one read; fields have one chunk per increment
# Exceptions that h5py, or code that uses its values, raises for a file of other content.
MISREAD = (
    *(OSError, KeyError, ValueError, TypeError, AttributeError, IndexError, RuntimeError),
    SystemError,  # h5py raises it for some damaged attributes
)

# Bytes of the superblock of an HDF5 file that contain the size of the file.
END_OF_FILE = slice(40, 48)

MAPS = "maps"  # group of the arrays that the scene reads from files
# Label of the first index of fields at the ends of load steps.
STEP = "step"


class FieldsAtEndsOnly(KeyError):
    """Error: the run has stored fields at the ends of load steps only, not at this increment."""

    def __str__(self) -> str:
        return str(self.args[0])


@contextmanager
def open_hdf5(path: Path) -> Iterator[h5py.File]:
    """Open an HDF5 file for reading in the `with` block.

    Raises ValueError if h5py cannot read the file, if another process uses it, or if it contains
    links to other places.
    """
    try:
        with h5py.File(path) as file:
            if (name := file.visititems_links(_name_of_link)) is not None:
                raise ValueError(f"{path}: {name!r} links to another place; expected its values")
            yield file
    except (OSError, RuntimeError, SystemError) as error:
        if getattr(error, "errno", None) in (EACCES, EAGAIN) and "lock" in str(error):
            raise ValueError(
                f"{path} is in use by another process; wait until it is closed there"
            ) from None
        raise ValueError(f"{path} cannot be read as HDF5: {error}") from None


def _name_of_link(name: str, link: object) -> str | None:
    """Return the name of an entry of an HDF5 file that is a link to another place, else None."""
    return None if isinstance(link, h5py.HardLink) else name


def fields_digest(path: Path) -> str:
    """Compute the SHA-256 of a file, which `summary.json` records for the file of fields.

    The result is empty for a file whose size is not that in its superblock (HDF5 File Format
    Specification 3.0, section II.A, version 0): a damaged file may be too large to be read.
    """
    with path.open("rb") as file:
        size = int.from_bytes(file.read(END_OF_FILE.stop)[END_OF_FILE], "little")
        if size != path.stat().st_size:
            return ""
        file.seek(0)
        return hashlib.file_digest(file, "sha256").hexdigest()


def ends_of_steps(steps: NDArray[Any]) -> NDArray[np.intp]:
    """Return the index of the last increment of each load step (steps,).

    steps  load step number of each increment (increments,)
    """
    return np.flatnonzero(np.diff(steps, append=steps[-1] + 1))


def row_of(dataset: h5py.Dataset, increment: int) -> int:
    """Return the first array index of a dataset that contains the values of an increment.

    Datasets of fields may have one entry per load step instead of one per increment.

    dataset    dataset in the group of the increments
    increment  index of the increment in the whole history, from 0

    Raises FieldsAtEndsOnly for an increment within a load step whose fields were not stored.
    """
    if dataset.dims[0].label != STEP:
        return increment
    found = np.flatnonzero(ends_of_steps(read_dataset(dataset.parent["step"])) == increment)
    if not len(found):
        raise FieldsAtEndsOnly(
            f"{dataset.file.filename} has {dataset.name} at the ends of load steps only, and "
            f"increment {increment + 1} is not one of them; run again with --all-fields"
        )
    return int(found[0])


def read_dataset(dataset: h5py.Dataset, row: int | None = None) -> NDArray[Any]:
    """Read all values of a dataset, or those at one index along its first axis.

    Nothing is read if an error is raised.

    row  index along the first axis; None reads all values

    Raises
    ------
    ValueError
        The dataset is empty, declares more bytes than a file of this size can contain, or has too
        many chunks.
    ResourceRefused
        The values do not fit into the available memory.
    """
    if dataset.external or dataset.is_virtual:
        raise ValueError(f"{dataset.name} refers to values in another file; expected the values")
    shape = dataset.shape if row is None else (1, *dataset.shape[1:])
    chunk = dataset.chunks or shape
    if 0 in (*dataset.shape, *chunk):
        raise ValueError(f"{dataset.name} of shape {dataset.shape} is empty")
    chunks = math.prod(-(-n // piece) for n, piece in zip(shape, chunk, strict=True))
    if chunks > MAX_CHUNKS:
        raise ValueError(f"{dataset.name} has {chunks} chunks, at most {MAX_CHUNKS} are read")
    size = dataset.dtype.itemsize * max(math.prod(shape), math.prod(chunk))
    file = Path(dataset.file.filename)
    stored = file.stat().st_size
    if size > LARGEST_RATIO * stored:
        raise ValueError(
            f"{dataset.name} declares {size} bytes, too many for a file of {stored} bytes"
        )
    if size > (available := available_bytes()):
        raise ResourceRefused(
            f"{dataset.name} of {file} needs {size / 1e9:.1f} GB, and {available / 1e9:.1f} GB "
            "are available"
        )
    read: NDArray[Any] = dataset[()] if row is None else dataset[row]
    return read


def read_text(dataset: h5py.Dataset) -> str:
    """Read a dataset that contains a text, such as the scene. Raises errors of `read_dataset`."""
    content: Any = read_dataset(dataset)
    return content.decode() if isinstance(content, bytes) else str(content)
