"""Tests of text tables: height maps, friction maps, measured tables and points read them alike."""

import codecs
from pathlib import Path

import numpy as np
import pytest

from contact_scene.friction import FrictionMap
from contact_scene.geometry import HeightMap
from contact_scene.reading.text_table import read_columns
from slipstick.against import MEASURED
from slipstick.cli.commands.stress import POINTS

HEADS = ("x [mm]", "y [mm]", "z [µm]", "p [MPa]", "q [MPa]")
SIZES = np.array([1e-3, 1e-3, 1e-6, 1e6, 1e6])
VALUES = np.array(
    [
        [0.25, 0.5, 12.0, 800.5, 80.25],
        [0.125, 0.0, 1.5, 1900.0, 190.0],
        [0.0, 0.75, 2e-3, 2100.0, 1.25e2],
        [0.5, 0.0, 4.25, 30.5, 0.0],
    ]
)


def height_map(path: Path) -> np.ndarray:
    given = {"shape": "height_map", "material": "rigid", "file": path.name, "spacing": 1e-5}
    return HeightMap.model_validate(given, context={"folder": path.parent}).file.values.T[::-1]


def friction_map(path: Path) -> np.ndarray:
    given = {"map": path.name, "spacing": 1e-5}
    return FrictionMap.model_validate(given, context={"folder": path.parent}).map.values.T[::-1]


def measured(path: Path) -> np.ndarray:
    found = read_columns(path, MEASURED)
    values = VALUES * SIZES
    values[:, [0, 3, 4]] = np.transpose([found[name] for name in ("x", "pressure", "shear")])
    return values / SIZES


def points(path: Path) -> np.ndarray:
    found = read_columns(path, POINTS)
    values = VALUES * SIZES
    values[:, :3] = np.transpose([found[name] for name in "xyz"])
    return values / SIZES


USES = {
    "height map": height_map,
    "friction map": friction_map,
    "against": measured,
    "points": points,
}


def table(mark: str, *, end: str = "", comma: bool = False, quote: str = "", head: str = "") -> str:
    """The table as text: heads, then rows."""

    def line(fields):
        return mark.join(f"{quote}{field}{quote}" for field in fields) + end + "\n"

    rows = [[str(value) for value in row] for row in VALUES.tolist()]
    rows = [[text.replace(".", ",") if comma else text for text in row] for row in rows]
    return head + line(HEADS) + "".join(map(line, rows))


NOTES = "Profil 3\nBreite;0,08 mm\n\n# Channel: 1 2\n"
READ = {
    "plain": table(",").encode(),
    "byte-order mark": codecs.BOM_UTF8 + table(",").encode(),
    "Latin-1": table(",").encode("latin-1"),
    "decimal commas": table(";", comma=True, head=NOTES).encode("latin-1"),
    "separator at the end": table(";", comma=True, end=";").encode(),
    "tabs": table("\t", comma=True, head=NOTES).encode(),
    "tabs at the end": table("\t", end="\t").encode(),
    "commas and spaces": table(", ").encode(),
    "spaces before commas": table(" ,").encode(),
    "spaces": table("  ").encode(),
    "spaces and decimal commas": table(" ", comma=True, end="  ").encode(),
    "quotes": table(",", quote='"').encode(),
    "quotes and semicolons": table(";", quote='"', comma=True).encode(),
    "quoted heads": table(",").replace("x [mm]", '"x [mm]"').encode(),
    "heads in a comment": table(",", head="# by numpy.savetxt\n# ").encode(),
    "heads in parentheses": table(";").replace("[", "(").replace("]", ")").encode(),
    "heads without spaces": table(" ").replace(" [", "[").encode(),
    "lines of Windows": table(",").replace("\n", "\r\n").encode(),
    "lines of old Macs": table(",").replace("\n", "\r").encode(),
    "blank lines": table(",").replace("\n", "\n\n").encode() + b"\n \n",
    "no last line end": table(",").strip().encode(),
    "UTF-16": table("\t", comma=True).encode("utf-16"),
    "UTF-16 of the other order": codecs.BOM_UTF16_BE + table(",").encode("utf-16-be"),
    "Fortran": table(" ").replace("1900.0", "0.19D+04").replace("0.002", "2.0d-3").encode(),
    "minus signs": table(",").replace("0.125", "1.25e\N{MINUS SIGN}1").encode(),
    "comments": table(",").replace("0.5,0.0,4", "# turn\n% back\n0.5,0.0,4").encode(),
}


@pytest.mark.parametrize("use", USES)
@pytest.mark.parametrize("kind", READ)
def test_a_table_is_read_alike_for_every_use(use, kind, tmp_path):
    path = tmp_path / "table.csv"
    path.write_bytes(READ[kind])
    np.testing.assert_allclose(USES[use](path), VALUES, rtol=1e-14)


PLAIN = table(",")


def test_rows_without_numbers_below_a_single_row_are_left_out(tmp_path):
    path = tmp_path / "table.csv"
    path.write_text("\n".join([*PLAIN.splitlines()[:2], ",,,,", ",,,,", ""]), encoding="utf-8")
    assert [len(column) for column in read_columns(path, POINTS).values()] == [1, 1, 1]


def test_a_column_without_any_value_is_left_out(tmp_path):
    """A run without friction writes profiles with heads of shear and no shear."""
    path = tmp_path / "profiles.csv"
    path.write_text("x [m],shear [Pa],pressure [Pa]\n0.0,,2.0\n1.0,,1.0\n", encoding="utf-8")
    assert [*read_columns(path, MEASURED)] == ["x", "pressure"]
    for rows in ("0,,2\n1,3,1", "0,nan,2\n1,nan,1", "0,#DIV/0!,2\n1,,1", ",,\n,,"):
        path.write_text(f"x [m],shear [Pa],pressure [Pa]\n{rows}\n", encoding="utf-8")
        with pytest.raises(ValueError, match=r"line 2 .* no finite number in the column"):
            read_columns(path, MEASURED)


@pytest.mark.parametrize("word", ["", "nan", "#N/A", "***"])
def test_a_missing_value_is_filled_in_heights_alone(word, tmp_path):
    path = tmp_path / "table.csv"
    path.write_text(PLAIN.replace("0.125,", f"{word},"), encoding="utf-8")
    expected = VALUES.copy()
    expected[1, 0] = np.nan
    np.testing.assert_allclose(height_map(path), expected)
    for use, match in ((friction_map, "nan"), (measured, "line 3"), (points, "line 3")):
        with pytest.raises(ValueError, match=match):
            use(path)
