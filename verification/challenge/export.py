"""Export of a challenge to files that another contact code can read without this program.

The files describe the problem, list the required quantities, and contain empty tables for the
answer.
"""

from __future__ import annotations

import csv
import hashlib
import io
import json
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from contact_results.directory.atomic_file import Refused
from contact_results.directory.run_directory import files_at_once
from contact_scene import Scene
from contact_scene.stepping.load_path import (
    ControlKind,
    LoadRamp,
)
from verification.challenge.requested_quantities import Challenge, Patch


def toml_text(scene: Scene | Patch) -> str:
    """Return a scene as the text of a TOML scene file, with all values that differ from the
    defaults."""
    if isinstance(scene, Patch):
        tables = scene.document(exclude_defaults=True)
        return "\n".join(_toml_lines(tables, ())).lstrip("\n") + "\n"
    content = scene.model_dump(mode="json", exclude_defaults=True, exclude_none=True)
    shape = scene.model_dump(mode="json")["indenter"]["shape"]
    content["indenter"] = {"shape": shape, **content["indenter"]}
    return "\n".join(_toml_lines(content, ())).lstrip("\n") + "\n"


def _toml_lines(content: Mapping[str, Any], path: tuple[str, ...]) -> Iterator[str]:
    """Yield the TOML lines of a table of a scene file: its values, then its subtables and table
    arrays.

    content  values of the table by key
    path     keys of the enclosing tables
    """
    deeper = {name: v for name, v in content.items() if _is_table(v) or _is_tables(v)}
    for name, value in content.items():
        if name not in deeper:
            yield f"{name} = {_toml_value(value)}"
    for name, value in deeper.items():
        here = (*path, name)
        for one in [value] if _is_table(value) else value:
            head = ".".join(here)
            yield f"\n[{head}]" if _is_table(value) else f"\n[[{head}]]"
            yield from _toml_lines(one, here)


def _is_table(value: Any) -> bool:
    return isinstance(value, dict)


def _is_tables(value: Any) -> bool:
    return isinstance(value, list) and bool(value) and all(map(_is_table, value))


def _toml_value(value: Any) -> str:
    if isinstance(value, list):
        return f"[{', '.join(map(_toml_value, value))}]"
    if isinstance(value, float):
        return repr(value)
    return json.dumps(value, ensure_ascii=False)


POINTS = "points.csv"
SCHEMA = "slipstick-challenge/1"
MANIFEST, ANSWERS, LEVELS, SOLVER, FIELDS = (
    "manifest.json", "answers.csv", "levels.csv", "solver.toml", "fields",
)  # fmt: skip
ANSWER_COLUMNS = ("level", "load_step", "quantity", "value", "unit", "u")
POINT_COLUMNS = ("quantity", "load_step", "point", "x [m]", "y [m]", "z [m]")
# Additional column of the answers, for numbers at given points.
POINT = "point"
LEVEL_COLUMNS = ("level", "status", "reason", "h", "h_unit", "unknowns", "cpu_seconds")
FIELD_COLUMNS = ("x [m]", "y [m]", "area [m^2]")
# Suffix of the name of a traction in the header of its table.
IN_PASCAL = " [Pa]"
TEMPLATES = Path(__file__).parent / "templates"
# Exported files that must be returned unchanged.
GIVEN = ("scene.toml", "asked.csv", POINTS)


def export(challenge: Challenge, directory: Path, *, blind: bool) -> None:
    """Write the files of a challenge, which another code reads and fills in, to a folder.

    Raises Refused if the folder already contains answers.

    blind  True if the reference values are withheld
    """
    if (directory / ANSWERS).exists():
        raise Refused(f"{directory / ANSWERS} exists: take another folder, or delete it")
    reference = json.dumps(challenge.reference(), indent=1) + "\n"
    files = {
        "scene.toml": toml_text(challenge.scene),
        "asked.csv": _required_quantities_csv(challenge, blind=blind),
        POINTS: _csv_text([POINT_COLUMNS, *_point_rows(challenge)]),
        "problem.md": _problem_text(challenge),
        SOLVER: _template_text(SOLVER),
        LEVELS: _csv_text([LEVEL_COLUMNS]),
        ANSWERS: _csv_text([(*ANSWER_COLUMNS, POINT), *_empty_answers(challenge)]),
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
    with files_at_once(directory, ANSWERS, ()) as staging:
        for name, text in files.items():
            (staging / name).write_text(text, encoding="utf-8")


def digest(text: str) -> str:
    """Compute the SHA-256 digest of the text of an exported file.

    The digest is stored in the manifest of the challenge. The reader of answers compares the digest
    to detect a changed file.
    """
    return hashlib.sha256(text.encode()).hexdigest()


def _required_quantities_csv(challenge: Challenge, *, blind: bool) -> str:
    rows: list[Sequence[Any]] = [
        ("quantity", "load_step", "unit", "norm", "scale", "scale_name", "grade", "required",
         "meaning")
    ]  # fmt: skip
    for v in challenge.values:
        scale = "" if blind else f"{v.scale:.10g}"
        required = "yes" if v.required else "no"
        rows.append((v.quantity, v.step, v.unit, "abs", scale, v.over, v.par, required, v.meaning))
    for p in challenge.points:
        scale = "" if blind else f"{p.scale:.10g}"
        required = "yes" if p.required else "no"
        meaning = f"{p.meaning}, at the places of {POINTS}"
        rows.append(
            (p.quantity, p.step, p.unit, "largest", scale, p.over, p.par, required, meaning)
        )
    for f in challenge.fields:
        over = "its own norm" if f.norm == "L2" else "µW"
        rows.append((f.quantity, f.step, "Pa", f.norm, "", over, f.par, "no", f.meaning))
    return _csv_text(rows)


def _empty_answers(challenge: Challenge) -> list[Sequence[Any]]:
    rows = [("1", v.step, v.quantity, "", v.unit, "", "") for v in challenge.values]
    return rows + [
        ("1", p.step, p.quantity, "", p.unit, "", n)
        for p in challenge.points for n in range(1, 1 + len(p.places))
    ]  # fmt: skip


def _point_rows(challenge: Challenge) -> Iterator[Sequence[Any]]:
    """Yield the rows of the CSV table of the points at which a challenge requires numbers.

    The points of each quantity are numbered from 1.
    """
    for p in challenge.points:
        for n, place in enumerate(p.places, start=1):
            yield p.quantity, p.step, n, *(f"{x:.10g}" for x in place)


def _problem_text(challenge: Challenge) -> str:
    steps = [f"{ramp.step}. {', '.join(_prescribed_ends(ramp))}" for ramp in challenge.ramps]
    return _template_text("problem.md").format(
        title=challenge.title, problem=challenge.problem,
        steps="\n".join(steps) or "1. the tractions as told above",
        window=f"{challenge.window * 1e3:g} mm square", source=challenge.source,
        fields=_field_instructions(challenge),
        shares=challenge.shares or "nothing",
    )  # fmt: skip


def _field_instructions(challenge: Challenge) -> str:
    """Return the instructions for the tractions that a code gives at points of its own choice.

    The text is empty if the challenge requires no traction field.
    """
    if not challenge.fields:
        return ""
    step, heads = challenge.fields[0].step, list(FIELD_COLUMNS)
    heads += [f"{f.quantity}{IN_PASCAL}" for f in challenge.fields if f.step == step]
    return "\n" + _template_text("fields.md").format(step=step, columns=",".join(heads)).rstrip()


def _prescribed_ends(ramp: LoadRamp) -> Iterator[str]:
    """Yield the forces, moments or motions that a load step prescribes at its end, as text with
    units.

    Twist and tilt that are prescribed as zero are left out.
    """
    for words, control in (
        (("W", "N", "approach", "m"), ramp.normal),
        (("T", "N", "tangential shift", "m"), ramp.tangential),
        (("torque about z", "N m", "twist", "rad"), ramp.twisting),
        (("moments", "N m", "tilt", "rad"), ramp.tilting),
    ):
        rotates = control in (ramp.twisting, ramp.tilting)
        if rotates and control.kind is ControlKind.DISPLACEMENT and not np.any(control.end):
            continue
        name, unit = words[:2] if control.kind is ControlKind.FORCE else words[2:]
        end = control.end
        number = f"({end[0]:.17g}, {end[1]:.17g})" if isinstance(end, tuple) else f"{end:.17g}"
        yield f"{name} = {number} {unit}"


def _template_text(name: str) -> str:
    return (TEMPLATES / name).read_text(encoding="utf-8")


def _csv_text(rows: Sequence[Sequence[Any]]) -> str:
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(rows)
    return text.getvalue()
