"""A file that appears whole or not at all."""

import os
import secrets
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from contact_results.directory.refusal import OutputRefused


@contextmanager
def atomic_file(path: Path) -> Iterator[Path]:
    """Give a path beside `path` to write to; it takes the name when the block ends without error.

    A file of that name is replaced. Raises OutputRefused if the directory cannot be made or the
    name is a directory's, a device's or a queue's; an OSError of the block, as that of a full disk,
    names `path`.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputRefused(f"cannot create {path.parent}: {error.strerror}") from error
    if path.is_dir():
        raise OutputRefused(f"{path} is a directory where a file should go; move it")
    if path.exists() and not path.is_file():
        raise OutputRefused(f"{path} is not a regular file, and one would take its place")
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
