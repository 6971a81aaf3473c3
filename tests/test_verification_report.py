"""Tests of the verification report: self-contained, without scripts, and reproducible."""

import json
import os
import re
from html.parser import HTMLParser

import jsonschema
import pytest
from report_examples import case, report_of, run_record, study

from verification.cases.indenters import hertz_point
from verification.cases.partial_slip import cattaneo_mindlin
from verification.judging.judgement import judge
from verification.report.file_names import JUNIT, PAGE, RECORD, SHEETS, SUMMARY
from verification.report.files import write_report
from verification.report.page import render_page, render_sheets
from verification.running.provenance import provenance
from verification.running.report_record import load_report, report_schema

VOID = {"meta", "br", "link", "img", "hr"}
PAYLOADS = (
    "<script>act()</script>",
    "</title></style></desc></svg><script>act()</script>",
    "\"'><img src=x onerror=act()>",
    "\" onmouseover=act() x=' onfocus=act() y=",
    "-->]]><base href=http://example.invalid/>",
    "{{ cycler.__init__ }}{% set x %}",
)


@pytest.fixture(scope="module")
def report():
    hertz = judge(hertz_point(cells=(16, 20, 24, 32)))
    report = report_of((hertz, judge(cattaneo_mindlin(cells=(24, 28, 32)))))
    made = provenance("slipstick verify --level quick", {"hertz_point": 0.1})
    return report.model_copy(update={"provenance": made})


RENDERED = {PAGE: render_page, SHEETS: render_sheets}


@pytest.fixture(scope="module")
def pages(report):
    return {name: render(report) for name, render in RENDERED.items()}


@pytest.fixture(scope="module", params=RENDERED)
def page(pages, request):
    return pages[request.param]


class Outline(HTMLParser):
    """Tags in order, ids, links within the page, and whether every tag is closed."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags = []
        self.open = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


def test_names_are_unique_and_links_lead_to_parts_of_the_report(pages):
    """Within a page and to the other one: nothing is read from the network."""
    outlines = {name: Outline(text) for name, text in pages.items()}
    ids = {
        name: [attributes["id"] for _, attributes in outline.tags if "id" in attributes]
        for name, outline in outlines.items()
    }
    across = set()
    for name, outline in outlines.items():
        assert outline.open == []
        assert len(set(ids[name])) == len(ids[name])
        links = [
            attributes.get(kind) or ""
            for _, attributes in outline.tags
            for kind in ("src", "href", "xlink:href")
        ]
        for link in links + [f"#{part}" for part in re.findall(r"url\(#([^)]*)\)", pages[name])]:
            page, _, part = link.partition("#")
            assert not part or part in ids[page or name]
            across.add(page)
    assert across == {"", *RENDERED}


def test_page_has_no_script(page):
    outline = Outline(page)
    assert "script" not in {tag for tag, _ in outline.tags}
    for _, attributes in outline.tags:
        assert not [name for name in attributes if name.startswith("on")]
    assert "default-src 'none'" in page
    assert "@import" not in page


def test_figures_have_names_and_take_the_colours_of_the_page(pages, report):
    page = pages[SHEETS]
    figures = [attributes for tag, attributes in Outline(page).tags if tag == "svg"]
    drawn = sum(len(case.charts) for case in report.cases)
    assert len(figures) == drawn
    assert all(figure.get("role") == "img" for figure in figures)
    assert page.count("<title id=") == drawn
    assert "var(--series-1)" in page
    assert "#0072b2" not in page[page.index("<body ") :].lower()


def test_record_fulfils_its_schema_and_can_be_rendered_again(report, pages, tmp_path):
    write_report(report, tmp_path)
    assert sorted(os.listdir(tmp_path)) == sorted([PAGE, SHEETS, RECORD, JUNIT, SUMMARY])
    record = json.loads((tmp_path / RECORD).read_text(encoding="utf-8"))
    jsonschema.validate(record, report_schema())
    assert set(record["counts"]) == {"pass", "fail", "inconclusive"}
    again = load_report(tmp_path / RECORD)
    assert {name: render(again) for name, render in RENDERED.items()} == pages


@pytest.mark.parametrize("render", RENDERED.values(), ids=RENDERED)
@pytest.mark.parametrize("payload", PAYLOADS)
def test_text_from_a_record_cannot_become_markup(payload, render):
    """Pages have the same tags and attributes whatever the texts of their records are."""

    def tags(text):
        one = case("one", {text: (1e-6, 1e-6)}, run_record(64, None), text)
        studies = (study("stability", text, "full", text),)
        found = Outline(render(report_of((one,), studies)))
        assert found.open == []
        return [(tag, sorted(attributes)) for tag, attributes in found.tags]

    assert tags(payload) == tags("plain text")
