"""Changes of a scene document by dotted keys, as with the command-line option `--set key=value`.

A document is the content of a scene file: nested tables and arrays.
"""

import re
import tomllib
from dataclasses import replace
from typing import Any

from pydantic import BaseModel

from contact_scene.reading.scene_error import (
    Path,
    Problem,
    SceneError,
    shown,
)
from contact_scene.reading.toml_file import locate_keys

_MAX_PARTS = 20  # far more than any key of a scene has
_PART = re.compile(r"([A-Za-z0-9_-]+)((?:\[[0-9]{1,6}\])*)")
_EXPECTED = "key=value such as semi_analytical.cells=[128,128] or loading[2].increments=5"


def override(document: dict[str, Any], assignment: str, option: str = "--set") -> Path:
    """Set one key of a scene document to the value in an assignment, such as `--set key=value`.

    The document is the nested tables of a scene file and is changed in place. Missing tables are
    created, missing array entries are not. Raises `SceneError` and leaves the document unchanged if
    there is no such key.

    document    tables by their keys
    assignment  `dotted.key=value`. Array entries count from 1: `loading[2].increments=5`. A value
                that is not TOML, such as a bare word or `18 mm`, is a text
    option      name of the option that has the assignment, for messages
    returns     path of the key
    """
    key, equals, text = assignment.partition("=")
    source = origin(assignment, option)
    if not equals or not _parse_key(key.strip()) or not text.isprintable():
        raise SceneError([Problem((), f"got {shown(assignment)}", _EXPECTED, file=source)])
    return assign(document, key.strip(), _parse_value(text.strip()), source)


def assign(document: dict[str, Any], key: str, value: Any, source: str = "") -> Path:
    """Set one key of a scene document, the nested tables of a scene file, to a Python value.

    Missing tables are created, missing array entries are not. Raises `SceneError` and leaves the
    document unchanged if there is no such key.

    document  tables by their keys, changed in place
    key       dotted key. Array entries count from 1: `loading[2].increments`
    value     new value
    source    name of the option that sets the key, for messages
    returns   path of the key
    """
    path = _parse_key(key)
    if not path:
        expected = "a key such as loading[2].increments"
        raise SceneError([Problem((), f"got the key {shown(key)}", expected)])
    document.update(_replace_value(document, path, value, Problem(path, "", file=source)))
    return path


def _replace_value(holder: Any, path: Path, value: Any, problem: Problem) -> Any:
    """Return a copy of a part of a scene document, with another value at a path of keys.

    The document is the nested tables of a scene file. Raises `SceneError` for a path that does not
    exist.

    holder   table, model or array of the document
    path     keys and indices from `holder` to the value; missing tables are created
    value    new value
    problem  template of the error
    """
    if not path:
        return value
    part, entries = path[0], list(holder) if isinstance(holder, list | tuple) else None
    if isinstance(part, str):
        if not isinstance(holder, dict | BaseModel):
            hint = "" if entries is None else "entries count from 1: loading[1].normal_force"
            message = f"{part} is not a key of a table"
            raise SceneError([replace(problem, message=message, hint=hint)])
        table = dict(holder)
        return table | {part: _replace_value(table.get(part, {}), path[1:], value, problem)}
    if entries is None:
        raise SceneError([replace(problem, message=f"there is no array for entry {part + 1}")])
    if not 0 <= part < len(entries):
        expected = f"1 to {len(entries)}" if entries else "none: the array is empty"
        message = f"there is no entry {part + 1}"
        raise SceneError([replace(problem, message=message, expected=expected)])
    entries[part] = _replace_value(entries[part], path[1:], value, problem)
    return entries


def _parse_key(key: str) -> Path:
    path: list[str | int] = []
    for part in key.split(".", _MAX_PARTS):
        match = _PART.fullmatch(part.strip())
        if match is None:
            return ()
        path.append(match[1])
        path += [int(index) - 1 for index in re.findall(r"[0-9]+", match[2])]
    return tuple(path) if len(path) <= _MAX_PARTS else ()


def _parse_value(text: str) -> Any:
    try:
        locate_keys(f"value = {text}")  # refuses deep nesting, on which the parser would recurse
        return tomllib.loads(f"value = {text}")["value"]
    except (ValueError, RecursionError):
        return text


def origin(assignment: str, option: str = "--set") -> str:
    """Return the text that names an assignment of a key in messages, such as "--set key=value".

    Messages contain the text in place of the name of a scene file.

    assignment  `dotted.key=value`
    option      name of the option that has the assignment
    """
    return f"{option} {shown(assignment)[1:-1]}"
