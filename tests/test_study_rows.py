"""Tests of the rows of a study: their files, and the rules by which they are judged."""

import json
from dataclasses import dataclass
from enum import StrEnum

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from verification.running.study import (
    CaseRecord,
    Row,
    TypedRow,
    found,
    json_text,
    parameters_of,
    row_files,
)


class How(StrEnum):
    WELL = "well"


@dataclass(frozen=True)
class Inner:
    ratio: float


@dataclass(frozen=True)
class Asked:
    name: str
    how: How = How.WELL
    inner: Inner = Inner(2.0)
    cells: tuple[int, int] = (4, 6)


def test_the_clock_changes_no_other_file():
    one, other = (row_files({"one": CaseRecord(seconds=s, repeats=n)}) for s, n in ((1, 1), (2, 5)))
    assert {name for name in one if one[name] != other[name]} == {"seconds.csv"}


def test_parameters_are_the_plain_values_of_a_case():
    expected = {"name": "a", "how": "well", "ratio": 2.0, "cells": "4 x 6"}
    assert parameters_of(Asked("a")) == expected


def test_cases_without_a_record_are_left_out():
    a, b = Asked("a"), Asked("b")
    assert found((a, b), {"b": CaseRecord()}) == {b: CaseRecord()}


said = st.text(st.sampled_from('[]{}", \n\\a'), max_size=6)
anything = st.recursive(
    st.none() | st.booleans() | st.integers() | said,
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(said, inner, max_size=3),
)


@example({"words": ["two  spaces", "a  ]  b", "[\n", "}{"]})
@given(st.dictionaries(said, anything, max_size=3))
def test_what_is_written_comes_back_whatever_brackets_its_texts_have(values):
    assert json.loads(json_text(values)) == values


class Ended(TypedRow):
    """With a field that rows of before do not have."""

    residual: float
    way: str = "none was said"


def test_a_row_of_before_a_field_was_there_is_read_with_its_default():
    before = Row(measures={"residual": 1e-9})
    assert Ended.of(before) == Ended(residual=1e-9)
    with pytest.raises(ValueError, match="residual"):
        Ended.of(Row(words={"way": "any"}))
