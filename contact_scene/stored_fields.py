"""Fields of a long history lie in a file, and are read whenever somebody asks for them.

The file has no name: it is gone with the last value that has a field in it, and with the process.
"""

from __future__ import annotations

import copy
import math
import tempfile
from dataclasses import dataclass
from typing import IO, Any, TypeVar

import numpy as np
from numpy.typing import NDArray

# What a history holds in memory; only longer ones have a file, in the system's folder for
# temporary files (TMPDIR).
MOST_HELD = 32 << 20
LEAST_STORED = 512  # bytes; the place of an array in a file takes as much

Value = TypeVar("Value", bound="WithFields")


@dataclass(frozen=True, slots=True)
class StoredArray:
    """An array in a file."""

    file: IO[bytes]
    offset: int
    dtype: np.dtype[Any]
    shape: tuple[int, ...]

    @property
    def nbytes(self) -> int:
        """Of the array."""
        return self.dtype.itemsize * math.prod(self.shape)

    def read(self) -> NDArray[Any]:
        """A copy: it cannot be written to, since nobody else would see it."""
        mapped = np.memmap(self.file, self.dtype, "r", self.offset, self.shape)
        values = np.array(mapped, subok=False)
        values.flags.writeable = False
        return values

    def __reduce_ex__(self, protocol: Any) -> Any:
        """Another process gets the array, once for all values that share it."""
        return self.read().__reduce_ex__(protocol)


class WithFields:
    """A value whose arrays may lie in a file; each is then read, anew, when it is asked for."""

    def __getattribute__(self, name: str) -> Any:
        value = object.__getattribute__(self, name)
        return value.read() if type(value) is StoredArray else value


def stored_bytes(value: WithFields) -> int:
    """Of all arrays of a value [byte]."""
    return sum(getattr(array, "nbytes", 0) for array in vars(value).values())


class FieldStore:
    """Takes the values of one history in their order: the arrays of the first ones stay in memory,
    those beyond `MOST_HELD` bytes go into a file. What a value shares with the one before, or what
    is twice in it, is kept once."""

    def __init__(self) -> None:
        self._held = 0
        self._file: IO[bytes] | None = None
        self._known: dict[int, tuple[NDArray[Any], NDArray[Any] | StoredArray]] = {}

    def kept(self, value: Value) -> Value:
        """The same value, to be held; raises OSError where the file cannot grow."""
        kept = copy.copy(value)
        known: dict[int, tuple[NDArray[Any], NDArray[Any] | StoredArray]] = {}
        for name, array in vars(value).items():
            if isinstance(array, np.ndarray) and array.nbytes >= LEAST_STORED:
                place = id(array)  # nobody else's while `_known` holds the array
                found = known.get(place) or self._known.get(place) or (array, self._put(array))
                known[place] = found
                vars(kept)[name] = found[1]
        self._known = known
        return kept

    def _put(self, array: NDArray[Any]) -> NDArray[Any] | StoredArray:
        if self._held + array.nbytes <= MOST_HELD:
            self._held += array.nbytes
            return array
        try:
            if self._file is None:
                # Open as long as a value has a field in it.
                self._file = tempfile.TemporaryFile(prefix="slipstick-")  # noqa: SIM115
            offset = self._file.seek(0, 2)
            self._file.write(np.ascontiguousarray(array).data)
            self._file.flush()
        except OSError as error:
            folder = tempfile.tempdir or "temporary files"  # where there is none, asking raises
            error.filename = f"{folder} (TMPDIR), for the fields of increments"
            raise
        return StoredArray(self._file, offset, array.dtype, array.shape)
