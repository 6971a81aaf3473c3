"""What the page finds out hangs on fields: labels, titles and claims are for people alone."""

import json
from collections.abc import Callable
from functools import cache
from itertools import count
from pathlib import Path
from typing import Any

import pytest

from verification.judging.outcome import IMBALANCE, RESIDUAL, SOLVED, VIOLATION, Verdict
from verification.report.answers import answers
from verification.report.both_solvers import (
    Measured,
    both_solvers_charts,
    furthest_apart,
    shared_references,
)
from verification.report.features import FORCED, features
from verification.report.order_table import not_judged
from verification.report.orders import observed_orders
from verification.report.page import PAPER_CASE
from verification.report.profiles_together import profiles_together
from verification.running.report_record import Report, dump_report, load_report

KEPT = Path(__file__).resolve().parents[1] / "reports/full/report.json.xz"
TEXTS = {
    *("title", "question", "caption", "label", "x_label", "y_label", "meaning", "problem"),
    *("source", "because", "claim", "measured", "answer", "note", "scale_name", "remark", "why"),
    *("material", "substrate", "friction"),
}
# Names that are known by themselves: of cases with a place of their own, and of every case's laws.
NAMES = {FORCED, PAPER_CASE, SOLVED, RESIDUAL, VIOLATION, IMBALANCE}


def other_words() -> Callable[[str], str]:
    """Another text for every text, made of letters alone; equal ones stay equal."""
    known: dict[str, str] = {"": ""}
    number = count()

    def other(text: str) -> str:
        if text not in known:
            known[text] = "".join("abcdefghij"[int(digit)] for digit in f"{next(number):05d}")
        return known[text]

    return other


def reworded(document: Any, other: Callable[[str], str]) -> Any:
    """A report as JSON with every text for people replaced, but for labels of runs."""
    if isinstance(document, list):
        return [reworded(one, other) for one in document]
    if not isinstance(document, dict):
        return document
    texts = TEXTS - {"label"} if "convolutions" in document else TEXTS
    return {
        key: other(value) if key in texts and isinstance(value, str) else reworded(value, other)
        for key, value in document.items()
    }


def renamed(case: dict[str, Any], number: int) -> dict[str, Any]:
    """A case with another name, its runs called r1, r2 … from the last to the first, and its
    verdicts v1, v2 …"""
    labels = [run["label"] for run in case["runs"]]
    new = {label: f"r{len(labels) - n}" for n, label in enumerate(labels)}
    runs = [run | {"label": new[run["label"]], "planned": new.get(run["planned"])}
            for run in case["runs"]]  # fmt: skip
    verdicts = [
        verdict | {
            "name": verdict["name"] if verdict["name"] in NAMES else f"v{n}",
            "run": " or ".join(new[label] for label in verdict["runs"]) or f"where {n}",
            "runs": [new[label] for label in verdict["runs"]],
        }
        for n, verdict in enumerate(case["verdicts"])
    ]  # fmt: skip
    name = case["name"] if case["name"] in NAMES else f"c{number}"
    return case | {"name": name, "runs": runs, "verdicts": verdicts}


@cache
def kept() -> Report:
    return load_report(KEPT)


@cache
def in_other_words() -> Report:
    """The kept report, where nothing but numbers, fields and names of charts is as it was."""
    document = json.loads(dump_report(kept()))
    document["cases"] = [renamed(case, n) for n, case in enumerate(document["cases"])]
    other = other_words()
    words = reworded(document, other)
    for study in [*words["studies"], *words["cases"]]:
        for table in [*study.get("conclusion", study)["tables"]]:
            table["columns"] = [other(column) for column in table["columns"]]
            table["rows"] = [[other(cell) for cell in row] for row in table["rows"]]
    return Report.model_validate_json(json.dumps(words))


def place(report: Report, measured: Measured) -> tuple[int, int, int]:
    """Case, run and verdict of a measurement, by their numbers."""
    (number,) = (n for n, case in enumerate(report.cases) if case.name == measured.case)
    case = report.cases[number]
    return number, case.runs.index(measured.run), case.verdicts.index(measured.verdict)


def promised(report: Report) -> object:
    planned, *others = features(report)
    return planned, [(one.promise, one.status, one.anchor) for one in others]


def paired(report: Report) -> object:
    shared = shared_references(report)
    assert len(shared) > 50
    return [(place(report, pair.cells), place(report, pair.elements)) for pair in shared]


def drawn(report: Report) -> object:
    together = profiles_together(report)
    assert len(together) == 3
    charts = (*together, *both_solvers_charts(shared_references(report)))
    return [
        (chart.name, [[one.model_copy(update={"label": ""}) for one in panel.curves]
                      for row in chart.rows for panel in row])
        for chart in charts
    ]  # fmt: skip


def ordered(report: Report) -> object:
    def number(verdict: Verdict) -> tuple[object, ...]:
        assert verdict.order is not None
        read_off = verdict.order.model_copy(update={"meaning": ""})
        return verdict.value, verdict.reference, read_off

    found = observed_orders(report)
    assert len(found) > 30
    same = [number(one.verdict) for one in found]
    return sorted(map(str, same)), [one.of for one in not_judged(report.cases)]


def answered(report: Report) -> object:
    def numbers(table: Any) -> object:
        return None if table is None else [row[1:] for row in table.rows]

    told = answers(report)
    assert all(answer.sentences or answer.missing for answer in told)
    return [
        (len(one.sentences), one.links and [anchor for anchor, _ in one.links],
         one.chart and one.chart.name, numbers(one.table))
        for one in told
    ], numbers(furthest_apart(shared_references(report)))  # fmt: skip


@pytest.mark.parametrize(
    "found", [promised, paired, drawn, ordered, answered],
    ids=lambda found: found.__name__,
)  # fmt: skip
def test_other_words_change_nothing_but_words(found: Callable[[Report], object]) -> None:
    assert found(in_other_words()) == found(kept())
