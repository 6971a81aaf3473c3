"""Pickle file of a checkpoint, with the identity of the solve and a check sum.

The file has four parts: a line with the format, a line with the identity of the solve, a line with
the SHA-256 of the rest, and a pickle. Arrays are stored as bytes with a data type from a list. The
reader resolves frozen classes of the solvers only, so that a foreign file cannot execute code.
"""

from __future__ import annotations

import hashlib
import importlib
import pickle
from collections.abc import Callable
from enum import Enum
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from contact_scene import FiniteElementDiscretisation
from contact_scene.machine import available_bytes, open_own
from contact_scene.quantities.stored_fields import StoredArray

FORMAT = b"slipstick checkpoint 2"
PROTOCOL = 5
LONGEST_LINE = 1000

PACKAGES = (
    *("contact_scene", "contact_solver", "semi_analytical", "fem_reference", "radial"),
    *("contact_results", "contact_errors"),
)
DTYPES = frozenset(np.dtype(kind).str for kind in "?bBhHiIqQfdFD")
FAR_FIELDS = "fem_reference.elasticity.motion"  # its pure functions are in stored values


class Unusable(Exception):
    """A checkpoint file cannot be used; the message has its name and the reason."""


def write_checkpoint_file(value: Any, identity: str, path: Path) -> None:
    """Write a value to a checkpoint file, with one array in memory at a time.

    value     contents, made of frozen classes of the solvers
    identity  digest of the input and the code of the solve

    Raises OSError if the file cannot be written.
    """
    with open(path, "wb") as file:
        file.write(FORMAT + b"\n" + identity.encode() + b"\n")
        before, content = file.tell(), _DigestWriter(file)
        file.write(bytes(2 * content.digest.digest_size) + b"\n")
        writer = _Writer(content, PROTOCOL)
        writer.fast = True  # the memo of a pickler would keep every array that it has written
        writer.dump(value)
        file.seek(before)
        file.write(content.digest.hexdigest().encode())


class _DigestWriter:
    """Writer to a binary file that computes the SHA-256 of the bytes it writes."""

    def __init__(self, file: BinaryIO) -> None:
        self.file, self.digest = file, hashlib.sha256()

    def write(self, content: bytes) -> int:
        """Write all bytes to the file and add them to the digest; return their number."""
        self.digest.update(content)
        return self.file.write(content)


def read_checkpoint_file(path: Path, identity: str) -> Any:
    """Read the value of a checkpoint file.

    identity  digest of the input and the code of the solve that the file must have

    Raises Unusable if the file cannot be read, is damaged, exceeds the free memory, or belongs to
    another solve or version.
    """
    try:
        with open_own(path) as file:
            name, whose, digest = (file.readline(LONGEST_LINE).rstrip(b"\n") for _ in range(3))
            if name != FORMAT:
                raise Unusable(f"{path} is not a checkpoint of this version")
            if path.stat().st_size > available_bytes():
                raise Unusable(f"{path} is larger than the available memory")
            start = file.tell()
            if digest != hashlib.file_digest(file, "sha256").hexdigest().encode():
                raise Unusable(f"{path} is damaged")
            if whose != identity.encode():
                raise Unusable(f"{path} is of another scene, solver, discretisation or version")
            file.seek(start)
            return _Reader(file).load()
    except Unusable:
        raise
    except OSError as error:
        raise Unusable(f"{path} cannot be read: {error.strerror}") from error
    except Exception as error:  # a damaged or foreign pickle may raise any exception
        raise Unusable(f"{path} is damaged: {error}") from error


class _Writer(pickle.Pickler):
    """Pickler that writes numpy arrays as plain bytes with data type and shape."""

    def reducer_override(self, value: Any) -> tuple[Callable[..., Any], tuple[Any, ...]]:
        if isinstance(value, StoredArray):
            value = value.read()
        if isinstance(value, np.generic):
            return scalar, (value.dtype.str, value.tobytes())
        if not isinstance(value, np.ndarray):
            return NotImplemented
        by_columns = value.flags.f_contiguous and not value.flags.c_contiguous
        lines = value.T if by_columns else value
        return array, (value.dtype.str, lines.tobytes(), lines.shape, by_columns)


def array(dtype: str, content: bytes, shape: tuple[int, ...], by_columns: bool) -> NDArray[Any]:
    """Create a numpy array from the bytes in a checkpoint file.

    dtype       data type, one of DTYPES
    content     bytes of the values
    by_columns  True if the bytes are in Fortran order; `shape` is then that of the transpose

    Raises ValueError for another data type, or if shape and number of bytes differ.
    """
    if dtype not in DTYPES:
        raise ValueError(f"a checkpoint may not contain an array of data type {dtype!r}")
    lines = np.frombuffer(content, dtype).reshape(shape).copy()
    return lines.T if by_columns else lines


def scalar(dtype: str, content: bytes) -> Any:
    """Create a numpy scalar from the bytes in a checkpoint file.

    dtype    data type, one of DTYPES
    content  bytes of the value

    Raises ValueError for another data type or number of bytes.
    """
    return array(dtype, content, (), by_columns=False)[()]


class _Reader(pickle.Unpickler):
    """Unpickler that resolves only frozen classes of the solvers, numpy arrays, and floats.

    A foreign file therefore cannot execute code.
    """

    def find_class(self, module: str, name: str) -> Any:
        if module == __name__ and name in ("array", "scalar"):
            return globals()[name]
        if (module, name) == ("builtins", "float"):
            return float
        if any(module == package or module.startswith(f"{package}.") for package in PACKAGES):
            found = getattr(importlib.import_module(module), name, None)
            if getattr(found, "__module__", None) == module and _is_storable(found):
                return found
        raise pickle.UnpicklingError(f"a checkpoint may not contain {module}.{name}")


def _is_storable(found: Any) -> bool:
    """Return True for frozen dataclasses that are no files, enumerations,
    the finite element settings, and functions of FAR_FIELDS."""
    if isinstance(found, type):
        frozen = getattr(getattr(found, "__dataclass_params__", None), "frozen", False)
        plain = frozen and not issubclass(found, StoredArray)
        return plain or issubclass(found, Enum | FiniteElementDiscretisation)
    return bool(found.__module__ == FAR_FIELDS)
