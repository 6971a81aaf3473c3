"""The page and the overview of a run say what it found, whatever its title."""

import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib.text import Text
from synthetic_result import synthetic_result

from contact_results.figures.figure_files import _figures_called_for, seen_from_above
from contact_results.figures.load_plot import hysteresis_plot, moved
from contact_results.figures.overview import DOTS_PER_INCH, coarser, overview, section_stress
from contact_results.figures.run_page import write_page
from contact_results.figures.style import figure_style, save
from contact_results.key_numbers import key_numbers
from contact_results.number_text import Uncertainty, number_text
from contact_results.result_files import write_result
from contact_results.stress.loaded_bodies import state_of_result
from contact_scene import RadialDiscretisation, load_scene
from contact_scene.stated_error import ErrorStatus, StatedError
from slipstick import solve

SCENES = Path(__file__).resolve().parents[1] / "scenes"
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


def test_rings_have_a_map_of_every_field_that_they_know() -> None:
    scene = load_scene(SCENES / "fretting_loop.toml").replace({"loading[2].increments": 4})
    pushed = scene.model_copy(update={"loading": scene.loading[:2]})
    result = solve(pushed, "radial", RadialDiscretisation(rings=16))
    with figure_style():
        drawn = {name for name, _ in _figures_called_for(result, (), None)}
    assert drawn >= {"pressure.png", "shear.png", "slip.png", "stick_slip.png"}
    assert "dissipation.png" not in drawn


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


def test_the_overview_of_one_increment_shows_the_stress_down_the_axis() -> None:
    result: Any = synthetic_result()
    last = replace(result.increments[-1], tangential_force=(0.0, 0.0))
    once = replace(result, increments=(last,))
    with figure_style():
        figure = overview(once, seen_from_above(once))
    names = [ax.get_ylabel() for ax in figure.get_axes()]
    assert any(name.startswith("depth z on the axis") for name in names)
    assert not any(name.startswith("normal force") for name in names)


def test_both_radii_have_one_unit() -> None:
    found = dict(key_numbers(ended(synthetic_result(), stick_area=1e-12).steps, None))
    units = {found[name].split()[-1] for name in ("contact radius", "stick radius")}
    assert units == {"mm"}


@pytest.mark.parametrize(("name", "tiny"), [("torque", 9.9e-22), ("twist", 1e-20)])
def test_round_off_beside_the_load_is_nothing(name: str, tiny: float) -> None:
    found = dict(key_numbers(ended(synthetic_result(), **{name: tiny}).steps, None))
    assert found[name].split()[0] == "0"
    told = dict(key_numbers(ended(synthetic_result(), **{name: 1e-5}).steps, None))
    assert told[name].split()[0] == "10"


@pytest.mark.parametrize(("cells", "by"), [((48, 40), 2), ((63, 45), 3)])
def test_coarser_cells_carry_the_same_load_at_the_same_place(
    cells: tuple[int, int], by: int
) -> None:
    state = state_of_result(synthetic_result(cells), None)
    fewer = coarser(state, 24)
    assert fewer.tractions["pressure"].shape == (cells[0] // by, cells[1] // by)
    for name, field in state.tractions.items():
        coarse = fewer.tractions[name]
        near = 1e-12 * float(np.abs(field).sum())
        difference = by**2 * coarse.sum(axis=(-2, -1)) - field.sum(axis=(-2, -1))
        assert np.max(np.abs(difference)) <= near
    first = state.axes["x"][:, None] * state.tractions["shear"][0]
    coarse_first = fewer.axes["x"][:, None] * fewer.tractions["shear"][0]
    scale = np.abs(first).sum()
    assert abs(by**2 * coarse_first.sum() - first.sum()) < 1e-2 * scale


def test_stress_of_too_many_cells_without_a_divisor_is_left_to_its_command() -> None:
    assert section_stress(synthetic_result((67, 67))) is None
    assert section_stress(synthetic_result((24, 20))) is not None


@pytest.mark.parametrize(("twist", "axes"), [(1e-9, "shift along x"), (1.0, "twist")])
def test_the_loop_is_that_of_the_load_that_does_the_work(twist: float, axes: str) -> None:
    result = synthetic_result()
    turned = tuple(
        replace(i, torque=0.1 * i.index, twist=twist * i.index) for i in result.increments
    )
    (ax,) = hysteresis_plot(replace(result, increments=turned)).axes
    assert axes in ax.get_xlabel()
    assert moved(turned) == len(turned)
    still = tuple(replace(i, tangential_force=(0.0, 0.0)) for i in result.increments)
    assert moved(still) == 0
