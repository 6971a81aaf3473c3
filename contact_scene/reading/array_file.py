"""Arrays of a scene that are read from files: height maps and friction maps."""

import hashlib
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath
from typing import Annotated, Any

import numpy as np
from numpy.typing import NDArray
from pydantic import PlainSerializer, PlainValidator, ValidationInfo, WithJsonSchema
from pydantic_core import PydanticCustomError

from contact_scene.reading.scene_error import (
    refusal,
    shown,
)
from contact_scene.reading.text_table import TABLE_SUFFIXES, read_text_table

_MIN_SIDE = 4
_MAX_SIDE = 16384
_MAX_VALUES = 4096 * 4096  # 134 MB, more than the largest grid


@dataclass(frozen=True)
class ArrayFile:
    """Two-dimensional array of a scene with its file name; arrays with equal values compare equal.

    values  read-only, index [i, j] = (x_i, y_j); NaN for missing values
    name    name in the scene file; empty for an array made in Python
    digest  SHA-256 of shape and values
    """

    values: NDArray[np.float64] = field(compare=False, repr=False)
    name: str = field(compare=False)
    digest: str

    def __str__(self) -> str:
        return _array_name(self.name)

    @property
    def shape(self) -> tuple[int, int]:
        """Number of values of the height map or friction map along x and along y."""
        nx, ny = self.values.shape
        return nx, ny


def array_file(value: Any, info: ValidationInfo, least_side: int = _MIN_SIDE) -> ArrayFile:
    """Validate the value of a key that names a height map or friction map, and return the array.

    A scene file names a `.npy`, `.csv` or `.txt` file in or below its folder,
    `info.context["folder"]`. A stored run contains the array in `info.context["arrays"]`, by its
    key. Python code may pass any path or the array.

    value  file name, path or array
    info   key of the value, and context of the validation
    least_side
           least number of values along each side

    Raises a validation error for other values, and for a file that cannot be read.
    """
    if isinstance(value, ArrayFile):
        return value
    context, name = info.context or {}, ""
    if isinstance(value, str) and info.field_name in context.get("arrays", ()):
        value, name = context["arrays"][info.field_name], value
    if isinstance(value, np.ndarray):
        if type(value) not in (np.ndarray, np.memmap):  # units or masks would be lost
            hint = "pass its numbers in SI, without gaps, as a plain array"
            expected = "a plain numpy array or the name of a .npy file"
            raise refusal(f"got {shown(value)}", expected, hint)
        return _check_array(value, name, least_side)
    folder = context.get("folder")
    if isinstance(value, Path) and folder is None:
        value = str(value)
    if not isinstance(value, str) or not value:
        hint = "pass numpy.asarray(...) of it, in SI" if hasattr(value, "__array__") else ""
        raise refusal(f"got {shown(value)}", 'the name of a file such as "heights.npy"', hint)
    path = Path(value) if folder is None else _path_in_folder(folder, value)
    return _check_array(_read_array(path, value), value, least_side)


def _read_table(value: Any, info: ValidationInfo) -> ArrayFile:
    """Validate a key that names a table of two columns, such as a profile."""
    return array_file(value, info, least_side=2)


_AS_NAME = PlainSerializer(lambda array: array.name, return_type=str)
_SCHEMA = WithJsonSchema(
    {
        "type": "string",
        "pattern": r"\.(npy|csv|txt)$",
        "description": "name of a .npy, .csv or .txt file in or below the folder of the scene file",
    }
)
FileKey = Annotated[ArrayFile, PlainValidator(array_file), _AS_NAME, _SCHEMA]
TableKey = Annotated[ArrayFile, PlainValidator(_read_table), _AS_NAME, _SCHEMA]


def _path_in_folder(folder: Path, name: str) -> Path:
    """Resolve the name of an array file in a scene to its path.

    The file must be in or below the folder of the scene file. Raises a validation error for other
    names, and for links to other folders.

    folder  folder of the scene file
    name    file name, relative to the folder
    """
    relative = PurePosixPath(name)
    is_plain = not relative.is_absolute() and ".." not in relative.parts
    try:
        path = (folder / relative).resolve()
        inside = path.is_relative_to(folder.resolve())
        if is_plain and "\\" not in name and ":" not in name and inside:
            return path
    except (OSError, ValueError, RuntimeError):
        pass  # not a file name, or circular links
    raise refusal(
        f"got {shown(name)}", "a file in or below the folder of the scene file, relative to it"
    )


def _read_array(path: Path, name: str) -> NDArray[Any]:
    """Read the array of a height map or friction map from its file.

    The array of a `.npy` file is mapped into memory and allocates no memory. Other files are text.
    Raises a validation error for missing or incomplete files, and for other contents.

    path  path of the file
    name  name of the file in the scene, for messages
    """
    expected = (
        "a .npy file with a two-dimensional array of numbers (numpy.save writes it), or a .csv or "
        ".txt file with equally many numbers in every line"
    )
    try:
        if not path.is_file():
            raise refusal(f"there is no file {shown(name)}", expected)
        if path.suffix.lower() in TABLE_SUFFIXES:
            return _read_text_array(path, name)
        values = np.lib.format.open_memmap(path, mode="r")
        if path.stat().st_size > values.offset + values.nbytes:
            raise refusal(f"the file {shown(name)} is too long", "a complete .npy file")
        return values
    except PydanticCustomError:
        raise
    except (OSError, ValueError, EOFError, SyntaxError, TypeError, MemoryError) as error:
        reason = getattr(error, "strerror", None) or "it is no .npy file of numbers, or cut short"
        raise refusal(f"cannot read {shown(name)}: {reason}", expected) from None


def _read_text_array(path: Path, name: str) -> NDArray[Any]:
    """Read a height map or friction map from a text table in the orientation of a top view.

    x points to the right and y upwards. Raises a validation error for a field that is no number,
    rows of unequal length, and a list of points with their coordinates.

    path  path of the file
    name  name of the file in the scene, for messages
    """
    table = read_text_table(path, name)
    for row, (position, line) in zip(table.rows, table.lines, strict=True):
        if None in row:
            raise refusal(
                f"line {position} of {shown(name)} has a field that is no number: {shown(line)}",
                'a number or "nan" in every field, and "#" at the start of a heading',
            )
    counts = {len(row) for row in table.rows}
    if len(counts) > 1 or counts == {3}:
        few_to_many = " to ".join(map(str, sorted({min(counts), max(counts)})))
        raise refusal(
            f"the lines of {shown(name)} have {few_to_many} numbers",
            f"values without their coordinates, equally many in every line, at least {_MIN_SIDE}",
        )
    values = np.array(table.rows, dtype=np.float64).T[:, ::-1]
    return np.ascontiguousarray(values[:-1] if table.ends_with_separator else values)


def _array_name(name: str) -> str:
    return shown(name) if name else "in memory"


def _check_array(values: NDArray[Any], name: str, least_side: int = _MIN_SIDE) -> ArrayFile:
    """Check shape and type of the array of a height map or friction map, and copy it to float64.

    The checks precede the copy, which allocates memory. Raises a validation error for an array that
    is too small, too large, infinite or not of real numbers.

    values  array as read or as given in Python
    name    name of the file in the scene; empty for an array made in Python
    least_side
            least number of values along each side
    """
    nx, ny = shape = values.shape if values.ndim == 2 else (0, 0)
    expected = ""
    if not least_side <= min(shape) <= max(shape) <= _MAX_SIDE:
        expected = f"two dimensions (x, y) of {least_side} to {_MAX_SIDE} values each"
    elif nx * ny > _MAX_VALUES:
        expected = f"at most {_MAX_VALUES} values in all (4096 x 4096)"
    if expected:
        raise refusal(f"the array {_array_name(name)} has shape {values.shape}", expected)
    if values.dtype.kind not in "fiu":
        got = f"the array {_array_name(name)} holds values of type {values.dtype}"
        raise refusal(got, "real numbers")
    values = np.array(values, dtype=np.float64, order="C", subok=False)
    _refuse_values(np.isinf(values), values, name)
    values.flags.writeable = False
    digest = hashlib.sha256(repr(values.shape).encode())
    digest.update(values.data)
    return ArrayFile(values, name, digest.hexdigest())


def refuse_missing(array: ArrayFile) -> None:
    """Raise a validation error if a value of an array file is missing (NaN), with its position.

    array  array of a scene, such as a friction map
    """
    _refuse_values(np.isnan(array.values), array.values, array.name)


def _refuse_values(bad: NDArray[np.bool_], values: NDArray[np.float64], name: str) -> None:
    if np.any(bad):
        i, j = np.argwhere(bad)[0]
        raise refusal(
            f"the array {_array_name(name)} holds {values[i, j]} at [{i}, {j}]", "finite numbers"
        )
