"""Tests of the verification report: self-contained, without scripts, and reproducible."""

import json
import os
import re
from collections.abc import Callable
from html.parser import HTMLParser
from pathlib import Path

import jsonschema
import pytest
from report_examples import case, report_of, run_record, study, verdict

from verification.cases.indenters import hertz_point
from verification.cases.partial_slip import cattaneo_mindlin
from verification.judging.judgement import judge
from verification.judging.outcome import (
    CaseOutcome,
    Status,
    failure_text,
)
from verification.report.file_names import JUNIT, PAGE, RECORD, SHEETS, SUMMARY
from verification.report.files import write_report
from verification.report.page import render_page, render_sheets
from verification.report.summary_text import OMISSIONS
from verification.running.provenance import provenance
from verification.running.report_record import (
    Report,
    count,
    load_report,
    report_schema,
)

VOID = {"meta", "br", "link", "img", "hr"}
PAYLOADS = (
    "<script>act()</script>",
    "</title></style></desc></svg><script>act()</script>",
    "\"'><img src=x onerror=act()>",
    "\" onmouseover=act() x=' onfocus=act() y=",
    "-->]]><base href=http://example.invalid/>",
    "{{ cycler.__init__ }}{% set x %}",
)


def made_by(*outcomes: CaseOutcome) -> Report:
    return Report(
        level="quick",
        counts=count(outcomes),
        cases=outcomes,
        omissions=OMISSIONS,
        provenance=provenance("slipstick verify --level quick", {"hertz_point": 0.1}),
    )


@pytest.fixture(scope="module")
def report() -> Report:
    hertz = judge(hertz_point(cells=(16, 20, 24, 32)))
    return made_by(hertz, judge(cattaneo_mindlin(cells=(24, 28, 32))))


RENDERED = {PAGE: render_page, SHEETS: render_sheets}


@pytest.fixture(scope="module")
def pages(report: Report) -> dict[str, str]:
    return {name: render(report) for name, render in RENDERED.items()}


@pytest.fixture(scope="module", params=RENDERED)
def page(pages: dict[str, str], request: pytest.FixtureRequest) -> str:
    return pages[request.param]


class Outline(HTMLParser):
    """Tags in order, ids, links within the page, and whether every tag is closed."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.open: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


def test_page_is_well_formed_and_its_names_are_unique(page: str) -> None:
    outline = Outline(page)
    assert outline.open == []
    ids = [attributes["id"] for _, attributes in outline.tags if "id" in attributes]
    assert len(set(ids)) == len(ids)
    for _, attributes in outline.tags:
        link = attributes.get("href") or attributes.get("xlink:href") or ""
        if link.startswith("#"):
            assert link[1:] in ids
    for name in re.findall(r"url\(#([^)]*)\)", page):
        assert name in ids


def test_pages_lead_to_parts_of_each_other_that_there_are(pages: dict[str, str]) -> None:
    ids = {
        name: {attributes.get("id") for _, attributes in Outline(text).tags}
        for name, text in pages.items()
    }
    links = [
        (attributes.get("href") or "").partition("#")
        for text in pages.values()
        for _, attributes in Outline(text).tags
    ]
    across = [(name, part) for name, _, part in links if name]
    assert {name for name, _ in across} == {*RENDERED}
    assert all(not part or part in ids[name] for name, part in across)


def test_page_needs_no_network_and_no_script(page: str) -> None:
    outline = Outline(page)
    assert "script" not in {tag for tag, _ in outline.tags}
    for _, attributes in outline.tags:
        assert not [name for name in attributes if name.startswith("on")]
        for name in ("src", "href", "xlink:href"):
            assert (attributes.get(name) or "#").partition("#")[0] in ("", *RENDERED)
    assert "default-src 'none'" in page
    assert "@import" not in page


def test_figures_have_names_and_take_the_colours_of_the_page(
    pages: dict[str, str], report: Report
) -> None:
    page = pages[SHEETS]
    figures = [attributes for tag, attributes in Outline(page).tags if tag == "svg"]
    drawn = sum(len(case.charts) for case in report.cases)
    assert len(figures) == drawn
    assert all(figure.get("role") == "img" for figure in figures)
    assert page.count("<title id=") == drawn
    assert "var(--series-1)" in page
    assert "#0072b2" not in page[page.index("<body ") :].lower()


def test_record_fulfils_its_schema_and_can_be_rendered_again(
    report: Report, pages: dict[str, str], tmp_path: Path
) -> None:
    write_report(report, tmp_path)
    assert sorted(os.listdir(tmp_path)) == sorted([PAGE, SHEETS, RECORD, JUNIT, SUMMARY])
    record = json.loads((tmp_path / RECORD).read_text(encoding="utf-8"))
    jsonschema.validate(record, report_schema())
    assert set(record["counts"]) == {"pass", "fail", "inconclusive"}
    again = load_report(tmp_path / RECORD)
    assert {name: render(again) for name, render in RENDERED.items()} == pages


@pytest.mark.parametrize("render", RENDERED.values(), ids=RENDERED)
@pytest.mark.parametrize("payload", PAYLOADS)
def test_text_from_a_record_cannot_become_markup(
    payload: str, render: Callable[[Report], str]
) -> None:
    """Pages have the same tags and attributes whatever the texts of their records are."""

    def tags(text: str) -> list[tuple[str, list[str]]]:
        one = case("one", {text: (1e-6, 1e-6)}, run_record(64, None), text)
        studies = (study("stability", text, "full", text),)
        found = Outline(render(report_of((one,), studies)))
        assert found.open == []
        return [(tag, sorted(attributes)) for tag, attributes in found.tags]

    assert tags(payload) == tags("plain text")


@pytest.mark.parametrize(
    ("value", "reference", "allowed", "unit", "text"),
    [
        (3.16838e9, 3.1e9, 4.8e5, "Pa", "3.16838 GPa, expected 3.10000 GPa ± 0.00048 GPa"),
        (8.4e-6, 9e-6, 3e-8, "m", "8.40000 µm, expected 9.00000 µm ± 0.03 µm"),
        (2e-6, 0.0, 3e-9, "m", "2.00000 µm, expected 0 ± 0.003 µm"),
        (1.5, 2.0, 0.1, "", "1.5, expected 2 ± 0.1"),
    ],
)
def test_what_is_allowed_stands_in_the_unit_of_the_value(
    value: float, reference: float, allowed: float, unit: str, text: str
) -> None:
    error = abs(value - reference)
    failed = verdict("one", 9.0, 1.0).model_copy(
        update={
            "value": value,
            "reference": reference,
            "unit": unit,
            "allowed": allowed,
            "scale": 1.0,
            "error": error,
            "status": Status.FAIL,
            "meaning": "energy, increment 3: work 2 J",
        }
    )
    assert failure_text(failed) == f"{text} ({error / allowed:.2g} U), increment 3: work 2 J"
