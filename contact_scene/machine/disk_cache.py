"""Arrays kept on disk, found again by what determines them: they depend on neither load nor shape
nor friction, and many runs need the same.

A file holds raw numbers behind their own checksum; its name is the hash of what they were computed
from. One that is damaged, cut off, foreign or renamed is named, computed again and replaced.
Without a place to write there is no cache, and no complaint.
"""

from __future__ import annotations

import contextlib
import logging
import os
import tempfile
from collections.abc import Callable, Iterator
from contextvars import ContextVar
from hashlib import sha256
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from contact_scene.machine.trusted_file import open_own

FIRST_LINE = b"slipstick array, format 1\n"
SUFFIX = ".array"
# All entries together; one alone may take a quarter. The least recently used ones go first.
LARGEST_CACHE = 1 << 30
OF_CLOCKS_APART = 3600.0  # seconds by which machines that share a cache may differ

_ignored = ContextVar("_ignored", default=False)
# Without a handler of the caller's, a warning is one line on stderr.
log = logging.getLogger(__name__)


def remembered(
    identity: str, shape: tuple[int, ...], compute: Callable[[], NDArray[np.float64]]
) -> NDArray[np.float64]:
    """The array that `compute` gives, from the cache if it is there.

    identity  text that determines every bit of the array
    """
    key = sha256(identity.encode()).hexdigest()
    directory = cache_directory()
    if directory is None or _ignored.get():
        return compute()
    path = directory / (key + SUFFIX)
    values = _read(path, key, shape)
    if values is None:
        values = compute()
        with contextlib.suppress(OSError):
            _write(path, key, values)
    return values


@contextlib.contextmanager
def without_cache() -> Iterator[None]:
    """Neither read nor write the cache in the block, for a measurement of what a solve costs."""
    before = _ignored.set(True)
    try:
        yield
    finally:
        _ignored.reset(before)


def cache_directory() -> Path | None:
    """SLIPSTICK_CACHE_DIR, or `slipstick` in the user's cache directory (XDG), if there is one."""
    chosen = os.environ.get("SLIPSTICK_CACHE_DIR")
    if chosen:
        return Path(chosen)
    user = os.environ.get("XDG_CACHE_HOME", "")
    if os.path.isabs(user):  # the specification tells to ignore a relative one
        return Path(user) / "slipstick"
    try:
        return Path.home() / ".cache" / "slipstick"
    except RuntimeError:
        return None


def _read(path: Path, key: str, shape: tuple[int, ...]) -> NDArray[np.float64] | None:
    """The stored array, or None unless the file is whole and the one that was asked for."""
    size = 8 * int(np.prod(shape))
    try:
        with open_own(path) as file:
            header = file.read(len(FIRST_LINE) + 2 * 65)
            body = file.read(size + 1)  # one more, to see whether the file is longer
    except (FileNotFoundError, NotADirectoryError):
        return None
    except OSError as error:
        log.warning("%s cannot be used: %s; computed again", path, error.strerror)
        return None
    if len(body) != size or header != _header(key, body):
        what = "is damaged" if header.startswith(FIRST_LINE) else "is no array of this version"
        log.warning("%s %s; computed again", path, what)
        return None
    with contextlib.suppress(OSError):
        os.utime(path)
    return np.frombuffer(body, "<f8").reshape(shape).astype(np.float64)


def _write(path: Path, key: str, values: NDArray[np.float64]) -> None:
    """Store an array so that nobody ever sees a part of it; make room by age."""
    body = values.astype("<f8").tobytes()
    if len(body) > LARGEST_CACHE // 4:
        return
    path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
    handle, temporary = tempfile.mkstemp(suffix=SUFFIX, dir=path.parent)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(_header(key, body))
            file.write(body)
        os.replace(temporary, path)
    except BaseException:
        os.unlink(temporary)
        raise
    _make_room(path)


def _header(key: str, body: bytes) -> bytes:
    """What stands before the numbers: format, identity and checksum."""
    return FIRST_LINE + f"{key}\n{sha256(body).hexdigest()}\n".encode()


def _make_room(newest: Path) -> None:
    """Delete the least recently used entries beyond LARGEST_CACHE; other files are not touched."""
    entries, latest = [], newest.stat().st_mtime + OF_CLOCKS_APART
    for path in newest.parent.glob("*" + SUFFIX):
        with contextlib.suppress(OSError):  # another process may be making room as well
            status = path.stat()
            # One of a clock that was wrong would be the last to go for as long as that was ahead.
            used = status.st_mtime if status.st_mtime <= latest else 0.0
            entries.append((path != newest, -used, status.st_size, path))
    total = 0
    for _, _, size, path in sorted(entries):
        total += size
        if total > LARGEST_CACHE:
            with contextlib.suppress(OSError):
                path.unlink()
