"""Problems of a scene, and the exception that contains them."""

from collections.abc import Iterable
from dataclasses import dataclass

from contact_scene.reading.validator_error import (
    is_bare_key,
    printable,
    shortened,
)

Path = tuple[str | int, ...]

_MAX_LISTED = 100


@dataclass(frozen=True)
class Problem:
    """One mistake.

    path      keys and indices in the document; indices count from 0
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
        """Dotted path: `loading[2].normal_force` for the second step, counted from 1."""
        return dotted(self.path)

    def __str__(self) -> str:
        place = printable(self.file) + ("" if self.line is None else f":{self.line}")
        sentence = self.message
        sentence += f", expected {self.expected}" if self.expected else ""
        sentence += f"; {self.hint}" if self.hint else ""
        return ": ".join(part for part in (place, self.key, sentence) if part)


class SceneError(Exception):
    """Invalid scene; `problems` contains every mistake."""

    def __init__(self, problems: Iterable[Problem]) -> None:
        self.problems = tuple(problems)
        super().__init__(self.problems)

    def __str__(self) -> str:
        lines = [str(problem) for problem in self.problems[:_MAX_LISTED]]
        left = len(self.problems) - len(lines)
        return "\n".join(lines + ([f"… and {left} more"] if left else []))


def dotted(path: Path) -> str:
    """Join the keys of a path by dots; array indices count from 1."""
    text = ""
    for part in path:
        if isinstance(part, int):
            text += f"[{part + 1}]"
        else:
            bare, key = is_bare_key(part), shortened(part)
            text += ("." if text else "") + (key if bare else f'"{printable(key)}"')
    return text
