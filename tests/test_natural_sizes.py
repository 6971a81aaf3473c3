"""Axes over the sizes of Hertz' contact, round-off as nothing, and wide tables in blocks."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from command import outcome
from synthetic_result import MU, RADIUS, STEEL, synthetic_result

from contact_results.figures.load_plot import hysteresis_plot
from contact_results.figures.map_panels import MapFrame
from contact_results.figures.profile_plot import profile_plot
from contact_results.figures.style import figure_style
from contact_results.natural_sizes import NaturalUnit, natural_units, without_round_off
from contact_results.result_files import write_result
from contact_results.stress.loaded_bodies import state_of_run
from contact_results.surface import surface_of
from contact_scene import Body, Cone, Layer
from slipstick.cli import terminal
from slipstick.cli.outcome_text import outcome_columns

ROOT = Path(__file__).resolve().parents[1]
LOAD, BALL = 1000.0, 18e-3


def hertz() -> tuple[float, float]:
    """a and p0 of two equal bodies: E* = E / 2(1 - ν²)."""
    modulus = STEEL.young_modulus / (2 * (1 - STEEL.poisson_ratio**2))
    a = (3 * LOAD * BALL / (4 * modulus)) ** (1 / 3)
    return a, 1.5 * LOAD / (np.pi * a**2)


def of_scene(**changes: Any) -> Any:
    result = synthetic_result()
    return replace(result, scene=result.scene.model_copy(update=changes))


def test_sizes_are_those_of_hertz_and_coulomb() -> None:
    units, (a, p0) = natural_units(synthetic_result()), hertz()
    expected = {
        "length": a,
        "pressure": p0,
        "shear": MU * p0,
        "approach": a**2 / BALL,
        "slip": MU * a**2 / BALL,
        "normal_force": LOAD,
        "tangential_force": MU * LOAD,
    }
    found = {kind: units.sizes[kind].size for kind in expected}
    assert found == pytest.approx(expected, rel=1e-12)
    assert "uncoated" not in units.note


def test_a_coating_is_left_out_of_the_sizes_and_named() -> None:
    body = of_scene().scene.body
    soft = STEEL.model_copy(update={"young_modulus": 1e9})
    coated = body.model_copy(update={"layers": (Layer(thickness=1e-5, material=soft),)})
    units = natural_units(of_scene(body=coated))
    assert units.sizes["length"].size == pytest.approx(hertz()[0], rel=1e-12)
    assert "uncoated" in units.note


def test_without_hertz_the_contact_measures_itself() -> None:
    result = of_scene(indenter=Cone(slope_angle=0.02, material=STEEL), friction=None)
    units = natural_units(result)
    assert units.sizes["length"].size == pytest.approx(RADIUS)
    assert units.sizes["shear"].name == "$p_0$"
    assert "this contact" in units.note


def test_figures_are_over_the_sizes_and_say_so() -> None:
    result = synthetic_result()
    units, surface = natural_units(result), surface_of(result)
    with figure_style():
        one, plain = profile_plot(result, surface, units).axes, profile_plot(result, surface).axes
        loop = hysteresis_plot(result, units).axes[0]
    assert one[0].get_ylabel() == "pressure p / $p_0$"
    assert one[1].get_ylabel() == "shear $q_{x}$ / µ$p_0$"
    assert one[-1].get_xlabel() == "x / a at y = 0"
    assert plain[-1].get_xlabel() == "x at y = 0 (mm)"
    (x, p), (mm, gpa) = (axes[0].lines[0].get_data() for axes in (one, plain))
    np.testing.assert_allclose(x * units.sizes["length"].size, np.asarray(mm) * 1e-3)
    np.testing.assert_allclose(p * units.sizes["pressure"].size, np.asarray(gpa) * 1e9)
    assert loop.get_ylabel() == "tangential force along x / µ$W_0$"
    assert np.max(loop.lines[2].get_ydata()) == pytest.approx(90 / (MU * LOAD))
    frame = MapFrame.around_contact(result, surface, units)
    assert frame.extent[1] * units.sizes["length"].size == pytest.approx(0.6e-3)


@pytest.mark.usefixtures("undrawn")
def test_tables_and_summary_stay_in_si(tmp_path: Path) -> None:
    result, plain, normalised = synthetic_result((12, 10)), tmp_path / "SI", tmp_path / "natural"
    for directory in (plain, normalised):
        directory.mkdir()
    write_result(result, plain, with_figures=False)
    write_result(result, normalised, normalised=True)
    for path in plain.iterdir():
        assert path.read_bytes() == (normalised / path.name).read_bytes(), path.name
    assert (normalised / "overview.png").is_file()


@pytest.mark.parametrize(
    "changes",
    [
        {},
        {"indenter": Cone(slope_angle=0.1, material=STEEL)},
        {"body": Body(material=STEEL, layers=(Layer(thickness=1e-4, material=STEEL),))},
    ],
    ids=["as it is", "cone", "coated"],
)
def test_a_stored_run_has_the_sizes_of_its_result(tmp_path: Path, changes: dict[str, Any]) -> None:
    result = of_scene(**changes)
    write_result(result, tmp_path, with_figures=False)
    assert state_of_run(tmp_path, 1).units == natural_units(result)


def test_the_command_draws_figures_or_refuses(tmp_path: Path) -> None:
    found = outcome(
        "run", "scenes/hertz.toml", "-o", str(tmp_path / "out"), "--normalised", "--no-figures",
        cwd=ROOT,
    )  # fmt: skip
    assert found.returncode == 2
    assert "--no-figures" in found.stderr
    assert not (tmp_path / "out").exists()
    found = outcome(
        "stress", "scenes/hertz.toml", "-o", str(tmp_path / "out"), "--normalised", "--no-figures",
        cwd=ROOT,
    )  # fmt: skip
    assert found.returncode == 2
    assert "--no-figures" in found.stderr


def test_an_axis_names_the_size_before_the_place() -> None:
    assert NaturalUnit(1.0, "a").labelled("x at y = 0, z = 0") == "x / a at y = 0, z = 0"
    assert NaturalUnit(1.0, "a").labelled("radius r") == "radius r / a"
    assert NaturalUnit(1.0, "a").labelled("x, z = 0") == "x / a, z = 0"


@pytest.mark.parametrize(("unit", "tiny"), [("N m", 1e-12), ("rad", 1e-14), ("J", 1e-14)])
def test_round_off_beside_the_load_is_zero(unit: str, tiny: float) -> None:
    ends = synthetic_result().steps
    assert without_round_off(tiny, ends, unit) == 0.0
    assert without_round_off(1e6 * tiny, ends, unit) == 1e6 * tiny


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
