"""What another code needs, as files and nothing of ours."""

from __future__ import annotations

import csv
import hashlib
import io
import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from contact_results.directory.atomic_file import atomic_file
from contact_results.directory.refusal import Refused
from verification.challenge.asked import Challenge
from verification.challenge.toml_text import toml_text

SCHEMA = "slipstick-challenge/1"
MANIFEST, ANSWERS, LEVELS, SOLVER, FIELDS = (
    "manifest.json", "answers.csv", "levels.csv", "solver.toml", "fields",
)  # fmt: skip
ANSWER_COLUMNS = ("level", "load_step", "quantity", "value", "unit", "u")
LEVEL_COLUMNS = ("level", "status", "reason", "h", "h_unit", "unknowns", "cpu_seconds")
FIELD_COLUMNS = ("x [m]", "y [m]", "area [m^2]")
TEMPLATES = Path(__file__).parent / "templates"
GIVEN = ("scene.toml", "asked.csv")  # must come back as they went


def export(challenge: Challenge, directory: Path, *, blind: bool) -> None:
    """Write the files; raises Refused where answers are waiting already."""
    if (directory / ANSWERS).exists():
        raise Refused(f"{directory / ANSWERS} exists: take another folder, or delete it")
    reference = json.dumps(challenge.reference(), indent=1) + "\n"
    files = {
        "scene.toml": toml_text(challenge.scene),
        "asked.csv": _asked(challenge, blind=blind),
        "problem.md": _problem(challenge),
        SOLVER: _template_text(SOLVER),
        LEVELS: _csv([LEVEL_COLUMNS]),
        ANSWERS: _csv([ANSWER_COLUMNS, *_empty_answers(challenge)]),
    }
    manifest = {
        "schema": SCHEMA,
        "case": challenge.name,
        "case_version": challenge.version,
        "blind": blind,
        "files": {name: digest(files[name]) for name in GIVEN},
        "reference": digest(reference),
    }
    if not blind:
        files["reference.json"] = reference
    files[MANIFEST] = json.dumps(manifest, indent=1) + "\n"
    for name, text in files.items():
        with atomic_file(directory / name) as unfinished:
            unfinished.write_text(text, encoding="utf-8")


def digest(text: str) -> str:
    """By which a change of a file is seen."""
    return hashlib.sha256(text.encode()).hexdigest()


def _asked(challenge: Challenge, *, blind: bool) -> str:
    rows: list[Sequence[Any]] = [
        ("quantity", "load_step", "unit", "norm", "scale", "scale_name", "grade", "required",
         "meaning")
    ]  # fmt: skip
    for v in challenge.values:
        scale = "" if blind else f"{v.scale:.10g}"
        required = "yes" if v.required else "no"
        rows.append((v.quantity, v.step, v.unit, "abs", scale, v.over, v.par, required, v.meaning))
    for f in challenge.fields:
        over = "its own norm" if f.norm == "L2" else "µW"
        rows.append((f.quantity, f.step, "Pa", f.norm, "", over, f.par, "no", f.meaning))
    return _csv(rows)


def _empty_answers(challenge: Challenge) -> list[Sequence[Any]]:
    return [("1", v.step, v.quantity, "", v.unit, "") for v in challenge.values]


def _problem(challenge: Challenge) -> str:
    steps = [
        f"{n}. W = {normal:.17g} N, T = ({x:.17g}, {y:.17g}) N"
        for n, (normal, (x, y)) in enumerate(challenge.loads, start=1)
    ]
    return _template_text("problem.md").format(
        title=challenge.title, problem=challenge.problem, steps="\n".join(steps),
        window=f"{challenge.window * 1e3:g} mm square", source=challenge.source,
        shares=challenge.shares or "nothing",
    )  # fmt: skip


def _template_text(name: str) -> str:
    return (TEMPLATES / name).read_text(encoding="utf-8")


def _csv(rows: Sequence[Sequence[Any]]) -> str:
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(rows)
    return text.getvalue()
