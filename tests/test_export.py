"""What was written comes back as arrays with units and places, here and in other programs."""

import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from command import outcome
from fem_scenes import solved
from synthetic_result import synthetic_result
from test_section_output import LOOP
from test_stress_files import COATED, STATES

import slipstick
from contact_results.files.mesh_file import read_mesh
from contact_results.result_files import write_result
from contact_results.stress.on_cells import stress_on_cells
from contact_results.stress.stress_maxima import extremes
from contact_results.stress_files import write_stress
from contact_scene.quantities.increment import (
    SCALARS,
    components,
)

HOSTILE = '=HYPERLINK("http://a.example";"b") <&>  µ'


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
        write_result(of, directory / name, figures="none")
    state = STATES["cells"]
    field = stress_on_cells(state, see_edge=False, volume=True)
    write_stress(
        state, "body", field, extremes(field, COATED), directory / "stress", with_figures=False
    )
    return directory


def exported(place: Path, source: str) -> Any:
    return outcome("export", source, "-o", "out", cwd=place)


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


@pytest.mark.parametrize("name", ["cells", "rings"])
def test_surfaces_of_all_steps_carry_their_loads(place: Path, name: str) -> None:
    """As far as the peaks: a disc of rings has no area of its own."""
    assert exported(place, name).returncode == 0
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


def test_what_cannot_be_exported_is_refused_with_what_to_do(place: Path) -> None:
    for source, complaint in (
        ("nowhere", "nowhere is no run: it has no summary.json"),
        ("stress", "open its stress_section.vtu"),
    ):
        ended = exported(place, source)
        assert ended.returncode == 2, ended.stdout
        assert complaint in " ".join(ended.stderr.replace("│", " ").split())
