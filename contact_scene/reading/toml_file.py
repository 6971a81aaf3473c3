"""Reading of a TOML file of limited size, with the lines of its keys."""

import re
import sys
import tomllib
from pathlib import Path as FilePath
from typing import Any

from contact_scene.loading import MAX_STEPS
from contact_scene.reading.key_lines import (
    MAX_DEPTH,
    NestedTooDeep,
    locate,
)
from contact_scene.reading.scene_error import (
    Path,
    Problem,
    SceneError,
)

_MAX_SIZE = 10_000_000
# Every key, entry, table and escape contains one of the counted characters, and the longest load
# step seven. The limit bounds time and memory of reading.
_MAX_SIGNS = 7 * MAX_STEPS
_MAX_DIGITS = sys.int_info.default_max_str_digits
_LONG_NUMBER = re.compile(rf"[0-9](?:_?[0-9]){{{_MAX_DIGITS},}}+")


def read_toml(file: FilePath) -> tuple[dict[str, Any], dict[Path, int]]:
    """Read a TOML file; return its contents and the line of every key. Raises `SceneError`."""
    text = _text(file)
    try:
        lines = locate(text)  # first, since its limits let tomllib read in linear time
        return tomllib.loads(text), lines
    except NestedTooDeep as error:
        raise _refused(file, "nested too deep", f"at most {MAX_DEPTH} levels", error.line) from None
    except (ValueError, RecursionError) as error:
        place = re.search(r" \(at line (\d+), column (\d+)\)", str(error))
        line = int(place[1]) if place else text.count("\n") + 1
        column = f" (column {place[2]})" if place else ""
        reason = str(error).partition(" (at ")[0]
        if (long := _LONG_NUMBER.search(text)) and "int_max_str_digits" in reason:
            line = text.count("\n", 0, long.start()) + 1
            reason = f"a whole number of more than {_MAX_DIGITS} digits"
        raise _refused(file, f"not valid TOML: {reason}{column}", line=line) from None


def _text(file: FilePath) -> str:
    try:
        if not file.is_file():
            other = "is a folder" if file.is_dir() else "is not a regular file"
            message = other if file.exists() else "there is no such file"
            raise _refused(file, message, "a scene file (TOML)")
        with file.open("rb") as stream:
            contents = stream.read(_MAX_SIZE + 1)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or "not a file name"
        raise _refused(file, f"cannot be read: {reason}") from None
    if len(contents) > _MAX_SIZE:
        raise _refused(file, "is too large", f"at most {_MAX_SIZE // 10**6} MB")
    try:
        text = contents.removeprefix(b"\xef\xbb\xbf").decode("utf-8")
    except UnicodeDecodeError as error:
        line = contents.count(b"\n", 0, error.start) + 1
        raise _refused(file, "is not text in UTF-8", line=line) from None
    if not text.strip():
        raise _refused(file, "is empty", "a scene (TOML)")
    if sum(map(text.count, "=,[\\")) > _MAX_SIGNS:
        raise _refused(file, "holds too many keys or escapes", f"at most {MAX_STEPS} loading steps")
    return text


def _refused(
    file: FilePath, message: str, expected: str = "", line: int | None = None
) -> SceneError:
    return SceneError([Problem((), message, expected, file=str(file), line=line)])
