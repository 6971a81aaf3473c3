"""The tables of a run: every number has its unit, every column its meaning, whoever solved."""

import csv
import json
from pathlib import Path

import pytest
from command import rows
from fem_scenes import solved
from synthetic_result import synthetic_result
from test_section_output import LOOP, TWISTED

import slipstick
from contact_results.directory.file_names import COLUMNS, SUMMARY
from contact_results.result_files import write_result
from contact_scene.quantities.convention import CONVENTION
from contact_scene.quantities.summary import (
    SUMMARY_VERSION,
    load_summary,
)

RESULTS = {
    "cells": synthetic_result,
    "cells, frictionless": lambda: synthetic_result(friction=False),
    "elements": lambda: solved(LOOP, 8, harmonics=2),
    "elements, twisted": lambda: solved(TWISTED, 8, harmonics=2),
    "radii": lambda: slipstick.solve(LOOP.model_copy(update={"friction": None,
                                                            "loading": LOOP.loading[:1]}),
                                     "radial"),
}  # fmt: skip
# Names of rows, not quantities.
LABELS = {"step", "increment", "start_step", "end_step"}


@pytest.fixture(scope="module")
def written(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    places = {name: tmp_path_factory.mktemp("written") for name in RESULTS}
    for name, place in places.items():
        write_result(RESULTS[name](), place, figures="none")
    return places


def header(path: Path) -> list[str]:
    with open(path, newline="", encoding="ascii") as file:
        return next(csv.reader(file))


def test_every_column_but_the_names_of_rows_has_its_unit(written: dict[str, Path]) -> None:
    assert set(written) == set(RESULTS)
    for place in written.values():
        for path in set(place.glob("*.csv")) - {place / COLUMNS}:
            without = {name for name in header(path) if not name.endswith("]")}
            assert without <= LABELS, path.name


def test_every_column_has_one_row_that_says_what_it_means(written: dict[str, Path]) -> None:
    assert set(written) == set(RESULTS)
    for place in written.values():
        (first, *told) = rows(place / COLUMNS)
        assert first == {"file": "all", "column": "", "unit": "SI", "meaning": CONVENTION}
        found = [(row["file"], row["column"], row["unit"]) for row in told]
        tables = sorted(set(place.glob("*.csv")) - {place / COLUMNS})
        split = (
            (path.name, name, unit.removesuffix("]"))
            for path in tables
            for name, _, unit in (column.partition(" [") for column in header(path))
        )
        assert sorted(found) == sorted(split)
        assert all(row["meaning"].isascii() and len(row["meaning"]) > 8 for row in told)


def test_all_solvers_have_the_same_columns(written: dict[str, Path]) -> None:
    for name in ("profiles.csv", "increments.csv"):
        assert len({tuple(header(place / name)) for place in written.values()}) == 1


def test_files_say_axes_and_signs_themselves(written: dict[str, Path]) -> None:
    texts = [(place / SUMMARY).read_text(encoding="utf-8") for place in written.values()]
    assert {json.loads(text)["convention"] for text in texts} == {CONVENTION}


@pytest.mark.parametrize(("other", "age"), [(-1, "an earlier"), (1, "a newer")])
def test_a_summary_of_another_version_is_refused(
    written: dict[str, Path], other: int, age: str
) -> None:
    record = json.loads((written["cells"] / SUMMARY).read_text(encoding="utf-8"))
    record["schema_version"] = SUMMARY_VERSION + other
    told = f"^schema_version: version {SUMMARY_VERSION + other} is of {age} slipstick"
    with pytest.raises(ValueError, match=told):
        load_summary(json.dumps(record))
