"""Atomic creation of a file, and of its parent directories."""

import os
import secrets
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path


class Refused(Exception):
    """A file cannot be used by the command; the message has its name and the reason."""


class OutputRefused(Refused):
    """The directory cannot be written, is in use, or contains files of other programs."""


@contextmanager
def atomic_file(path: Path) -> Iterator[Path]:
    """Yield a temporary path in the same directory; rename it to `path` if the block succeeds.

    An existing file `path` is replaced. An OSError of the block, such as that of a full disk, gets
    the name `path`.

    Raises OutputRefused if the parent directory cannot be created, or if `path` exists and is not a
    regular file.
    """
    _refuse_occupied(path)
    created = create_parents(path)
    temporary = path.with_name(f".{secrets.token_hex(4)}.{path.name}")
    try:
        yield temporary
        with open(temporary, "rb+") as file:
            os.fsync(file.fileno())
        os.replace(temporary, path)
    except OSError as error:
        if error.filename in (None, str(temporary)):
            error.filename, error.filename2 = str(path), None
        raise
    finally:
        temporary.unlink(missing_ok=True)
        remove_empty(created)


def _refuse_occupied(path: Path) -> None:
    """Raise OutputRefused if the path is not accessible, or exists and is not a regular file."""
    try:
        os.lstat(path)
    except FileNotFoundError:
        return
    except OSError as error:
        raise OutputRefused(f"cannot write {path}: {error.strerror}") from error
    if path.is_dir():
        raise OutputRefused(f"{path} is a directory, expected a file or nothing; move it")
    if not path.is_file():
        raise OutputRefused(f"{path} is not a regular file and will not be replaced; move it")


def create_parents(target: Path) -> list[Path]:
    """Create the missing parent directories of `target`; return them, innermost first.

    Raises OutputRefused if a directory cannot be created.
    """
    missing = [parent for parent in target.parents if not parent.exists()]
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputRefused(f"cannot create {target.parent}: {error.strerror}") from error
    return missing


def remove_empty(directories: Sequence[Path]) -> None:
    """Remove directories in order, up to the first that is not empty."""
    for directory in directories:
        try:
            directory.rmdir()
        except OSError:
            return
