"""What a comparison leaves out is shown, with the largest difference there."""

import numpy as np
import pytest
from report_examples import case, report_of, run_record

from verification.cases.apart_everywhere import NAME, NOWHERE, Apart, apart_everywhere
from verification.problems.reference import ReferenceKind
from verification.report.answers import answers

X = np.linspace(-1.0, 1.0, 21)
AXIS, EDGE = np.abs(X) < 0.15, np.abs(X) > 0.85


def apart(load: str, peaks: dict[int, float]) -> Apart:
    difference = np.full(len(X), 0.001)
    for at, value in peaks.items():
        difference[at] = value
    return Apart(load, X, difference, {"near the axis": AXIS, "near the edge": EDGE})


@pytest.mark.parametrize(
    ("at", "value", "why"), [(10, 0.5, "near the axis"), (20, 0.3, "near the edge")]
)
def test_largest_difference_that_is_left_out_is_told_with_place_and_reason(
    at: int, value: float, why: str
) -> None:
    lines = [apart("0.3 µW", {5: 0.02}), apart("0.9 µW", {at: value, 15: 0.04})]
    table = apart_everywhere(lines, "q_x", "µp_H", "a_H")
    assert table.rows[0][1] == "0.02"
    assert table.rows[1] == ("0.9 µW", "0.04", f"{value:g}", f"{round(X[at], 9):g}", why)
    assert f"up to {value:g} µp_H: {why}" in table.note
    assert "0.9 µW" in table.note


def test_nothing_left_out_is_said() -> None:
    line = Apart("1 N", X, np.full(len(X), 0.1), {"near the axis": X > 2.0})
    assert (line.judged, line.largest[2]) == (0.1, NOWHERE)


def test_where_nothing_is_compared_no_difference_is_told() -> None:
    line = Apart("1 N", X, np.full(len(X), 0.1), {"near the axis": X < 2.0})
    assert apart_everywhere([line], "q_x", "µp_H", "a_H").rows[0][1:3] == (NOWHERE, "0.1")


def test_answer_tells_what_the_comparison_does_not_see() -> None:
    table = apart_everywhere([apart("0.3 µW", {10: 0.53})], "q_x", "µp_H", "a_H")
    one = case("cross_check", {"difference": (1.001, 1.0)}, run_record(64, None))
    (verdict,) = one.verdicts
    compared = verdict.model_copy(update={"reference_kind": ReferenceKind.OTHER_SOLVER})
    report = report_of((one.model_copy(update={"verdicts": (compared,), "tables": (table,)}),))
    said = answers(report)[2].sentences
    assert table.name == NAME
    assert any("apart by up to 0.53 µp_H" in sentence for sentence in said)
