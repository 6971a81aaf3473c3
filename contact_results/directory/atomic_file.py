"""Atomic creation of a file, and of its parent directories."""

import os
import secrets
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path


class Refused(Exception):
    """A command cannot use a file or directory; the message has its name and the reason."""


class OutputRefused(Refused):
    """The output directory cannot be written, is in use, or contains files of other programs."""


@contextmanager
def atomic_file(path: Path) -> Iterator[Path]:
    """Yield a temporary path in the directory of `path`, and rename the file to `path` at the end.

    The rename takes place only if the `with` block succeeds. It replaces an existing file. An
    OSError of the block, such as that of a full disk, gets the name `path` instead of the temporary
    name.

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
    """Create the missing parent directories of `target`; return the missing ones, innermost first.

    Raises OutputRefused if a directory cannot be created.
    """
    missing = [parent for parent in target.parents if not parent.exists()]
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputRefused(f"cannot create {target.parent}: {error.strerror}") from error
    return missing


def remove_empty(directories: Sequence[Path]) -> None:
    """Remove directories in the given order, and stop at the first that is not empty.

    directories  directories that `create_parents` has created, innermost first
    """
    for directory in directories:
        try:
            directory.rmdir()
        except OSError:
            return
