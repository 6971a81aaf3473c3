"""Compliance matrices kept on disk: they depend on neither load nor shape nor friction.

An entry is a NumPy archive whose name is the hash of all it was computed from, and which holds the
hash of its own numbers. Whatever is not such a file, whole and unchanged, counts as absent and is
overwritten. A disk that cannot be read or written makes solves slower, not impossible.
"""

import contextlib
import hashlib
import io
import math
import os
import tempfile
import zipfile
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

ENDING = ".compliance.npz"
# The directory may hold this many bytes of entries; those unused for longest are dropped first.
MOST_BYTES = 1 << 30
# What an archive holds besides the numbers of the matrix, at most [byte].
_FRAME = 4096
_HARMLESS = (OSError, ValueError, KeyError, EOFError, MemoryError, zipfile.BadZipFile)


def stored(key: str, shape: tuple[int, ...]) -> NDArray[np.float64] | None:
    """The matrix under a key, or None."""
    entry = _entry(key)
    if entry is None:
        return None
    most = np.dtype(np.float64).itemsize * math.prod(shape) + _FRAME
    with contextlib.suppress(*_HARMLESS):
        with entry.open("rb") as file:
            content = file.read(most + 1)
        if len(content) > most or _unpacked_bytes(content) > most:
            return None
        with np.load(io.BytesIO(content), allow_pickle=False) as archive:
            matrix, digest = archive["matrix"], str(archive["digest"])
        if matrix.shape == shape and matrix.dtype == np.float64 and digest == _digest(key, matrix):
            entry.touch()
            return np.ascontiguousarray(matrix)
    return None


def _unpacked_bytes(content: bytes) -> int:
    """What the members of an archive claim to hold, before anything is unpacked."""
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        return sum(member.file_size for member in archive.infolist())


def store(key: str, matrix: NDArray[np.float64]) -> None:
    """Keep a matrix; another process sees either all of it or nothing."""
    entry = _entry(key)
    if entry is None:
        return
    archive = io.BytesIO()
    np.savez(archive, matrix=matrix, digest=np.array(_digest(key, matrix)))
    with contextlib.suppress(OSError):
        entry.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        with tempfile.NamedTemporaryFile(dir=entry.parent, suffix=".partial", delete=False) as file:
            try:
                file.write(archive.getbuffer())
                file.close()
                os.replace(file.name, entry)
            except BaseException:
                os.unlink(file.name)
                raise
        _drop_oldest(entry)


def _entry(key: str) -> Path | None:
    """Where the matrix under a key lies; None if this user has no such place."""
    if place := os.environ.get("SLIPSTICK_CACHE_DIR"):
        return Path(place) / (key + ENDING)
    place = os.environ.get("XDG_CACHE_HOME", "")
    if not os.path.isabs(place):
        place = os.path.expanduser("~/.cache")
    return Path(place) / "slipstick" / (key + ENDING) if os.path.isabs(place) else None


def _digest(key: str, matrix: NDArray[np.float64]) -> str:
    return hashlib.sha256(key.encode() + np.ascontiguousarray(matrix).tobytes()).hexdigest()


def _drop_oldest(newest: Path) -> None:
    """Make room, the newest entry spared."""
    entries = [(path.stat(), path) for path in newest.parent.glob("*" + ENDING) if path != newest]
    total = newest.stat().st_size + sum(status.st_size for status, _ in entries)
    for status, path in sorted(entries, key=lambda entry: entry[0].st_mtime):
        if total <= MOST_BYTES:
            return
        path.unlink(missing_ok=True)
        total -= status.st_size
