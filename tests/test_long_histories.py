"""Fields of a long history lie in a file: no result shows it, and little is in memory."""

import gc
import pickle
import tracemalloc
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from synthetic_result import synthetic_result
from test_checkpoint import SOLVES, All, checkpoint, differences

from contact_results.directory.checkpoint_file import pack
from contact_results.result_files import write_result
from contact_scene import stored_fields
from contact_scene.stored_fields import FieldStore, WithFields
from semi_analytical.fields import Increment, Result

CHECKPOINT = "contact_results.directory.checkpoint"
LIGHT = 600  # bytes of an increment that is in the file
MEGABYTE = 1 << 20


@pytest.fixture
def stored(monkeypatch: pytest.MonkeyPatch) -> None:
    """Whatever can be is in a file."""
    monkeypatch.setattr(stored_fields, "MOST_HELD", 0)
    monkeypatch.setattr(stored_fields, "LEAST_STORED", 1)


def in_file(value: WithFields) -> list[str]:
    kept = vars(value).items()
    return [name for name, array in kept if isinstance(array, stored_fields.StoredArray)]


def long_result(count: int, cells: int = 64) -> Result:
    """One increment so often that only its numbers could be held, each time with arrays of its
    own, and a cycle in it."""
    short = synthetic_result((cells, cells))
    *before, last = short.increments
    fields = FieldStore()
    increments = [*before, *(fields.kept(anew(last, number)) for number in range(count))]
    return replace(short, increments=tuple(increments))


def anew(increment: Increment, number: int) -> Increment:
    scaled: dict[str, Any] = {
        name: array * (1 + 1e-6 * number)
        for name, array in vars(increment).items()
        if isinstance(array, np.ndarray) and array.dtype == float
    }
    return replace(increment, **scaled)


@pytest.mark.parametrize("name", ["similar", "torsion", "similar by penalty"])
def test_files_are_the_same_to_the_byte(
    name: str, tmp_path: Path, request: pytest.FixtureRequest
) -> None:
    results = [SOLVES[name](None)]
    request.getfixturevalue("stored")
    results.append(SOLVES[name](None))
    assert not in_file(results[0].increments[-1])
    assert {"pressure", "gap", "in_stick"} <= {*in_file(results[1].increments[-1])}
    assert [*differences(results[0].increments, results[1].increments)] == []
    written = []
    for number, result in enumerate(results):
        directory = tmp_path / str(number)
        directory.mkdir()
        write_result(result, directory, figures="none", all_fields=True)
        written.append({path.name: path.read_bytes() for path in directory.iterdir()})
    assert written[0] == written[1]


@pytest.mark.usefixtures("stored")
def test_what_increments_share_is_kept_once() -> None:
    increments = SOLVES["similar"](None).increments
    for before, after in pairwise(increments):
        assert vars(after)["slip_before"] == vars(before)["slip"]  # the place in the file
    received = pickle.loads(pickle.dumps(increments))
    assert not in_file(received[-1])
    assert [*differences(increments, received)] == []


@pytest.mark.usefixtures("stored")
def test_a_field_that_was_read_cannot_be_written_to() -> None:
    increment = long_result(1).increments[-1]
    with pytest.raises(ValueError, match="read-only"):
        increment.pressure[0, 0] = 1.0
    assert increment.pressure is not increment.pressure


@pytest.mark.usefixtures("stored")
def test_an_increment_holds_a_few_hundred_bytes() -> None:
    """3 000 of them less than 2 MB, besides `MOST_HELD`."""
    held = []
    for count in (100, 500):
        gc.collect()
        tracemalloc.start()
        try:
            result = long_result(count)
            gc.collect()
            held.append(tracemalloc.get_traced_memory()[0])
        finally:
            tracemalloc.stop()
    assert held[1] - held[0] < 400 * LIGHT
    assert len(in_file(result.increments[-1])) >= 6


@pytest.mark.usefixtures("stored")
def test_writing_holds_a_few_fields(tmp_path: Path) -> None:
    """Of 13 MB, and of the file that they make."""
    result = long_result(40)
    gc.collect()
    tracemalloc.start()
    try:
        write_result(result, tmp_path, figures="none", all_fields=True)
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert peak < 2 * MEGABYTE


def test_checkpoint_of_many_increments_is_written_in_parts(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """No part holds more than it may, and only a whole sequence of them is gone on from."""
    said: list[str] = []
    every = All()
    whole = SOLVES["similar"](every)
    monkeypatch.setattr(f"{CHECKPOINT}.SHARE", np.inf)
    monkeypatch.setattr(f"{CHECKPOINT}.MOST_IN_PART", 1)
    keeper = checkpoint(tmp_path, said)
    keeper.keep(every.kept[2])
    keeper.keep(every.kept[-1])
    keeper.close()
    parts = sorted((tmp_path / "checkpoint").iterdir())
    assert len(parts) == len(whole.increments)
    pack(every.kept[0], "", tmp_path / "one")  # which has a state besides
    assert parts[4].stat().st_size < (tmp_path / "one").stat().st_size
    for done in (len(whole.increments), 3):
        again = checkpoint(tmp_path, said)
        last = again.last()
        assert last is not None
        assert last.mark.done == done
        if done > 3:
            again.close()
            parts[-1].unlink()
    assert [*differences(whole.increments, SOLVES["similar"](again).increments)] == []


def test_full_disk_is_told_with_the_place(monkeypatch: pytest.MonkeyPatch, stored: None) -> None:
    def full(**_: Any) -> Any:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("tempfile.TemporaryFile", full)
    with pytest.raises(OSError, match=r"No space left on device.*TMPDIR"):
        long_result(1)
