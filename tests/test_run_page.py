"""The page and the overview of a run say what it found, whatever its title."""

import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.quiver import Quiver
from matplotlib.text import Text
from synthetic_result import synthetic_result

from contact_results.figures.figure_files import seen_from_above
from contact_results.figures.map_panels import RingsAbove
from contact_results.figures.maps import stick_slip_map
from contact_results.figures.overview import DOTS_PER_INCH, overview
from contact_results.figures.run_page import write_page
from contact_results.figures.style import figure_style, save
from contact_results.key_numbers import key_numbers, outcome_columns
from contact_results.number_text import Uncertainty, number_text
from contact_results.result_files import write_result
from contact_results.surface import Rings
from contact_scene.stated_error import ErrorStatus, StatedError
from slipstick.cli import terminal

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


def test_the_overview_shows_the_title_and_draws_it_whatever_it_is(tmp_path: Path) -> None:
    place = tmp_path / "overview.png"
    with figure_style():
        figure = overview(hostile(), seen_from_above(hostile()), None)
        assert any("alert(1)" in text.get_text() for text in figure.findobj(Text))
        save(figure, place, DOTS_PER_INCH)
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


# ---- Round-off as nothing, and wide tables in blocks.


ROOT = Path(__file__).resolve().parents[1]


def test_a_torque_of_round_off_is_zero_on_the_console() -> None:
    steps = synthetic_result().steps
    twisted = [replace(step, torque=9.9e-22, twist=1e-3) for step in steps]
    (torques,) = (texts for name, texts in outcome_columns(twisted).items() if "torque" in name)
    assert torques == ["0"] * len(steps)


@pytest.mark.parametrize("width", [40, 80, 200])
def test_wide_tables_break_between_columns(
    width: int, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(terminal, "WIDE", width)
    columns = {"step": ["1", "2"]} | {
        f"quantity\n{k}": [f"{k}.{10**9 + k}", "–"] for k in range(20)
    }
    terminal.print_table(columns, zip(*columns.values(), strict=True), numbers=True)
    lines = capsys.readouterr().out.splitlines()
    assert max(map(len, lines)) <= width
    shown = [word for line in lines for word in line.split()]
    for entries in list(columns.values())[1:]:
        assert shown.count(entries[0]) == 1
    per_block = (width - 6) // 15  # a name of four letters, columns of up to 13 and gaps of 2
    blocks = sum(line.split()[:1] == ["step"] for line in lines)
    assert blocks <= -(-20 // per_block)


# ---- Figures of slip show what was computed, seen alike from cells and from rings.


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


def arrows(figure: Figure) -> list[tuple[Any, Quiver]]:
    return [(ax, c) for ax in figure.axes for c in ax.collections if isinstance(c, Quiver)]


def test_arrows_of_the_latest_slip_oppose_the_shear_where_it_slips() -> None:
    result: Any = synthetic_result()
    cells = seen_from_above(result)
    with figure_style():
        figure = stick_slip_map(result, cells)
    found = arrows(figure)
    sheared = [step for step in result.steps if step.shear is not None]
    drawn = {ax.get_title().partition(":")[0]: arrow for ax, arrow in found}
    assert drawn
    for step in sheared:
        arrow = drawn.get(f"step {step.step}")
        if arrow is None:
            continue
        i, j = (
            np.argmin(np.abs(np.subtract.outer(at, 1e3 * centres)), axis=1)
            for at, centres in ((arrow.X, cells.x), (arrow.Y, cells.y))
        )
        q_x, q_y = step.shear[:, i, j]
        assert np.all(arrow.U * q_x + arrow.V * q_y < 0)
        assert np.all(step.in_contact[i, j] & ~step.in_stick[i, j])


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
