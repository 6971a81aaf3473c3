"""Tests of the files of a run: their content, and equal bytes for equal results."""

import json
import os
import subprocess
import sys
from dataclasses import replace
from html import escape
from pathlib import Path

import numpy as np
import pytest
from synthetic_result import CONVOLUTIONS, ITERATIONS, synthetic_errors, synthetic_result

from contact_results.directory.file_names import PAGE, SUMMARY
from contact_results.directory.timing import Stopwatch, write_timing
from contact_results.key_numbers import key_numbers
from contact_results.result_files import write_result
from contact_scene.quantities.field_metadata import Kind
from contact_scene.quantities.increment import SCALARS
from contact_scene.quantities.summary import (
    load_summary,
    summary_schema,
)
from semi_analytical.fields import Result

ROOT = Path(__file__).resolve().parents[1]


@pytest.fixture(scope="module")
def written(tmp_path_factory: pytest.TempPathFactory) -> tuple[Result, Path]:
    result, directory = synthetic_result(), tmp_path_factory.mktemp("written")
    write_result(result, directory, figures="all", errors=synthetic_errors(result))
    return result, directory


def test_equal_results_give_equal_bytes(written: tuple[Result, Path], tmp_path: Path) -> None:
    """In a fresh process with other hash seed, locale and matplotlibrc, too."""
    script = (
        "import sys; from pathlib import Path\n"
        "from synthetic_result import synthetic_errors, synthetic_result\n"
        "from contact_results.result_files import write_result\n"
        "result = synthetic_result()\n"
        "errors = synthetic_errors(result)\n"
        "write_result(result, Path(sys.argv[1]), figures='all', errors=errors)"
    )
    (tmp_path / "matplotlibrc").write_text(
        "font.size: 20\nlines.solid_capstyle: butt\naxes.facecolor: red\n"
    )
    again = tmp_path / "again"
    again.mkdir()
    subprocess.run(
        [sys.executable, "-c", script, again],
        cwd=tmp_path,
        env=os.environ | {"PYTHONPATH": f"{ROOT}:{ROOT / 'tests'}", "PYTHONHASHSEED": "7"},
        check=True,
    )
    first = {path.name: path.read_bytes() for path in written[1].iterdir()}
    assert first == {path.name: path.read_bytes() for path in again.iterdir()}


@pytest.mark.parametrize("title", ["日本語 😀", r"$x_ \frac{$ 100 % \n<b>&"])
def test_a_title_of_any_characters_is_drawn_without_a_warning(
    title: str, tmp_path: Path, recwarn: pytest.WarningsRecorder
) -> None:
    result = synthetic_result()
    named = replace(result, scene=result.scene.model_copy(update={"title": title}))
    assert not write_result(named, tmp_path).causes
    assert (tmp_path / PAGE).read_text(encoding="utf-8").count(escape(title)) >= 2
    assert [str(warning.message) for warning in recwarn] == []


def test_summary_fulfils_its_schema_and_reads_back(written: tuple[Result, Path]) -> None:
    import jsonschema

    result, directory = written
    text = (directory / SUMMARY).read_text(encoding="utf-8")
    jsonschema.validate(json.loads(text), summary_schema())
    summary, errors = load_summary(text), synthetic_errors(result).steps
    assert tuple(step.errors for step in summary.steps) == errors
    page = (directory / PAGE).read_text(encoding="utf-8")
    assert all(shown in page for _, shown in key_numbers(result.steps, errors[-1]))
    assert len(summary.steps) == len(result.scene.loading)
    for step, end in zip(summary.steps, result.steps, strict=True):
        within = [i for i in result.increments if i.step == end.step]
        for name, mark in SCALARS.items():
            values = [v for i in within if (v := getattr(i, name)) is not None] or [None]
            expected = max(values) if mark.kind is Kind.LARGEST and values[0] else values[-1]
            assert np.array_equal(getattr(step, name), expected), name


def test_timing_counts_the_work_of_all_increments_of_a_step(tmp_path: Path) -> None:
    result = synthetic_result()
    write_timing(Stopwatch(), tmp_path, result.increments)
    record = json.loads((tmp_path / "timing.json").read_text(encoding="utf-8"))
    steps = record["counters"]
    assert 2e7 < record["peak_memory_bytes"] < 1e11  # an interpreter with numpy takes more
    numbers = [end.increments_in_step for end in result.steps]
    assert [step["increments"] for step in steps] == numbers
    assert [step["iterations"] for step in steps] == [ITERATIONS * number for number in numbers]
    assert [step["convolutions"] for step in steps] == [CONVOLUTIONS * n for n in numbers]
    assert [step["factorizations"] for step in steps] == [None] * len(numbers)
