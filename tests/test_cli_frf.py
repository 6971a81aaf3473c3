"""`slipstick maintain frf`: exact, of the lower body alone, and with every bad request named."""

import csv
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from contact_scene import RIGID, SceneError, read_body
from slipstick.cli import main
from verification.references import load_reference

ROWS = load_reference("frf")["rows"]
ACCURACY = 5e-15
COATED = """
[body]
material = { young_modulus = "210 GPa", poisson_ratio = 0.3 }
[[body.layers]]
thickness = "0.4 mm"
material = { young_modulus = "420 GPa", poisson_ratio = 0.3 }
"""
Ask = Callable[..., tuple[int, str, str]]


@pytest.fixture
def ask(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Ask:
    """Run the command on a scene text; exit code, output and error."""

    def run(text: str, *arguments: object) -> tuple[int, str, str]:
        path = tmp_path / "scene.toml"
        path.write_text(text, encoding="utf-8")
        with pytest.raises(SystemExit) as leaving:
            main(["maintain", "frf", str(path), *map(str, arguments)])
        shown = capsys.readouterr()
        return int(leaving.value.code or 0), shown.out, shown.err

    return run


def material(constants: dict[str, float]) -> str:
    E = 2 * constants["G"] * (1 + constants["nu"])
    return f"{{ young_modulus = {E!r}, poisson_ratio = {constants['nu']!r} }}"


def scene_of(row: dict[str, Any]) -> str:
    base = '"rigid"' if row["base"] == "rigid" else material(row["base"])
    layers = "".join(
        f"[[body.layers]]\nthickness = {film['h']!r}\nmaterial = {material(film)}\n"
        for film in row["layers_top_down"]
    )
    return f"[body]\nmaterial = {base}\n{layers}"


@pytest.mark.parametrize("row", ROWS, ids=lambda row: str(row["id"]))
def test_command_prints_the_reference(row: dict[str, Any], ask: Ask) -> None:
    code, out, _ = ask(scene_of(row), "--at", f"{row['m']!r},{row['n']!r}", "--json")
    assert code == 0
    [answer] = json.loads(out)
    assert (answer["m"], answer["n"]) == (row["m"], row["n"])
    got = np.array(answer["F"]) @ [1, 1j]
    F = {key: float(value) for key, value in row["F"].items()}
    xz, yz = 1j * F["im_xz"], 1j * F["im_yz"]
    expected = np.array([[F["xx"], F["xy"], xz], [F["xy"], F["yy"], yz], [-xz, -yz, F["zz"]]])
    assert np.abs(got - expected).max() < ACCURACY * np.abs(expected).max()


def test_negative_wavenumbers_are_taken_in_both_spellings(ask: Ask) -> None:
    code, out, _ = ask(COATED, "--at", "-100,200", "--at=-100,200", "--at", "100,-200", "--json")
    assert code == 0
    first, second, turned = json.loads(out)
    assert first == second
    assert set(first) == {"m", "n", "F"}
    np.testing.assert_array_equal(np.array(first["F"]), np.array(turned["F"]) * [1, -1])
    assert "-0.0" not in out.replace("-0.0000", "")


@pytest.mark.parametrize("E", ["1e-3", "1e30", "1e-200", "1e150", '"1e40 GPa"'])
@pytest.mark.parametrize("base", ["stiff", "same", "rigid"])
def test_any_positive_modulus_is_taken(E: str, base: str, ask: Ask) -> None:
    layer = f"{{ young_modulus = {E}, poisson_ratio = 0.5 }}"
    below = {"stiff": layer.replace("0.5", "-0.9"), "same": layer, "rigid": '"rigid"'}[base]
    text = f"[body]\nmaterial = {below}\n[[body.layers]]\nthickness = 1e-4\nmaterial = {layer}\n"
    code, out, err = ask(text, "--at", "3e3,-4e3", "--json")
    assert code == 0, err
    assert np.linalg.eigvalsh(np.array(json.loads(out)[0]["F"]) @ [1, 1j]).min() > 0


def test_the_rest_of_the_scene_is_not_read(ask: Ask) -> None:
    nonsense = '[indenter]\nshape = 7\n[[loading]]\nforce = "much"\n[semi_analytical]\ncells = -1\n'
    assert ask(COATED + nonsense, "--at", "1,1", "--json") == ask(COATED, "--at", "1,1", "--json")


def test_layers_on_a_rigid_base_have_a_limit_for_uniform_load(ask: Ask) -> None:
    text = COATED.replace(
        '{ young_modulus = "210 GPa", poisson_ratio = 0.3 }', '"rigid"'
    )  # fmt: skip
    uniform, long = (
        np.array(json.loads(ask(text, "--at", at, "--json")[1])[0]["F"]) @ [1, 1j]
        for at in ("0,-0.0", "3e-4,4e-4")
    )
    assert np.abs(uniform - long).max() < 1e-6 * np.abs(uniform).max()
    assert uniform[2, 2] / uniform[0, 0] == pytest.approx((1 - 0.6) / 2 / 0.7)


def test_rigid_body_does_not_move(ask: Ask) -> None:
    code, out, _ = ask('[body]\nmaterial = "rigid"\n', "--at", "1,2", "--at", "0,0", "--json")
    assert code == 0
    assert not np.any([entry["F"] for entry in json.loads(out)])
    assert ask('[body]\nmaterial = "rigid"\n')[0] == 2


@pytest.mark.parametrize(
    ("at", "reason"),
    [
        ("0,0", "moves without bound"),
        ("nan,0", "finite"),
        ("1,inf", "finite"),
        ("1e308,-1.7e308", "positive and"),
        ("1e-320,0", "exceeds"),
        ("1", "two numbers"),
        ("1,2,3", "two numbers"),
        ("a,b", "two numbers"),
        ("", "two numbers"),
    ],
)
def test_wavenumbers_without_an_answer_are_refused(at: str, reason: str, ask: Ask) -> None:
    code, out, err = ask(COATED, "--at", "1,1", "--at", at, "--json")
    assert (code, out) == (2, "")
    assert reason in err


BAD_BODIES = {
    "zero thickness": ('"0.4 mm"', "0", "body.layers[1].thickness: got 0"),
    "negative thickness": ('"0.4 mm"', '"-1 um"', "body.layers[1].thickness: got"),
    "free substrate": ('"210 GPa"', "0", "body.material.young_modulus: got 0"),
    "vanishing modulus": ('"210 GPa"', "1e-310", "a magnitude between 1e-300 and 1e+300 Pa"),
    "nu below -1": ("0.3 }", "-1.0 }", "body.material.poisson_ratio: got -1.0"),
    "nu above one half": ("0.3 }", "0.51 }", "body.layers[1].material.poisson_ratio: got 0.51"),
    "misspelt key": ("thickness", "thikness", "did you mean thickness?"),
    "single brackets": ("[[body.layers]]", "[body.layers]", "write [[body.layers]]"),
    "no body": ("body", "bodi", "body: the key is missing"),
}


@pytest.mark.parametrize(("old", "new", "reason"), BAD_BODIES.values(), ids=BAD_BODIES)
def test_bad_bodies_are_refused_with_file_line_and_key(
    old: str, new: str, reason: str, ask: Ask
) -> None:
    code, _, err = ask(COATED.replace(old, new), "--at", "1,1")
    assert code == 2
    assert "scene.toml:" in err
    assert reason in err


def test_more_than_a_hundred_layers_are_refused(ask: Ask) -> None:
    layer = COATED[COATED.index("[[body") :]
    code, _, err = ask(COATED + 100 * layer, "--at", "1,1")
    assert code == 2
    assert "body.layers: got 101 entries, expected at most 100" in err


def test_table_and_figures_are_written_whole(ask: Ask, tmp_path: Path) -> None:
    directory = tmp_path / "new" / "frf"
    code, out, err = ask(COATED, "--range", "1e2,1e5", "--points", 7, "--output", directory)
    assert code == 0, err
    assert "αG·F_zz" in out
    assert sorted(path.name for path in directory.iterdir()) == [
        *("frf.csv", "frf.png", "frf.svg", "frf_columns.csv"),
    ]
    with open(directory / "frf.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [float(row["alpha [1/m]"]) for row in rows] == pytest.approx(np.geomspace(1e2, 1e5, 7))
    [answer] = json.loads(ask(COATED, "--at", f"{rows[3]['alpha [1/m]']},0", "--json")[1])
    assert float(rows[3]["F_zz [m^3/N]"]) == answer["F"][2][2][0]
    assert float(rows[3]["C [m^3/N]"]) == answer["F"][0][2][1]
    assert float(rows[-1]["alpha G F_tt [1]"]) == pytest.approx(1, rel=1e-9)


def test_long_waves_feel_the_substrate_and_short_ones_the_coating(ask: Ask) -> None:
    matrices = [np.array(row["F"]) for row in json.loads(ask(COATED, "--json")[1])]
    assert len(matrices) > 10
    ratios = [matrix[1, 1, 0] / matrix[2, 2, 0] for matrix in matrices]  # 1/(1 - nu) of either
    assert ratios[0] == pytest.approx(1 / 0.7, rel=0.05)
    assert ratios[-1] == pytest.approx(1 / 0.7, rel=1e-4)


def test_unwritable_output_is_refused(ask: Ask, tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    code, _, err = ask(COATED, "--output", tmp_path / "file" / "frf")
    assert code == 2
    assert "file is a file; --output needs a directory" in err


@pytest.mark.parametrize("band", ["1e5,1e2", "0,1", "-1,1", "1,inf"])
def test_impossible_ranges_are_refused(band: str, ask: Ask) -> None:
    assert ask(COATED, "--range", band)[0] == 2


def test_body_is_read_with_overrides(tmp_path: Path) -> None:
    path = tmp_path / "scene.toml"
    path.write_text(COATED, encoding="utf-8")
    body = read_body(path, ['body.material="rigid"', "body.layers[1].thickness=1e-40"])
    assert body.material is RIGID
    assert body.layers[0].thickness == 1e-40
    with pytest.raises(SceneError, match=r"--set body.layers\[1\].thickness=-1: .* got -1"):
        read_body(path, ["body.layers[1].thickness=-1"])
