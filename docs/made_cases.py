"""Pages of the verification manual: one for each case, from its declaration and its baseline, and
the requirements with the cases that show them."""

import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from made_reference import table

import verification.baselines
from contact_scene.reading.engineering_units import quantity
from verification.cases.catalogue import CASES, case_of
from verification.cases.requirements import REQUIREMENTS
from verification.judging.case import Case, Derived, Level
from verification.report.summary_text import OMISSIONS

BASELINES = Path(verification.baselines.__file__).parent
LEVELS = ("full", "standard", "quick")


def pages() -> dict[str, str]:
    """Return the text of each page by its name; the page `index` lists the cases."""
    cases = [case_of(name, Level.QUICK) for name in CASES]
    accepted = {case.name: _accepted(case.name) for case in cases}
    return {"index": _index(cases)} | {c.name: page(c, *accepted[c.name]) for c in cases}


def requirements() -> str:
    """Return the tables of requirements with the cases that show them, and the list of gaps."""
    shown = {name: case_of(name, Level.QUICK).shows for name in CASES}
    parts = []
    for group, meanings in REQUIREMENTS.items():
        rows = [
            (key, meaning, ", ".join(f"`{name}`" for name, keys in shown.items() if key in keys))
            for key, meaning in meanings.items()
        ]
        parts += [f"## {group}\n", table(("requirement", "meaning", "cases"), rows)]
    return "\n".join((*parts, "## Gaps\n", *(f"- {_text(text)}" for text in OMISSIONS), ""))


def page(case: Case, level: str, numbers: Mapping[str, Any]) -> str:
    """Return the page of a case: problem, equations, verdicts with tolerances, accepted numbers.

    level, numbers  finest accepted level, and its content of the baseline; empty without a baseline
    """
    parts = [
        f"# {case.title}\n",
        f"{_text(case.problem)}\n",
        *(f"```{{math}}\n{equation}\n```\n" for equation in case.equations),
        f"    slipstick verify {case.name}   # quick; --level standard and full are finer\n",
        "## What is judged\n",
        table(("what", "reference", "allowed, because"), _rows(case)),
    ]
    if numbers:
        parts += ["## What came out\n", _measured(level, numbers)]
    if case.limits:
        parts += [
            "## What this case does not show\n",
            "".join(f"- {_text(x)}\n" for x in case.limits),
        ]
    return "\n".join(parts)


def _index(cases: list[Case]) -> str:
    rows = [(f"[{_cell(c.title)}]({c.name}.md)", f"`{c.name}`") for c in cases]
    names = "\n".join(case.name for case in cases)
    return (
        "# Verification manual\n\n"
        "One page per case: what is solved and why the answer is known, what is allowed and why, "
        "and the numbers that were accepted last. `slipstick verify` computes all of them and "
        "draws the report; a case that fails is shown as failing.\n\n"
        f"{table(('case', 'name'), rows)}\n```{{toctree}}\n:hidden:\n\n{names}\n```\n"
    )


def _rows(case: Case) -> Iterator[tuple[str, str, str]]:
    seen = set()
    for q in case.quantities:
        bound = q.tolerance
        derived = isinstance(bound, Derived)
        allowed = (
            f"twice the numerical uncertainty, at most {bound.cap:.2g}"
            if derived
            else f"{bound.allowed:.2g}"
        )
        row = (
            _cell(q.meaning),
            _cell(f"{q.reference.kind}: {q.reference.source}"),
            _cell(f"{allowed} of {q.scale_name}: {bound.because}"),
        )
        if row not in seen:
            seen.add(row)
            yield row
    for o in case.orders:
        yield (
            f"order of {_cell(o.name.removeprefix('order_of_').replace('_', ' '))}",
            "theory",
            _cell(f"{o.expected:g}: {o.because}"),
        )


def _measured(level: str, numbers: Mapping[str, Any]) -> str:
    by = numbers["by"]
    rows = []
    for q in numbers.get("quantities", ()):
        if q.get("reference") is None or q.get("value") is None:
            continue
        unit = q.get("unit") or ""
        off, allowed = abs(q["value"] - q["reference"]), q["allowed"]
        rows.append(
            (
                f"{q['name'].replace('_', ' ')}",
                f"{q.get('run', '')}",
                _number(q["value"], unit),
                _number(q["reference"], unit),
                f"{off / allowed:.2g}" if allowed else "0",
                q["status"],
            )
        )
    head = ("number", "run", "ours", "reference", "error / allowed", "verdict")
    return f"Level {level}, accepted {by['date'][:10]}: {numbers['status']}.\n\n{table(head, rows)}"


def _number(value: float, unit: str) -> str:
    if unit in ("m", "Pa", "N", "J"):
        return quantity(value, unit, 7)
    return f"{value:.7g} {unit}".strip()


def _accepted(name: str) -> tuple[str, Mapping[str, Any]]:
    path = BASELINES / f"{name}.json"
    if not path.is_file():
        return "", {}
    levels = json.loads(path.read_text(encoding="utf-8"))["levels"]
    level = next(level for level in LEVELS if level in levels)
    return level, levels[level]


def _text(text: str) -> str:
    return " ".join(text.split()).replace("*", "\\*").replace("_", "\\_")


def _cell(text: str) -> str:
    return _text(text).replace("|", "\\|").replace("[", "\\[").replace("]", "\\]")
