"""Changing keys of a scene document from the command line: `--set key=value`."""

import re
import tomllib
from typing import Any

from contact_scene.locator import locate
from contact_scene.problem import Path, Problem, SceneError
from contact_scene.refusal import shown

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
        raise _refused(assignment, f"got {shown(assignment)}", _EXPECTED)
    _check_steps(document, path, assignment)
    holder: Any = document
    for part, following in zip(path, (*path[1:], None), strict=True):
        if following is None:
            holder[part] = _value(text.strip())
        elif isinstance(holder, dict):
            holder = holder.setdefault(part, {})
        else:
            holder = holder[part]
    return path


def _path(key: str) -> Path:
    path: list[str | int] = []
    for part in key.split(".", _MOST_PARTS):
        match = _PART.fullmatch(part.strip())
        if match is None:
            return ()
        path.append(match[1])
        path += [int(index) - 1 for index in re.findall(r"[0-9]+", match[2])]
    return tuple(path) if len(path) <= _MOST_PARTS else ()


def _check_steps(document: dict[str, Any], path: Path, assignment: str) -> None:
    holder: Any = document
    for part in path:
        _check_step(holder, part, path, assignment)
        holder = holder.get(part, {}) if isinstance(holder, dict) else holder[part]


def _check_step(holder: Any, part: str | int, path: Path, assignment: str) -> None:
    if isinstance(part, str) and not isinstance(holder, dict):
        hint = "entries count from 1: loading[1].normal_force" if isinstance(holder, list) else ""
        raise _refused(assignment, f"{part} is not a key of a table", "", hint, path)
    if isinstance(part, int):
        if not isinstance(holder, list):
            raise _refused(assignment, f"there is no array for entry {part + 1}", "", "", path)
        if not 0 <= part < len(holder):
            there = f"1 to {len(holder)}" if holder else "none: the array is empty"
            raise _refused(assignment, f"there is no entry {part + 1}", there, "", path)


def _value(text: str) -> Any:
    try:
        locate(f"value = {text}")  # refuses nesting before the parser recurses
        return tomllib.loads(f"value = {text}")["value"]
    except (ValueError, RecursionError):
        return text


def _refused(
    assignment: str, message: str, expected: str = "", hint: str = "", path: Path = ()
) -> SceneError:
    return SceneError([Problem(path, message, expected, hint, file=origin(assignment))])


def origin(assignment: str) -> str:
    """How messages name an override in place of a file."""
    return f"--set {shown(assignment)[1:-1]}"
