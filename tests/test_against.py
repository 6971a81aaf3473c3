"""Tests of `slipstick against`: comparison of measured loops and profiles with a run, with its
errors."""

import csv
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from command import outcome, rows, succeeded

from contact_results.files.stored_run import load
from slipstick.against import comparison
from verification.closed_forms.hertz import PointContact, contact_modulus
from verification.closed_forms.line_contact import CylinderContact

SCENE = """
[indenter]
shape = "paraboloid"
radius = "18 mm"
material = { young_modulus = "420 GPa", poisson_ratio = 0 }
[body]
material = { young_modulus = "420 GPa", poisson_ratio = 0 }
[friction]
coefficient = 0.1
[rig]
tangential_stiffness = "100 N/um"
[[loading]]
normal_force = "1 kN"
[[loading]]
tangential_shift = ["1.5 um", 0]
[[loading]]
tangential_shift = ["-1.5 um", 0]
increments = 24
[[loading]]
tangential_shift = ["1.5 um", 0]
increments = 24
[semi_analytical]
cells = [20, 20]
window = ["1.2 mm", "1.2 mm"]
"""


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    """A scene and its run in `run`."""
    directory = tmp_path_factory.mktemp("against")
    (directory / "scene.toml").write_text(SCENE, encoding="utf-8")
    succeeded("run", "scene.toml", "-o", "run", "--figures", "none", cwd=directory)
    return directory


def table(path: Path, **columns) -> Path:
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(columns)
        writer.writerows(zip(*columns.values(), strict=True))
    return path


def column(path: Path, name: str, steps: tuple[str, ...]) -> np.ndarray:
    return np.array([float(row[name]) for row in rows(path) if row["step"] in steps])


def compared(place: Path, output: str) -> dict[str, Any]:
    """Record of a comparison that was written to `output`."""
    return json.loads((place / output / "against.json").read_text("utf-8"))


def against(place, measured, scene, *options):
    """Record of a comparison with a run, or a scene, which is solved for it."""
    succeeded("against", measured, scene, *options, "-o", "compared", cwd=place)
    return compared(place, "compared")


def loop(place: Path, run: str = "run") -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Actuator shift, shift and force of the last load cycle, from its first point to its end."""
    path = place / run / "increments.csv"
    names = ("actuator_shift_x [m]", "tangential_shift_x [m]", "tangential_force_x [N]")
    actuator, shift, force = (
        np.append(column(path, name, ("2",))[-1], column(path, name, ("3", "4"))) for name in names
    )
    return actuator, shift, force


CLOSED = [(0.01, 0.0), (0.0, 0.01), (0.01, 0.01), (-0.02, 0.01), (0.003, -0.015)]


@pytest.mark.parametrize("cycles", [1, 3])
@pytest.mark.parametrize("start", [0, 7, 24, 31])
def test_a_drift_of_a_loop_is_no_energy(place, cycles, start):
    """Linear drifts of shift and force, as parts of their ranges, from every start, both ways."""
    run = load(place / "run")
    _, *once = loop(place)

    def energy(points):
        columns = {"tangential_shift": points[0], "tangential_force": points[1]}
        (found,) = (
            each for each in comparison(columns, run).numbers if each.name == "energy per cycle"
        )
        return found

    whole = energy(np.array(once))
    assert whole.measured == pytest.approx(whole.computed, abs=whole.error + whole.of_table)
    assert whole.of_table < 0.02 * whole.measured
    one = np.roll(np.array(once)[:, 1:], start, axis=1)
    table = np.hstack([one] * cycles + [one[:, :1]])
    time, ranges = np.linspace(0, 1, table.shape[1]), np.ptp(table, axis=1)
    for drift in CLOSED:
        drifted = table + np.outer(drift * ranges, time)
        for points, sign in ((drifted, 1), (drifted[:, ::-1], -1)):
            found = energy(points)
            assert sign * found.measured == pytest.approx(whole.measured, rel=1e-9)
            furthest = np.max(np.abs(table - np.mean(table, axis=1)[:, None]), axis=1)
            bound = np.abs(drift * ranges) @ furthest[::-1] / cycles
            assert found.of_table == pytest.approx(bound, abs=1.1 * whole.of_table + 0.02 * bound)
    # A drift of another course has the same gap, and an energy within the error.
    bent = energy(table + np.outer((0.01 * ranges[0], 0), time**3))
    assert bent.measured == pytest.approx(whole.measured, abs=bent.of_table)
    # Without its last point, the table lacks one step.
    open_ended = energy(table[:, :-1])
    assert open_ended.measured == pytest.approx(whole.measured, rel=1e-9)
    assert open_ended.of_table > whole.of_table


def test_the_gap_to_a_measured_force_is_a_mean_over_one_cycle(place):
    _, shift, force = loop(place)
    smaller = table(place / "loop.csv", **{"shift [m]": shift, "T [N]": 0.9 * force})
    both_ways = np.sum(force**2) + np.min(force) ** 2  # with both ends twice
    gap = 0.1 * np.sqrt(both_ways / (len(force) + 1))
    numbers = against(place, smaller, "run")["numbers"]
    assert numbers["force_along_the_loop"]["gap"] == pytest.approx(gap, rel=1e-3)


LINE = """
[indenter]
shape = "cylinder"
radius = "18 mm"
material = { young_modulus = "210 GPa", poisson_ratio = 0.3 }
[body]
material = { young_modulus = "210 GPa", poisson_ratio = 0.3 }
[friction]
coefficient = 0.1
[[loading]]
normal_force = "1 kN/mm"
[[loading]]
tangential_force = ["50 N/mm", 0]
[semi_analytical]
cells = 64
"""


def test_the_shear_of_a_line_contact_has_an_error_without_a_reference_length(
    tmp_path,
):
    """Its shift is unknown, and its shear in the middle, µp₀(1 - c/a), is within the error."""
    (tmp_path / "line.toml").write_text(LINE, encoding="utf-8")
    ended = outcome("run", "line.toml", "-o", "run", "--figures", "none", cwd=tmp_path)
    assert ended.returncode == 0, ended.stderr
    run = load(tmp_path / "run")
    pressed = CylinderContact(1e6, 18e-3, 210e9 / 0.91 / 2, 1.0)
    exact = 0.1 * pressed.peak_pressure * (1 - np.sqrt(0.5))
    found = comparison({"x": np.zeros(1), "shear": np.full(1, exact)}, run).numbers[0]
    assert found.name == "largest shear"
    assert found.gap < found.error < 0.1 * exact


# ---- Loops of line contacts, whose forces are per length.

PUSHES = "".join(
    f"[[loading]]\ntangential_force = ['{T} N/mm', 0]\nincrements = 6\n" for T in (-50, 50)
)
LINE_LOOP = (
    LINE.replace("[body]", 'reference_length = "20 mm"\n[body]')
    .replace("[semi_analytical]", f"{PUSHES}[semi_analytical]")
    .replace("cells = 64", "cells = 16")
)


@pytest.fixture(scope="module")
def line_place(tmp_path_factory):
    """A loop of a cylinder in `line.toml`, and its run in `line`."""
    directory = tmp_path_factory.mktemp("line")
    (directory / "line.toml").write_text(LINE_LOOP, encoding="utf-8")
    succeeded("run", "line.toml", "-o", "line", "--figures", "none", cwd=directory)
    return directory


def line_loop(line_place: Path, unit: str = "N/mm", factor: float = 1e-3) -> Path:
    """The loop of the run with a force 3 % too small, in a unit per N/m."""
    path = line_place / "line/increments.csv"
    names = ("tangential_shift_x [m]", "tangential_force_x [N/m]")
    shift, force = (
        np.append(column(path, name, ("2",))[-1], column(path, name, ("3", "4"))) for name in names
    )
    heads = {"shift [um]": 1e6 * shift, f"T [{unit}]": 0.97 * factor * force}
    return table(line_place / "measured.csv", **heads)


@pytest.mark.parametrize(
    ("unit", "factor", "options"),
    [
        ("N/mm", 1e-3, ()),
        ("kN/m", 1e-3, ()),
        ("no unit", 1e-3, ("--columns", "shift=1, T=2 N/mm")),
    ],
)
def test_a_loop_of_forces_per_length_is_compared_with_a_line_contact(
    line_place, unit, factor, options
):
    """Energy and slope are per length. The energy is that of the run, to the area of few points."""
    measured = line_loop(line_place, unit, factor)
    command = ("against", measured, "line", *options, "--require", "slope 2%", "-o", "out")
    assert outcome(*command, cwd=line_place).returncode == 1
    numbers = compared(line_place, "out")["numbers"]
    units = {name: numbers[name]["unit"] for name in ("slope", "energy_per_cycle", "gap_of_force")}
    assert units == {"slope": "N/m^2", "energy_per_cycle": "J/m", "gap_of_force": "N/m"}
    assert numbers["slope"]["ratio"] == pytest.approx(0.97, rel=1e-6)
    energy = numbers["energy_per_cycle"]
    steps = json.loads((line_place / "line/summary.json").read_text("utf-8"))["steps"]
    assert energy["computed"] == steps[-1]["energy_per_cycle"]
    assert energy["measured"] == pytest.approx(0.97 * energy["computed"], abs=energy["of_table"])
    assert energy["of_table"] < 0.2 * energy["computed"]
    assert numbers["centre_of_force"]["measured"] == pytest.approx(0, abs=1e-3)


def test_an_input_of_a_line_contact_is_uncertain(line_place):
    """The shift grows by 2T/πE* for each unit of the logarithm of the reference length."""
    measured, key = line_loop(line_place), "indenter.reference_length"
    per_logarithm = 2 * 50e3 / (np.pi * 210e9 / 0.91 / 2)
    shift = np.max(column(line_place / "line/increments.csv", "tangential_shift_x [m]", ("4",)))
    uncertain = against(line_place, measured, "line.toml", "--inputs", f"{key}=20±0.5 mm")
    slope = uncertain["numbers"]["slope"]
    by_length = 2 * 0.5 / 20 * per_logarithm / shift * slope["computed"]
    assert slope["uncertainty"] == pytest.approx(np.hypot(by_length, slope["error"]), rel=1e-2)


# ---- Validation uncertainty and identification of inputs.

PRESSED = SCENE.partition("[[loading]]")[0] + "[[loading]]\nnormal_force = '1 kN'\n"
PRESSED_ON_RINGS = ("pressed.toml", "--solver", "radial")


def hertz_pressure(force: float, x: np.ndarray) -> np.ndarray:
    """Pressure along x below the indenter of SCENE."""
    modulus = contact_modulus((420e9, 0.0), (420e9, 0.0))
    return PointContact.under_load(force, 0.018, modulus).pressure(np.abs(x))


def measured_profile(place: Path, noise: float = 0.0) -> tuple[Path, np.ndarray]:
    """A table of Hertz's pressure under 1.1 kN with scatter, and its places."""
    (place / "pressed.toml").write_text(PRESSED, encoding="utf-8")
    x = np.linspace(-0.2e-3, 0.2e-3, 41)
    pressure = hertz_pressure(1100.0, x)
    scattered = pressure + noise * np.random.default_rng(5).normal(size=len(x))
    return table(place / "p.csv", **{"x [m]": x, "p [Pa]": scattered}), x


@pytest.mark.parametrize("half_width", [0.2, 0.39])
@pytest.mark.parametrize("count", [24, 25])
def test_the_error_of_a_profile_covers_means_over_cells(place, count, half_width):
    """The exact pressure, whose peak the cells know better than its values between them."""
    (place / "pressed.toml").write_text(PRESSED, encoding="utf-8")
    x = np.linspace(-half_width, half_width, 41) * 1e-3
    exact = table(place / "exact.csv", **{"x [m]": x, "p [Pa]": hertz_pressure(1000.0, x)})
    cells = f"semi_analytical.cells=[{count}, {count}]"
    for number in against(place, exact, "pressed.toml", "--set", cells)["numbers"].values():
        assert number["gap"] <= number["error"] <= 0.1 * number["measured"]


def test_an_input_is_identified_with_both_uncertainties(place):
    """The slopes of Hertz's profile by the force give the standard deviation of the force."""
    noise = 1e7
    profile, x = measured_profile(place, noise)
    record = against(place, profile, *PRESSED_ON_RINGS, "--fit", "loading[1].normal_force=.7 kN")
    (found,) = record["fitted"]
    slope = (hertz_pressure(1102.2, x) - hertz_pressure(1097.8, x)) / 0.004
    deviation = 1.1 * noise / np.linalg.norm(slope)
    assert found["unit"] == "kN"
    assert found["by_scatter"] == pytest.approx(deviation, rel=0.3)
    assert abs(found["value"] - 1.1) <= 3 * deviation
    error = record["numbers"]["pressure_at_the_places"]["error"]
    by_errors = 1.1 * np.sum(np.abs(slope)) * error / (slope @ slope)
    assert found["by_errors"] == pytest.approx(by_errors, rel=0.05)


def test_a_fit_does_not_depend_on_the_unit(place):
    """From a first value of 1 in its unit, whose logarithm is 0."""
    profile, _ = measured_profile(place)
    found = [
        against(place, profile, *PRESSED_ON_RINGS, "--fit", f"loading[1].normal_force={one}")[
            "fitted"
        ][0]
        for one in ("1 kN", "1000 N")
    ]
    assert found[0]["value"] == pytest.approx(1.1, rel=2e-4)  # between the rings
    assert found[1]["value"] == pytest.approx(1000 * found[0]["value"], rel=1e-9)


def test_a_difference_has_its_validation_uncertainty(place):
    """The peak pressure grows with the cube root of the force."""
    profile, _ = measured_profile(place)
    given = ("--inputs", "loading[1].normal_force=1.1±.03 kN", "--deviation", "2%")
    record = against(place, profile, *PRESSED_ON_RINGS, *given)
    one = record["numbers"]["largest_pressure"]
    parts = (one["error"], 2 * one["computed"] * 0.03 / 1.1 / 3, 2 * 0.02 * one["measured"])
    assert one["uncertainty"] == pytest.approx(np.linalg.norm(parts), rel=1e-3)
    assert one["gap"] <= one["uncertainty"]
    curve = record["numbers"]["pressure_at_the_places"]
    assert 0.3 < (curve["uncertainty"] / one["uncertainty"]) <= 1.1
