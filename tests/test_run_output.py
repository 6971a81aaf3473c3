"""Tests of the files of a run: their content, and equal bytes for equal results."""

import os
import re
import subprocess
import sys
from dataclasses import replace
from html import escape
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure
from small_result import small_errors, small_result

from contact_results.directory.file_names import PAGE
from contact_results.figures.map_panels import PANEL, MapFrame
from contact_results.figures.maps import field_map
from contact_results.figures.overview import DOTS_PER_INCH, PLACE, TITLE, overview
from contact_results.figures.run_page import write_page
from contact_results.figures.style import figure_style
from contact_results.number_text import Uncertainty, number_text
from contact_results.result_files import write_result
from contact_results.result_report import ResultReport
from contact_scene import read_scene_file
from contact_scene.discretisation import SurfaceDiscretisation
from contact_scene.quantities.stated_error import StatedError, StatedErrors
from slipstick import solve

ROOT = Path(__file__).resolve().parents[1]


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    result, directory = small_result(), tmp_path_factory.mktemp("written")
    write_result(result, directory, figures="all", errors=small_errors(result))
    return result, directory


def test_equal_results_give_equal_bytes(written, tmp_path):
    """In a fresh process with other hash seed, locale and matplotlibrc, too."""
    script = (
        "import sys; from pathlib import Path\n"
        "from small_result import small_errors, small_result\n"
        "from contact_results.result_files import write_result\n"
        "result = small_result()\n"
        "errors = small_errors(result)\n"
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
def test_a_title_of_any_characters_is_drawn_without_a_warning(title, tmp_path, recwarn):
    result = small_result()
    named = replace(result, scene=result.scene.model_copy(update={"title": title}))
    assert not write_result(named, tmp_path).causes
    assert (tmp_path / PAGE).read_text(encoding="utf-8").count(escape(title)) >= 2
    assert [str(warning.message) for warning in recwarn] == []


# ---- page


@pytest.mark.parametrize("error", [3.2e-5, 4e-13, 4e-16])
def test_an_error_however_small_does_not_read_as_zero(error):
    text = number_text(0.3177303649, Uncertainty(error, True), 1.0)
    assert float(text.split(" ± ")[1]) == pytest.approx(error, rel=0.1, abs=0.0)


@pytest.mark.parametrize("value", [0.0, -4e-12, 3e-12])
@pytest.mark.parametrize(("error", "text"), [(7.5e-4, "0 ± 0.00075"), (7.5e-10, "0 ± 7.5e-10")])
def test_what_its_error_rounds_away_is_zero(value, error, text):
    assert number_text(value, Uncertainty(error, True), 1.0) == text


@pytest.mark.parametrize("columns", [2, 3])
def test_a_page_shows_every_panel_of_the_overview_but_the_key_numbers(columns, tmp_path):
    result = small_result()
    with figure_style():
        figure = Figure(figsize=(columns * PLACE[0], 2 * PLACE[1] + TITLE))
        figure.savefig(tmp_path / "overview.png", dpi=DOTS_PER_INCH)
    write_page(ResultReport.of(result), tmp_path)
    page = (tmp_path / "index.html").read_text(encoding="utf-8")
    assert re.findall(r'aria-label="panel (\d)', page) == [*"12345"[: 2 * columns - 1]]
    across = re.findall(r"background-position:(\d+)%", page)
    assert across == [f"{100 * n // (columns - 1)}" for n in (*range(columns), *range(columns - 1))]
    assert page.count("data:image") == 1


def test_a_title_of_two_lines_stands_above_the_panels():
    """The page cuts the overview into panels below the title."""
    result = small_result()
    named = replace(result, scene=result.scene.model_copy(update={"title": "A long title " * 10}))
    report = ResultReport.of(named)
    with figure_style():
        figure = overview(report, MapFrame.around_contact(report))
        (title,) = [text for text in figure.texts if "end of step" in text.get_text()]
        title_box = title.get_window_extent(figure.canvas.get_renderer())
    assert title.get_text().count("\n") == 1
    assert title_box.y0 > figure.bbox.height - TITLE * figure.dpi
    assert title_box.y1 < figure.bbox.height


def test_ticks_and_key_numbers_of_an_overview_fit():
    """Ticks on the narrow section of a thick stack of layers, and a number of 12 digits."""
    layered = read_scene_file(ROOT / "docs" / "gallery" / "road.toml").scene
    result = solve(layered, discretisation=SurfaceDiscretisation(cells=(24, 24)))
    errors = [{"contact_radius": StatedError(error=5e-11, parts={}, status="estimated")}]
    report = replace(ResultReport.of(result), errors=StatedErrors(tuple(errors), (), (0.0,)))
    with figure_style():
        figure = overview(report, MapFrame.around_contact(report))
        figure.draw_without_rendering()
        (section,) = (ax for ax in figure.axes if ax.get_ylabel() == "depth z (m)")
        boxes = [label.get_window_extent() for label in section.get_xticklabels()]
        texts = [text.get_window_extent() for ax in figure.axes for text in ax.texts]
    assert len(boxes) == 2
    assert boxes[0].x1 < boxes[1].x0
    assert max(box.x1 for box in texts) < figure.bbox.width


def test_a_map_fills_its_panel_whatever_the_size_of_the_contact():
    report = ResultReport.of(small_result())
    frame = MapFrame.around_contact(report)
    assert frame is not None
    with figure_style():
        figure = field_map(report, frame, "pressure")
        figure.draw_without_rendering()
        drawn = figure.get_size_inches() * figure.axes[2].get_position().size
    assert np.max(drawn) == pytest.approx(PANEL, rel=0.2)  # labels take the rest
