"""Tests of the report pages: the first page with its judgement, and the page with the cases."""

import lzma
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from report_examples import case, report_of, run_record, verdict

from verification.judging.outcome import (
    CaseOutcome,
    Status,
    Verdict,
    error_text,
)
from verification.report.file_names import PACKED, PAGE, RECORD, SHEETS
from verification.report.files import EARLIER, draw_again, record_in, set_aside_report, write_report
from verification.report.page import cases_by_physics, render_page, render_sheets
from verification.report.summary_text import claims_line, power_text
from verification.running.report_record import dump_report, load_report


def judged(*verdicts: Verdict, name: str = "one") -> CaseOutcome:
    one = case(name, {}, run_record(64, None), drawn=False)
    return one.model_copy(update={"verdicts": verdicts})


def test_cases_stand_below_their_physics_with_the_largest_share_of_a_tolerance_first() -> None:
    """The last case has a run without a result, whose verdict has no error to compare."""
    names = {"hertz_point": 1.001, "torsion": 1.003, "cone_contact": 1.009, "radial_torsion": 1.004}
    lost = verdict("solved", 1.0, 1.0).model_copy(
        update={"value": None, "error": None, "status": Status.FAIL}
    )
    cases = [judged(verdict("radius", value, 1.0), name=name) for name, value in names.items()]
    cases += [judged(lost, name="flat_punch"), judged(verdict("x", 1.0, 1.0), name="unlisted")]
    groups = cases_by_physics(cases)
    assert {title: [one.name for one in group] for title, group in groups.items()} == {
        "indenters": ["flat_punch", "cone_contact", "hertz_point"],
        "torsion": ["radial_torsion", "torsion"],
        "unlisted": ["unlisted"],
    }
    page = render_page(report_of(tuple(cases)))
    places = [page.index(f"{SHEETS}#{name}", page.index('id="cases"')) for name in SHOWN]
    assert places == sorted(places)


SHOWN = ("flat_punch", "cone_contact", "hertz_point", "radial_torsion", "torsion", "unlisted")


def test_the_front_names_stated_errors_that_do_not_cover() -> None:
    def stated(name: str, error: float) -> Verdict:
        covered = error >= 0.001
        return verdict(name, 1.001, 1.0).model_copy(
            update={"stated_error": error, "covered": covered}
        )

    small, large = stated("radius", 1e-4), stated("approach", 2e-3)
    header = render_page(report_of((judged(small, large),))).split("</header>")[0]
    assert "Stated errors that do not cover" in header
    assert f'<a href="{SHEETS}#one">one/radius [run]</a>: 1.00' in header
    assert "one/approach" not in header
    assert "do not cover" not in render_page(report_of((judged(large),)))


def test_errors_below_round_off_are_no_numbers_and_count_nowhere() -> None:
    """Errors are relative to the scale of their verdict, here 1e9 and 1e-9."""
    found = [verdict("p", s * (1 + e), s) for s in (1e9, 1e-9) for e in (1e-6, 5e-13)]
    assert [error_text(one) for one in found] == ["1e-6", "< 1e-12"] * 2
    assert power_text(report_of((judged(*found),))).startswith("Of 2 numbers with a reference")
    assert render_sheets(report_of((judged(*found),))).count("&lt; 1e-12") == 2


def test_a_claim_that_is_inconclusive_does_not_hold() -> None:
    outcomes = (Status.PASS, Status.FAIL, Status.INCONCLUSIVE, None)
    stated = [SimpleNamespace(outcome=outcome) for outcome in outcomes]
    record: Any = SimpleNamespace(level="full", conclusion=SimpleNamespace(statements=stated))
    assert claims_line(record) == "1 of its 3 judged claims hold (level full)"


def test_a_packed_record_is_read_drawn_from_and_left_as_it_is(tmp_path: Path) -> None:
    report = report_of((judged(verdict("radius", 1.001, 1.0)),))
    packed = tmp_path / PACKED
    packed.write_bytes(lzma.compress(dump_report(report).encode()))
    before = packed.read_bytes()
    assert record_in(tmp_path) == packed
    assert load_report(packed) == report
    draw_again(report, tmp_path)
    assert (tmp_path / PAGE).is_file()
    assert packed.read_bytes() == before
    assert not (tmp_path / RECORD).exists()
    write_report(report, tmp_path)  # a new record replaces it
    assert record_in(tmp_path) == tmp_path / RECORD
    assert not packed.exists()


def test_a_packed_record_is_set_aside_like_any_other(tmp_path: Path) -> None:
    (tmp_path / PACKED).write_bytes(b"kept")
    set_aside_report(tmp_path)
    assert not (tmp_path / PACKED).exists()
    assert (tmp_path / EARLIER / PACKED).read_bytes() == b"kept"


def test_a_packed_record_that_is_damaged_or_too_large_is_refused_in_words(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    packed = tmp_path / PACKED
    whole = lzma.compress(b" " * 5000)
    for content in (b"no xz", whole[:-20]):
        packed.write_bytes(content)
        with pytest.raises(ValueError, match="cannot be unpacked"):
            load_report(packed)
    packed.write_bytes(whole)
    monkeypatch.setattr("verification.running.report_record.LARGEST_RECORD", 4999)
    with pytest.raises(ValueError, match="larger than any report"):
        load_report(packed)
