"""Errors of validators: received value, expected value and a hint."""

import re
from datetime import date, datetime, time
from typing import Any

from pydantic_core import PydanticCustomError

_MAX_SHOWN = 60


def refusal(message: str, expected: str = "", hint: str = "") -> PydanticCustomError:
    """Create an exception for pydantic validators, with separate message, expectation and hint."""
    sentence = "{message}"
    sentence += ", expected {expected}" if expected else ""
    sentence += "; {hint}" if hint else ""
    context = {"message": message, "expected": expected, "hint": hint}
    return PydanticCustomError("refused", sentence, context)


def shown(value: Any) -> str:
    """Convert a value to printable text of limited length, in the notation of TOML."""
    if isinstance(value, str):
        return '"' + printable(shortened(value)) + '"'
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
    """Escape control characters and quotes of a text, for a terminal or a log."""
    return "".join(c if c.isprintable() and c != '"' else ascii(c)[1:-1] for c in text)


def _shown_array(items: list[Any] | tuple[Any, ...]) -> str:
    if len(items) > 4 or any(isinstance(item, list | tuple | dict) for item in items):
        return f"an array of {len(items)}"
    return shortened("[" + ", ".join(shown(item) for item in items) + "]", 160)


def shortened(text: str, longest: int = _MAX_SHOWN) -> str:
    """Cut a text to a largest length."""
    return text if len(text) <= longest else text[: longest - 1] + "…"


def is_bare_key(part: str) -> bool:
    """Determine if TOML allows a key without quotes."""
    return re.fullmatch(r"[A-Za-z0-9_-]+", part) is not None
