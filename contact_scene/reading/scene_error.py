"""Problems of a scene, the exception that contains them, and errors of pydantic validators."""

import re
from collections.abc import Iterable
from dataclasses import dataclass
from datetime import date, datetime, time
from typing import Any

from pydantic_core import PydanticCustomError

Path = tuple[str | int, ...]

_MAX_LISTED = 100
_MAX_SHOWN = 60  # characters


@dataclass(frozen=True)
class Problem:
    """One mistake in a scene, with its place and the expected value, for a message.

    path      keys and indices of the wrong value in the document; indices count from 0
    message   mistake, or received value
    expected  expected value; may be empty
    hint      remedy; may be empty
    file      name of the file, or the option that set the value; empty for a scene made in Python
    line      line in the file, counted from 1; None without a line
    """

    path: Path
    message: str
    expected: str = ""
    hint: str = ""
    file: str = ""
    line: int | None = None

    @property
    def key(self) -> str:
        """Dotted key of the wrong value in the scene, such as `loading[2].normal_force`.

        Entries of arrays count from 1.
        """
        return dotted_key(self.path)

    def __str__(self) -> str:
        place = printable(self.file) + ("" if self.line is None else f":{self.line}")
        sentence = self.message
        sentence += f", expected {self.expected}" if self.expected else ""
        sentence += f"; {self.hint}" if self.hint else ""
        return ": ".join(part for part in (place, self.key, sentence) if part)


class SceneError(Exception):
    """Error for an invalid scene; the attribute `problems` contains every mistake."""

    def __init__(self, problems: Iterable[Problem]) -> None:
        self.problems = tuple(problems)
        super().__init__(self.problems)

    def __str__(self) -> str:
        lines = [str(problem) for problem in self.problems[:_MAX_LISTED]]
        left = len(self.problems) - len(lines)
        return "\n".join(lines + ([f"… and {left} more"] if left else []))


def dotted_key(path: Path) -> str:
    """Convert the path of a key in a scene to text, as in `loading[2].normal_force`.

    path  keys, and array indices that count from 0; in the text they count from 1
    """
    text = ""
    for part in path:
        if isinstance(part, int):
            text += f"[{part + 1}]"
        else:
            bare, key = is_bare_key(part), shorten_text(part)
            text += ("." if text else "") + (key if bare else f'"{printable(key)}"')
    return text


def refusal(message: str, expected: str = "", hint: str = "") -> PydanticCustomError:
    """Create a validation error for pydantic, with separate message, expected value and hint.

    Used by the validators of a scene.

    message   mistake, or received value
    expected  expected value; may be empty
    hint      remedy; may be empty
    """
    sentence = "{message}"
    sentence += ", expected {expected}" if expected else ""
    sentence += "; {hint}" if hint else ""
    context = {"message": message, "expected": expected, "hint": hint}
    return PydanticCustomError("refused", sentence, context)


def shown(value: Any) -> str:
    """Convert a value of a scene to printable text of limited length for a message.

    The notation is that of TOML. Tables and long arrays are only named.

    value  value as written in the scene file or passed in Python
    """
    if isinstance(value, str):
        return '"' + printable(shorten_text(value)) + '"'
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int) and abs(value) >= 10**20:
        return "a whole number of more than 20 digits"
    if isinstance(value, int | float | datetime | date | time):
        return str(value)
    if isinstance(value, dict):
        return "a table"
    if isinstance(value, list | tuple):
        return _shown_array(value)
    return f"a {type(value).__name__}"


def printable(text: str) -> str:
    """Escape control characters and quotes in a text, so that a terminal or a log can show it."""
    return "".join(c if c.isprintable() and c != '"' else ascii(c)[1:-1] for c in text)


def _shown_array(items: list[Any] | tuple[Any, ...]) -> str:
    if len(items) > 4 or any(isinstance(item, list | tuple | dict) for item in items):
        return f"an array of {len(items)}"
    return shorten_text("[" + ", ".join(shown(item) for item in items) + "]", 160)


def shorten_text(text: str, longest: int = _MAX_SHOWN) -> str:
    """Limit a text to a maximum number of characters, with "…" in place of the rest.

    Used for texts of the user in messages.

    text     text to shorten
    longest  maximum number of characters
    """
    return text if len(text) <= longest else text[: longest - 1] + "…"


def is_bare_key(part: str) -> bool:
    """Determine if TOML allows a key without quotes.

    Such a key has only letters, digits, hyphens and underscores.

    part  key of a table
    """
    return re.fullmatch(r"[A-Za-z0-9_-]+", part) is not None
