"""Round-off as nothing, and wide tables in blocks."""

from dataclasses import replace
from pathlib import Path

import pytest
from synthetic_result import synthetic_result

from contact_results.key_numbers import outcome_columns
from slipstick.cli import terminal

ROOT = Path(__file__).resolve().parents[1]


def test_a_torque_of_round_off_is_zero_on_the_console() -> None:
    steps = synthetic_result().steps
    twisted = [replace(step, torque=9.9e-22, twist=1e-3) for step in steps]
    (torques,) = (texts for name, texts in outcome_columns(twisted).items() if "torque" in name)
    assert torques == ["0"] * len(steps)


@pytest.mark.parametrize("width", [40, 80, 200])
def test_wide_tables_break_between_columns(
    width: int, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(terminal, "WIDE", width)
    columns = {"step": ["1", "2"]} | {
        f"quantity\n{k}": [f"{k}.{10**9 + k}", "–"] for k in range(20)
    }
    terminal.print_table(columns, zip(*columns.values(), strict=True), numbers=True)
    lines = capsys.readouterr().out.splitlines()
    assert max(map(len, lines)) <= width
    shown = [word for line in lines for word in line.split()]
    for entries in list(columns.values())[1:]:
        assert shown.count(entries[0]) == 1
    per_block = (width - 6) // 15  # a name of four letters, columns of up to 13 and gaps of 2
    blocks = sum(line.split()[:1] == ["step"] for line in lines)
    assert blocks <= -(-20 // per_block)
