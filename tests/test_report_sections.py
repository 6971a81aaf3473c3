"""Tests of the report page: units of tables, main claims, size, and studies."""

import ast
from pathlib import Path

from report_examples import (
    case,
    chart,
    report_of,
    run_record,
    study,
)

from verification.exhibits.chart import Table
from verification.judging.outcome import Status
from verification.report.file_names import SHEETS
from verification.report.page import MAX_CHARTS, render_page
from verification.report.summary_text import features, stored_records
from verification.running.study import StudyRecord, dump_study

ROOT = Path(__file__).resolve().parents[1]


def test_every_table_that_is_made_says_the_units_of_its_numbers() -> None:
    """What has none is dimensionless by somebody's word, not because nobody has thought of it."""
    silent = [
        f"{path}:{call.lineno}"
        for path in sorted((ROOT / "verification").rglob("*.py"))
        for call in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(call, ast.Call)
        and isinstance(call.func, ast.Name)
        and call.func.id == "Table"
        and "units" not in {keyword.arg for keyword in call.keywords}
    ]
    assert silent == []


def test_promises_have_figures_or_the_command_that_finds_them() -> None:
    planned, forced = (
        run_record(48, None).model_copy(
            update={"label": how, "convolutions": count, "planned": planned}
        )
        for how, count, planned in (("as planned", 20, None), ("all on", 50, "as planned"))
    )
    same = case("forced_effects", {"ball": (1.0, 1.0)}, planned)
    report = report_of(
        (same.model_copy(update={"runs": (planned, forced)}),), (study("stability", level="full"),)
    )
    plan, cost, stable, _ = features(report, SHEETS)
    assert "2.5 to 2.5 times the convolutions" in plan.figures
    assert cost.status is None
    assert "slipstick maintain study work-precision" in cost.figures
    assert stable.status is Status.FAIL


def test_a_quick_page_stays_small() -> None:
    charts = tuple(chart(f"map_{n}", f"View {n}") for n in range(14))
    cells = Table(title="Cells", columns=("cell", "residual"), rows=(("a", "1e-9"),) * 300)
    large = study("seeded-defects")
    conclusion = large.conclusion.model_copy(update={"charts": charts, "tables": (cells,)})
    report = report_of((), (large.model_copy(update={"conclusion": conclusion}),))
    quick = render_page(report)
    assert quick.count("<svg") == MAX_CHARTS < 14
    assert "1e-9" not in quick
    full = render_page(report.model_copy(update={"level": "full"}))
    assert full.count("<svg") == 14
    assert full.count("1e-9") == 300


def test_the_best_record_of_a_study_is_shown(tmp_path: Path) -> None:
    """One of these sources, of the highest level, the latest; cells of a user are no level."""

    def store(place: str, record: StudyRecord, date: str, **changes: object) -> None:
        made = record.provenance.model_copy(update={"date": date, **changes})
        (tmp_path / place).mkdir(parents=True)
        text = dump_study(record.model_copy(update={"provenance": made}))
        (tmp_path / place / "study.json").write_text(text, encoding="utf-8")

    store("a/full", study("stability", "old", "full"), "2001")
    store("b/full", study("stability", "new", "full"), "2002")
    store("a/quick", study("stability", "quick", "quick"), "2003")
    store("a/other", study("no-such-place", "x"), "2003")
    store("b/elsewhere", study("stability", "of others", "full"), "2004", sources="those")
    coarse = study("stability", "coarse", "full").model_copy(update={"own_cells": True})
    store("b/coarse", coarse, "2004")
    for places in (("a", "b"), ("b", "a")):
        (chosen,) = stored_records(tmp_path / place for place in places)
        assert chosen.conclusion.answer == "new"
    assert stored_records([tmp_path / "nowhere"]) == ()
