"""Tests of the HTML page and the overview figure of a run."""

import re
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.quiver import Quiver
from synthetic_result import MU, synthetic_result

from contact_results.figures.map_panels import PANEL, MapFrame, RingsAbove
from contact_results.figures.maps import field_map, latest_slip, stick_slip_map
from contact_results.figures.overview import DOTS_PER_INCH, PLACE, TITLE, overview
from contact_results.figures.profile_plot import profile_plot
from contact_results.figures.run_page import write_page
from contact_results.figures.style import figure_style
from contact_results.key_numbers import key_numbers
from contact_results.number_text import Uncertainty, number_text
from contact_results.result_report import ResultReport
from contact_results.surface import Rings
from contact_scene.quantities.stated_error import ErrorStatus, StatedError


@pytest.mark.parametrize("error", [3.2e-5, 4e-13, 4e-16])
def test_an_error_however_small_does_not_read_as_zero(error: float) -> None:
    text = number_text(0.3177303649, Uncertainty(error, True), 1.0)
    assert float(text.split(" ± ")[1]) == pytest.approx(error, rel=0.1, abs=0.0)


@pytest.mark.parametrize("value", [0.0, -4e-12, 3e-12])
@pytest.mark.parametrize(("error", "text"), [(7.5e-4, "0 ± 0.00075"), (7.5e-10, "0 ± 7.5e-10")])
def test_what_its_error_rounds_away_is_zero(value: float, error: float, text: str) -> None:
    assert number_text(value, Uncertainty(error, True), 1.0) == text


# ---- figures of slip


RADII = np.linspace(0.0, 1.0, 201)
CELLS = np.linspace(-0.9, 0.9, 31)


class OnRings:
    """One increment, whose slip has these components."""

    def __init__(self, **components: Any) -> None:
        for part in ("radial", "circumferential", "along_load"):
            setattr(self, f"slip_{part}", components.get(part))


def seen(direction: tuple[float, float], angles: Any = None, **components: Any) -> Any:
    step: Any = OnRings(**components)
    rings = Rings(RADII, angles, direction, polar="along_load" not in components)
    return RingsAbove(rings, CELLS, CELLS).vector(step, "slip")


@pytest.mark.parametrize("direction", [(1.0, 0.0), (0.6, 0.8)])
def test_rings_seen_from_above_are_the_field_that_they_sample(
    direction: tuple[float, float],
) -> None:
    """Slip outward, around, along the load, and one that depends on the angle."""
    x, y = np.meshgrid(CELLS, CELLS, indexing="ij")
    (c, s), near = direction, np.hypot(x, y) <= 1.0

    def assert_same(found: Any, x_expected: Any, y_expected: Any) -> None:
        for one, other in zip(found, (x_expected, y_expected), strict=True):
            np.testing.assert_allclose(one[near], (other + 0 * x)[near], atol=2e-4)

    assert_same(seen(direction, radial=RADII), x, y)
    assert_same(seen(direction, circumferential=RADII), -y, x)
    assert_same(seen(direction, along_load=np.ones_like(RADII)), c, s)
    angles = np.linspace(0.0, np.pi, 181)
    outward, around = RADII[:, None] * np.cos(angles), -RADII[:, None] * np.sin(angles)
    along = np.hypot(x, y)  # r cos θ outward and −r sin θ around are r along the load
    assert_same(
        seen(direction, angles, radial=outward, circumferential=around), c * along, s * along
    )


def ended(result: Any, **changes: Any) -> Any:
    last = replace(result.increments[-1], **changes)
    return replace(result, increments=(*result.increments[:-1], last))


def test_a_component_is_shown_with_its_own_error() -> None:
    both = StatedError(error=(1.0, 2.0), parts={}, status=ErrorStatus.ESTIMATED)
    pushed = ended(synthetic_result(), tangential_force=np.array([30.0, 40.0])).steps
    found = dict(key_numbers(pushed, {"tangential_force": both}))
    shown = [found[f"tangential force {axis}"] for axis in "xy"]
    assert shown == ["30.0 ± 1.0 N", "40.0 ± 2.0 N"]
    unknown = StatedError(error=None, parts={}, status=ErrorStatus.NOT_CONVERGED)
    assert " ? " in dict(key_numbers(pushed, {"approach": unknown}))["approach"]


def frame_of(report: ResultReport) -> MapFrame:
    frame = MapFrame.around_contact(report)
    assert frame is not None
    return frame


def test_a_map_has_every_cell_at_its_place_and_a_profile_the_limit_of_its_last_step() -> None:
    whole: Any = synthetic_result()
    result = ended(whole, pressure=whole.increments[-1].pressure / 2)
    report, end = ResultReport.of(result), result.steps[-1]
    with figure_style():
        figure: Any = field_map(report, frame_of(report), "pressure")
        drawn = figure.axes[2].images[0].get_array().filled(0.0)
        figure.draw_without_rendering()
        wide = figure.get_size_inches() * figure.axes[2].get_position().size
        (band,) = profile_plot(report).axes[1].collections
    np.testing.assert_allclose(1e9 * drawn, end.pressure.T)
    assert np.max(wide) == pytest.approx(PANEL, rel=0.2)  # labels take the rest
    highest = 1e6 * np.max(band.get_paths()[0].vertices[:, 1])
    assert highest == pytest.approx(MU * np.max(report.surface.along(end.pressure)))


def arrows(figure: Figure) -> list[tuple[Any, Quiver]]:
    return [(ax, c) for ax in figure.axes for c in ax.collections if isinstance(c, Quiver)]


def test_arrows_of_the_latest_slip_oppose_the_shear_where_it_slips() -> None:
    result: Any = synthetic_result()
    report = ResultReport.of(result)
    frame = frame_of(report)
    with figure_style():
        figure = stick_slip_map(report, frame)
    drawn = [(ax.get_title().partition(":")[0], arrow) for ax, arrow in arrows(figure)]
    assert drawn
    for title, arrow in drawn:
        step = result.steps[int(title.split()[1]) - 1]
        i, j = (
            np.argmin(np.abs(np.subtract.outer(at, 1e3 * centres)), axis=1)
            for at, centres in ((arrow.X, frame.cells.x), (arrow.Y, frame.cells.y))
        )
        q_x, q_y = step.shear[:, i, j]
        assert np.all(arrow.U * q_x + arrow.V * q_y < 0)
        assert np.all(step.in_contact[i, j] & ~step.in_stick[i, j])
    slips = [latest_slip(report, frame.cells, i) for i in result.increments if i.slip is not None]
    assert len(slips) > 2
    np.testing.assert_allclose(sum(slips), result.increments[-1].slip)


def test_the_overview_begins_with_the_profile_and_ends_with_the_last_numbers() -> None:
    result: Any = synthetic_result()
    report = ResultReport.of(result)
    with figure_style():
        figure = overview(report, frame_of(report))
    (numbers,) = (ax for ax in figure.axes if ax.texts and "status" in ax.texts[0].get_text())
    assert figure.axes[0].get_position().y0 > numbers.get_position().y1
    shown = numbers.texts[0].get_text().splitlines()
    assert shown[1:-1] == [f"{name}: {text}" for name, text in key_numbers(result.steps, None)]


@pytest.mark.parametrize("columns", [2, 3])
def test_a_page_shows_every_panel_of_the_overview_but_the_key_numbers(columns, tmp_path) -> None:
    result: Any = synthetic_result()
    with figure_style():
        figure = Figure(figsize=(columns * PLACE[0], 2 * PLACE[1] + TITLE))
        figure.savefig(tmp_path / "overview.png", dpi=DOTS_PER_INCH)
    write_page(ResultReport.of(result), tmp_path)
    page = (tmp_path / "index.html").read_text(encoding="utf-8")
    assert re.findall(r'aria-label="panel (\d)', page) == [*"12345"[: 2 * columns - 1]]
    across = re.findall(r"background-position:(\d+)%", page)
    assert across == [f"{100 * n // (columns - 1)}" for n in (*range(columns), *range(columns - 1))]
    assert page.count("data:image") == 1
