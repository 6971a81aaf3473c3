"""The report's page: its order, its answers and what is missing."""

import ast
import re
from pathlib import Path

import pytest
from report_examples import (
    case,
    chart,
    report_of,
    run_record,
    study,
    verdict,
)

from verification.exhibits.chart import Table
from verification.judging.outcome import Status
from verification.report.files import SHEETS
from verification.report.page import MAX_CHARTS, alignment, heading, render_page
from verification.report.sections import TITLES, features, stored_records, study_section
from verification.report.summary_text import counts_text, render_summary
from verification.report.svg import compact
from verification.running.report_record import Report
from verification.running.study import Statement, StudyRecord, dump_study
from verification.studies.catalogue import STUDIES

ROOT = Path(__file__).resolve().parents[1]
SECTIONS = (
    "verdict", "pictures", "baseline", "cases", "paper", "cost",
    "stability", "defects", "omissions", "provenance",
)  # fmt: skip


def of_both(cells: float, elements: float) -> Report:
    """Both solvers on one reference of 1 µm."""
    return report_of((
        case("hertz_point", {"approach": (cells, 1e-6)}, run_record(64, None)),
        case("fem_hertz", {"approach": (elements, 1e-6)}, run_record(None, 32)),
    ))  # fmt: skip


def test_sections_come_in_their_order_and_the_contents_lead_to_each() -> None:
    page = render_page(of_both(1e-6, 1e-6))
    found = re.findall(r'<(?:section|header) id="([^"]*)"', page)
    assert tuple(found) == SECTIONS
    assert page.index("</header>") < page.index("<nav")  # on a phone the verdict comes first
    contents = page[page.index("<nav") : page.index("</nav>")]
    assert tuple(re.findall(r'<li><a href="#(\w+)">(?!<span)', contents)) == SECTIONS


def test_numbers_stand_to_the_right_and_words_to_the_left() -> None:
    rows = (("a", "1.2e-3", "16 x 16", "yes", "–"), ("b", "–", "–", "no", "0.0027 s"),
            ("c", "✓ 2 %", "8", "16 x 16 cells and 30 increments", "–"))  # fmt: skip
    table = Table(title="t", columns=("name", "error", "cells", "near", "cost"), rows=rows)
    found = [alignment(table, column) for column in range(1, 5)]
    assert found == ["number", "number", "words", "number"]


def test_every_column_of_numbers_has_a_unit_or_none() -> None:
    rows = (("a", "1.2e-3", "4.2 ms", "3", "✓ 0.2", "fine"), ("b", "–", "9 ms", "4", "–", "bad"))
    columns = ("name", "shift", "took", "cells", "error", "end")
    table = Table(title="t", columns=columns, rows=rows, units={"shift": "µm"})
    found = [heading(table, column) for column in range(6)]
    assert found == ["name", "shift [µm]", "took", "cells [–]", "error [–]", "end"]
    old = table.model_copy(update={"units": None})
    assert tuple(heading(old, column) for column in range(6)) == columns


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


def test_promises_lead_the_page_with_figures_or_with_the_command_that_finds_them() -> None:
    planned, forced = (
        run_record(48, None).model_copy(
            update={"label": how, "convolutions": count, "planned": planned}
        )
        for how, count, planned in (("as planned", 20, None), ("all on", 50, "as planned"))
    )
    same = case("forced_effects", {"ball": (1.0, 1.0)}, planned)
    report = report_of((same.model_copy(update={"runs": (planned, forced)}),),
                       (study("stability", level="full"),))  # fmt: skip
    plan, cost, stable, stated = features(report, SHEETS)
    assert "2.5 to 2.5 times the convolutions" in plan.figures
    assert cost.status is None
    assert "slipstick maintain study work-precision" in cost.figures
    assert stable.status is Status.FAIL
    header = render_page(report).split("</header>")[0]
    for feature in (plan, cost, stable, stated):
        assert f'<a href="{feature.address}">{feature.promise}</a>' in header
        assert feature.figures in header


@pytest.mark.parametrize("number", [0, 1, 2])
def test_headline_names_studies_that_are_inconclusive(number: int) -> None:
    claim = Statement(claim="c", outcome=Status.INCONCLUSIVE, measured="m")
    names = ("stability", "scoreboard", "coated-tractions")[: number + 1]
    records = [study(name) for name in names]
    open_ = [
        one.model_copy(update={"conclusion": one.conclusion.model_copy(
            update={"statements": (claim,)})})
        for one in records[:number]
    ]  # fmt: skip
    report = report_of((), (*open_, *records[number:]))
    words = {0: "", 1: "; 1 study inconclusive", 2: "; 2 studies inconclusive"}[number]
    assert counts_text(report) == f"0 passed, 0 failed, 0 inconclusive{words}"
    heading = re.search(r"<h1>(.*?)</h1>", render_page(report), re.DOTALL)
    assert heading is not None
    assert counts_text(report) in heading[1]
    assert f"{counts_text(report)}, in 0 cases." in render_summary(report)


def test_a_quick_page_stays_small_and_says_what_it_leaves_out() -> None:
    charts = tuple(chart(f"map_{n}", f"View {n}") for n in range(14))
    cells = Table(title="Cells", columns=("cell", "residual"), rows=(("a", "1e-9"),) * 300)
    large = study("seeded-defects")
    conclusion = large.conclusion.model_copy(update={"charts": charts, "tables": (cells,)})
    report = report_of((), (large.model_copy(update={"conclusion": conclusion}),))
    quick = render_page(report)
    shown = MAX_CHARTS
    assert quick.count("<svg") == shown < 14
    assert f"{14 - shown} more diagrams" in quick
    assert "View 12; View 13" in quick
    assert "Cells: 300 rows" in quick
    full = render_page(report.model_copy(update={"level": "full"}))
    assert full.count("<svg") == 14
    assert full.count("1e-9") == 300


def test_what_is_inconclusive_leads_the_page() -> None:
    wide = verdict("order_of_shear", 1.5, 1.5).model_copy(
        update={"tolerance_kind": "order", "interval": 0.4, "status": Status.INCONCLUSIVE}
    )
    one = case("one", {"approach": (1e-6, 1e-6)}, run_record(64, None))
    header = render_page(report_of((one.model_copy(update={"verdicts": (wide,)}),)))
    header = header.split("</header>")[0]
    assert "What is inconclusive" in header
    assert "1.50 ± 0.40, expected 1.5" in header
    assert "What is inconclusive" not in render_page(of_both(1e-6, 1e-6)).split("</header>")[0]


@pytest.mark.parametrize("name", TITLES)
def test_a_missing_study_names_the_command_that_makes_it(name: str) -> None:
    section = study_section(report_of(()), name)
    assert section.record is None
    page = render_page(report_of(()))
    article = page[page.index(f'id="study-{name}"') :].split("</article>")[0]
    assert name in STUDIES
    assert f"slipstick maintain study {name} --level quick" in article


def test_a_study_that_was_made_is_shown_with_its_level_and_what_it_lost() -> None:
    page = render_page(report_of((), (study("stability", level="full"),)))
    article = page[page.index('id="study-stability"') :].split("</article>")[0]
    assert "Level full" in article
    assert "lost-one" in article
    assert "not run" not in article.lower()


def test_the_highest_level_of_a_study_is_shown_and_of_equals_the_latest(tmp_path: Path) -> None:
    def store(place: str, record: StudyRecord, date: str) -> None:
        made = record.provenance.model_copy(update={"date": date})
        (tmp_path / place).mkdir(parents=True)
        text = dump_study(record.model_copy(update={"provenance": made}))
        (tmp_path / place / "study.json").write_text(text, encoding="utf-8")

    store("a/full", study("stability", "old", "full"), "2001")
    store("b/full", study("stability", "new", "full"), "2002")
    store("a/quick", study("stability", "quick", "quick"), "2003")
    store("a/other", study("no-such-place", "x"), "2003")
    for places in (("a", "b"), ("b", "a")):
        (chosen,) = stored_records(tmp_path / place for place in places)
        assert chosen.conclusion.answer == "new"
    assert stored_records([tmp_path / "nowhere"]) == ()


def test_a_broken_record_of_a_study_is_named(tmp_path: Path) -> None:
    (tmp_path / "broken").mkdir()
    (tmp_path / "broken" / "study.json").write_text("{", encoding="utf-8")
    with pytest.raises(ValueError, match=r"broken/study\.json"):
        stored_records([tmp_path])
    told: list[str] = []
    assert stored_records([tmp_path], told.append) == ()
    assert len(told) == 1
    assert "broken/study.json" in told[0]


def test_cells_of_somebodys_choice_are_no_level_of_a_study(tmp_path: Path) -> None:
    record = study("stability", "coarse", "full")
    (tmp_path / "coarse").mkdir()
    text = dump_study(record.model_copy(update={"own_cells": True}))
    (tmp_path / "coarse" / "study.json").write_text(text, encoding="utf-8")
    assert stored_records([tmp_path]) == ()


def test_summary_names_the_studies() -> None:
    assert "stability ✓ pass (quick)" in render_summary(report_of((), (study("stability"),)))


def test_a_compact_drawing_keeps_what_is_referred_to() -> None:
    svg = (
        '<svg><metadata>x</metadata><g id="figure_1"><g id="a"><defs><path id="m1" d="M 0 0 \n'
        'L 1.23456 0"/></defs><use xlink:href="#m1" x="2.000000"/></g>'
        '<g clip-path="url(#p1)"/><clipPath id="p1"/></g><g id="b">\n</g></svg>'
    )
    text = compact(svg, "one")
    ids = re.findall(r' id="([^"]*)"', text)
    assert len(ids) == len(set(ids)) == 2
    assert set(re.findall(r'(?:href="#|url\(#)([^")]*)', text)) == set(ids)
    assert "L1.23 0" in text
    assert 'x="2"' in text
    assert "<g>" not in text
    assert text.count("<g clip") == text.count("<g") == 1
    assert "</g>" not in text
    assert not set(ids) & set(re.findall(r' id="([^"]*)"', compact(svg, "two")))


def test_a_failure_leads_the_page() -> None:
    report = of_both(1e-6, 2e-6)
    assert report.status is Status.FAIL
    header = render_page(report).split("</header>")[0]
    assert "✗" in header
    assert "slipstick verify fem_hertz --level quick" in header


def test_a_failed_study_leads_the_page_too() -> None:
    header = render_page(report_of((), (study("stability", level="full"),))).split("</header>")[0]
    assert 'href="#study-stability"' in header
    assert "cases were lost" in header
