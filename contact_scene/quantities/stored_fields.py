"""Storage of a long history in a file, from which values are read when they are used.

The file has no name: it is gone with the last value that has a field in it, and with the process.
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

# Bytes of arrays that a history holds in memory. A longer one has a file, in the system's folder
# for temporary files (TMPDIR).
MAX_HELD = 4 << 20
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


class _StoredState(NamedTuple):
    """The attributes of a value in a file, arrays by their places. No dataclass, so that no
    checkpoint can hold one."""

    file: IO[bytes]
    offset: int
    size: int

    def read(self) -> dict[str, Any]:
        """Read the attributes."""
        content = np.memmap(self.file, np.uint8, "r", self.offset, (self.size,)).tobytes()
        state, arrays = pickle.loads(content)
        return state | {
            name: StoredArray(self.file, offset, np.dtype(dtype), shape)
            for name, (offset, dtype, shape) in arrays.items()
        }


class WithFields:
    """A value whose arrays, or all of whose attributes, may lie in a file. An array is read at
    every access; the attributes of one value at a time stay in memory."""

    def __getattribute__(self, name: str) -> Any:
        own = object.__getattribute__(self, "__dict__")
        if _STATE in own and name not in own:
            state = _state(self, own)
            if name == "__dict__":
                return state
            value = state[name] if name in state else object.__getattribute__(self, name)
        else:
            value = object.__getattribute__(self, name)
        return value.read() if type(value) is StoredArray else value

    def __getstate__(self) -> dict[str, Any]:
        return dict(vars(self))


# Attributes of a value that lies in a file: its place, and its state while it is the last one read.
_STATE, _OPENED = "_stored_state", "_opened_state"
# Attributes that stay in memory, by which the increments of a history are told apart.
_AT_HAND = ("step", "index", "increments_in_step")
_last_read: weakref.ref[WithFields] | None = None


def _state(value: WithFields, own: dict[str, Any]) -> dict[str, Any]:
    global _last_read
    if _OPENED not in own:
        last = None if _last_read is None else _last_read()
        if last is not None:
            object.__getattribute__(last, "__dict__").pop(_OPENED, None)
        own[_OPENED] = own[_STATE].read()
        _last_read = weakref.ref(value)
    state: dict[str, Any] = own[_OPENED]
    return state


def stored_bytes(value: WithFields) -> int:
    """Of all arrays of a value [byte]."""
    return sum(getattr(array, "nbytes", 0) for array in vars(value).values())


class FieldStore:
    """Takes the values of one history in their order: the first ones stay in memory, those whose
    arrays are beyond `MAX_HELD` bytes go into a file. An array that a value shares with the one
    before, or has twice, is stored once."""

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
        return kept if self._file is None else self._stored(kept, self._file)

    def _stored(self, value: Value, file: IO[bytes]) -> Value:
        """Write the attributes of a value whose arrays are in the file or in memory."""
        state = dict(vars(value))
        arrays = {
            name: (array.offset, array.dtype.str, array.shape)
            for name, array in state.items()
            if isinstance(array, StoredArray)
        }
        light = {name: held for name, held in state.items() if name not in arrays}
        content = pickle.dumps((light, arrays))
        place = self._write(content)
        kept = object.__new__(type(value))
        vars(kept).update({name: light[name] for name in _AT_HAND if name in light})
        vars(kept)[_STATE] = _StoredState(file, place, len(content))
        return kept

    def _put(self, array: NDArray[Any]) -> NDArray[Any] | StoredArray:
        if self._held + array.nbytes <= MAX_HELD:
            self._held += array.nbytes
            return array
        place = self._write(np.ascontiguousarray(array).data)
        assert self._file is not None
        return StoredArray(self._file, place, array.dtype, array.shape)

    def _write(self, content: bytes | memoryview) -> int:
        """Append to the file; returns the place."""
        try:
            if self._file is None:
                # Open as long as a value has a field in it.
                self._file = tempfile.TemporaryFile(prefix="slipstick-")  # noqa: SIM115
            offset = self._file.seek(0, 2)
            self._file.write(content)
            self._file.flush()
        except OSError as error:
            folder = tempfile.tempdir or "temporary files"  # where there is none, asking raises
            error.filename = f"{folder} (TMPDIR), for the fields of increments"
            raise
        return offset
