"""Tests of `slipstick against`: comparison of measured loops and profiles with a run, with its
errors."""

import csv
import json
import re
from pathlib import Path

import numpy as np
import pytest
from command import outcome, rows

from contact_results.files.stored_run import load
from slipstick.against import ComparedNumber, comparison
from verification.closed_forms.hertz import PointContact, contact_modulus

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
    ended = outcome("run", "scene.toml", "-o", "run", "--figures", "none", cwd=directory)
    assert ended.returncode == 0, ended.stderr
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
    ended = outcome("against", measured, run, *arguments, cwd=place)
    assert ended.returncode == 0, ended.stderr
    lines = (re.split(r"\s{2,}", line.strip()) for line in ended.stdout.splitlines())
    return {cells[0].split(" (")[0]: cells[1:] for cells in lines if len(cells) == 6}


def value(text: str) -> float:
    """Number of a cell without its error."""
    return float(text.partition("±")[0])


def loop(place: Path, run: str = "run") -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Actuator shift, shift and force of the last load cycle, from its first point to its end."""
    path = place / run / "increments.csv"
    names = ("actuator_shift_x [m]", "tangential_shift_x [m]", "tangential_force_x [N]")
    actuator, shift, force = (
        np.append(column(path, name, ("2",))[-1], column(path, name, ("3", "4"))) for name in names
    )
    return actuator, shift, force


def test_offset_slope_and_area_of_a_loop_are_found_with_our_part(place: Path) -> None:
    _, shift, force = loop(place)
    measured = table(
        place / "loop.csv",
        **{"time [s]": force, "δ [µm]": 1.02e6 * shift + 0.03, "T [mN]": 900 * force},
    )
    found = against(place, measured)
    offset, computed = found["centre of shift"], found["energy per cycle"][1]
    assert float(offset[3]) == pytest.approx(30.0, abs=0.3)  # nm
    assert float(found["slope"][2]) == pytest.approx(0.9 / 1.02, abs=1e-4)
    assert float(found["energy per cycle"][2]) == pytest.approx(0.9 * 1.02, abs=3e-3)
    assert float(found["force along the loop"][3]) == pytest.approx(0.1 * 60, rel=0.3)

    # Neither the first point of the cycle nor the number of points matters.
    back = against(
        place, table(place / "back.csv", **{"shift [m]": shift[::-1], "T [N]": force[::-1]})
    )
    assert float(back["energy per cycle"][2]) == pytest.approx(-1.0, abs=3e-3)
    finer = [np.interp(np.linspace(0, 48, 145), np.arange(49), each) for each in (shift, force)]
    columns = zip(("shift [m]", "T [N]"), (np.roll(each[1:], 50) for each in finer), strict=True)
    gap = against(place, table(place / "rolled.csv", **dict(columns)))["force along the loop"][3]
    assert float(gap) < 1e-4 * float(found["force along the loop"][3])

    end = json.loads((place / "run/summary.json").read_text(encoding="utf-8"))["steps"][-1]
    moves = [end["errors"][f"tangential_{name}"]["error"][0] for name in ("shift", "force")]
    parts = (2 * e / np.ptp(each) for e, each in zip(moves, (shift, force), strict=True))
    of_slope = [float(text) for text in found["slope"][1].split("±")]
    assert of_slope[1] / of_slope[0] == pytest.approx(sum(parts), rel=0.1)

    error = float(computed.split("±")[1])
    expected = 100 * error / float(found["energy per cycle"][3])
    assert float(found["energy per cycle"][4].split()[0]) == pytest.approx(expected, rel=0.03)


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


def test_a_loop_of_the_actuator_has_the_energy_of_the_contact(place: Path) -> None:
    actuator, shift, force = loop(place)
    energies, slopes = [], []
    for name, motion in (("actuator_shift [m]", actuator), ("shift [m]", shift)):
        found = against(place, table(place / "loop.csv", **{name: motion, "T [N]": force}))
        energies.append(value(found["energy per cycle"][0]))
        slopes.append(float(found["slope"][0]))
        assert float(found["slope"][2]) == pytest.approx(1.0, abs=1e-4)
        assert found["slope"][4] == "100.0 %"
    assert energies[0] == pytest.approx(energies[1], rel=1e-4)
    assert 1 / slopes[0] - 1 / slopes[1] == pytest.approx(1 / 100, rel=1e-3)  # of the spring
    smaller = table(place / "loop.csv", **{"shift [m]": shift, "T [N]": 0.9 * force})
    both_ways = np.sum(force**2) + np.min(force) ** 2  # with both ends twice
    gap = 0.1 * np.sqrt(both_ways / (len(force) + 1))
    found = against(place, smaller)["force along the loop"]
    assert float(found[3]) == pytest.approx(gap, rel=1e-3)


@pytest.mark.parametrize(
    ("columns", "message"),
    [
        (
            {"T [mm]": [1], "shift [um]": [1]},
            'got the column "T [mm]", expected the unit of its numbers, such as "t [N]"',
        ),
        ({"T": [1], "shift [um]": [1]}, 'got the column "T", expected the unit of its numbers'),
        (
            {"T [N]": ["two"], "shift [um]": [1]},
            'line 2 of "bad.csv" has no finite number in the column "T [N]"',
        ),
        ({"T [N]": ["nan"], "shift [um]": [1]}, "remove rows with missing values"),
        ({"T [N]": [1], "time [s]": [1]}, "got the columns tangential_force, expected shift or"),
        ({"T [N]": [1], "shift [um]": [1]}, "the table: got 0"),
        ({"T [N]": [9, 2, -2, -9], "shift [um]": [3, 1, -1, -3]}, "expected less than 4.5e-06 m"),
        (
            {"T [N]": [9, -2, -9, 2, 9, -2, -9], "shift [um]": [3, 0, -3, 0, 3, 0, -3]},
            "one or more whole cycles",
        ),
    ],
)
def test_a_table_that_cannot_be_compared_is_refused(place: Path, columns, message) -> None:
    ended = outcome("against", table(place / "bad.csv", **columns), "run", cwd=place)
    assert ended.returncode == 2
    assert message in " ".join(ended.stderr.replace("│", " ").split())


def test_a_profile_is_compared_at_its_places(place: Path) -> None:
    path = place / "run/profiles.csv"
    x, p, q = (column(path, name, ("2",)) for name in ("x [m]", "pressure [Pa]", "shear_x [Pa]"))
    some = slice(3, -3, 2)
    measured = table(
        place / "profile.csv",
        **{"x [mm]": 1e3 * x[some], "p [GPa]": 1.01e-9 * p[some], "q [MPa]": 1e-6 * q[some]},
    )
    found = against(place, measured, "--step", "2")
    assert float(found["largest pressure"][2]) == pytest.approx(1.01, abs=1e-4)
    gap = 0.01 * np.sqrt(np.mean((p[some] / 1e9) ** 2))
    assert float(found["pressure at the places"][3]) == pytest.approx(gap, rel=1e-3)
    assert found["shear at the places"][4] == "100.0 %"
    steps = json.loads((place / "run/summary.json").read_text(encoding="utf-8"))["steps"]
    error = steps[1]["errors"]["peak_pressure"]["error"] / steps[1]["peak_pressure"]
    assert float(found["largest pressure"][4].split()[0]) == pytest.approx(1e4 * error, abs=0.06)
    shear = [float(text) for text in found["largest shear"][1].split("±")]
    for name in ("tangential_shift", "tangential_force"):
        error += steps[1]["errors"][name]["error"][0] / steps[1][name][0]
    assert shear[1] / shear[0] == pytest.approx(error, rel=0.05)


def test_a_profile_with_several_load_steps_is_compared_step_by_step(place: Path) -> None:
    """The profiles of a run agree with those of the run at each of its load steps."""
    profiles = place / "run/profiles.csv"
    for step in (["--step", "1"], ["--step", "3"], []):
        found = against(place, profiles, *step)
        assert float(found["pressure at the places"][3]) == 0.0
        assert float(found["shear at the places"][3]) == 0.0
    once = table(place / "once.csv", **{"step": [1, 1], "x [mm]": [0, 0.1], "p [GPa]": [1, 0.5]})
    ended = outcome("against", once, "run", cwd=place)
    assert ended.returncode == 2
    message = "no row of load step 4: its column 'step' has 1; choose the load step with --step"
    assert message in " ".join(ended.stderr.replace("│", " ").split())
    samples = {"step": [0, 1], "x [mm]": [0, 0.1], "p [GPa]": [1, 0.5]}
    ended = outcome("against", table(place / "samples.csv", **samples), "run", cwd=place)
    message = "the column 'step' has 0 to 1, expected load steps of the run, 1 to 4"
    assert message in " ".join(ended.stderr.replace("│", " ").split())


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
        ("--columns", "shift=4 um,T=3 N", "got column 4, expected 1 to 3"),
        ("--columns", "shift=0 um,T=3 N", "got column 0, expected 1 to 3"),
        ("--columns", "foo=2 um", "known names"),
        ("--columns", "shift=2 um, delta=3 um", "different names"),
        ("--columns", "", "different names"),
        ("--require", "5", "at most 50 %"),
        ("--require", "approach 1%", "energy_per_cycle"),
        ("--require", "1%,2%", "given twice"),
    ],
)
def test_wrong_columns_and_requirements_are_refused(place, option, text, told) -> None:
    chosen = () if option == "--columns" else CHOSEN
    ended = outcome("against", as_lab(place, "t;s;F"), "run", *chosen, option, text, cwd=place)
    assert ended.returncode == 2
    assert told in " ".join(ended.stderr.replace("\u2502", " ").split())


def test_a_difference_beyond_the_requirement_ends_with_code_1(place: Path) -> None:
    lab = as_lab(place, "t;s;F")
    for required, code in (("2%", 1), ("4%", 0), ("slope 2%, energy_per_cycle 9%", 1)):
        command = ("against", lab, "run", *CHOSEN, "--require", required, "-o", "compared")
        assert outcome(*command, cwd=place).returncode == code
    numbers = json.loads((place / "compared/against.json").read_text(encoding="utf-8"))["numbers"]
    assert numbers["slope"]["ratio"] == pytest.approx(0.97, rel=1e-6)
    assert (place / "compared/against.png").read_bytes().startswith(b"\x89PNG")
    inside = outcome("against", lab.absolute(), ".", *CHOSEN, "-o", "../in", cwd=place / "run")
    assert inside.returncode == 0, inside.stderr
    title = json.loads((place / "in/against.json").read_text(encoding="utf-8"))["title"]
    assert title == f"{lab.name} and run"


def test_an_output_that_is_a_file_is_refused_before_the_scene_is_solved(place: Path) -> None:
    measured = table(place / "loop.csv", **{"shift [um]": [1.0], "T [N]": [1.0]})
    for output in ("loop.csv", "loop.csv/below"):
        ended = outcome("against", measured.name, "scene.toml", "-o", output, cwd=place)
        assert ended.returncode == 2
        assert "loop.csv is a file; --output needs a directory" in ended.stderr
        assert not ended.stdout


# ---- Validation uncertainty and identification of inputs.

PRESSED = SCENE.partition("[[loading]]")[0] + "[[loading]]\nnormal_force = '1 kN'\n"
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
    fitted = ("--fit", "loading[1].normal_force=.7 kN", "-o", "fitted")
    ended = outcome("against", profile, "pressed.toml", "--solver", "radial", *fitted, cwd=place)
    assert ended.returncode == 0, ended.stderr
    record = json.loads((place / "fitted/against.json").read_text(encoding="utf-8"))
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
    found = []
    for first in ("1 kN", "1000 N"):
        fitted = ("--fit", f"loading[1].normal_force={first}", "-o", "unit")
        outcome("against", profile, "pressed.toml", "--solver", "radial", *fitted, cwd=place)
        found += json.loads((place / "unit/against.json").read_text(encoding="utf-8"))["fitted"]
    assert found[0]["value"] == pytest.approx(1.1, rel=2e-4)  # between the rings
    assert found[1]["value"] == pytest.approx(1000 * found[0]["value"], rel=1e-9)


def test_friction_is_identified_from_a_loop(place: Path) -> None:
    small = SCENE.replace("increments = 24", "increments = 8").replace("[32, 32]", "[16, 16]")
    (place / "small.toml").write_text(small, encoding="utf-8")
    outcome("run", "small.toml", "-o", "small", "--figures", "none", "--no-error", cwd=place)
    actuator, _, force = loop(place, "small")
    measured = table(place / "own.csv", **{"actuator_shift [m]": actuator, "T [N]": force})
    fitted = ("--fit", "friction.coefficient=.12", "-o", "own")
    ended = outcome("against", measured, "small.toml", *fitted, cwd=place)
    assert ended.returncode == 0, ended.stderr
    (found,) = json.loads((place / "own/against.json").read_text(encoding="utf-8"))["fitted"]
    assert found["value"] == pytest.approx(0.1, abs=1e-5)


def test_a_difference_has_its_validation_uncertainty(place: Path) -> None:
    """The peak pressure grows with the cube root of the force."""
    profile, _ = measured_profile(place)
    given = ("--inputs", "loading[1].normal_force=1.1±.03 kN", "--deviation", "2%")
    ended = outcome(
        *("against", profile, "pressed.toml", "--solver", "radial", *given, "-o", "compared"),
        cwd=place,
    )
    assert ended.returncode == 0, ended.stderr
    record = json.loads((place / "compared/against.json").read_text(encoding="utf-8"))
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
        (("--deviation", "much"), "--deviation"),
    ],
)
def test_a_fit_without_answer_is_refused(place: Path, options, message) -> None:
    profile, _ = measured_profile(place)
    ended = outcome("against", profile, "pressed.toml", "--solver", "radial", *options, cwd=place)
    assert ended.returncode == 2
    assert message in " ".join(ended.stderr.replace("│", " ").split())
