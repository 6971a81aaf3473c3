"""Lines of the keys of a TOML document, which `tomllib` does not report.

The scanner reads valid documents exactly. In others it is right up to the mistake, which `tomllib`
reports.
"""

import re
import tomllib
from collections.abc import Iterator

from contact_scene.reading.scene_error import Path

DEEPEST = 100

# Repeats that never give back (`*+`): others remember every place that they might go back to.
_TOKEN = re.compile(
    r"""(?P<blank>[ \t\r]+|\#[^\n]*)
    |(?P<key>[^\s\[\]{}=,.\#"']+
        |\"\"\"(?:[^"\\]+|\\.|"(?!""))*+\"\"\""{0,2}|'''.*?''''{0,2}
        |"(?:[^"\\\n]+|\\.)*+"|'[^'\n]*')
    |(?P<lines>\n(?:[ \t\r\n]+|\#[^\n]*)*+)
    |(?P<mark>.)""",
    re.DOTALL | re.VERBOSE,
)
_END = ("\n", "")


class NestedTooDeep(ValueError):
    """More than `DEEPEST` tables, arrays or dotted keys within each other, on `line`."""

    def __init__(self, line: int) -> None:
        self.line = line
        super().__init__(f"line {line}")


def locate(document: str) -> dict[Path, int]:
    """Return the lines, counted from 1, of every key and array entry, counted from 0.

    A table counts from its header, or else from the first key within it. Takes time linear in the
    length of the document; raises `NestedTooDeep`.
    """
    scanner = _Scanner(document)
    scanner.scan()
    return scanner.lines


class _Scanner:
    """The token at the cursor, empty at the end, and the lines of the keys before it."""

    def __init__(self, document: str) -> None:
        self.lines: dict[Path, int] = {}
        self._entries: dict[Path, int] = {}  # number of [[tables]] so far
        self._tokens = self._read(document)
        self._next()

    def _read(self, document: str) -> Iterator[tuple[str, bool, int]]:
        """Tokens, whether they may be a key, and their lines."""
        line = 1
        for match in _TOKEN.finditer(document):
            if match.lastgroup != "blank":
                text = "\n" if match.lastgroup == "lines" else match[0]
                yield text, match.lastgroup == "key", line
            line += match[0].count("\n")
        while True:
            yield "", False, line

    def _next(self) -> None:
        self._text, self._is_key, self._line = next(self._tokens)

    def scan(self) -> None:
        """Read the whole document."""
        table: Path = ()
        while self._text:
            if self._text == "[":
                table = self._header()
            elif not self._pair(table):
                self._skip_to(*_END)
            if self._text == "\n":
                self._next()

    def _skip_to(self, *ends: str) -> None:
        while self._text not in ends:
            self._next()

    def _header(self) -> Path:
        """Read `[a.b]` or `[[a.b]]`; returns the path of the table that it opens."""
        line = self._line
        self._next()
        is_array = self._text == "["
        if is_array:
            self._next()
        keys = self._keys()
        self._skip_to(*_END)
        table: Path = ()
        for depth, key in enumerate(keys, start=1):
            table = (*table, key)
            self.lines.setdefault(table, line)
            if is_array and depth == len(keys):
                self._entries[table] = self._entries.get(table, 0) + 1
            if table in self._entries:
                table = (*table, self._entries[table] - 1)
                self.lines.setdefault(table, line)
        # Its own header settles the line of a table known so far from a header further in.
        self.lines[table] = line
        return table

    def _keys(self) -> list[str]:
        """Read the parts of a dotted key; empty where there is none."""
        keys: list[str] = []
        while self._is_key:
            keys.append(_unquoted(self._text))
            self._check_depth(len(keys))
            self._next()
            if self._text != ".":
                return keys
            self._next()
        return []

    def _pair(self, table: Path, depth: int = 0) -> bool:
        """Read `a.b = value`; returns whether there was one."""
        line, keys = self._line, self._keys()
        self._check_depth(depth + len(keys))
        if not keys or self._text != "=":
            return False
        self._next()
        for key in keys:
            table = (*table, key)
            self.lines.setdefault(table, line)
        self._value(table, depth + len(keys))
        return True

    def _value(self, path: Path, depth: int) -> None:
        self._check_depth(depth)
        opening = self._text
        if opening not in ("[", "{"):
            self._skip_to(",", "]", "}", *_END)
            return
        self._next()
        index = 0
        while self._text not in ("]", "}", ""):
            if self._text in (",", "\n"):
                self._next()
            elif opening == "{":
                if not self._pair(path, depth + 1):
                    self._next()
            else:
                self.lines.setdefault((*path, index), self._line)
                self._value((*path, index), depth + 1)
                index += 1
        self._next()

    def _check_depth(self, depth: int) -> None:
        if depth > DEEPEST:
            raise NestedTooDeep(self._line)


def _unquoted(key: str) -> str:
    if key[0] not in "\"'":
        return key
    try:
        return next(iter(tomllib.loads(f"{key} = 0")))
    except ValueError:
        return key
