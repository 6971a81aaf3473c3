"""The command line, run in the process of a test, and the tables that it writes."""

import csv
from pathlib import Path

import pytest

from slipstick.cli import main


def slipstick(*arguments: object) -> int:
    """Run the command in this process; its exit code."""
    with pytest.raises(SystemExit) as leaving:
        main([str(argument) for argument in arguments])
    return int(leaving.value.code or 0)


def rows(path: Path) -> list[dict[str, str]]:
    """The rows of a CSV file, by column."""
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))
