"""`slipstick table`: numbers against other computations, provenance, and what it refuses."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest
from command import outcome

from slipstick.tables.catalogue import TABLES
from slipstick.tables.table import Found, Table
from verification.references import load_reference

ROOT = Path(__file__).resolve().parents[1]


def test_the_ball_is_that_of_the_reference_within_both_uncertainties() -> None:
    for row in load_reference("coated_frictionless_paraboloid")["rows"]:
        if row["nu1"] != row["nu2"]:
            continue
        chosen = {
            name: [row[of]] for name, of in (("E1_over_E2",) * 2, ("h_over_aH",) * 2, ("nu", "nu1"))
        }
        (found,) = TABLES["ball"].rows(chosen)
        for name in TABLES["ball"].quantities:
            allowed = found[f"{name}_uncertainty"] + 2 * row["est_rel_error"] * row[name]
            assert abs(found[name] - row[name]) <= allowed


def test_the_punch_has_the_numbers_that_the_documentation_sets_against_others() -> None:
    text = (ROOT / "docs" / "theory" / "literature.md").read_text(encoding="utf-8")
    printed = re.findall(r"^\| ([\d.]+) \| (\d+\.\d{8}) \|", text, re.M)
    assert len(printed) == 5
    for over, kappa in printed:
        (row,) = TABLES["punch"].rows({"a_over_h": [float(over)], "nu": [0.5]})
        assert f"{row['kappa']:.8f}" == kappa


def test_a_thick_layer_is_a_half_space() -> None:
    (row,) = TABLES["punch"].rows({"a_over_h": [1e-9], "nu": [0.3]})
    assert row["kappa"] == pytest.approx(1.0, abs=1e-8)


def test_an_uncertainty_holds_what_doubling_changes_and_what_the_load_misses() -> None:
    punch = TABLES["punch"]
    made = Table(
        "made", punch.axes, punch.quantities, "", "", lambda _, fine: Found((1.0 + fine,), 0.5)
    )
    (row,) = made.rows({"a_over_h": [1.0], "nu": [0.5]})
    assert row["kappa_uncertainty"] == pytest.approx(2 * 1.0 + 0.5 * 2.0)


def test_csv_and_json_have_the_same_numbers_and_provenance() -> None:
    asked = ("table", "punch", "--over", "a_over_h=1,2", "--over", "nu=0.5")
    record = json.loads(outcome(*asked, "--json", cwd=ROOT).stdout)
    lines = outcome(*asked, cwd=ROOT).stdout.splitlines()
    said = dict(line[2:].split(": ", 1) for line in lines if line.startswith("#"))
    header, *rows = (line.split(",") for line in lines if not line.startswith("#"))
    assert {name: said[name] for name in ("problem", "source", "made_by", "uncertainty")} == {
        name: record[name] for name in ("problem", "source", "made_by", "uncertainty")
    }
    assert {name: said[name] for name in header} == record["columns"]
    for row, there in zip(rows, record["rows"], strict=True):
        assert [float(text) for text in row[:-1]] == pytest.approx(
            [there[name] for name in header[:-1]], rel=1e-14
        )


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("bal",), "did you mean ball"),
        (("punch", "--over", "nu=0.6"), "at most 0.5"),
        (("punch", "--over", "nu=nan"), "got nan"),
        (("punch", "--over", "a_over_h"), "expected numbers"),
        (("punch", "--over", "h=1"), "'punch' has a_over_h, nu"),
    ],
)
def test_what_no_table_has_is_refused(arguments: tuple[str, ...], words: str) -> None:
    ended = outcome("table", *arguments, cwd=ROOT)
    assert ended.returncode == 2
    assert words in " ".join(re.sub("[│\n]", " ", ended.stderr).split())
