"""The two layers of the page: a front that judges, and sheets behind it that say what they show."""

import lzma
import re
from pathlib import Path

import pytest
from report_examples import case, chart, report_of, run_record, study, verdict

from verification.exhibits.chart import Chart, Look, Panel, curve
from verification.exhibits.picture import Picture
from verification.judging.change import Change, ChangeKind, Origin
from verification.judging.outcome import (
    RESIDUAL,
    CaseOutcome,
    OrderRecord,
    RefinedErrors,
    Verdict,
)
from verification.report.changes import moved_rows, worse_rows
from verification.report.closing import closing_sentences, line_of
from verification.report.files import (
    APPENDICES,
    EARLIER,
    PACKED,
    PAGE,
    RECORD,
    SHEETS,
    draw_again,
    record_in,
    set_aside_report,
    write_report,
)
from verification.report.front import LOOP, front_charts
from verification.report.page import render_page, render_sheets
from verification.report.prices import amount, cost_sentence
from verification.report.stability_map import ENDS, VIEW, legend, stability_map
from verification.running.report_record import Report, dump_report, load_report
from verification.solver import Solver


def judged(*verdicts: Verdict, name: str = "one") -> CaseOutcome:
    one = case(name, {}, run_record(64, None), drawn=False)
    return one.model_copy(update={"verdicts": verdicts})


def test_every_sheet_and_study_is_folded_under_one_line_and_its_anchor_is_inside() -> None:
    report = report_of(
        tuple(
            case(name, {"approach": (1e-6, 1e-6)}, run_record(64, None))
            for name in ("hertz_point", "cone_contact")
        ),
        (study("stability", level="full"),),
    )
    front, sheets = render_page(report), render_sheets(report)
    for page, name in (
        (sheets, "hertz_point"), (front, "study-stability"), (front, "study-mutants")
    ):  # fmt: skip
        before, _, _ = page.partition(f'<article id="{name}">')
        line = before[before.rindex("<details") :]
        assert line.startswith('<details class="sheet">\n<summary>')  # shut
        assert "</details>" not in line
    assert f'href="{SHEETS}#hertz_point"' in front
    assert not re.search(r"<details [^>]*open", front)
    alone = render_sheets(report.model_copy(update={"cases": report.cases[:1]}))
    assert '<details class="sheet" open>\n<summary>' in alone


def test_a_picture_is_an_image_and_no_part_of_the_page() -> None:
    script = "<svg onload='x()'><script>x()</script><image href='http://example.invalid'/></svg>"
    for svg in (script, f"<!DOCTYPE x>{script}", '"><script>x()</script>'):
        picture = Picture(name="p", title="t", caption='c"><b>', svg=svg)
        page = render_page(report_of(()).model_copy(update={"pictures": (picture,)}))
        (image,) = re.findall(r"<img [^>]*>", page)
        assert re.fullmatch(r'<img src="data:[^"<>]*" alt="[^"<>]*">', image)
        assert "<script" not in page
        assert "onload" not in page.replace(image, "")


def test_a_line_names_the_quantity_nearest_to_its_limit() -> None:
    near, far = verdict("radius", 1.009, 1.0), verdict("approach", 1.001, 1.0)
    solved = verdict(RESIDUAL, 1.0099, 1.0)  # how well it was solved tells nobody what is right
    assert line_of(judged(far, near, solved)) == "3 verdicts; radius uses 90 % of what is allowed"
    wrong = verdict("energy", 1.02, 1.0)
    assert line_of(judged(near, wrong)).startswith("1 of 2 verdicts passed; energy uses 200 %")


def test_closing_sentences_say_what_the_numbers_say() -> None:
    near = verdict("radius", 1.009, 1.0)
    first, second = closing_sentences(judged(near, verdict("approach", 1.001, 1.0)))
    assert first.startswith("All its 2 judged numbers are within what is allowed")
    assert "off by 0.9 % of the reference, 90 % of what is allowed" in first
    assert second == "Its solve took 18 convolutions, with a residual of 1e-9 at most."
    wrong = verdict("energy", 1.02, 1.0)
    first, _ = closing_sentences(judged(near, wrong))
    assert first.startswith("1 of its 2 numbers are not within what is allowed")
    assert "off by 2 % of the reference, 200 % of what is allowed" in first


def test_closing_sentences_tell_what_refining_did_where_it_did_something() -> None:
    fine = verdict("radius", 1.001, 1.0)
    followed = RefinedErrors(per_radius=(8.0, 64.0), errors=(0.05, 0.001))
    (_, told) = closing_sentences(judged(fine.model_copy(update={"refined": followed})))
    assert told.startswith("From 8 to 64 cells per contact radius")
    assert told.endswith("falls from 5 % to 0.1 %.")
    worse = RefinedErrors(per_radius=(8.0, 64.0), errors=(0.001, 0.05))
    (_, told) = closing_sentences(judged(fine.model_copy(update={"refined": worse})))
    assert "falls" not in told
    rate = verdict("order_of_pressure", 1.002, 1.0).model_copy(update={
        "tolerance_kind": "order", "interval": 0.05,
        "order": OrderRecord(of="pressure", solver=Solver.CELLS, refined="mesh",
                             sizes=(1.0, 0.5, 0.25), errors=(0.4, 0.2, 0.1)),
    })  # fmt: skip
    (_, told) = closing_sentences(judged(rate))
    assert told.startswith("Over 3 levels of the mesh the error of pressure falls with order 1.00")


def test_the_front_shows_what_is_worse_and_the_table_only_what_moved() -> None:
    def compared(name: str, kind: ChangeKind) -> Verdict:
        was = Change(kind=kind, recorded=kind is not ChangeKind.NEW, was=1.0, moved=0.2, since="x")
        return verdict(name, 1.001, 1.0).model_copy(update={"regression": was})

    kinds = {"dear": ChangeKind.WORSE, "moved": ChangeKind.DRIFT, "fresh": ChangeKind.NEW,
             "still": ChangeKind.UNCHANGED}  # fmt: skip
    one = judged(*(compared(name, kind) for name, kind in kinds.items()))
    origin = Origin(commit="1a2b3c4", changed=False, date="2000-01-01", reason="first")
    report = report_of((one.model_copy(update={"baseline": origin}),))
    assert [row.name for row in moved_rows(report)] == ["dear", "moved"]
    assert [row.name for row in worse_rows(report)] == ["dear"]
    header = render_page(report).split("</header>")[0]
    assert "worse than the recorded numbers" in header
    assert f'<a href="{SHEETS}#one">one/dear</a>' in header
    assert "one/moved" not in header
    calm = render_page(report_of((judged(compared("still", ChangeKind.UNCHANGED)),)))
    assert "nothing is worse" in calm.split("</header>")[0]


def mapped(**ends: tuple[float, float]) -> Report:
    """A stability map of 2 by 2 places with efforts 10, 100, 100* and 12k, and these ends."""
    at = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)]
    notes = [(*place, text) for place, text in zip(at, ("10", "100", "100*", "12k"), strict=True)]
    series = {kind: number for number, kind in ENDS.items()}
    curves = tuple(
        curve("any word", [x], [y], Look.TILES, series[kind]) for kind, (x, y) in ends.items()
    )
    panel = Panel(x_label="E1/E2", y_label="h/a", curves=curves, notes=tuple(notes),
                  x_places=("1", "2"), y_places=("low", "high"))  # fmt: skip
    record = study("stability")
    drawn = Chart(name=VIEW, title="Map", caption="c", rows=((panel,),))
    conclusion = record.conclusion.model_copy(update={"charts": (drawn,)})
    return report_of((), (record.model_copy(update={"conclusion": conclusion}),))


def test_the_map_tells_how_much_dearer_than_usual_a_place_is_and_how_it_ended() -> None:
    found = stability_map(mapped(refused=(0.0, 0.0)))
    assert found is not None
    (high, top), (low, bottom) = found.rows
    assert (high, low) == ("high", "low")
    kinds = [[place and (place.kind, place.text) for place in row] for row in (top, bottom)]
    assert kinds == [
        [("effort-0", "1 ×"), ("effort-3", "1.2e2 ×")],
        [("refused", "refused"), ("effort-0", "1 ×")],
    ]
    assert {kind for kind, _ in legend()} >= {"effort-0", "effort-3", *ENDS.values()}
    page = render_page(mapped(refused=(0.0, 0.0)))
    style = page[: page.index("</style>")]
    for kind, meaning in legend():
        assert f".{kind.replace(' ', '-')} {{ background" in style
        assert meaning in page
    assert stability_map(report_of(())) is None


def test_the_front_shows_the_charts_that_there_are() -> None:
    loop = case("loop", {}, run_record(64, None)).model_copy(update={"charts": (chart(LOOP),)})
    cost = study("work-precision")
    report = report_of((loop,), (cost,))
    assert [one.name for one in front_charts(report)] == [LOOP, cost.conclusion.charts[0].name]
    assert front_charts(report_of(())) == ()


def test_a_study_without_prices_has_no_sentence_of_them() -> None:
    assert cost_sentence(study("work-precision")) == ""


@pytest.mark.parametrize(
    ("cost", "unit", "text"),
    [
        (138.2, "Mop", "138 million operations"),
        (5883.0, "Mop", "5.88 billion operations"),
        (0.1612, "s", "0.16 s"),
    ],
)
def test_a_cost_in_a_sentence_has_words_for_its_unit(cost: float, unit: str, text: str) -> None:
    assert amount(cost, unit) == text


@pytest.mark.parametrize("level", ["quick", "full"])
def test_studies_have_pages_beside_a_full_report_and_none_of_an_earlier_one_stays(
    level: str, tmp_path: Path
) -> None:
    report = report_of((), (study("stability"),)).model_copy(update={"level": level})
    (tmp_path / APPENDICES["mutants"]).write_text("of an earlier report")
    write_report(report, tmp_path)
    there = {path.name for path in tmp_path.iterdir()} & {*APPENDICES.values()}
    assert there == ({APPENDICES["stability"]} if level == "full" else set())


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
