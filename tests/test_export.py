"""What was written comes back as arrays with units and places, here and in other programs."""

import shutil
import sys
import xml.etree.ElementTree as ET
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from command import outcome, rows
from fem_scenes import solved
from scipy.io import loadmat
from synthetic_result import synthetic_result
from test_section_output import LOOP
from test_stress_files import COATED, STATES

import slipstick
from contact_results.export.matlab import HEADER
from contact_results.export.sheets import arrays_of, tables_of
from contact_results.files.mesh_file import read_mesh
from contact_results.result_files import write_result
from contact_results.stress.extremes import extremes
from contact_results.stress.on_cells import stress_on_cells
from contact_results.stress_files import write_stress
from contact_scene.increment import SCALARS, components

HOSTILE = '=HYPERLINK("http://a.example";"b") <&>  µ'
ROOT = Path(__file__).resolve().parents[1]


@pytest.fixture(scope="module")
def place(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A run on `cells` with a title that is a formula, one on `rings`, and a `stress`."""
    directory = tmp_path_factory.mktemp("export")
    result = synthetic_result()
    scene = result.scene.model_copy(update={"title": HOSTILE})
    for name, of in (
        ("cells", type(result)(scene, result.grid, 1e-8, result.plan, result.increments)),
        ("rings", solved(LOOP, 8, harmonics=2)),
    ):
        (directory / name).mkdir()
        write_result(of, directory / name, with_figures=False)
    state = STATES["cells"]
    field = stress_on_cells(state, see_edge=False, volume=True)
    write_stress(
        state, "body", field, extremes(field, COATED), directory / "stress", with_figures=False
    )
    return directory


def asked(place: Path, source: str, to: str) -> Any:
    return outcome("export", source, "-o", "out", "--to", to, cwd=place)


@pytest.mark.parametrize("name", ["cells", "rings"])
def test_tables_come_back_with_the_numbers_units_and_meanings_of_the_fields(
    place: Path, name: str
) -> None:
    run = slipstick.load(place / name)
    assert {"profiles", "increments"} <= set(run.tables)
    table = run.tables["increments"]
    for scalar, mark in SCALARS.items():
        parts = [table[part] for part in components(scalar)]
        assert {part.unit for part in parts} == {mark.unit}
        assert {part.meaning for part in parts} == {mark.meaning}
        found = np.stack([part.array for part in parts], axis=-1).squeeze()
        if scalar in run.increments:
            np.testing.assert_array_equal(found, run.increments[scalar].array)
        else:
            assert np.all(np.isnan(found))
    assert table["step"].array.dtype.kind == "i"


@pytest.mark.parametrize("name", ["cells", "rings"])
def test_every_index_is_that_of_a_coordinate_an_increment_or_a_component(
    place: Path, name: str
) -> None:
    run = slipstick.load(place / name)
    sizes = {"increment": len(run.increments["step"].array), "component": 2}
    sizes["step"] = len(run.summary.steps)
    sizes |= {axis: len(values.array) for axis, values in run.coordinates.items()}
    for group in (run.coordinates, run.increments, run.last_cycle):
        for values in group.values():
            assert values.array.shape == tuple(sizes[index] for index in values.indices)


def test_a_stress_comes_back_with_its_places_units_and_meanings(place: Path) -> None:
    stress = slipstick.load_stress(place / "stress")
    assert set(stress.tables) == {"stress_maxima", "stress_axis", "stress_interfaces"}
    axis = stress.tables["stress_axis"]
    assert axis["sigma_xx"].unit == "Pa"
    assert set(axis["material"].array) == {"layer 1", "base"}
    for mesh in (stress.section, stress.surface, stress.volume):
        assert mesh is not None
        assert mesh.points.unit == "m"
        counts = {"point": len(mesh.points.array), "cell": len(mesh.cells.array)}
        for name, values in mesh.fields.items():
            assert len(values.array) == counts[values.indices[0]]
            assert values.unit or name == "material"
            assert values.meaning
    assert stress.volume is not None
    largest = np.max(stress.volume.fields["von_mises"].array)
    assert largest == max(e["value"] for e in stress.record["maxima"] if e["region"] == "body"
                          and e["measure"] == "von_mises")  # fmt: skip


@pytest.mark.parametrize("name", ["cells", "rings", "stress"])
def test_matlab_reads_the_same_numbers_by_the_same_names(place: Path, name: str) -> None:
    ended = asked(place, name, "matlab")
    assert ended.returncode == 0, ended.stderr
    path = place / "out" / ("stress.mat" if name == "stress" else "run.mat")
    found = loadmat(path, simplify_cells=True)
    stored = (slipstick.load_stress if name == "stress" else slipstick.load)(place / name)
    assert found["convention"] == stored.convention
    if name != "stress":
        assert tuple(found.pop("direction")) == stored.direction == (1.0, 0.0)
    sheets = arrays_of(stored)
    assert set(sheets) | {"title", "convention", "unit", "meaning", "indices"} == {
        key for key in found if not key.startswith("__")
    }
    for group, sheet in sheets.items():
        assert set(found[group]) == set(sheet)
        for key, values in sheet.items():
            np.testing.assert_array_equal(
                np.squeeze(found[group][key]), values.array.squeeze(), strict=False
            )
            assert found["unit"][group][key] == (values.unit or "1")
            assert found["meaning"][group][key] == values.meaning


def test_equal_results_give_equal_bytes_whenever_they_are_written(
    place: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    written = []
    for hour in ("noon", "midnight"):
        monkeypatch.setattr("time.asctime", lambda *_, hour=hour: hour)
        for to in ("matlab", "excel", "vtu"):
            assert asked(place, "cells", to).returncode == 0
        written.append({path.name: path.read_bytes() for path in (place / "out").iterdir()})
    assert written[0] == written[1]
    assert b"slipstick" in written[0]["run.mat"][:HEADER]
    with zipfile.ZipFile(place / "out" / "run.xlsx") as book:
        assert {part.date_time[0] for part in book.infolist()} == {1980}
        assert b"1980-01-01" in book.read("docProps/core.xml")


MAIN = "{http://schemas.openxmlformats.org/spreadsheetml/2006/main}"


def workbook(path: Path) -> dict[str, list[list[Any]]]:
    """The cells of every sheet, by the words of the format; None where there is none."""
    with zipfile.ZipFile(path) as book:
        names = [sheet.attrib["name"] for sheet in ET.fromstring(book.read("xl/workbook.xml"))
                 .iter(f"{MAIN}sheet")]  # fmt: skip
        shared = ["".join(text.text or "" for text in item.iter(f"{MAIN}t"))
                  for item in ET.fromstring(book.read("xl/sharedStrings.xml"))]  # fmt: skip
        found = {}
        for number, name in enumerate(names, 1):
            sheet = ET.fromstring(book.read(f"xl/worksheets/sheet{number}.xml"))
            assert not list(sheet.iter(f"{MAIN}f"))  # no formula
            found[name] = [
                {
                    cell.attrib["r"].rstrip("0123456789"): shared[int(value.text or "")]
                    if cell.attrib.get("t") == "s"
                    else float(value.text or "")
                    for cell in row
                    for value in cell.iter(f"{MAIN}v")
                }
                for row in sheet.iter(f"{MAIN}row")
            ]
    return found


@pytest.mark.parametrize("name", ["cells", "rings", "stress"])
def test_a_workbook_has_the_tables_with_numbers_as_numbers_and_no_formula(
    place: Path, name: str
) -> None:
    ended = asked(place, name, "excel")
    assert ended.returncode == 0, ended.stderr
    kind = "stress" if name == "stress" else "run"
    book = workbook(place / "out" / f"{kind}.xlsx")
    stored = (slipstick.load_stress if name == "stress" else slipstick.load)(place / name)
    tables = tables_of(stored)
    assert list(book) == ["columns", *tables]
    for sheet, table in tables.items():
        head, *lines = book[sheet]
        assert [text.partition(" [")[0] for text in head.values()] == list(table)
        for letter, values in zip(head, table.values(), strict=True):
            column = [line.get(letter) for line in lines]
            if values.array.dtype.kind == "U":
                assert column == values.array.tolist()
                continue
            numbers = [np.nan if value is None else value for value in column]
            # A spreadsheet keeps 16 digits.
            np.testing.assert_allclose(numbers, values.array, rtol=1e-15, atol=0)
    if name == "cells":
        (title,) = book["columns"][0].values()
        assert title.startswith("=HYPERLINK")


@pytest.mark.parametrize("name", ["cells", "rings"])
def test_surfaces_of_all_steps_carry_their_loads(place: Path, name: str) -> None:
    """As far as the peaks: a disc of rings has no area of its own."""
    assert asked(place, name, "vtu").returncode == 0
    run = slipstick.load(place / name)
    files = [entry.attrib["file"] for entry in ET.parse(place / "out/surface.pvd").iter("DataSet")]
    assert files == [f"surface_step_{n}.vtu" for n in range(1, len(run.summary.steps) + 1)]
    for file, step in zip(files, run.summary.steps, strict=True):
        mesh = read_mesh(place / "out" / file)
        fields = mesh.on_cells or mesh.at_points
        assert {"pressure [Pa]", "shear [Pa]", "slip [m]", "gap [m]", "in_stick [1]"} <= set(fields)
        if name == "cells":
            load = np.sum(fields["pressure [Pa]"]) * (1.2e-3 / 24) * (1.0e-3 / 20)
            expected = np.sum(run.increments["pressure"].array[0]) * (1.2e-3 / 24) * (1e-3 / 20)
            assert load == pytest.approx(expected)
        else:
            assert fields["pressure [Pa]"].max() == step.peak_pressure


def test_profiles_of_a_workbook_are_those_of_the_table(place: Path) -> None:
    table = rows(place / "cells" / "profiles.csv")
    found = slipstick.load(place / "cells").tables["profiles"]
    assert [row["shear_x [Pa]"] for row in table] == [
        "" if v != v else repr(v) for v in found["shear_x"].array.tolist()
    ]


def test_what_cannot_be_exported_is_refused_with_what_to_do(
    place: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    old = place / "old"
    shutil.copytree(place / "cells", old)
    (old / "columns.csv").unlink()
    short = place / "short"
    shutil.copytree(place / "cells", short)
    with open(short / "profiles.csv", "a", encoding="utf-8") as file:
        file.write("1,2\n")
    monkeypatch.setitem(sys.modules, "xlsxwriter", None)
    for source, to, complaint in (
        ("nowhere", "matlab", "is no run and no stress: it has no summary.json"),
        ("stress", "vtu", "open its stress_section.vtu"),
        ("cells", "excel", "pip install 'slipstick[excel]'"),
        ("old", "matlab", "the files are of an earlier version; write them again"),
        ("short", "matlab", "profiles.csv:74: 2 values, expected 11"),
    ):
        ended = asked(place, source, to)
        assert ended.returncode == 2, ended.stdout
        assert complaint in " ".join(ended.stderr.replace("│", " ").split())


def test_a_run_and_a_stress_are_told_apart(place: Path) -> None:
    with pytest.raises(FileNotFoundError, match="it is a stress, which load_stress reads"):
        slipstick.load(place / "stress")
    with pytest.raises(FileNotFoundError, match="it is a run, which load reads"):
        slipstick.load_stress(place / "cells")
    other = place / "other"
    other.mkdir()
    for content, complaint in ((b"[1]", "it is of an earlier version"), (b"\xff", "is not the")):
        (other / "stress.json").write_bytes(content)
        with pytest.raises(ValueError, match=complaint):
            slipstick.load_stress(other)


@pytest.mark.parametrize(("to", "suffix"), [("matlab", ".mat"), ("excel", ".xlsx")])
def test_an_output_that_is_named_like_the_file_is_the_file(
    place: Path, tmp_path: Path, to: str, suffix: str
) -> None:
    for output in (tmp_path / f"mine{suffix}", tmp_path / "folder.of.mine"):
        told = outcome("export", "stress", "-o", output, "--to", to, cwd=place)
        file = output if output.suffix == suffix else output / f"stress{suffix}"
        assert file.is_file()
        assert str(file) in told.stdout
