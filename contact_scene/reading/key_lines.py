"""Lines of the keys of a TOML document, which `tomllib` does not report."""

import re
import tomllib
from collections.abc import Iterator
from itertools import count

from contact_scene.reading.scene_error import Path

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


class NestedTooDeep(ValueError):
    """More than `MAX_DEPTH` nested tables, arrays or dotted keys, on `line`."""

    def __init__(self, line: int) -> None:
        self.line = line
        super().__init__(f"line {line}")


def locate(document: str) -> dict[Path, int]:
    """Determine the line of every key and array entry of a valid document.

    Lines count from 1, array entries from 0. The line of a table is that of its header, else that
    of its first key. The time is linear in the length of the document. Raises `NestedTooDeep`, also
    for invalid documents.
    """
    lines: dict[Path, int] = {}
    entries: dict[Path, int] = {}  # number of [[tables]] so far
    table: Path = ()  # of the last header
    open_values: list[tuple[Path, Iterator[int] | None]] = []  # arrays with indices, inline tables
    brackets, keys, value = 0, list[str](), None
    for text, is_key, line in _tokens(document):
        path, indices = open_values[-1] if open_values else (table, None)
        if len(path) + len(keys) > MAX_DEPTH:
            raise NestedTooDeep(line)
        if text in ("]", "}") and open_values:
            value, _ = open_values.pop()
        elif text == "\n" and not open_values:
            if brackets and keys:
                table = _opened(keys, brackets == 2, line, lines, entries)
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
                value = path
                for key in keys:
                    value = (*value, key)
                    lines.setdefault(value, line)
            elif value is None and is_key:
                keys.append(_unquoted(text))
            else:
                brackets += text == "["
    return lines


def _tokens(document: str) -> Iterator[tuple[str, bool, int]]:
    """Yield tokens, with True for a possible key, and their lines; the last token ends a line."""
    line = 1
    for match in _TOKEN.finditer(document):
        if match.lastgroup != "blank":
            yield "\n" if match.lastgroup == "lines" else match[0], match.lastgroup == "key", line
        line += match[0].count("\n")
    yield "\n", False, line


def _opened(
    keys: list[str], is_entry: bool, line: int, lines: dict[Path, int], entries: dict[Path, int]
) -> Path:
    """Record the line of a header `[a.b]` or `[[a.b]]`; return the path of its table."""
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


def _unquoted(key: str) -> str:
    if key[0] not in "\"'":
        return key
    try:
        return next(iter(tomllib.loads(f"{key} = 0")))
    except ValueError:
        return key
