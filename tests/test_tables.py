"""Tests of `slipstick table`: comparison with other computations, provenance, and refusals."""

import json
import re
from dataclasses import replace
from datetime import date
from pathlib import Path

import pytest
from command import outcome

from slipstick.cli.commands import deposit
from slipstick.tables import frictional
from slipstick.tables.catalogue import TABLES
from slipstick.tables.table import Axis, RowValues, Table
from verification.challenge.cases import challenges
from verification.references import load_reference

ROOT = Path(__file__).resolve().parents[1]


@pytest.mark.parametrize("name", TABLES)
def test_the_rows_of_a_table_are_in_order_and_within_its_bounds(name):
    for axis in TABLES[name].axes.values():
        values = axis.values
        assert axis.least < values[0]
        assert values[-1] <= axis.most
        assert sorted({*values}) == [*values]


def test_an_uncertainty_has_its_parts_with_their_signs_and_sizes():
    """2 |3 - 3.5| + 0.01 * 3 + 0.1."""
    found = {1: RowValues((3.0,), 0.01, (0.1,)), 2: RowValues((3.5,))}
    table = Table("t", {"k": Axis("", (7.0,))}, {"q": ""}, "", "", lambda place, fine: found[fine])
    (row,) = table.rows({})
    assert row == pytest.approx({"k": 7.0, "q": 3.0, "q_uncertainty": 1.13})


BARE = load_reference("frictional_indentation_homogeneous")["rows"][0]
FRICTIONAL = [
    pytest.param(BARE, (1.0, 1.0, BARE["nu"], BARE["mu"]), id="bare", marks=pytest.mark.slow),
    pytest.param(
        load_reference("frictional_indentation_coated"), (2.0, 1.0, 0.3, 0.1), id="coated"
    ),
]
OF_REFERENCE = {"a_over_aH": 2e-8, "delta_over_deltaH": 2e-8, "c_over_a": 1e-6}


@pytest.mark.parametrize(("reference", "place"), FRICTIONAL)
def test_pressing_with_friction_is_that_of_integral_equations(reference, place, monkeypatch):
    """Contact, and tractions at the radii of the reference; an eighth of the increments suffices.

    place  E1/E2, h/a_H, ν and µ"""
    monkeypatch.setattr(frictional, "PATH_INCREMENTS", frictional.PATH_INCREMENTS // 8)
    chosen = {name: [value] for name, value in zip(TABLES["pressing"].axes, place, strict=True)}
    (found,) = TABLES["pressing"].rows(chosen)
    for name, left in OF_REFERENCE.items():
        assert abs(found[name] - reference[name]) <= found[f"{name}_uncertainty"] + left
    assert found["delta_over_deltaH_uncertainty"] < 5e-8
    radii = reference["r_over_a"]
    inside = [n for n, r in enumerate(radii) if 0.05 <= r <= 0.95]
    at = {"r_over_a": [radii[n] for n in inside]}
    for n, row in zip(inside, TABLES["tractions"].rows(chosen | at), strict=True):
        for name, of in (("p_over_pH",) * 2, ("q_over_mu_pH",) * 2):
            assert abs(row[name] - reference[of][n]) <= row[f"{name}_uncertainty"] + 3e-6


def test_the_punch_has_the_numbers_that_the_documentation_sets_against_others():
    text = (ROOT / "docs" / "theory" / "literature.md").read_text(encoding="utf-8")
    printed = re.findall(r"^\| ([\d.]+) \| (\d+\.\d{8}) \|", text, re.M)
    assert len(printed) == 5
    for over, kappa in printed:
        (row,) = TABLES["punch"].rows({"a_over_h": [float(over)], "nu": [0.5]})
        assert f"{row['kappa']:.8f}" == kappa


ONE_PUNCH = {name: replace(axis, values=(0.5,)) for name, axis in TABLES["punch"].axes.items()}


def test_the_deposit_describes_every_table_and_has_the_same_bytes_again(tmp_path, monkeypatch):
    monkeypatch.setattr(deposit, "TABLES", {"punch": replace(TABLES["punch"], axes=ONE_PUNCH)})
    found = list(deposit.datasets())
    assert [one.about["table"] for one in found] == ["punch", "onset", "changing_loads"]
    for folder in (tmp_path / "one", tmp_path / "two"):
        deposit.write_crate(folder, found, date(2026, 1, 2))
    files = sorted((tmp_path / "one").iterdir())
    assert len(files) == 2 * len(found) + 1
    assert [f.read_bytes() for f in files] == [
        (tmp_path / "two" / f.name).read_bytes() for f in files
    ]
    graph = {e["@id"]: e for e in json.loads(files[-1].read_text())["@graph"]}
    listed = {part["@id"] for part in graph["./"]["hasPart"]}
    assert listed == {f.name for f in files[:-1]}
    for one in found:
        name = one.about["table"]
        assert graph[f"{name}.csv"]["description"] == one.about["problem"]
        formats = [graph[f"{name}.{kind}"]["encodingFormat"] for kind in ("csv", "json")]
        assert formats == ["text/csv", "application/json"]
        document = json.loads((tmp_path / "one" / f"{name}.json").read_text())
        assert document["columns"].keys() == document["rows"][0].keys()
        assert all(row["digest"] and row["method"] and row["command"] for row in one.rows)
    asked = found[0].rows[0]["command"].split()[1:]
    (again,) = json.loads(outcome(*asked, "--json", cwd=ROOT).stdout)["rows"]
    assert again.items() <= found[0].rows[0].items()
    last = challenges()["changing_loads/nu=0.5"].values[-1]
    row = found[2].rows[-1]
    assert (row["step"], row["quantity"], row["value"]) == (last.step, last.quantity, last.value)
    assert row["value_uncertainty"] == last.uncertainty * last.scale


def test_a_refused_row_names_its_values_and_a_remedy_that_tables_have():
    ended = outcome("table", "punch", "--over", "a_over_h=1e4", "--over", "nu=0.3", cwd=ROOT)
    said = " ".join(ended.stderr.split())
    assert ended.returncode
    assert "a_over_h=10000, nu=0.3: " in said
    assert said.endswith("resolve. Choose other values with --over")
