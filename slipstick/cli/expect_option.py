"""Options that save the numbers of a scene with their errors, and compare later numbers with them.

The comparison itself is imported only if an option is given.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, TypeAlias

import typer

from slipstick.cli.errors import ExitCode
from slipstick.cli.options import optional, refuse_if

if TYPE_CHECKING:
    from slipstick.expected import ExpectedNumbers, Numbers, Source

SAVE_EXPECTED = "--save-expected"

SaveExpectedOption: TypeAlias = Annotated[
    Path | None,
    optional(
        SAVE_EXPECTED,
        metavar="FILE",
        help="Save all numbers with their stated errors in FILE (JSON), for --expect.",
    ),
]

ExpectOption: TypeAlias = Annotated[
    Path | None,
    optional(
        "--expect",
        metavar="FILE",
        help="Compare with the numbers in FILE: exit with code 7 if two intervals exclude each "
        "other, a stated error grew by 50 %, or a number is missing or no longer reliable.",
    ),
]


@dataclass(frozen=True)
class Expectation:
    """Files of the two options, and the numbers of one of them.

    source    command, scene and solver
    expected  numbers in the file of `--expect`; None without the option
    file      file of `--expect`, or None
    save      file of `--save-expected`, or None
    """

    source: Source
    expected: ExpectedNumbers | None
    file: Path | None
    save: Path | None

    def settle(self, numbers: Numbers) -> ExitCode:
        """Save the numbers of a result, or compare them, and return the exit code.

        Raises Refused if there are no numbers to save.
        """
        from contact_results.directory.atomic_file import Refused
        from slipstick.cli.changes import print_comparison
        from slipstick.expected import expected_changes, save_expected
        from verification.regression.change_row import Comparison

        found = self.source.with_numbers(numbers)
        if self.save is not None:
            if not any(numbers.values()):
                raise Refused(f"{self.save}: got no number with a stated error, nothing is saved")
            save_expected(found, self.save)
            typer.echo(f"expected numbers in {self.save}")
        if self.expected is None or self.file is None:
            return ExitCode.PASS
        rows = tuple(expected_changes(found, self.expected, self.file.name))
        return print_comparison(Comparison(rows, self.file, f"{SAVE_EXPECTED} {self.file}"))


def read_expectation(
    expect: Path | None, save: Path | None, source: Callable[[], Source], *, error: bool
) -> Expectation | None:
    """Read the expected numbers before a solve; None if neither option is given.

    Raises BadParameter for options that exclude each other, and Refused for a file that is damaged
    or of another scene.

    expect, save  values of `--expect` and `--save-expected`
    source        function that returns command, scene and solver
    error         false for `--no-error`
    """
    if expect is None and save is None:
        return None
    refuse_if(
        (
            (expect and save, f"--expect excludes {SAVE_EXPECTED}; omit one of them"),
            (not error, "--no-error leaves no error to compare; omit --no-error"),
        )
    )
    from slipstick.expected import read_expected

    origin = source()
    expected = None if expect is None else read_expected(expect, origin)
    return Expectation(origin, expected, expect, save)
