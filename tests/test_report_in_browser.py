"""Tests of the report in Chromium: no error, no network request, no script from a record is run."""

from pathlib import Path

import pytest
from browser import ACT, PAYLOADS, RAN, chromium, opened
from report_examples import case, report_of, run_record, study

from verification.report.page import render_page, render_sheets
from verification.running.report_record import Report

pytestmark = pytest.mark.skipif(
    chromium() is None, reason="no Chromium here; on Debian: apt-get install chromium"
)


@pytest.fixture(scope="module")
def full() -> Report:
    """A report with both solvers, a failure and studies."""
    cells = case("hertz_point", {"approach": (1.001e-6, 1e-6)}, run_record(64, None))
    elements = case("fem_hertz", {"approach": (1.2e-6, 1e-6)}, run_record(None, 32))
    laws = case("frf_laws", {"law": (1e-6, 1e-6)}, run_record(8, None))
    return report_of(
        (cells, elements, laws),
        (study("coated-tractions", "No."), study("stability", level="full")),
    )


def test_page_opens_without_error_and_without_request(full: Report, tmp_path: Path) -> None:
    for render in (render_page, render_sheets):
        seen = opened(render(full), tmp_path)
        assert seen.console == []
        assert seen.requests == []
        assert seen.document.count("<article") == render(full).count("<article")
        assert seen.document.rstrip().endswith("</html>")


def test_page_forbids_scripts_and_so_works_without_them(full: Report, tmp_path: Path) -> None:
    page = render_page(full)
    assert "<script" not in page
    seen = opened(page.replace("</body>", f"<script>{ACT}</script></body>"), tmp_path)
    assert f"<title>{RAN}" not in seen.document
    assert any("Content Security Policy" in line for line in seen.console)


def test_nothing_in_a_record_is_run(tmp_path: Path) -> None:
    outcomes = tuple(
        case(f"case_{n}", {payload: (1e-6, 1e-6)}, run_record(64, None), payload, drawn=n % 4 == 0)
        for n, payload in enumerate(PAYLOADS)
    )
    assert len(PAYLOADS) >= 30
    studies = (study("coated-tractions", PAYLOADS[0], text=PAYLOADS[1]),)
    report = report_of(outcomes, studies)
    for render in (render_page, render_sheets):
        seen = opened(render(report), tmp_path)
        assert f"<title>{RAN}" not in seen.document
        assert seen.console == []
        assert seen.requests == []


def test_a_page_that_runs_or_asks_is_seen_to(tmp_path: Path) -> None:
    """The instruments of this file notice what they are to notice."""
    bad = f"<!DOCTYPE html><title>x</title><script>{ACT};console.error('seen')</script>"
    seen = opened(f"{bad}<img src='http://localhost:9/x.png'>", tmp_path)
    assert f"<title>{RAN}" in seen.document
    assert any("seen" in line for line in seen.console)
    assert any("localhost:9" in url for url in seen.requests)
