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

from verification.exhibits.table import Table
from verification.judging.outcome import CaseOutcome, OrderRecord, Status
from verification.problems.reference import ReferenceKind
from verification.report.answers import answers
from verification.report.both_solvers import both_solvers_charts, furthest_apart, shared_references
from verification.report.columns import alignment, heading
from verification.report.compact_svg import compact
from verification.report.counts import counts_text
from verification.report.extent import extent
from verification.report.features import features
from verification.report.page import render_page
from verification.report.prices import price_table, telling_chart
from verification.report.sections import TITLES, stored_records, study_section
from verification.report.summary_text import render_summary
from verification.running.record import StudyRecord, dump_study
from verification.running.report_record import Report
from verification.running.row import Row
from verification.running.study import Conclusion, Statement
from verification.solver import Method, Solver
from verification.studies.catalogue import STUDIES
from verification.studies.work_precision.price_rows import Reached

ROOT = Path(__file__).resolve().parents[1]
SECTIONS = (
    "verdict", "pictures", "baseline", "answers", "cases", "solvers", "paper", "cost",
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


def test_three_kinds_of_verdict_are_counted_apart() -> None:
    good = case("one", {"approach": (1e-6, 1e-6), "radius": (2e-6, 1e-6)}, run_record(64, None))
    rate = verdict("rate", 2.0, 2.0).model_copy(update={"tolerance_kind": "order"})
    page = render_page(report_of((good.model_copy(update={"verdicts": (*good.verdicts, rate)}),)))
    table = page[page.index("Three kinds of verdict") :]
    rows = re.findall(r'<tr><th scope="row">([\w ]+)</th>(.*)</tr>', table)[:2]
    assert [(name, re.findall(r"\d+", cells)) for name, cells in rows] == [
        ("against a reference", ["1", "1", "0"]),
        ("order of convergence", ["1", "0", "0"]),
    ]


def test_rows_of_both_solvers_have_names_of_their_own_and_a_chart_per_kind() -> None:
    def with_runs(name: str, cells: int | None, values: dict[str, float]) -> CaseOutcome:
        runs, verdicts = [], []
        for k, (what, reference) in enumerate(values.items()):
            label = f"E1/E2 = {k}, {cells}x{cells}" if cells else f"E1/E2 = {k}"
            runs.append(
                run_record(cells, None if cells else 64).model_copy(
                    update={"label": label, "problem": f"E1/E2 = {k}"}
                )
            )
            word = what.partition(" ")[0]
            verdicts.append(verdict(word, 1.001 * reference, reference, label))
        one = case(name, {}, run_record(64, None), drawn=False)
        return one.model_copy(update={"runs": tuple(runs), "verdicts": tuple(verdicts)})

    values = {"approach a": 1e-6, "approach b": 2e-6, "contact_radius": 3e-6, "energy": 4e-6}
    outcomes = (with_runs("coated", 256, values), with_runs("again", 256, values),
                with_runs("fem_coated", None, values))  # fmt: skip
    charts = both_solvers_charts(shared_references(report_of(outcomes)))
    places = [chart.rows[0][0].y_places for chart in charts]
    assert places == [
        ("coated, E1/E2 = 1", "coated, E1/E2 = 0"),
        ("contact, coated, E1/E2 = 2",),
        ("energy, coated, E1/E2 = 3",),
    ]
    assert len({chart.name for chart in charts}) == len(charts)


def test_values_of_different_references_are_not_compared() -> None:
    one = case("hertz_point", {"approach": (1e-6, 1e-6)}, run_record(64, None))
    other = case("fem_hertz", {"approach": (2e-6, 2e-6)}, run_record(None, 32))
    assert shared_references(report_of((one, other))) == ()


def test_springs_are_left_to_their_own_study() -> None:
    elements = run_record(None, 32)
    springs = elements.model_copy(update={"method": Method.PENALTY})
    for run, shared in ((elements, 1), (springs, 0)):
        one = case("hertz_point", {"approach": (1e-6, 1e-6)}, run_record(64, None))
        other = case("any_name", {"approach": (1e-6, 1e-6)}, run)
        assert len(shared_references(report_of((one, other)))) == shared


def test_a_study_answers_its_question_in_its_own_words() -> None:
    report = report_of((), (study("coated-tractions", "No, for a reason."),))
    (sliding, cost, both) = answers(report)
    assert sliding.sentences == ("No, for a reason.",)
    assert sliding.chart is not None
    assert sliding.missing is None
    assert cost.sentences == both.sentences == ()
    assert cost.missing is not None
    assert both.missing is None


def priced(*rows: Row) -> StudyRecord:
    """A study of what accuracy costs, with a diagram for every quantity."""
    charts = tuple(chart(str(name), "Diagram") for name in dict.fromkeys(
        row.parameters["chart"] for row in rows
    ))  # fmt: skip
    return study("work-precision", "It depends.").model_copy(
        update={"conclusion": Conclusion(
            statements=(Statement(claim="c", outcome=Status.PASS, measured="m"),),
            answer="It depends.", rows=rows, charts=charts,
        )}
    )  # fmt: skip


def prices(title: str, **costs: float | None) -> tuple[Row, ...]:
    """What a quantity costs to 1 % and to 0.1 %, by method: 1 s, and this."""
    return tuple(
        Row(
            parameters={"title": title, "method": method, "target": target,
                        "chart": f"chart of {title}"},
            measures={"cost": cost}, units={"cost": "s"},
            words={"reached": Reached.NOT if cost is None else Reached.TRIED, "setting": "8 x 8"},
        )
        for method, asked in costs.items() for target, cost in ((0.01, 1.0), (0.001, asked))
    )  # fmt: skip


def test_what_an_accuracy_costs_is_one_table_of_quantities_and_methods() -> None:
    record = priced(
        *prices("Hertz: pressure, L2", cells=None, elements=None),
        *prices("Hertz: radius", cells=9.0, elements=None),
        *prices("Hertz: approach", cells=2.0, sampled=3.0),
    )
    (answer,) = [a for a in answers(report_of((), (record,))) if "cost" in a.question]
    assert answer.table is not None
    assert answer.table.columns == ("quantity", "cells", "elements", "sampled")
    assert answer.table.rows == (
        ("Hertz: pressure, L2", "–", "–", ""),
        ("Hertz: radius", "9 s", "–", ""),
        ("Hertz: approach", "2 s", "", "3 s"),
    )
    # The chart is of the quantity that most methods get there.
    assert answer.chart is not None
    assert answer.chart.name == "chart of Hertz: approach"


def test_a_study_without_prices_has_no_table_of_them() -> None:
    conclusion = study("work-precision").conclusion
    assert price_table(conclusion, "") is None
    assert telling_chart(conclusion) == conclusion.charts[0]


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


def test_the_places_where_solvers_are_furthest_apart_come_first() -> None:
    near = case("hertz_point", {"approach": (1e-6, 1e-6), "radius": (2.1e-6, 2e-6)},
                run_record(64, None))  # fmt: skip
    far = case("fem_hertz", {"approach": (1.001e-6, 1e-6), "radius": (1.9e-6, 2e-6)},
               run_record(None, 32))  # fmt: skip
    report = report_of((near, far))
    table = furthest_apart(shared_references(report))
    assert table.title in render_page(report)
    assert [row[0] for row in table.rows] == [
        "radius, hertz point",
        "approach, hertz point",
    ]
    assert table.rows[0][1:4] == ("10 %", "5 %", "5 %")


def test_a_solver_against_itself_is_no_comparison_of_solvers() -> None:
    one = case("cross_check", {"difference": (1.001, 1.0), "own_error": (1.009, 1.0)},
               run_record(64, None))  # fmt: skip
    kinds = (ReferenceKind.OTHER_SOLVER, ReferenceKind.OWN_REFINEMENT)
    verdicts = tuple(
        v.model_copy(update={"reference_kind": kind})
        for v, kind in zip(one.verdicts, kinds, strict=True)
    )
    report = report_of((one.model_copy(update={"verdicts": verdicts}),))
    text = " ".join(answers(report)[2].sentences)
    assert "Compared with each other in 1 numbers" in text
    assert "(10 % of it)" in text


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
    plan, cost, stable, stated = features(report)
    assert "2.5 to 2.5 times the convolutions" in plan.figures
    assert cost.status is None
    assert "slipstick maintain study work-precision" in cost.figures
    assert stable.status is Status.FAIL
    header = render_page(report).split("</header>")[0]
    for feature in (plan, cost, stable, stated):
        assert f'<a href="{feature.address}">{feature.promise}</a>' in header
        assert feature.figures in header


def test_a_promise_is_told_in_a_line_also_by_a_study_without_an_answer() -> None:
    record = study("stability")
    claims = tuple(
        Statement(claim=f"claim {n}", outcome=outcome, measured="words " * 40)
        for n, outcome in enumerate((Status.PASS, Status.PASS, Status.FAIL, None))
    )
    conclusion = record.conclusion.model_copy(update={"statements": claims})
    told = record.model_copy(update={"conclusion": conclusion})
    (*_, stable, _) = features(report_of((), (told,)))
    assert stable.figures == "2 of its 3 judged claims hold (level quick)"


@pytest.mark.parametrize("number", [0, 1, 2])
def test_headline_names_studies_that_are_inconclusive(number: int) -> None:
    claim = Statement(claim="c", outcome=Status.INCONCLUSIVE, measured="m")
    names = ("stability", "mutants", "coated-tractions")[: number + 1]
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


def test_observed_orders_stand_in_one_table_with_expectation_and_reason() -> None:
    rate = verdict("order_of_pressure", 1.02, 1.0).model_copy(update={
        "tolerance_kind": "order", "interval": 0.13, "source": "the square-root edge",
        "order": OrderRecord(
            of="pressure", solver=Solver.CELLS, refined="mesh", sizes=(), errors=()
        ),
    })  # fmt: skip
    one = case("one", {"approach": (1e-6, 1e-6)}, run_record(64, None))
    page = render_page(report_of((one.model_copy(update={"verdicts": (rate,)}),)))
    table = page[page.index("Orders of convergence, with") :].split("</table>")[0]
    (row,) = re.findall(r"<tr><th scope=\"row\">.*</tr>", table)
    cells = [re.sub(r"<[^>]*>", "", cell) for cell in re.findall(r"<t[hd].*?</t[hd]>", row)]
    assert cells[:5] == ["pressurewhat it is", "semi-analytical", "mesh", "1.02 ± 0.13", "1"]
    assert cells[6:] == ["the square-root edge", "one"]
    gaps = page[page.index("whose order is not judged here") :].split("</table>")[0]
    assert gaps.count("<tr>") > 2  # one order alone leaves others open


def test_a_quick_page_stays_small_and_says_what_it_leaves_out() -> None:
    charts = tuple(chart(f"map_{n}", f"View {n}") for n in range(14))
    cells = Table(title="Cells", columns=("cell", "residual"), rows=(("a", "1e-9"),) * 300)
    large = study("seeded-defects")
    conclusion = large.conclusion.model_copy(update={"charts": charts, "tables": (cells,)})
    report = report_of((), (large.model_copy(update={"conclusion": conclusion}),))
    quick = render_page(report)
    shown = extent("quick").charts
    assert quick.count("<svg") == shown < 14
    assert f"{14 - shown} more diagrams" in quick
    assert "View 12; View 13" in quick
    assert "Cells: 300 rows" in quick
    full = render_page(report.model_copy(update={"level": "full"}))
    assert full.count("<svg") == extent("full").charts
    assert full.count("1e-9") == 300
    assert 'href="study-seeded-defects.html"' in full


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
