"""Fields of a long history lie in a file: no result shows it, and little is in memory."""

import gc
import tracemalloc
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from synthetic_result import synthetic_result
from test_checkpoint import SOLVES, differences

from contact_results.result_files import write_result
from contact_scene import stored_fields
from contact_scene.stored_fields import FieldStore, WithFields
from semi_analytical.fields import Increment, Result

LIGHT = 600  # bytes of an increment that is in the file


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


def test_full_disk_is_told_with_the_place(monkeypatch: pytest.MonkeyPatch, stored: None) -> None:
    def full(**_: Any) -> Any:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("tempfile.TemporaryFile", full)
    with pytest.raises(OSError, match=r"No space left on device.*TMPDIR"):
        long_result(1)
