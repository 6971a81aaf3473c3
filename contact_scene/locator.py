"""On which line of a TOML document a key is: `tomllib` does not tell.

The scanner reads documents that are valid TOML exactly. On others it does not fail: what it finds
up to the mistake is right, and `tomllib` will report the mistake itself.
"""

import re

from contact_scene.problem import Path

DEEPEST = 100

_BLANK = re.compile(r"[ \t\r]*")
# Repeats that never give back (`*+`): others remember every place that they might go back to.
_BLANK_LINES = re.compile(r"(?:[ \t\r\n]+|#[^\n]*)*+")
_TO_END_OF_LINE = re.compile(r"[^\n]*")
_KEY = re.compile(r"[A-Za-z0-9_-]+|'([^'\n]*)'|\"((?:[^\"\\\n]+|\\.)*+)\"")
_STRING = re.compile(
    r"\"\"\"(?:[^\"\\]+|\\.|\"(?!\"\"))*+\"\"\"\"{0,2}|'''.*?''''{0,2}"
    r"|\"(?:[^\"\\\n]+|\\.)*+\"|'[^'\n]*'",
    re.DOTALL,
)
_SCALAR = re.compile(r"[^,\]}#\n]*")
_ESCAPE = re.compile(r"\\(?:u([0-9a-fA-F]{4})|U([0-9a-fA-F]{8})|(.))", re.DOTALL)
_ESCAPES = {"b": "\b", "t": "\t", "n": "\n", "f": "\f", "r": "\r"}


class NestedTooDeep(ValueError):
    """More than `DEEPEST` tables, arrays or dotted keys within each other, on `line`."""

    def __init__(self, line: int) -> None:
        self.line = line
        super().__init__(f"line {line}")


def locate(document: str) -> dict[Path, int]:
    """Lines, counted from 1, of every key and array entry; list indices count from 0.

    A table counts from its header, or else from the first key within it. Takes time linear in the
    length of the document; raises `NestedTooDeep`.
    """
    scanner = _Scanner(document)
    scanner.scan()
    return scanner.lines


class _Scanner:
    """A cursor over the document and what has been found so far."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.at = 0
        self.lines: dict[Path, int] = {}
        self.entries: dict[Path, int] = {}  # number of [[tables]] so far
        self.line, self.counted = 1, 0  # the line of a place that is not ahead of the cursor

    def scan(self) -> None:
        table: Path = ()
        while self._skip(_BLANK_LINES) < len(self.text):
            if self.text[self.at] == "[":
                table = self._header()
            elif not self._pair(table):
                self._skip(_TO_END_OF_LINE)

    def _header(self) -> Path:
        """`[a.b]` or `[[a.b]]`; returns the path of the table it opens."""
        is_array = self.text.startswith("[[", self.at)
        self.at += 2 if is_array else 1
        line, keys = self._line(), self._keys()
        self._skip(_TO_END_OF_LINE)
        table: Path = ()
        for depth, key in enumerate(keys, start=1):
            table = (*table, key)
            self.lines.setdefault(table, line)
            if is_array and depth == len(keys):
                self.entries[table] = self.entries.get(table, 0) + 1
            if table in self.entries:
                table = (*table, self.entries[table] - 1)
                self.lines.setdefault(table, line)
        # Its own header settles the line of a table known so far from a header further in.
        self.lines[table] = line
        return table

    def _pair(self, table: Path, depth: int = 0) -> bool:
        """`a.b = value`; whether there was one."""
        line, keys = self._line(), self._keys()
        self._check_depth(depth + len(keys))
        self._skip(_BLANK)
        if not keys or not self.text.startswith("=", self.at):
            return False
        self.at += 1
        for key in keys:
            table = (*table, key)
            self.lines.setdefault(table, line)
        self._skip(_BLANK)
        self._value(table, depth + len(keys))
        return True

    def _keys(self) -> list[str]:
        """Parts of a dotted key; empty where there is none."""
        keys: list[str] = []
        while True:
            self._skip(_BLANK)
            match = _KEY.match(self.text, self.at)
            if match is None:
                return []
            self.at = match.end()
            literal, basic = match.groups()
            keys.append(match[0] if literal is basic else literal or _unescaped(basic or ""))
            self._check_depth(len(keys))
            self._skip(_BLANK)
            if not self.text.startswith(".", self.at):
                return keys
            self.at += 1

    def _value(self, path: Path, depth: int) -> None:
        self._check_depth(depth)
        opening = self.text[self.at : self.at + 1]
        if opening == "[":
            self._array(path, depth + 1)
        elif opening == "{":
            self._inline_table(path, depth + 1)
        elif opening in ("'", '"'):
            if self._skip_if(_STRING) is False:
                self.at = len(self.text)  # never closed: nothing after it can be told apart
        else:
            self._skip(_SCALAR)

    def _array(self, path: Path, depth: int) -> None:
        self.at += 1
        index = 0
        while self._skip(_BLANK_LINES) < len(self.text):
            if self.text[self.at] == "]":
                self.at += 1
                return
            if self.text[self.at] in ",}=":
                self.at += 1
                continue
            self.lines.setdefault((*path, index), self._line())
            self._value((*path, index), depth)
            index += 1

    def _inline_table(self, path: Path, depth: int) -> None:
        self.at += 1
        while self._skip(_BLANK_LINES) < len(self.text):
            if self.text[self.at] == "}":
                self.at += 1
                return
            if self.text[self.at] == "," or not self._pair(path, depth):
                self.at += 1

    def _skip(self, pattern: re.Pattern[str]) -> int:
        match = pattern.match(self.text, self.at)
        self.at = match.end() if match else self.at
        return self.at

    def _skip_if(self, pattern: re.Pattern[str]) -> bool:
        start = self.at
        return self._skip(pattern) > start

    def _line(self) -> int:
        self.line += self.text.count("\n", self.counted, self.at)
        self.counted = self.at
        return self.line

    def _check_depth(self, depth: int) -> None:
        if depth > DEEPEST:
            raise NestedTooDeep(self._line())


def _unescaped(text: str) -> str:
    """A basic string with its escapes resolved."""

    def character(match: re.Match[str]) -> str:
        short, long, plain = match.groups()
        if plain is not None:
            return _ESCAPES.get(plain, plain)
        code = int(short or long, 16)
        return chr(code) if code <= 0x10FFFF else ""

    return _ESCAPE.sub(character, text)
