"""A file that appears whole or not at all, and the directories above it."""

import os
import secrets
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from contact_results.directory.refusal import OutputRefused


@contextmanager
def atomic_file(path: Path) -> Iterator[Path]:
    """Give a path beside `path` to write to; it takes the name when the block ends without error.

    A file of that name is replaced. Raises OutputRefused if the directory cannot be made or the
    name is a directory's, a device's, a queue's or a link's that leads nowhere; an
    OSError of the block, as that of a full disk, names `path`.
    """
    refuse_what_is_in_the_way(path)
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


def refuse_what_is_in_the_way(path: Path) -> None:
    """Raise OutputRefused where no file could go, or one would take the place of something else."""
    try:
        os.lstat(path)
    except FileNotFoundError:
        return
    except OSError as error:
        raise OutputRefused(f"cannot write {path}: {error.strerror}") from error
    if path.is_dir():
        raise OutputRefused(f"{path} is a directory where a file should go; move it")
    if not path.is_file():
        raise OutputRefused(f"{path} is not a regular file, and one would take its place")


def create_parents(target: Path) -> list[Path]:
    """Create the directories missing above `target`; return them, innermost first.

    Raises OutputRefused where they cannot be created.
    """
    missing = [parent for parent in target.parents if not parent.exists()]
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputRefused(f"cannot create {target.parent}: {error.strerror}") from error
    return missing


def remove_empty(directories: Sequence[Path]) -> None:
    """Remove these directories, innermost first, as long as they are empty."""
    for directory in directories:
        try:
            directory.rmdir()
        except OSError:
            return
