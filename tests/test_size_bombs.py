"""Tests of files that claim to be huge: they are refused at once and without using memory."""

import hashlib
import json
import os
import time
import tracemalloc
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import h5py
import numpy as np
import pytest
from command import outcome
from processes import run
from small_result import small_result

from contact_results.directory.checkpoint_file import FORMAT, Unusable, read_checkpoint_file
from contact_results.directory.file_names import FIELDS, SUMMARY
from contact_results.files.stored_run import load
from contact_results.result_files import write_result
from contact_results.stress.loaded_bodies import NoSuchState, state_of_run

MEGABYTE = 1_000_000
MAX_MEMORY = 200  # MiB of a whole process, Python and its libraries included
SOON = 1.0  # seconds of CPU
# Limit over the time of an empty scene, since processors differ: 10 MB of text take 2 to 5 times.
AT_ONCE = 8
CLAIM = "too many for a file of"
HUGE = 1 << 14  # cells along a side, the most there can be: 2 GB for one field
LONGEST_MESSAGE = 1000
# ---- a whole process -----------------------------------------------------------------------------


def sparse(path: Path, content: bytes) -> None:
    """A file that begins so and goes on with zeros which the disk does not hold."""
    path.write_bytes(content)
    os.truncate(path, 100_000 * MEGABYTE)


SCENE_BOMBS = {
    "keys": (lambda path: path.write_bytes(b"a = 1\n" * (100 * MEGABYTE // 6)), "too large"),
    "zeros": (lambda path: sparse(path, b"title = 'x'\n"), "too large"),
    "steps": (lambda path: path.write_bytes(b"[[loading]]\n" * 800_000), "too many keys"),
    "brackets": (lambda path: path.write_bytes(b"a = " + b"[" * 9 * MEGABYTE), "too many keys"),
    "title": (lambda path: path.write_bytes(b'title = "' + 9 * MEGABYTE * b"a" + b'"'), "title"),
    "escapes": (lambda path: path.write_bytes(b'title = "' + 9 * MEGABYTE * b"\\"), "escapes"),
    "key": (lambda path: path.write_bytes(9 * MEGABYTE * b"k" + b" = 1"), "kkk…"),
    "digits": (
        lambda path: path.write_bytes(b"\na = " + b"1" * MEGABYTE),
        "scene.toml:2: not valid TOML: a whole number of more than 4300 digits",
    ),
}


@pytest.fixture(scope="module")
def refusal_of_nothing(tmp_path_factory):
    """What it takes to refuse a small file: Python and its libraries."""
    folder = tmp_path_factory.mktemp("small")
    (folder / "scene.toml").touch()
    return run(folder, "check", "scene.toml")


@pytest.mark.parametrize(("write", "words"), SCENE_BOMBS.values(), ids=SCENE_BOMBS)
def test_huge_scene_is_refused_at_once(tmp_path, refusal_of_nothing, write, words):
    write(tmp_path / "scene.toml")
    ended = run(tmp_path, "check", "scene.toml")
    assert ended.code == 2
    assert words in " ".join(ended.said.replace("│", " ").split())
    assert len(ended.said) < LONGEST_MESSAGE
    assert ended.memory < MAX_MEMORY
    soon = AT_ONCE * refusal_of_nothing.seconds
    if ended.seconds >= soon:  # others on the core slow it, too
        ended = run(tmp_path, "check", "scene.toml")
    assert ended.seconds < soon


# ---- within a process ----------------------------------------------------------------------------


@contextmanager
def frugal() -> Iterator[None]:
    """Little memory is asked for in the block, and little time."""
    tracemalloc.start()
    started = time.process_time()
    try:
        yield
        assert time.process_time() - started < SOON
        assert tracemalloc.get_traced_memory()[1] < 20 * MEGABYTE
    finally:
        tracemalloc.stop()


def claiming(result, path, **changed):
    """A stored run in which datasets claim other shapes, and were never written."""
    write_result(result, path.parent, figures="none")
    with h5py.File(path, "a") as file:
        for name, shape in changed.items():
            place = name.replace("_of_", "/")
            if place in file:
                del file[place]
            claimed(file.create_dataset(place, shape, float))
    signed(path)


def signed(path: Path) -> None:
    """Put the digest of changed fields into the summary beside them."""
    summary = path.parent / SUMMARY
    record = json.loads(summary.read_text(encoding="utf-8"))
    record["fields_digest"] = hashlib.sha256(path.read_bytes()).hexdigest()
    summary.write_text(json.dumps(record), encoding="utf-8")


def claimed(dataset: h5py.Dataset) -> None:
    dataset.attrs.update({"unit": "m", "description": "claimed"})


def surface_result(path: Path, **changed: tuple[int, ...]) -> None:
    """A result of 24 x 20 cells and 6 increments."""
    claiming(small_result(), path, **changed)


NOT_A_RESULT = f"is not the {FIELDS} of a run: "
DIGEST = "its digest is not that"
RESULT_BOMBS = {
    "grid": (lambda path: surface_result(path, increments_of_pressure=(6, HUGE, HUGE)), CLAIM),
    "pressure": (lambda path: surface_result(path, increments_of_pressure=(6, 9, HUGE)), "shape"),
    "shear": (lambda path: surface_result(path, increments_of_shear=(6, 2, 9, HUGE)), "shape"),
    "dimensions": (lambda path: surface_result(path, x=(HUGE, HUGE)), CLAIM),
    "map": (lambda path: surface_result(path, maps_of_file=(HUGE, HUGE)), CLAIM),
    "chunks": (lambda path: many_chunks(path), "chunks, at most"),
    "zeros": (lambda path: damaged(path, b""), DIGEST),
}


def damaged(path: Path, head: bytes) -> None:
    surface_result(path)
    sparse(path, head)


def many_chunks(path: Path) -> None:
    """Numbers one by one: what takes the library long to find, and much memory to remember."""
    surface_result(path)
    with h5py.File(path, "a") as file:
        del file["x"]
        claimed(file.create_dataset("x", (MEGABYTE,), float, chunks=(1,)))
    signed(path)


@pytest.mark.parametrize(("write", "words"), RESULT_BOMBS.values(), ids=RESULT_BOMBS)
def test_claims_of_a_surface_result_are_refused_unread(tmp_path, write, words):
    write(tmp_path / FIELDS)
    words = words if words == DIGEST else f"{NOT_A_RESULT}.*{words}"
    with frugal(), pytest.raises(NoSuchState, match=words):
        state_of_run(tmp_path, None)


def replaced(file: h5py.File, name: str) -> np.ndarray:
    """The values of a dataset that is taken out of a file."""
    values = file[name][()]
    del file[name]
    return values


def other_number(file: h5py.File, folder: Path) -> None:
    file["increments/pressure"][0, 12, 10] *= 2


def external_link(file: h5py.File, folder: Path) -> None:
    with h5py.File(folder / "other.h5", "w") as other:
        other["pressure"] = replaced(file, "increments/pressure")
    file["increments/pressure"] = h5py.ExternalLink(folder / "other.h5", "/pressure")


@pytest.mark.parametrize(
    ("change", "own_digest", "words"),
    [
        (other_number, False, "was changed or damaged"),
        (external_link, True, "links to another place"),
    ],
)
def test_fields_that_were_changed_or_lie_elsewhere_are_refused(
    change,
    own_digest,
    words,
    tmp_path,
    monkeypatch,
):
    """HDF5, which a damaged file may crash, reads nothing of a file with another digest."""
    surface_result(tmp_path / FIELDS)
    with h5py.File(tmp_path / FIELDS, "a") as file:
        change(file, tmp_path)
    if own_digest:
        signed(tmp_path / FIELDS)
    else:
        monkeypatch.setattr("contact_results.files.stored_run.open_hdf5", None)
    with pytest.raises(ValueError, match=words):
        load(tmp_path)
    done = outcome("export", ".", "-o", "out", cwd=tmp_path)
    assert (done.returncode, words in done.stderr) == (2, True)


@pytest.mark.parametrize("head", [b"", FORMAT + b"\nthis solve\n"])
def test_checkpoint_of_zeros_is_refused_unread(tmp_path, head):
    sparse(tmp_path / "part", head)
    with frugal(), pytest.raises(Unusable, match=r"not a checkpoint of this version|larger than"):
        read_checkpoint_file(tmp_path / "part", "this solve")
