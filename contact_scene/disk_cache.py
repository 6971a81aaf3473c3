"""Cache of arrays on disk, for operators that do not depend on load, shape and friction.

A file contains a checksum and raw numbers. Its name is the hash of all data that determine the
array. A damaged, foreign or renamed file causes a warning; its array is computed again and
replaced. Without a writable directory there is no cache and no warning.
"""

from __future__ import annotations

import contextlib
import logging
import os
import tempfile
from collections.abc import Callable, Iterator
from contextvars import ContextVar
from functools import cache
from hashlib import sha256
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from contact_scene.machine import open_own

FIRST_LINE = b"slipstick array, format 1\n"
SUFFIX = ".array"
# Largest size of all entries [byte]; one entry may have a quarter. The least recently used entries
# are deleted first.
LARGEST_CACHE = 1 << 30
# Number of stored arrays per search for old entries. A search takes 0.06 s in a cache of 18 000
# entries, as long as the solve of a small contact.
WRITES_PER_SEARCH = 16

_ignored = ContextVar("_ignored", default=False)
# Without a handler, a warning is one line on stderr.
log = logging.getLogger(__name__)


def cached_array(
    identity: str, shape: tuple[int, ...], compute: Callable[[], NDArray[np.float64]]
) -> NDArray[np.float64]:
    """Return an array, such as a compliance matrix, from the disk cache, or compute and store it.

    identity  text that determines every bit of the array; its hash is the name of the file
    shape     shape of the array
    compute   function that computes the array
    """
    key = sha256(identity.encode()).hexdigest()
    directory = cache_directory()
    if directory is None or _ignored.get():
        return compute()
    path = directory / (key + SUFFIX)
    values = _read_entry(path, key, shape)
    if values is None:
        values = compute()
        with contextlib.suppress(OSError):
            _write_entry(path, key, values)
    return values


@cache
def sources_digest(package: Path, folders: tuple[str, ...], libraries: tuple[str, ...]) -> str:
    """Compute a digest of the source files that determine an array, for cache keys.

    A change of the sources or of a library invalidates the cached arrays.

    package    folder that contains the folders
    folders    folders of the source files
    libraries  versions of the libraries that the files use
    """
    digest = sha256(repr(libraries).encode())
    for folder in folders:
        for source in sorted((package / folder).rglob("*.py")):
            content = sha256(source.read_bytes()).hexdigest()
            digest.update(f"{source.relative_to(package).as_posix()} {content}\n".encode())
    return digest.hexdigest()


@contextlib.contextmanager
def without_cache() -> Iterator[None]:
    """Disable the use of the disk cache of compliances within a `with` block.

    Used to measure the cost of a solve, which then computes all operators.
    """
    before = _ignored.set(True)
    try:
        yield
    finally:
        _ignored.reset(before)


def cache_directory() -> Path | None:
    """Return the directory of the disk cache; None if the user has no home directory.

    The environment variable SLIPSTICK_CACHE_DIR sets the directory. The default is `slipstick` in
    the user's cache directory (XDG_CACHE_HOME or ~/.cache).
    """
    chosen = os.environ.get("SLIPSTICK_CACHE_DIR")
    if chosen:
        return Path(chosen)
    user = os.environ.get("XDG_CACHE_HOME", "")
    if os.path.isabs(user):  # relative paths are ignored, as in the specification
        return Path(user) / "slipstick"
    try:
        return Path.home() / ".cache" / "slipstick"
    except RuntimeError:
        return None


def _read_entry(path: Path, key: str, shape: tuple[int, ...]) -> NDArray[np.float64] | None:
    """Read an array from its file in the disk cache.

    Return None if the file is missing, unreadable or damaged, or belongs to another key.

    path   file of the array
    key    hash of the data that determine the array, stored in the header of the file
    shape  shape of the array
    """
    size = 8 * int(np.prod(shape))
    try:
        with open_own(path) as file:
            header = file.read(len(FIRST_LINE) + 2 * 65)
            body = file.read(size + 1)  # one more byte, to detect a longer file
    except (FileNotFoundError, NotADirectoryError):
        return None
    except OSError as error:
        log.warning("%s cannot be used: %s; computed again", path, error.strerror)
        return None
    if len(body) != size or header != _entry_header(key, body):
        what = "is damaged" if header.startswith(FIRST_LINE) else "is no array of this version"
        log.warning("%s %s; computed again", path, what)
        return None
    with contextlib.suppress(OSError):
        os.utime(path)
    return np.frombuffer(body, "<f8").reshape(shape).astype(np.float64)


def _write_entry(path: Path, key: str, values: NDArray[np.float64]) -> None:
    """Store an array in the disk cache atomically, and delete the oldest arrays beyond its limit.

    An array of more than LARGEST_CACHE / 4 bytes is not stored. The key selects the stored arrays
    after which old arrays are deleted: one in WRITES_PER_SEARCH.

    path    file of the array
    key     hash of the data that determine the array
    values  array to store
    """
    body = values.astype("<f8").tobytes()
    if len(body) > LARGEST_CACHE // 4:
        return
    path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
    handle, temporary = tempfile.mkstemp(suffix=SUFFIX, dir=path.parent)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(_entry_header(key, body))
            file.write(body)
        os.replace(temporary, path)
    except BaseException:
        os.unlink(temporary)
        raise
    if int(key, 16) % WRITES_PER_SEARCH == 0:
        _delete_old_entries(path)


def _entry_header(key: str, body: bytes) -> bytes:
    """Build the header of a cache file: format, key of the array and checksum of its bytes."""
    return FIRST_LINE + f"{key}\n{sha256(body).hexdigest()}\n".encode()


def _delete_old_entries(newest: Path) -> None:
    """Delete the least recently used arrays of the disk cache above its size LARGEST_CACHE.

    Files without the suffix of the cache remain.

    newest  file of the newest array, which is deleted last
    """
    entries = []
    for entry in os.scandir(newest.parent):
        with contextlib.suppress(OSError):  # another process may delete entries, too
            if entry.name.endswith(SUFFIX):
                status = entry.stat()
                entries.append(
                    (entry.name != newest.name, -status.st_mtime, status.st_size, entry.path)
                )
    total = 0
    for _, _, size, path in sorted(entries):
        total += size
        if total > LARGEST_CACHE:
            with contextlib.suppress(OSError):
                os.unlink(path)
