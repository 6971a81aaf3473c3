"""Tests of charts: labels of logarithmic axes, visible points, distinguishable series."""

import itertools
import re
from pathlib import Path

import numpy as np
import pytest

import verification.report
from contact_results.figures import style
from verification.exhibits.chart import Chart, Look, Panel, curve
from verification.report.drawing import draw, inline_svg

STYLES = Path(verification.report.__file__).parent / "templates" / "style.css"
# contrasts that WCAG 2.1 asks for, AA
TEXT = 4.5
GRAPHICS = 3.0
INKS = ("ink", "soft", "link", "pass", "fail", "inconclusive")
LINES = ("reference", *(f"series-{n}" for n in range(1, 7)))


@pytest.mark.parametrize("letters", [10, 70])
def test_a_legend_leaves_the_plot_half_of_the_width(letters):
    curves = tuple(curve(f"{n} {'m' * letters}", [1, 2], [n, n + 1], series=n) for n in range(8))
    panel = Panel(x_label="x", y_label="y", curves=curves, height=2.4)
    chart = Chart(name="one", title="t", caption="c", rows=((panel,),))
    with style.figure_style():
        figure = draw(chart)
        figure.draw_without_rendering()
        legend = [*figure.legends, figure.axes[0].get_legend()][0].get_window_extent()
    assert figure.axes[0].get_position().width > 0.5
    assert figure.axes[0].get_position().height * figure.get_figheight() > 1.5
    # Beside the plot or below it, never on it.
    assert not legend.overlaps(figure.axes[0].get_window_extent())
    assert all(f"{n} {'m' * letters}" in inline_svg(chart) for n in range(8))


@pytest.mark.parametrize(("last", "spread"), [(1.1, 0.05), (4.0, 0.6)])
def test_equal_times_are_not_drawn_apart(last, spread):
    """Work of 1 to 1.1 s takes a tenth of the axis, and four times the work two thirds."""
    work = curve("cells", [1.0, last], [1e-2, 1e-4], Look.POINTS)
    panel = Panel(
        x_label="time", y_label="error", curves=(work,), logarithmic=True, least_range=10.0
    )
    with style.figure_style():
        (axes,) = draw(Chart(name="one", title="t", caption="c", rows=((panel,),))).axes
    low, high = np.log(axes.get_xlim())
    assert np.log(last) / (high - low) == pytest.approx(spread, abs=0.1)


@pytest.mark.parametrize("ratio", [1.0003, 1.004, 1.01, 1.5, 2.4, 4.9, 5.1])
def test_labels_of_a_short_logarithmic_axis_differ_and_do_not_overlap(ratio):
    errors = curve("cells", [1.18e-4, ratio * 1.18e-4], [1e-2, 1e-3], Look.POINTS)
    panel = Panel(x_label="time", y_label="error", curves=(errors,), logarithmic=True)
    with style.figure_style():
        figure = draw(Chart(name="one", title="t", caption="c", rows=((panel,),)))
        figure.draw_without_rendering()
        (axes,) = figure.axes
        low, high = axes.get_xlim()
        places = zip(axes.get_xticks(), axes.get_xticklabels(), strict=True)
        labels = [label for x, label in places if low <= x <= high]
        boxes = [label.get_window_extent() for label in labels]
    assert len({label.get_text() for label in labels}) == len(labels) >= 2
    assert all(one.x1 < other.x0 for one, other in itertools.pairwise(boxes))


def test_no_two_series_of_one_chart_are_drawn_alike():
    names = range(36)
    curves = tuple(curve(str(n), [0, 1], [0, n], Look.COMPUTED, n) for n in names)
    chart = Chart(
        name="one",
        title="t",
        caption="c",
        rows=((Panel(x_label="x", y_label="y", curves=curves),),),
    )
    with style.figure_style():
        (axes,) = draw(chart).axes
    looks = {(line.get_color(), str(vars(line)["_dash_pattern"])) for line in axes.get_lines()}
    assert len(looks) == len(names)


def test_a_map_shows_every_named_place_with_half_a_place_around_it():
    tiles = curve("all", [0, 2], [0, 3], Look.TILES)
    panel = Panel(
        x_label="x",
        y_label="y",
        curves=(tiles,),
        x_places=("a", "b", "c"),
        y_places=("1", "2", "3", "4"),
    )
    with style.figure_style():
        (axes,) = draw(Chart(name="map", title="t", caption="c", rows=((panel,),))).axes
    assert [text.get_text() for text in axes.get_xticklabels()] == ["a", "b", "c"]
    assert [text.get_text() for text in axes.get_yticklabels()] == ["1", "2", "3", "4"]
    assert axes.get_xlim() == (-0.5, 2.5)
    assert axes.get_ylim()[0] == -0.5
    assert 3.5 <= axes.get_ylim()[1] < 4


def _luminance(colour: str) -> float:
    parts = [int(colour[n : n + 2], 16) / 255 for n in (1, 3, 5)]
    linear = [c / 12.92 if c <= 0.03928 else ((c + 0.055) / 1.055) ** 2.4 for c in parts]
    return float(np.dot((0.2126, 0.7152, 0.0722), linear))


def _contrast(one: str, other: str) -> float:
    dark, light = sorted((_luminance(one), _luminance(other)))
    return (light + 0.05) / (dark + 0.05)


@pytest.mark.parametrize("scheme", [0, 1, 2], ids=["light", "dark", "print"])
def test_text_and_lines_stand_out_from_the_paper_in_every_scheme(scheme):
    blocks = re.findall(r":root \{(.*?)\}", STYLES.read_text(encoding="utf-8"), re.DOTALL)
    colours = dict(re.findall(r"--([\w-]+): (#[0-9A-Fa-f]{6});", blocks[scheme]))
    for name in INKS:
        for behind in ("paper", "panel"):
            assert _contrast(colours[name], colours[behind]) >= TEXT, (name, behind)
    for name in LINES:
        assert _contrast(colours[name], colours["paper"]) >= GRAPHICS, name
