"""Reading of a TOML file of limited size, with the line of each of its keys.

The lines are for error messages; Python's `tomllib` does not report them.
"""

import re
import sys
import tomllib
from collections.abc import Iterator
from itertools import count
from pathlib import Path as FilePath
from typing import Any

from contact_scene.loading import MAX_STEPS
from contact_scene.reading.scene_error import Path, Problem, SceneError

_MAX_SIZE = 10_000_000
# Every key, entry, table and escape contains one of the counted characters, and the longest load
# step seven. The limit bounds time and memory of reading.
_MAX_SIGNS = 7 * MAX_STEPS
_MAX_DIGITS = sys.int_info.default_max_str_digits
_LONG_NUMBER = re.compile(rf"[0-9](?:_?[0-9]){{{_MAX_DIGITS},}}+")
# A number and the letter after it, at which reading stops: a value with a unit but without quotes.
_BARE_UNIT = re.compile(r"[=,\[]\s*[-+]?\d[\d._]*(?:[eE][-+]?\d+)?[ \t]*[A-Za-zµμ°%]$")
MAX_DEPTH = 100

# Possessive repeats (`*+`) need no memory for backtracking.
_TOKEN = re.compile(
    r"""(?P<blank>[ \t\r]+|\#[^\n]*)
    |(?P<key>[^\s\[\]{}=,.\#"']+
        |\"\"\"(?:[^"\\]+|\\.|"(?!""))*+\"\"\""{0,2}|'''.*?''''{0,2}
        |"(?:[^"\\\n]+|\\.)*+"|'[^'\n]*')
    |(?P<lines>\n(?:[ \t\r\n]+|\#[^\n]*)*+)
    |(?P<mark>.)""",
    re.DOTALL | re.VERBOSE,
)


def read_toml(file: FilePath) -> tuple[dict[str, Any], dict[Path, int]]:
    """Read a scene file in TOML, and determine the line of each of its keys for error messages.

    file     path of the scene file
    returns  contents of the file; line of every key and array entry

    Raises `SceneError` for a file that is missing, too large or not valid.
    """
    text = _read_text(file)
    try:
        lines = locate_keys(text)  # first, since its limits let tomllib read in linear time
        return tomllib.loads(text), lines
    except NestedTooDeep as error:
        raise _file_error(
            file, "nested too deep", f"at most {MAX_DEPTH} levels", error.line
        ) from None
    except (ValueError, RecursionError) as error:
        place = re.search(r" \(at line (\d+), column (\d+)\)", str(error))
        line = int(place[1]) if place else text.count("\n") + 1
        column = f" (column {place[2]})" if place else ""
        reason = str(error).partition(" (at ")[0]
        if (long := _LONG_NUMBER.search(text)) and "int_max_str_digits" in reason:
            line = text.count("\n", 0, long.start()) + 1
            reason = f"a whole number of more than {_MAX_DIGITS} digits"
        expected = ""
        if place and _BARE_UNIT.search(text.split("\n")[line - 1][: int(place[2])]):
            expected = 'values with units in quotes, such as "1 kN"'
        if repeated := re.match(r"Cannot declare \('(loading|layers)',\) twice", reason):
            expected = f"[[{repeated[1]}]], with double brackets, for each entry"
        raise _file_error(file, f"not valid TOML: {reason}{column}", expected, line) from None


def _read_text(file: FilePath) -> str:
    try:
        if not file.is_file():
            other = "is a folder" if file.is_dir() else "is not a regular file"
            message = other if file.exists() else "there is no such file"
            raise _file_error(file, message, "a scene file (TOML)")
        with file.open("rb") as stream:
            contents = stream.read(_MAX_SIZE + 1)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or "not a file name"
        raise _file_error(file, f"cannot be read: {reason}") from None
    if len(contents) > _MAX_SIZE:
        raise _file_error(file, "is too large", f"at most {_MAX_SIZE // 10**6} MB")
    try:
        text = contents.removeprefix(b"\xef\xbb\xbf").decode("utf-8")
    except UnicodeDecodeError as error:
        line = contents.count(b"\n", 0, error.start) + 1
        raise _file_error(file, "is not text in UTF-8", line=line) from None
    if not text.strip():
        raise _file_error(file, "is empty", "a scene (TOML)")
    if sum(map(text.count, "=,[\\")) > _MAX_SIGNS:
        raise _file_error(
            file, "holds too many keys or escapes", f"at most {MAX_STEPS} loading steps"
        )
    return text


def _file_error(
    file: FilePath, message: str, expected: str = "", line: int | None = None
) -> SceneError:
    return SceneError([Problem((), message, expected, file=str(file), line=line)])


class NestedTooDeep(ValueError):
    """Error for a scene file with more than `MAX_DEPTH` nested tables, arrays or dotted keys.

    line  line in the file at which the limit is exceeded
    """

    def __init__(self, line: int) -> None:
        self.line = line
        super().__init__(f"line {line}")


def locate_keys(document: str) -> dict[Path, int]:
    """Determine the line of every key and array entry of a valid TOML document.

    Used to state the line of a mistake in a scene file. Lines count from 1, array entries from 0.
    The line of a table is that of its header, else that of its first key. The time is linear in the
    length of the document.

    Raises `NestedTooDeep`, also for invalid documents.
    """
    lines: dict[Path, int] = {}
    entries: dict[Path, int] = {}  # number of [[tables]] so far
    table: Path = ()  # of the last header
    open_values: list[tuple[Path, Iterator[int] | None]] = []  # arrays with indices, inline tables
    brackets, keys, value = 0, list[str](), None
    for text, is_key, line in _toml_tokens(document):
        path, indices = open_values[-1] if open_values else (table, None)
        if len(path) + len(keys) > MAX_DEPTH:
            raise NestedTooDeep(line)
        if text in ("]", "}") and open_values:
            value, _ = open_values.pop()
        elif text == "\n" and not open_values:
            if brackets and keys:
                table = _open_table(keys, brackets == 2, line, lines, entries)
            brackets, keys, value = 0, [], None
        elif text == ",":
            keys, value = [], None
        elif text != "\n":
            if indices is not None and value is None:
                value = (*path, next(indices))
                lines.setdefault(value, line)
            if value is not None and text in ("[", "{"):
                open_values.append((value, count() if text == "[" else None))
                keys, value = [], None
            elif value is None and text == "=":
                value = _record_keys(path, keys, line, lines)
            elif value is None and is_key:
                keys.append(_unquote_key(text))
            else:
                brackets += text == "["
    return lines


def _record_keys(table: Path, keys: list[str], line: int, lines: dict[Path, int]) -> Path:
    """Record the line of dotted keys `a.b` of a table in `lines`, and return the last path."""
    for key in keys:
        table = (*table, key)
        lines.setdefault(table, line)
    return table


def _toml_tokens(document: str) -> Iterator[tuple[str, bool, int]]:
    """Yield the tokens of a TOML document: text, True if it may be a key, and line.

    Tokens are keys, values, marks and ends of lines. The last token ends a line.
    """
    line = 1
    for match in _TOKEN.finditer(document):
        if match.lastgroup != "blank":
            yield "\n" if match.lastgroup == "lines" else match[0], match.lastgroup == "key", line
        line += match[0].count("\n")
    yield "\n", False, line


def _open_table(
    keys: list[str], is_entry: bool, line: int, lines: dict[Path, int], entries: dict[Path, int]
) -> Path:
    """Record the line of a TOML table header `[a.b]` or `[[a.b]]`, for error messages.

    keys      keys of the header
    is_entry  True for a header in double brackets, which adds an entry to an array of tables
    line      line of the header
    lines     line of each path, which is changed in place
    entries   number of entries so far of each array of tables, which is changed in place
    returns   path of the table
    """
    table: Path = ()
    for depth, key in enumerate(keys, start=1):
        table = (*table, key)
        lines.setdefault(table, line)
        if is_entry and depth == len(keys):
            entries[table] = entries.get(table, 0) + 1
        if table in entries:
            table = (*table, entries[table] - 1)
            lines.setdefault(table, line)
    lines[table] = line  # also if a header of a table inside came first
    return table


def _unquote_key(key: str) -> str:
    if key[0] not in "\"'":
        return key
    try:
        return next(iter(tomllib.loads(f"{key} = 0")))
    except ValueError:
        return key
