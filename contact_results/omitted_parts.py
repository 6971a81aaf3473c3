"""Record of the parts of a run that could not be computed from its solved history."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import TypeVar

Value = TypeVar("Value")


@dataclass(frozen=True)
class OmittedParts:
    """Parts of the results of a run whose computation has failed; the other parts are written.

    causes  exception that ended the computation, by name of the part
    """

    causes: dict[str, Exception] = field(default_factory=dict)

    def compute(self, part: str, function: Callable[[], Value], otherwise: Value) -> Value:
        """Return the value of a function; if it raises an exception, record the exception.

        part       name of the part that the function computes
        function   function without arguments
        otherwise  value that is returned if the function raises an exception
        """
        try:
            return function()
        except Exception as error:  # no defect of a part may discard the solved history
            self.causes[part] = error
            return otherwise

    def write(self, part: str, paths: Iterable[Path], function: Callable[[], None]) -> None:
        """Write files by a function; if it raises an exception, remove them and record it.

        part      name of the part that the files contain
        paths     files that the function may have written
        function  function without arguments
        """
        self.compute(part, function, None)
        for path in paths if part in self.causes else ():
            path.unlink(missing_ok=True)

    @property
    def warnings(self) -> tuple[str, ...]:
        """One clause per omitted part, with the exception."""
        return tuple(
            f"{part} could not be computed: {type(error).__name__}: {error}; the other results "
            "are complete"
            for part, error in self.causes.items()
        )
