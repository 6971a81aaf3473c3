"""Tests of invalid scene files: every mistake is reported once, with file, line, key and remedy."""

import copy
import gc
import math
import time
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import Document, as_toml, documents

from contact_scene import SceneError, SceneFile, read_scene_file

# ---- random files


# The profile says how much: dev and ci 25 -> 100 and 500, nightly 2 000 -> 8 000 and 40 000
# examples.
STRUCTURED = settings(max_examples=7 * settings().max_examples)
LONGEST = 0.05  # seconds of CPU; of 1 250 examples half took 0.5 ms, the longest 4 ms

JUNK = st.recursive(
    st.sampled_from([0, -1, 1, 10**30, True, 0.0, -0.0, 1e300, 5e-324, math.nan, math.inf])
    | st.sampled_from(["", "rigid", "1 mm", "1 s", "1 kN", "sphere", "height_map", "../x"])
    | st.sampled_from(["<sphere>", "nan mm", "1e9 GPa", "1 furlong"]),
    lambda inner: (
        st.lists(inner, max_size=3)
        | st.dictionaries(
            st.sampled_from(["shape", "material", "radius", "map", "file", "<elastic>", "x", ""]),
            inner,
            max_size=3,
        )
    ),
    max_leaves=5,
)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("fuzz")


def check(error: SceneError, path: Path, lines: int) -> None:
    assert error.problems
    assert len(set(error.problems)) == len(error.problems)
    for problem in error.problems:
        assert str(problem).isprintable()
        assert problem.file == str(path)
        assert problem.line is None or 1 <= problem.line <= lines


def outcome(folder: Path, contents: bytes) -> SceneFile | SceneError:
    path = folder / "scene.toml"
    path.write_bytes(contents)
    gc.disable()  # what Hypothesis leaves behind is not the reader's to tidy up
    start = time.process_time()
    try:
        return read_scene_file(path)
    except SceneError as error:
        check(error, path, contents.count(b"\n") + 1)
        return error
    finally:
        took = time.process_time() - start
        gc.enable()
        assert took < LONGEST


def places(value, path=()):
    keys = value if isinstance(value, dict) else range(len(value)) if type(value) is list else ()
    found = [(*path, key) for key in keys]
    return found + [place for key in keys for place in places(value[key], (*path, key))]


@st.composite
def mutated(draw: st.DrawFn) -> Document:
    document = copy.deepcopy(draw(documents()))
    for _ in range(draw(st.integers(1, 4))):
        where = draw(st.sampled_from(places(document)))
        holder = document
        for key in where[:-1]:
            holder = holder[key]
        change = draw(st.sampled_from(["replace", "remove", "add", "rename"]))
        if change == "replace":
            holder[where[-1]] = draw(JUNK)
        elif change == "add" and isinstance(holder, dict):
            holder[draw(st.sampled_from(["x", "<sphere>", "layers", "map"]))] = draw(JUNK)
        elif change == "rename" and isinstance(holder, dict):
            holder[str(where[-1])[:-1]] = holder.pop(where[-1])
        else:
            del holder[where[-1]]
        if not places(document):
            break
    return document


@STRUCTURED
@given(mutated())
def test_a_mutated_scene_is_read_or_refused(folder, document):
    assert outcome(folder, as_toml(document).encode())


@given(st.binary(max_size=200) | st.text(max_size=100).map(str.encode))
def test_anything_else_is_refused(folder, contents):
    assert isinstance(outcome(folder, contents), SceneError)
