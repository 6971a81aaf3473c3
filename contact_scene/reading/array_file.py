"""Arrays that a scene takes from a file: height maps and maps of friction."""

import hashlib
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath
from typing import Annotated, Any, BinaryIO

import numpy as np
from numpy.typing import NDArray
from pydantic import PlainSerializer, PlainValidator, ValidationInfo, WithJsonSchema
from pydantic_core import PydanticCustomError

from contact_scene.reading.validator_error import (
    refusal,
    shown,
)

_FEWEST, _MOST = 4, 16384
_MOST_VALUES = 4096 * 4096  # 134 MB, more than any grid has that can be solved on
_AT_ONCE = 1 << 20
_MOST_TEXT = 1 << 28  # bytes
# Of a text file, where an instrument has found no surface; in lower case.
_MISSING = {"", "nan", "bad", "na", "n/a", "null", "***", "---"}


@dataclass(frozen=True)
class ArrayFile:
    """A two-dimensional array and the name it came by; equal by content.

    values  read-only, index [i, j] = (x_i, y_j); NaN where a text file or an array has no value
    name    as the scene file names it; empty for an array made in Python
    digest  SHA-256 of shape and values
    """

    values: NDArray[np.float64] = field(compare=False, repr=False)
    name: str = field(compare=False)
    digest: str

    def __str__(self) -> str:
        return _named(self.name)

    @property
    def shape(self) -> tuple[int, int]:
        """Number of values along x and along y."""
        nx, ny = self.values.shape
        return nx, ny


def array_file(value: Any, info: ValidationInfo) -> ArrayFile:
    """Return the array that a file key names.

    A scene file names a `.npy`, `.csv` or `.txt` file in or below its own folder,
    `info.context["folder"]`. A stored run has the array by the name of its key, in
    `info.context["arrays"]`. Python code may pass any path or the array itself.
    """
    if isinstance(value, ArrayFile):
        return value
    context, name = info.context or {}, ""
    if isinstance(value, str) and info.field_name in context.get("arrays", ()):
        value, name = context["arrays"][info.field_name], value
    if isinstance(value, np.ndarray):
        _check_plain(value)
        _check_shape(value.shape, name)
        return _checked(np.array(value, dtype=np.float64, order="C"), name)
    folder = context.get("folder")
    if isinstance(value, Path) and folder is None:
        value = str(value)
    if not isinstance(value, str) or not value:
        hint = "hand over numpy.asarray(...) of it, in SI" if hasattr(value, "__array__") else ""
        raise refusal(f"got {shown(value)}", 'the name of a file such as "heights.npy"', hint)
    path = Path(value) if folder is None else _inside(folder, value)
    return _checked(_read(path, value), value)


FileKey = Annotated[
    ArrayFile,
    PlainValidator(array_file),
    PlainSerializer(lambda array: array.name, return_type=str),
    WithJsonSchema(
        {
            "type": "string",
            "pattern": r"\.(npy|csv|txt)$",
            "description": "name of a .npy, .csv or .txt file in or below the folder of the scene "
            "file",
        }
    ),
]


def _inside(folder: Path, name: str) -> Path:
    """The path of a file in or below the folder; links must not lead out of it either."""
    relative = PurePosixPath(name)
    is_plain = not relative.is_absolute() and ".." not in relative.parts
    try:
        path = (folder / relative).resolve()
        if is_plain and "\\" not in name and ":" not in name and _holds(folder, path):
            return path
    except (OSError, ValueError, RuntimeError):
        pass  # no name of a file, or links in a circle
    raise refusal(
        f"got {shown(name)}", "a file in or below the folder of the scene file, relative to it"
    )


def _holds(folder: Path, path: Path) -> bool:
    return path.is_relative_to(folder.resolve())


def _read(path: Path, name: str) -> NDArray[np.float64]:
    """The array in a file; of a `.npy` file a part at a time: two whole ones take too much
    memory."""
    expected = (
        "a .npy file with a two-dimensional array of numbers (numpy.save writes it), or a .csv or "
        ".txt file with as many numbers in every line"
    )
    try:
        if not path.is_file():
            raise refusal(f"there is no file {shown(name)}", expected)
        if path.suffix.lower() in (".csv", ".txt"):
            values = _text(path, name)
            _check_shape(values.shape, name)
            return values
        with path.open("rb") as stream:
            shape, by_columns, dtype = _header(stream, path.stat().st_size, name)
            values = np.empty(shape)
            lines = values.T if by_columns else values
            count = _AT_ONCE // lines.shape[1]
            for begin in range(0, len(lines), count):
                some = lines[begin : begin + count]
                read = np.frombuffer(stream.read(some.size * dtype.itemsize), dtype)
                some[:] = read.reshape(some.shape)
            return values
    except PydanticCustomError:
        raise
    except (OSError, ValueError, EOFError, SyntaxError, TypeError, MemoryError) as error:
        reason = getattr(error, "strerror", None) or "not a .npy file"
        raise refusal(f"cannot read {shown(name)}: {reason}", expected) from None


def _text(path: Path, name: str) -> NDArray[np.float64]:
    """The array in a text file, printed as it is seen from above: x to the right, y upwards.

    Fields are separated by semicolons, tabs, commas or spaces; lines before the first numbers are
    skipped. Fields of `_MISSING` are NaN.
    """
    if path.stat().st_size > _MOST_TEXT:
        raise refusal(f"the file {shown(name)} is too long", "a .npy file of so many numbers")
    lines = path.read_text(encoding="utf-8-sig", errors="replace").splitlines()
    lines = [line for line in lines if line.strip() and line.strip()[0] not in "#%"]
    last = lines[-1] if lines else ""
    separator = next((mark for mark in ";\t," if mark in last), None)
    rows: list[list[float]] = []
    for line in lines:
        fields = (line if separator == "," else line.replace(",", ".")).split(separator)
        try:
            rows.append([np.nan if f.strip().lower() in _MISSING else float(f) for f in fields])
        except ValueError:
            if rows:
                raise refusal(f"{shown(name)} has no number in {shown(line)}", "") from None
    counts = {len(row) for row in rows}
    if len(counts) > 1 or counts == {3}:
        got = f"the lines of {shown(name)} have {min(counts)} to {max(counts)} numbers"
        raise refusal(got, "values alone, in rows and columns, as many in every line")
    values = np.array(rows or [[]]).T[:, ::-1]
    if separator and last.endswith(separator):
        values = values[:-1]
    return np.ascontiguousarray(values)


def _header(stream: BinaryIO, size: int, name: str) -> tuple[tuple[int, ...], bool, np.dtype[Any]]:
    """Shape, whether columns come first, and type; what the header announces is refused here if
    need be, before anything is allocated for it."""
    version = np.lib.format.read_magic(stream)
    read_header = {
        (1, 0): np.lib.format.read_array_header_1_0,
        (2, 0): np.lib.format.read_array_header_2_0,
    }.get(version)
    if read_header is None:
        raise ValueError(f"version {version} of the format")
    shape, by_columns, dtype = read_header(stream)
    _check_shape(shape, name)
    _check_type(dtype, name)
    if size - stream.tell() != shape[0] * shape[1] * dtype.itemsize:
        raise refusal(f"the file {shown(name)} is cut short or has a tail", "a whole .npy file")
    return shape, by_columns, dtype


def _named(name: str) -> str:
    return shown(name) if name else "in memory"


def _check_plain(value: NDArray[Any]) -> None:
    """Refuse what is more than its numbers: units and masks would be lost."""
    if type(value) not in (np.ndarray, np.memmap):
        hint = "hand over its numbers in SI, without gaps, as a plain array"
        raise refusal(f"got {shown(value)}", "a plain numpy array or the name of a .npy file", hint)
    _check_type(value.dtype, "")


def _check_type(dtype: np.dtype[Any], name: str) -> None:
    if dtype.kind not in "fiu":
        raise refusal(f"the array {_named(name)} holds values of type {dtype}", "real numbers")


def _check_shape(shape: tuple[int, ...], name: str) -> None:
    if len(shape) != 2 or not _FEWEST <= min(shape) <= max(shape) <= _MOST:
        expected = f"two dimensions (x, y) of {_FEWEST} to {_MOST} values each"
    elif shape[0] * shape[1] > _MOST_VALUES:
        expected = f"at most {_MOST_VALUES} values in all, as 4096 x 4096 are"
    else:
        return
    raise refusal(f"the array {_named(name)} has shape {tuple(shape)}", expected)


def _checked(values: NDArray[np.float64], name: str) -> ArrayFile:
    _refuse(np.isinf(values), values, name)
    values.flags.writeable = False
    digest = hashlib.sha256(repr(values.shape).encode())
    digest.update(values.data)
    return ArrayFile(values, name, digest.hexdigest())


def refuse_missing(array: ArrayFile) -> None:
    """Refuse an array with NaN; raises a refusal that names the first one."""
    _refuse(np.isnan(array.values), array.values, array.name)


def _refuse(bad: NDArray[np.bool_], values: NDArray[np.float64], name: str) -> None:
    if np.any(bad):
        i, j = np.argwhere(bad)[0]
        raise refusal(
            f"the array {_named(name)} holds {values[i, j]} at [{i}, {j}]", "finite numbers"
        )
