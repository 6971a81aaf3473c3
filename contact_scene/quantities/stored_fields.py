"""Storage of the results of a long load history in a temporary file, read on access.

The file has no name: the operating system deletes the file with the last value that refers to it.
"""

from __future__ import annotations

import copy
import math
import pickle
import tempfile
import weakref
from dataclasses import dataclass
from typing import IO, Any, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

# Largest size of the arrays of a history in memory [byte]. Further arrays are in a file, in the
# system's folder for temporary files (TMPDIR).
MAX_IN_MEMORY = 4 << 20
LEAST_STORED = 512  # smallest array in the file [byte]; the record of its place has this size

Value = TypeVar("Value", bound="WithFields")


@dataclass(frozen=True, slots=True)
class StoredArray:
    """Reference to an array of a result that is stored in a temporary file.

    file    open file
    offset  position of the first byte in the file
    dtype   type of the numbers
    shape   shape of the array
    """

    file: IO[bytes]
    offset: int
    dtype: np.dtype[Any]
    shape: tuple[int, ...]

    @property
    def nbytes(self) -> int:
        """Size of the array in the temporary file [byte]."""
        return self.dtype.itemsize * math.prod(self.shape)

    def read(self) -> NDArray[Any]:
        """Read a copy of the array from the temporary file.

        The copy is read-only, since changes would not reach the file.
        """
        mapped = np.memmap(self.file, self.dtype, "r", self.offset, self.shape)
        values = np.array(mapped, subok=False)
        values.flags.writeable = False
        return values

    def __reduce_ex__(self, protocol: Any) -> Any:
        """Return the pickle data of the array itself instead of the reference to its file.

        Other processes cannot read the temporary file.
        """
        return self.read().__reduce_ex__(protocol)


class _StoredState(NamedTuple):
    """Reference to the attributes of a result of an increment in a temporary file.

    The class is no dataclass: files of checkpoints accept frozen dataclasses, and must not contain
    such a reference, because its `read` unpickles bytes.

    file    open file
    offset  position of the first byte in the file
    size    number of bytes
    """

    file: IO[bytes]
    offset: int
    size: int

    def read(self) -> dict[str, Any]:
        """Read the attributes of a result from the temporary file.

        Arrays remain in the file; the attributes contain references to them.
        """
        content = np.memmap(self.file, np.uint8, "r", self.offset, (self.size,)).tobytes()
        state, arrays = pickle.loads(content)
        return state | {
            name: StoredArray(self.file, offset, np.dtype(dtype), shape)
            for name, (offset, dtype, shape) in arrays.items()
        }


class WithFields:
    """Base class of results with arrays, which may be stored in a temporary file.

    An array in a file is read at every access. If all attributes are in the file, they are read on
    access; only those of the object that was read last remain in memory.
    """

    def __getattribute__(self, name: str) -> Any:
        own = object.__getattribute__(self, "__dict__")
        if _STATE in own and name not in own:
            state = _opened_attributes(self, own)
            if name == "__dict__":
                return state
            value = state[name] if name in state else object.__getattribute__(self, name)
        else:
            value = object.__getattribute__(self, name)
        return value.read() if type(value) is StoredArray else value

    def __getstate__(self) -> dict[str, Any]:
        return dict(vars(self))


# Attributes of a value in a file: its place, and its attributes if it was read last.
_STATE = "_stored_state"
_OPENED = "_opened_state"
# Attributes that remain in memory and identify the increments of a history.
_AT_HAND = ("step", "index", "increments_in_step")
_last_read: weakref.ref[WithFields] | None = None


def _opened_attributes(value: WithFields, own: dict[str, Any]) -> dict[str, Any]:
    global _last_read
    if _OPENED not in own:
        last = None if _last_read is None else _last_read()
        if last is not None:
            object.__getattribute__(last, "__dict__").pop(_OPENED, None)
        own[_OPENED] = own[_STATE].read()
        _last_read = weakref.ref(value)
    state: dict[str, Any] = own[_OPENED]
    return state


class FieldStore:
    """Storage of the results of all increments of one load history, in their order.

    Arrays beyond `MAX_IN_MEMORY` bytes in total, and all results from then on, are in a temporary
    file. An array that a result shares with the preceding result, or has twice, is stored once.
    """

    def __init__(self) -> None:
        self._in_memory = 0
        self._file: IO[bytes] | None = None
        self._known: dict[int, tuple[NDArray[Any], NDArray[Any] | StoredArray]] = {}

    def store(self, value: Value) -> Value:
        """Store the result of an increment and return an equivalent object with less memory.

        Large arrays of the returned object, or all its attributes, are in the temporary file and
        are read on access.

        value  result of an increment

        Raises OSError if the file cannot grow.
        """
        copied = copy.copy(value)
        known: dict[int, tuple[NDArray[Any], NDArray[Any] | StoredArray]] = {}
        for name, array in vars(value).items():
            if isinstance(array, np.ndarray) and array.nbytes >= LEAST_STORED:
                place = id(array)  # unique, since `_known` refers to the array
                found = (
                    known.get(place) or self._known.get(place) or (array, self._store_array(array))
                )
                known[place] = found
                vars(copied)[name] = found[1]
        self._known = known
        return copied if self._file is None else self._store_attributes(copied, self._file)

    def _store_attributes(self, value: Value, file: IO[bytes]) -> Value:
        """Write the attributes of a result to the temporary file; return a reference object.

        The returned object reads the attributes from the file on access. Arrays that are in the
        file already are not written again.

        value  result of an increment
        file   open temporary file
        """
        state = dict(vars(value))
        arrays = {
            name: (array.offset, array.dtype.str, array.shape)
            for name, array in state.items()
            if isinstance(array, StoredArray)
        }
        light = {name: attribute for name, attribute in state.items() if name not in arrays}
        content = pickle.dumps((light, arrays))
        place = self._append_bytes(content)
        place_only = object.__new__(type(value))
        vars(place_only).update({name: light[name] for name in _AT_HAND if name in light})
        vars(place_only)[_STATE] = _StoredState(file, place, len(content))
        return place_only

    def _store_array(self, array: NDArray[Any]) -> NDArray[Any] | StoredArray:
        if self._in_memory + array.nbytes <= MAX_IN_MEMORY:
            self._in_memory += array.nbytes
            return array
        place = self._append_bytes(np.ascontiguousarray(array).data)
        assert self._file is not None
        return StoredArray(self._file, place, array.dtype, array.shape)

    def _append_bytes(self, content: bytes | memoryview) -> int:
        """Append bytes to the temporary file of the results, which is created if needed.

        content  bytes of an array, or of the attributes of a result
        returns  position of the first byte in the file

        Raises OSError if the folder of temporary files is full or missing.
        """
        try:
            if self._file is None:
                # Open as long as a value refers to it.
                self._file = tempfile.TemporaryFile(prefix="slipstick-")  # noqa: SIM115
            offset = self._file.seek(0, 2)
            self._file.write(content)
            self._file.flush()
        except OSError as error:
            folder = tempfile.tempdir or "temporary files"  # gettempdir raises if there is none
            error.filename = f"{folder} (TMPDIR), for the fields of increments"
            raise
        return offset
