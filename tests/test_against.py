"""Tests of `slipstick against`: comparison of measured loops and profiles with a run, with its
errors."""

import csv
import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from command import outcome, rows, succeeded

from contact_results.files.stored_run import load
from slipstick.against import ComparedNumber, comparison
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
cells = [32, 32]
window = ["1.2 mm", "1.2 mm"]
"""


@pytest.fixture(scope="module")
def place(tmp_path_factory: pytest.TempPathFactory) -> Path:
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


def against(place: Path, measured: Path, *arguments, run: str = "run") -> dict[str, list[str]]:
    """Cells of the printed table by the name of its row: measured, computed, ratio, difference,
    and our part."""
    ended = succeeded("against", measured, run, *arguments, cwd=place)
    lines = (re.split(r"\s{2,}", line.strip()) for line in ended.stdout.splitlines())
    return {cells[0].split(" (")[0]: cells[1:] for cells in lines if len(cells) == 6}


def value(text: str) -> float:
    """Number of a cell without its error."""
    return float(text.partition("±")[0])


def compared(place: Path, output: str) -> dict[str, Any]:
    """Record of a comparison that was written to `output`."""
    record: dict[str, Any] = json.loads((place / output / "against.json").read_text("utf-8"))
    return record


def against_scene(place: Path, measured: Path, scene: str, *options: object) -> dict[str, Any]:
    """Record of a comparison with a scene, which is solved for it."""
    succeeded("against", measured, scene, *options, "-o", "compared", cwd=place)
    return compared(place, "compared")


def refusal(place: Path, *words: object) -> str:
    """Message of a comparison that ends with code 2, without its frame."""
    ended = outcome("against", *words, cwd=place)
    assert ended.returncode == 2
    return " ".join(ended.stderr.replace("│", " ").split())


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
def test_a_drift_of_a_loop_is_no_energy(place: Path, cycles: int, start: int) -> None:
    """Linear drifts of shift and force, as parts of their ranges, from every start, both ways."""
    run = load(place / "run")
    _, *once = loop(place)

    def energy(points: np.ndarray) -> ComparedNumber:
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


def test_the_gap_to_a_measured_force_is_a_mean_over_one_cycle(place: Path) -> None:
    _, shift, force = loop(place)
    smaller = table(place / "loop.csv", **{"shift [m]": shift, "T [N]": 0.9 * force})
    both_ways = np.sum(force**2) + np.min(force) ** 2  # with both ends twice
    gap = 0.1 * np.sqrt(both_ways / (len(force) + 1))
    found = against(place, smaller)["force along the loop"]
    assert float(found[3]) == pytest.approx(gap, rel=1e-3)


@pytest.mark.parametrize(
    ("columns", "message"),
    [
        ({"T [N]": [1], "time [s]": [1]}, "got the columns tangential_force, expected shift or"),
        (
            {"T [N]": [9, -2, -9, 2, 9, -2, -9], "shift [um]": [3, 0, -3, 0, 3, 0, -3]},
            "one or more whole cycles",
        ),
        (
            {"step": [1, 1], "x [mm]": [0, 0.1], "p [GPa]": [1, 0.5]},
            "no row of load step 4: its column 'step' has 1; choose the load step with --step",
        ),
        (
            {"step": [0, 1], "x [mm]": [0, 0.1], "p [GPa]": [1, 0.5]},
            "the column 'step' has 0 to 1, expected load steps of the run, 1 to 4",
        ),
    ],
)
def test_a_table_that_cannot_be_compared_is_refused(place: Path, columns, message) -> None:
    assert message in refusal(place, table(place / "bad.csv", **columns), "run")


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
    tmp_path: Path,
) -> None:
    """Its shift is unknown, and its shear in the middle, µp₀(1 - c/a), is within the error."""
    (tmp_path / "line.toml").write_text(LINE, encoding="utf-8")
    ended = outcome("run", "line.toml", "-o", "run", "--figures", "none", cwd=tmp_path)
    assert ended.returncode == 0, ended.stderr
    run = load(tmp_path / "run")
    pressed = CylinderContact(1e6, 18e-3, 210e9 / 0.91 / 2, 1.0)
    exact = 0.1 * pressed.peak_pressure * (1 - np.sqrt(0.5))
    found = comparison({"x": np.zeros(1), "shear": np.full(1, exact)}, run).numbers[0]
    assert found.name == "largest shear"
    assert found.error is not None
    assert found.gap < found.error < 0.1 * exact


# ---- Loops of line contacts, whose forces are per length.

PUSHES = "".join(
    f"[[loading]]\ntangential_force = ['{T} N/mm', 0]\nincrements = 6\n" for T in (-50, 50)
)
LINE_LOOP = (
    LINE.replace("[body]", 'reference_length = "20 mm"\n[body]')
    .replace("[semi_analytical]", f"{PUSHES}[semi_analytical]")
    .replace("cells = 64", "cells = 32")
)


@pytest.fixture(scope="module")
def line_place(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A loop of a cylinder in `line.toml`, its run in `line`, and the same without its length."""
    directory = tmp_path_factory.mktemp("line")
    lost = LINE_LOOP.replace("reference_length", "# reference_length")
    for name, text in (("line", LINE_LOOP), ("lost", lost)):
        (directory / f"{name}.toml").write_text(text, encoding="utf-8")
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
    line_place: Path, unit: str, factor: float, options: tuple[str, ...]
) -> None:
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


def test_inputs_of_a_line_contact_are_fitted_and_uncertain(line_place: Path) -> None:
    """The shift grows by 2T/πE* for each unit of the logarithm of the reference length."""
    measured, key = line_loop(line_place), "indenter.reference_length"
    per_logarithm = 2 * 50e3 / (np.pi * 210e9 / 0.91 / 2)
    shift = np.max(column(line_place / "line/increments.csv", "tangential_shift_x [m]", ("4",)))
    fitted = against_scene(line_place, measured, "line.toml", "--fit", f"{key}=21 mm")
    # A force 3 % too small at equal shifts has the slope of a shift that is too large.
    length = 20 * np.exp((1 / 0.97 - 1) * shift / per_logarithm)
    assert fitted["fitted"][0]["value"] == pytest.approx(length, rel=1e-3)
    uncertain = against_scene(line_place, measured, "line.toml", "--inputs", f"{key}=20±0.5 mm")
    slope = uncertain["numbers"]["slope"]
    by_length = 2 * 0.5 / 20 * per_logarithm / shift * slope["computed"]
    assert slope["uncertainty"] == pytest.approx(np.hypot(by_length, slope["error"]), rel=1e-2)


@pytest.mark.parametrize(
    ("unit", "scene", "message"),
    [
        ("N", "line.toml", "divide T by the length of the contact, and name its unit, such as"),
        ("N/mm", "lost.toml", "add indenter.reference_length"),
        ("Pa", "line.toml", "the units are N, uN"),
    ],
)
def test_a_loop_that_is_no_line_loop_is_refused(line_place, unit, scene, message) -> None:
    assert message in refusal(line_place, line_loop(line_place, unit), scene)


def test_a_force_per_length_on_a_ball_is_refused(place: Path) -> None:
    _, shift, force = loop(place)
    per_length = table(place / "per.csv", **{"shift [m]": shift, "T [N/m]": force})
    assert "the contact is no line contact; give T in N" in refusal(place, per_length, "run")


def test_a_profile_with_several_load_steps_is_compared_step_by_step(place: Path) -> None:
    """The profiles of a run agree with those of the run at each of its load steps."""
    profiles = place / "run/profiles.csv"
    for step in (["--step", "1"], ["--step", "3"], []):
        found = against(place, profiles, *step)
        assert float(found["pressure at the places"][3]) == 0.0
        assert float(found["shear at the places"][3]) == 0.0


def test_a_column_of_times_or_words_has_no_load_steps(place: Path) -> None:
    actuator, _, force = loop(place)
    for head, values in (("step [s]", range(len(force))), ("step", ["a"] * len(force))):
        columns = {head: values, "actuator_shift [m]": actuator, "T [N]": force}
        assert against(place, table(place / "timed.csv", **columns))
    words = {"step": ["a", "b"], "x [mm]": [0, 0.1], "p [GPa]": [1, 0.5]}
    assert against(place, table(place / "words.csv", **words))


def as_lab(place: Path, heads: str) -> Path:
    """The loop of the run as a laboratory writes it: time, shift in µm and force, 3 % too small."""
    moved, _, force = loop(place)
    path = place / "lab.txt"
    rows = np.stack([np.arange(len(force)), 1e6 * moved, 0.97 * force], axis=1)
    lines = [heads, *(";".join(map(str, row)) for row in rows.tolist())]
    path.write_text("\n".join(lines), encoding="utf-8")
    return path


CHOSEN = ("--columns", "actuator_shift = 2 um, T=3 N")


@pytest.mark.parametrize("heads", ["Time;Disp;Load", "Time;Disp (mm);Load [kN]", ""])
def test_columns_are_chosen_by_number_whatever_their_heads(place: Path, heads: str) -> None:
    moved, _, force = loop(place)
    named = {"actuator_shift [m]": moved, "T [N]": 0.97 * force}
    by_heads = against(place, table(place / "named.csv", **named))
    assert against(place, as_lab(place, heads), *CHOSEN) == by_heads


def test_a_column_without_a_unit_has_that_of_its_head(place: Path) -> None:
    lab = as_lab(place, "Time;Disp (um);Load [N]")
    assert against(place, lab, "--columns", "δ*=2,T=3") == against(place, lab, *CHOSEN)


@pytest.mark.parametrize(
    ("option", "text", "told"),
    [
        ("--columns", "shift=2", "unit of its numbers"),
        ("--columns", "shift=4 um,T=3 N", "expected 1 to 3"),
        ("--columns", "shift=0 um,T=3 N", "got column 0, expected 1 to 3"),
        ("--columns", "foo=2 um", "known names"),
        ("--columns", "shift=2 um, delta=3 um", "different names"),
        ("--require", "5", "at most 50 %"),
        ("--require", "approach 1%", "energy_per_cycle"),
    ],
)
def test_wrong_columns_and_requirements_are_refused(place, option, text, told) -> None:
    chosen = () if option == "--columns" else CHOSEN
    assert told in refusal(place, as_lab(place, "t;s;F"), "run", *chosen, option, text)


def test_a_difference_beyond_the_requirement_ends_with_code_1(place: Path) -> None:
    lab = as_lab(place, "t;s;F")
    for required, code in (("2%", 1), ("4%", 0), ("slope 2%, energy_per_cycle 9%", 1)):
        command = ("against", lab, "run", *CHOSEN, "--require", required, "-o", "compared")
        assert outcome(*command, cwd=place).returncode == code
    assert compared(place, "compared")["numbers"]["slope"]["ratio"] == pytest.approx(0.97, rel=1e-6)
    assert (place / "compared/against.png").read_bytes().startswith(b"\x89PNG")
    succeeded("against", lab.absolute(), ".", *CHOSEN, "-o", "../in", cwd=place / "run")
    assert compared(place, "in")["title"] == f"{lab.name} and run"


def test_an_output_below_a_file_is_refused_before_the_scene_is_solved(place: Path) -> None:
    measured = table(place / "loop.csv", **{"shift [um]": [1.0], "T [N]": [1.0]})
    told = refusal(place, measured, "scene.toml", "-o", "loop.csv/below")
    assert "loop.csv is a file; --output needs a directory" in told


# ---- Validation uncertainty and identification of inputs.

PRESSED = SCENE.partition("[[loading]]")[0] + "[[loading]]\nnormal_force = '1 kN'\n"
PRESSED_ON_RINGS = ("pressed.toml", "--solver", "radial")
MODULUS = "material.young_modulus=420 GPa"


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


def test_an_input_is_identified_with_both_uncertainties(place: Path) -> None:
    """The slopes of Hertz's profile by the force give the standard deviation of the force."""
    noise = 1e7
    profile, x = measured_profile(place, noise)
    record = against_scene(
        place, profile, *PRESSED_ON_RINGS, "--fit", "loading[1].normal_force=.7 kN"
    )
    (found,) = record["fitted"]
    slope = (hertz_pressure(1102.2, x) - hertz_pressure(1097.8, x)) / 0.004
    deviation = 1.1 * noise / np.linalg.norm(slope)
    assert found["unit"] == "kN"
    assert found["by_scatter"] == pytest.approx(deviation, rel=0.3)
    assert abs(found["value"] - 1.1) <= 3 * deviation
    error = record["numbers"]["pressure_at_the_places"]["error"]
    by_errors = 1.1 * np.sum(np.abs(slope)) * error / (slope @ slope)
    assert found["by_errors"] == pytest.approx(by_errors, rel=0.05)


def test_a_fit_does_not_depend_on_the_unit(place: Path) -> None:
    """From a first value of 1 in its unit, whose logarithm is 0."""
    profile, _ = measured_profile(place)
    found = [
        against_scene(place, profile, *PRESSED_ON_RINGS, "--fit", f"loading[1].normal_force={one}")[
            "fitted"
        ][0]
        for one in ("1 kN", "1000 N")
    ]
    assert found[0]["value"] == pytest.approx(1.1, rel=2e-4)  # between the rings
    assert found[1]["value"] == pytest.approx(1000 * found[0]["value"], rel=1e-9)


def test_friction_is_identified_from_a_loop(place: Path) -> None:
    small = SCENE.replace("increments = 24", "increments = 8").replace("[32, 32]", "[16, 16]")
    (place / "small.toml").write_text(small, encoding="utf-8")
    outcome("run", "small.toml", "-o", "small", "--figures", "none", "--no-error", cwd=place)
    actuator, _, force = loop(place, "small")
    measured = table(place / "own.csv", **{"actuator_shift [m]": actuator, "T [N]": force})
    (found,) = against_scene(place, measured, "small.toml", "--fit", "friction.coefficient=.12")[
        "fitted"
    ]
    assert found["value"] == pytest.approx(0.1, abs=1e-5)


def test_a_difference_has_its_validation_uncertainty(place: Path) -> None:
    """The peak pressure grows with the cube root of the force."""
    profile, _ = measured_profile(place)
    given = ("--inputs", "loading[1].normal_force=1.1±.03 kN", "--deviation", "2%")
    record = against_scene(place, profile, *PRESSED_ON_RINGS, *given)
    one = record["numbers"]["largest_pressure"]
    parts = (one["error"], 2 * one["computed"] * 0.03 / 1.1 / 3, 2 * 0.02 * one["measured"])
    assert one["uncertainty"] == pytest.approx(np.linalg.norm(parts), rel=1e-3)
    assert one["gap"] <= one["uncertainty"]
    curve = record["numbers"]["pressure_at_the_places"]
    assert 0.3 < (curve["uncertainty"] / one["uncertainty"]) <= 1.1


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("--fit", "friction.coefficient=-1"), "expected key=first value above 0"),
        (("--fit", "friction.coefficient=.1"), "do not depend on friction.coefficient"),
        (
            ("--fit", f"body.{MODULUS}, indenter.{MODULUS}"),
            "change the curves in the same way",
        ),
        (
            ("--fit", "friction.coefficient=.1", "--inputs", "friction.coefficient=.1±.1"),
            "got --inputs and --fit",
        ),
    ],
)
def test_a_fit_without_answer_is_refused(place: Path, options, message) -> None:
    profile, _ = measured_profile(place)
    assert message in refusal(place, profile, *PRESSED_ON_RINGS, *options)
