"""The page and the overview of a run say what it found, whatever its title."""

import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from matplotlib.text import Text
from synthetic_result import synthetic_result

from contact_results.figures.figure_files import _figures_called_for
from contact_results.figures.overview import DOTS_PER_INCH
from contact_results.figures.run_page import write_page
from contact_results.figures.style import figure_style, save
from contact_results.key_numbers import key_numbers
from contact_results.number_text import Uncertainty, number_text
from contact_results.result_files import write_result
from contact_scene.stated_error import ErrorStatus, StatedError

HOSTILE = "<script>alert(1)</script><img src=http://example.invalid/x.png> $x_{y$ & \"'"


def ended(result: Any, **changes: Any) -> Any:
    last = replace(result.increments[-1], **changes)
    return replace(result, increments=(*result.increments[:-1], last))


def hostile() -> Any:
    result = synthetic_result()
    return replace(result, scene=result.scene.model_copy(update={"title": HOSTILE}))


@pytest.mark.usefixtures("undrawn")
def test_a_page_holds_all_figures_and_asks_for_nothing(tmp_path: Path) -> None:
    write_result(hostile(), tmp_path, figures="all")
    page = (tmp_path / "index.html").read_text(encoding="utf-8")
    assert page.count("<img") == len(list(tmp_path.glob("*.png")))
    assert all(source.startswith("data:") for source in re.findall(r'src="([^"]*)', page))
    assert "<script" not in page
    links = re.findall(r'href="([^"]*)', page)  # every figure to itself, larger, and back
    assert sorted(set(links)) == sorted(
        ["#", *(f"#{path.stem}" for path in tmp_path.glob("*.png"))]
    )
    assert sorted(re.findall(r'id="([^"]*)', page)) == sorted(x[1:] for x in set(links) if x[1:])
    assert "default-src 'none'" in page


def test_the_overview_alone_shows_the_title_and_draws_it_whatever_it_is(tmp_path: Path) -> None:
    place, titled = tmp_path / "overview.png", set()
    with figure_style():
        for name, figure in _figures_called_for(hostile(), (), None):
            if any("alert(1)" in text.get_text() for text in figure.findobj(Text)):
                titled.add(name)
                save(figure, tmp_path / name, DOTS_PER_INCH)
    assert titled == {place.name}
    assert place.stat().st_size < 200_000


def test_numbers_on_the_page_carry_their_errors(tmp_path: Path) -> None:
    result = synthetic_result()
    error = StatedError(error=2e6, parts={"cells": 2e6}, status=ErrorStatus.ESTIMATED)
    write_page(result, tmp_path, {"peak_pressure": error})
    assert "3.0000 ± 0.0020 GPa" in (tmp_path / "index.html").read_text(encoding="utf-8")


@pytest.mark.parametrize("error", [3.2e-5, 4e-13, 4e-16])
def test_an_error_however_small_does_not_read_as_zero(error: float) -> None:
    text = number_text(0.3177303649, Uncertainty(error, True), 1.0)
    assert float(text.split(" ± ")[1]) == pytest.approx(error, rel=0.1, abs=0.0)


@pytest.mark.parametrize("value", [0.0, -4e-12, 3e-12])
@pytest.mark.parametrize(("error", "text"), [(7.5e-4, "0 ± 0.00075"), (7.5e-10, "0 ± 7.5e-10")])
def test_what_its_error_rounds_away_is_zero(value: float, error: float, text: str) -> None:
    assert number_text(value, Uncertainty(error, True), 1.0) == text


@pytest.mark.parametrize(("name", "tiny"), [("torque", 9.9e-22), ("twist", 1e-20)])
def test_round_off_beside_the_load_is_nothing(name: str, tiny: float) -> None:
    found = dict(key_numbers(ended(synthetic_result(), **{name: tiny}).steps, None))
    assert found[name].split()[0] == "0"
    told = dict(key_numbers(ended(synthetic_result(), **{name: 1e-5}).steps, None))
    assert told[name].split()[0] == "10"
