"""Changing keys of a scene document by their dotted names, as `--set key=value` does."""

import re
import tomllib
from typing import Any

from pydantic import BaseModel

from contact_scene.reading.key_lines import locate
from contact_scene.reading.scene_error import (
    Path,
    Problem,
    SceneError,
)
from contact_scene.reading.validator_error import shown

_MOST_PARTS = 20  # far more than any key of a scene has
_PART = re.compile(r"([A-Za-z0-9_-]+)((?:\[[0-9]{1,6}\])*)")
_EXPECTED = "key=value such as semi_analytical.cells=[128,128] or loading[2].increments=5"


def override(document: dict[str, Any], assignment: str) -> Path:
    """Set one key of the document, in place; returns its path.

    assignment  `dotted.key=value`; entries of an array count from 1, as in messages:
                `loading[2].increments=5` is the second step. The value is TOML; what is not,
                such as a bare word or `18 mm`, is a text.
    Tables that are not there are made, entries of arrays are not. Raises `SceneError`, with the
    document as it was.
    """
    key, equals, text = assignment.partition("=")
    path = _path(key.strip())
    if not equals or not path or not text.isprintable():
        raise _refused(origin(assignment), f"got {shown(assignment)}", _EXPECTED)
    _set(document, path, _value(text.strip()), origin(assignment))
    return path


def assign(document: dict[str, Any], key: str, value: Any) -> None:
    """Set one key of the document, in place, to a value in Python; see `override`.

    Parts of a scene that hold the key become tables. Raises `SceneError`.
    """
    path = _path(key)
    if not path:
        raise _refused("", f"got the key {shown(key)}", "a key such as loading[2].increments")
    _set(document, path, value, "")


def _set(document: dict[str, Any], path: Path, value: Any, source: str) -> None:
    """Set the value at a path.

    source  of the value, for messages
    """
    _open(document, path[:-1])
    holder: Any = document
    for part in path:
        _check_step(holder, part, path, source)
        holder = holder.get(part, {}) if isinstance(holder, dict) else holder[part]
    holder = document
    for part, following in zip(path, (*path[1:], None), strict=True):
        if following is None:
            holder[part] = value
        elif isinstance(holder, dict):
            holder = holder.setdefault(part, {})
        else:
            holder = holder[part]


def _open(holder: Any, path: Path) -> None:
    """Replace the parts of a scene along a path by tables, and tuples by arrays."""
    for part in path:
        try:
            inner = holder[part]
        except (LookupError, TypeError):  # reported with the key
            return
        if isinstance(inner, BaseModel):
            inner = holder[part] = dict(inner)
        elif isinstance(inner, tuple):
            inner = holder[part] = list(inner)
        holder = inner


def _path(key: str) -> Path:
    path: list[str | int] = []
    for part in key.split(".", _MOST_PARTS):
        match = _PART.fullmatch(part.strip())
        if match is None:
            return ()
        path.append(match[1])
        path += [int(index) - 1 for index in re.findall(r"[0-9]+", match[2])]
    return tuple(path) if len(path) <= _MOST_PARTS else ()


def _check_step(holder: Any, part: str | int, path: Path, source: str) -> None:
    if isinstance(part, str) and not isinstance(holder, dict):
        hint = "entries count from 1: loading[1].normal_force" if isinstance(holder, list) else ""
        raise _refused(source, f"{part} is not a key of a table", "", hint, path)
    if isinstance(part, int):
        if not isinstance(holder, list):
            raise _refused(source, f"there is no array for entry {part + 1}", "", "", path)
        if not 0 <= part < len(holder):
            there = f"1 to {len(holder)}" if holder else "none: the array is empty"
            raise _refused(source, f"there is no entry {part + 1}", there, "", path)


def _value(text: str) -> Any:
    try:
        locate(f"value = {text}")  # refuses nesting before the parser recurses
        return tomllib.loads(f"value = {text}")["value"]
    except (ValueError, RecursionError):
        return text


def _refused(
    source: str, message: str, expected: str = "", hint: str = "", path: Path = ()
) -> SceneError:
    return SceneError([Problem(path, message, expected, hint, file=source)])


def origin(assignment: str) -> str:
    """How messages name an override in place of a file."""
    return f"--set {shown(assignment)[1:-1]}"
