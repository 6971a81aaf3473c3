"""Tests of the cache of arrays on disk: damaged and foreign files are detected and not used."""

import os
import re
import shutil
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from contact_scene import disk_cache
from contact_scene.disk_cache import (
    SUFFIX,
    cached_array,
    without_cache,
)
from fem_reference.elasticity import compliance
from semi_analytical.influence import layered

SHAPE = (4, 3)


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setenv("SLIPSTICK_CACHE_DIR", str(tmp_path / "deep" / "cache"))
    return tmp_path / "deep" / "cache"


def computed(identity: str = "this", shape: tuple[int, ...] = SHAPE) -> bool:
    """Ask for an array; whether it had to be computed."""
    called = []

    def compute() -> NDArray[np.float64]:
        called.append(1)
        return np.arange(np.prod(shape), dtype=float).reshape(shape)

    values = cached_array(identity, shape, compute)
    np.testing.assert_array_equal(values, np.arange(np.prod(shape)).reshape(shape))
    values[0] = -1  # it is writable, and nobody else's
    return bool(called)


def the_entry(folder: Path) -> Path:
    (path,) = folder.iterdir()
    return path


def test_what_is_kept_is_not_computed_again(folder):
    assert [computed(), computed(), computed("that"), computed()] == [True, False, True, False]


def test_without_the_cache_nothing_is_read_or_kept(folder):
    with without_cache():
        assert computed()
    assert not folder.exists()
    assert computed()
    with without_cache():
        assert computed()
    assert not computed()


def grown_to_zeros(path: Path) -> None:
    os.truncate(path, 1 << 40)  # the disk does not hold them


def in_place_of(path: Path, make: Callable[[Path], object]) -> None:
    path.unlink()
    make(path)


DAMAGES = {
    "a flipped bit": (lambda p: flipped(p, -5), "is damaged"),
    "cut off": (lambda p: os.truncate(p, p.stat().st_size - 8), "is damaged"),
    "grown": (grown_to_zeros, "is damaged"),
    "empty": (lambda p: os.truncate(p, 0), "is no array of this version"),
    "of another version": (
        lambda p: p.write_bytes(p.read_bytes().replace(b"format 1", b"format 0")),
        "is no array of this version",
    ),
    "a queue that never ends": (
        lambda p: in_place_of(p, os.mkfifo),
        "cannot be used: it is no plain file",
    ),
    "a directory": (lambda p: in_place_of(p, os.mkdir), "cannot be used: it is no plain file"),
}


def flipped(path: Path, at: int) -> None:
    content = bytearray(path.read_bytes())
    content[at] ^= 1
    path.write_bytes(content)


@pytest.mark.parametrize("damage", DAMAGES)
def test_what_is_not_whole_is_named_once_and_computed_again(folder, damage, caplog):
    computed()
    path = the_entry(folder)
    apply, why = DAMAGES[damage]
    apply(path)
    assert computed()
    assert caplog.messages == [f"{path} {why}; computed again"]
    assert computed() == path.is_dir()


def test_planted_link_writes_nowhere_else(folder, tmp_path):
    computed()
    outside, path = tmp_path / "outside", the_entry(folder)
    outside.write_text("precious")
    in_place_of(path, lambda p: p.symlink_to(outside))
    assert computed()
    assert outside.read_text() == "precious"
    assert not path.is_symlink()
    assert not computed()


def test_least_recently_used_make_room_and_other_files_are_spared(folder, monkeypatch):
    monkeypatch.setattr(disk_cache, "LARGEST_CACHE", 900)
    monkeypatch.setattr(disk_cache, "WRITES_PER_SEARCH", 1)
    folder.mkdir(parents=True)
    (folder / "notes.txt").write_text("x" * 5000)
    for number in range(3):  # of 250 bytes each
        computed(str(number), (4,))
    for path in folder.glob(f"*{SUFFIX}"):
        os.utime(path, (0, 0))
    computed("0", (4,))
    computed("3", (4,))
    assert sum(path.stat().st_size for path in folder.glob(f"*{SUFFIX}")) <= 900
    assert not computed("0", (4,))
    assert not computed("3", (4,))
    before = set(folder.iterdir())
    computed("more than a quarter", (60, 60))
    assert set(folder.iterdir()) == before


@pytest.mark.parametrize("cached", [compliance, layered], ids=["compliance", "coefficients"])
def test_all_sources_of_an_array_are_in_its_key(cached, tmp_path):
    """Of the project's modules only values, refusals and the folders of the digest are imported."""
    own = cached.PACKAGE.name
    inside = tuple(f"{own}.{folder}" for folder in cached.FOLDERS)
    for folder in cached.FOLDERS:
        shutil.copytree(cached.PACKAGE / folder, tmp_path / folder)
    sources = [*tmp_path.rglob("*.py")]
    texts = [source.read_text(encoding="utf-8") for source in sources]
    imported = {name for text in texts for name in re.findall(r"(?m)^from (\S+) import", text)}
    ours = {name for name in imported if name.startswith(own) and not name.startswith(inside)}
    assert ours <= {"fem_reference.memory"}
    assert any(name.startswith(inside) for name in imported)
    at, given = disk_cache.sources_digest, (cached.FOLDERS, cached.LIBRARIES)
    assert at(tmp_path, *given) == at(cached.PACKAGE, *given)
    sources[-1].write_text(texts[-1] + "# another line\n", encoding="utf-8")
    at.cache_clear()
    assert at(tmp_path, *given) != at(cached.PACKAGE, *given)
