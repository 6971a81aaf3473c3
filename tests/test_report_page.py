"""Tests of the report page: cases by physics, claims, units and size."""

import ast
from pathlib import Path
from types import SimpleNamespace

from report_examples import (
    case,
    chart,
    report_of,
    run_record,
    study,
    verdict,
)

from verification.exhibits.chart import Table
from verification.judging.outcome import (
    CaseOutcome,
    Status,
    Verdict,
    error_text,
)
from verification.report import validity
from verification.report.file_names import SHEETS
from verification.report.page import MAX_CHARTS, cases_by_physics, render_page, render_sheets
from verification.report.summary_text import OUTSIDE, claims_line, features, power_text

ROOT = Path(__file__).resolve().parents[1]


def judged(*verdicts: Verdict, name: str = "one") -> CaseOutcome:
    one = case(name, {}, run_record(64, None), drawn=False)
    return one.model_copy(update={"verdicts": verdicts})


SHOWN = ("tilted_punch", "cone_contact", "hertz_point", "radial_torsion", "torsion", "unlisted")


def test_cases_stand_below_their_physics_with_the_largest_share_of_a_tolerance_first():
    """The last case has a run without a result, whose verdict has no error to compare."""
    names = {"hertz_point": 1.001, "torsion": 1.003, "cone_contact": 1.009, "radial_torsion": 1.004}
    lost = verdict("solved", 1.0, 1.0).model_copy(
        update={"value": None, "error": None, "status": Status.FAIL}
    )
    cases = [judged(verdict("radius", value, 1.0), name=name) for name, value in names.items()]
    cases += [judged(lost, name="tilted_punch"), judged(verdict("x", 1.0, 1.0), name="unlisted")]
    groups = cases_by_physics(cases)
    assert {title: [one.name for one in group] for title, group in groups.items()} == {
        "indenters": ["tilted_punch", "cone_contact", "hertz_point"],
        "torsion": ["radial_torsion", "torsion"],
        "unlisted": ["unlisted"],
    }
    page = render_page(report_of(tuple(cases)))
    places = [page.index(f"{SHEETS}#{name}", page.index('id="cases"')) for name in SHOWN]
    assert places == sorted(places)


def test_errors_below_round_off_are_no_numbers_and_count_nowhere():
    """Errors are relative to the scale of their verdict, here 1e9 and 1e-9."""
    found = [verdict("p", s * (1 + e), s) for s in (1e9, 1e-9) for e in (1e-6, 5e-13)]
    assert [error_text(one) for one in found] == ["1e-6", "< 1e-12"] * 2
    assert power_text(report_of((judged(*found),))).startswith("Of 2 numbers with a reference")
    assert render_sheets(report_of((judged(*found),))).count("&lt; 1e-12") == 2


def test_a_claim_that_is_inconclusive_does_not_hold():
    outcomes = (Status.PASS, Status.FAIL, Status.INCONCLUSIVE, None)
    stated = [SimpleNamespace(outcome=outcome) for outcome in outcomes]
    record = SimpleNamespace(level="full", conclusion=SimpleNamespace(statements=stated))
    assert claims_line(record) == "1 of its 3 judged claims hold (level full)"


def test_every_table_that_is_made_says_the_units_of_its_numbers():
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


def test_promises_have_figures_or_the_command_that_finds_them():
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


def test_a_quick_page_stays_small():
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


def test_round_off_does_not_choose_between_equal_errors_of_the_validity_table():
    case = None
    verdicts = [
        SimpleNamespace(reference_kind=min(OUTSIDE), error=error)
        for error in (0.012, 0.012 + 1e-15)
    ]
    first, second = (validity.Tested(1.0, case, verdict).error_rank for verdict in verdicts)
    assert first == second
