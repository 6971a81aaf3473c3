"""Helpers of tests that run the command line in the process of the test, and read its tables."""

import csv
from contextlib import chdir, redirect_stderr, redirect_stdout
from io import StringIO
from pathlib import Path
from subprocess import CompletedProcess

import pytest

from slipstick.cli import main


def slipstick(*arguments):
    """Run the command in this process; its exit code."""
    with pytest.raises(SystemExit) as leaving:
        main([str(argument) for argument in arguments])
    return int(leaving.value.code or 0)


def outcome(*arguments, cwd):
    """What the command has said in a directory, and how it ended, as of a process of its own."""
    with redirect_stdout(StringIO()) as out, redirect_stderr(StringIO()) as err, chdir(cwd):
        code = slipstick(*arguments)
    return CompletedProcess(arguments, code, out.getvalue(), err.getvalue())


def succeeded(*arguments, cwd):
    """Outcome of a command that ends with exit code 0."""
    ended = outcome(*arguments, cwd=cwd)
    assert ended.returncode == 0, ended.stdout + ended.stderr
    return ended


def rows(path: Path) -> list[dict[str, str]]:
    """The rows of a CSV file, by column."""
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def signalled(name: str, *, saved: int) -> str:
    """Text of a program that gets a signal once it has saved so many cases, however busy the
    machine is: some are done then and some are not."""
    return f"""
import signal
from verification.running.case_pool import CaseStore
kept, save = [], CaseStore.save
def save_and_signal(*arguments):
    save(*arguments)
    kept.append(arguments)
    if len(kept) == {saved}:
        signal.raise_signal(signal.{name})
CaseStore.save = save_and_signal
"""
