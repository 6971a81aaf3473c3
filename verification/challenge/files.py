"""Files of a challenge: export for another contact code, and reader of the returned answer.

The exported files describe the problem, list the required quantities, and contain empty tables for
the answer. Each mistake in a returned file is reported with the file, the line, the found and the
expected value.
"""

from __future__ import annotations

import csv
import hashlib
import io
import json
import math
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from contact_results.directory.atomic_file import Refused
from contact_results.directory.run_directory import files_at_once
from contact_scene import Scene
from contact_scene.array_types import Vector
from contact_scene.reading.units import (
    LENGTH,
    MOMENT,
    PRESSURE,
    ROTATION,
    Kind,
    unit_factors,
)
from contact_scene.stepping.load_path import (
    ControlKind,
    LoadRamp,
)
from verification.challenge.cases import challenges
from verification.challenge.requested_quantities import (
    SAMPLINGS,
    Answer,
    AskedValue,
    Challenge,
    Field,
    Grade,
    Key,
    Patch,
    Solver,
)


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
MANIFEST = "manifest.json"
ANSWERS = "answers.csv"
LEVELS = "levels.csv"
SOLVER = "solver.toml"
FIELDS = "fields"
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
        (
            "quantity",
            "load_step",
            "unit",
            "norm",
            "scale",
            "scale_name",
            "grade",
            "required",
            "meaning",
        )
    ]
    for v in (*challenge.values, *challenge.points):
        scale = "" if blind else f"{v.scale:.10g}"
        norm, at = ("abs", "") if v.places is None else ("largest", f", at the places of {POINTS}")
        required = "yes" if v.required else "no"
        meaning = f"{v.meaning}{at}"
        rows.append((v.quantity, v.step, v.unit, norm, scale, v.over, v.par, required, meaning))
    for f in challenge.fields:
        over = "its own norm" if f.norm == "L2" else "µW"
        rows.append((f.quantity, f.step, "Pa", f.norm, "", over, f.par, "no", f.meaning))
    return _csv_text(rows)


def _empty_answers(challenge: Challenge) -> list[Sequence[Any]]:
    rows = [("1", v.step, v.quantity, "", v.unit, "", "") for v in challenge.values]
    return rows + [
        ("1", p.step, p.quantity, "", p.unit, "", n)
        for p in challenge.points
        for n in range(1, 1 + len(p.value))
    ]


def _point_rows(challenge: Challenge) -> Iterator[Sequence[Any]]:
    """Yield the rows of the CSV table of the points at which a challenge requires numbers.

    The points of each quantity are numbered from 1.
    """
    for p in challenge.points:
        for n, place in enumerate(p.places, start=1):
            yield p.quantity, p.step, n, *(f"{x:.10g}" for x in place)


def _problem_text(challenge: Challenge) -> str:
    steps = [f"{ramp.step}. {', '.join(_prescribed_ends(ramp))}" for ramp in challenge.ramps]
    window = (
        f"\nA suitable window: {challenge.window * 1e3:g} mm square; what is cut to the contact "
        "radius knows the answer.\n"
    )
    return _template_text("problem.md").format(
        title=challenge.title,
        problem=challenge.problem,
        steps="\n".join(steps) or "1. the tractions as told above",
        window=window if steps else "",
        source=challenge.source,
        fields=_field_instructions(challenge),
        shares=challenge.shares or "nothing",
    )


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


MAX_BYTES = 100_000_000


def rows(
    folder: Path, table: str, columns: tuple[str, ...]
) -> Iterator[tuple[str, dict[str, str]]]:
    """Yield file position and cells of every row of a CSV file that another code has filled in.

    The cells are texts by column name. Raises Refused if the file cannot be read or has other
    columns.

    folder   folder of the answer to a challenge
    table    name of the file, for levels or for answers
    columns  names of the required columns
    """
    path = folder / table
    reader = csv.DictReader(read_text_file(path).splitlines(), restkey="more")
    require_columns(f"{path}:1", reader.fieldnames or (), columns)
    for row in reader:
        where = f"{path}:{reader.line_num}"
        if "more" in row:
            raise Refused(
                f"{where}: more values than columns; commas are between them, so that "
                "numbers have a decimal point"
            )
        yield where, {k: (v or "").strip() for k, v in row.items()}


def require_columns(where: str, found: Sequence[str], expected: Sequence[str]) -> None:
    """Raise Refused if a table of an answer lacks an expected column; the message lists the columns
    found.

    where     file and line of the header, for the message
    found     column names of the table
    expected  required column names
    """
    missing = [name for name in expected if name not in found]
    if not missing:
        return
    there = ", ".join(map(repr, found)) or "nothing"
    if len(found) == 1 and any(mark in found[0] for mark in ";\t"):
        there += " (columns are separated by commas)"
    raise Refused(
        f"{where}: no column {', '.join(missing)}; expected {', '.join(expected)}; there is "
        f"{there[:200]}"
    )


def read_text_file(path: Path) -> str:
    """Return the text of a file of an answer to a challenge.

    Raises Refused for a file that is not regular, is larger than 100 MB, or is not text in UTF-8.
    """
    try:
        if path.exists() and not path.is_file():
            raise Refused(f"{path}: is not a regular file")
        if path.stat().st_size > MAX_BYTES:
            raise Refused(f"{path}: larger than {MAX_BYTES // 10**6} MB")
        return path.read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        reason = getattr(error, "strerror", None) or "not text in UTF-8"
        raise Refused(f"{path}: {reason}") from None


# Columns of a field file: numbers by the name of the column.
Columns = Mapping[str, Any]


def read_fields(
    folder: Path, challenge: Challenge, levels: Mapping[str, Any]
) -> dict[str, dict[Key, Field]]:
    """Read the traction fields of an answer to a challenge from the CSV files of its field folder.

    Returns the fields by level name; for each level by quantity and load step. Raises Refused for a
    file with a mistake.

    folder  folder of the answer
    levels  refinement levels of the answer, by name
    """
    found: dict[str, dict[Key, Field]] = {}
    for where, level, step, columns in _field_files(folder):
        if level not in levels or not step.isdigit():
            raise Refused(
                f"{where}: level {level!r} and load_step {step!r}, expected a level of {LEVELS} "
                f"({', '.join(levels)}) and a whole number"
            )
        here = [f.quantity for f in challenge.fields if f.step == int(step)]
        if not here:
            steps = ", ".join(dict.fromkeys(str(f.step) for f in challenge.fields))
            raise Refused(
                f"{where}: no traction of step {step} is asked, but of step {steps or 'none'}"
            )
        require_columns(where, list(columns), FIELD_COLUMNS)
        quantities = [q for q in here if f"{q}{IN_PASCAL}" in columns]
        if not quantities:
            expected = " or ".join(f"'{q}{IN_PASCAL}'" for q in here)
            there = ", ".join(map(repr, columns))
            raise Refused(
                f"{where}: no traction of step {step}, expected {expected}; there is {there}"
            )
        for quantity in quantities:
            names = (*FIELD_COLUMNS[:2], f"{quantity}{IN_PASCAL}", FIELD_COLUMNS[2])
            try:
                field = Field(*(np.asarray(columns[name], dtype=float) for name in names))
            except (ValueError, TypeError) as error:
                raise Refused(f"{where}: {error}") from None
            found.setdefault(level, {})[quantity, int(step)] = field
    return found


def _field_files(folder: Path) -> Iterator[tuple[str, str, str, Columns]]:
    """Read every traction file LEVEL_STEP.csv of an answer to a challenge.

    Yields the file position, the level name, the load step as text, and the columns by header.
    Raises Refused for a wrong file name or table.

    folder  folder of the answer
    """
    tables = folder / FIELDS
    for path in sorted(tables.glob("*")) if tables.is_dir() else ():
        level, _, step = path.stem.rpartition("_")
        if path.suffix != ".csv" or not level:
            raise Refused(f"{path}: expected LEVEL_STEP.csv, with a level of {LEVELS}")
        head, _, rest = read_text_file(path).partition("\n")
        header = [name.strip() for name in head.split(",")]
        require_columns(f"{path}:1", header, FIELD_COLUMNS)
        lines = rest.splitlines()
        try:
            table = np.loadtxt(lines, delimiter=",", ndmin=2) if any(lines) else np.zeros((0, 0))
            if table.shape[1] not in (0, len(header)):
                raise ValueError(f"{table.shape[1]} numbers a row, expected {len(header)}")
        except ValueError as error:
            reason = str(error).partition("; use `usecols`")[0]
            raise Refused(f"{path}, below its head: {reason}") from None
        columns = table.T if table.size else np.zeros((len(header), 0))
        yield f"{path}:1", level, step, dict(zip(header, columns, strict=True))


ENERGY = Kind(
    "J",
    '"3 uJ"',
    unit_factors(**{"J": "1", "mJ": "1e-3", "uJ": "1e-6", "N m": "1", "N mm": "1e-3"}),
)
KINDS = {"m": LENGTH, "Pa": PRESSURE, "J": ENERGY, "N m": MOMENT, "rad": ROTATION}
SOLVED = "solved"
GAVE_UP = "gave up"


def read_answers(directory: Path) -> tuple[Challenge, Solver, tuple[Answer, ...]]:
    """Read the answer of another code to a challenge from its folder.

    Returns the challenge, the description of the code, and one `Answer` per refinement level, from
    coarse to fine. Raises Refused with file, line, found and expected value.
    """
    challenge = _read_challenge(directory)
    file = directory / ANSWERS
    solver = _read_solver(directory / SOLVER)
    levels = dict(_read_levels(directory, challenge.window))
    values: dict[str, dict[Key, float | tuple[float, float]]] = {name: {} for name in levels}
    at_places: dict[str, dict[Key, Vector]] = {name: {} for name in levels}
    points = {one.key: len(one.value) for one in challenge.points}
    filled: set[tuple[str, Key, int]] = set()
    for where, level, key, point, value in _read_values(directory, challenge):
        if level not in levels:
            known = ", ".join(levels) or "none"
            raise Refused(f"{where}: level {level!r} is not in {LEVELS}; there are {known}")
        if (level, key, point) in filled:
            raise Refused(f"{where}: {key[0]} of step {key[1]} twice on level {level}")
        filled.add((level, key, point))
        if point:
            each = at_places[level].setdefault(key, np.zeros(points[key]))
            each[point - 1] = value
        else:
            values[level][key] = value
    for level, found in at_places.items():
        for key, each in found.items():
            missing_points = [n for n in range(1, 1 + len(each)) if (level, key, n) not in filled]
            if missing_points:
                raise Refused(
                    f"{file}: {key[0]} of step {key[1]} on level {level} has no "
                    f"value at point {', '.join(map(str, missing_points))}; fill in all or none"
                )
    fields = read_fields(directory, challenge, levels)
    answers = tuple(
        Answer(
            scalars=values[name],
            points=at_places[name],
            fields=fields.get(name, {}),
            label=name,
            **level,
        )
        for name, level in levels.items()
    )
    if not any(a.scalars or a.points or a.fields or a.gave_up for a in answers):
        raise Refused(f"{file}: no value is filled in; there is nothing to judge")
    return challenge, solver, answers


def _read_challenge(directory: Path) -> Challenge:
    path = directory / MANIFEST
    if not path.exists():
        raise Refused(
            f"{path}: no such file; expected the folder of 'slipstick challenge export', or "
            "FILE.py:FUNCTION"
        )
    try:
        manifest = json.loads(read_text_file(path))
        schema, name, version = (manifest[key] for key in ("schema", "case", "case_version"))
        files = {given: manifest["files"][given] for given in GIVEN}
    except (ValueError, KeyError, TypeError, RecursionError) as error:
        raise Refused(
            f"{path}: not the manifest of a challenge ({error}); export it again"
        ) from None
    if schema != SCHEMA or name not in challenges():
        raise Refused(f"{path}: {schema!r} {name!r} is no challenge that is known here")
    challenge = challenges()[name]
    if challenge.version != version:
        raise Refused(
            f"{path}: the answers are for version {version} of {name}, here it is "
            f"{challenge.version}; export it again"
        )
    for given, sha in files.items():
        if digest(read_text_file(directory / given)) != sha:
            raise Refused(f"{directory / given}: differs from what was exported; export it again")
    return challenge


def _read_solver(path: Path) -> Solver:
    try:
        content = tomllib.loads(read_text_file(path))
    except (tomllib.TOMLDecodeError, RecursionError) as error:
        raise Refused(f"{path}: {error}") from None
    tables = {key: content.get(key, {}) for key in ("solver", "convention", "claims")}
    for key, given in tables.items():
        if not isinstance(given, dict):
            raise Refused(f"{path}: {key} is {given!r}, expected a table [{key}]")
    who, convention, claims = tables.values()
    name = str(who.get("name", "")).strip()
    if not name:
        raise Refused(f"{path}: solver.name is empty; enter the name of the solver")
    sampling = convention.get("sampling", SAMPLINGS[0])
    if sampling not in SAMPLINGS:
        raise Refused(
            f"{path}: convention.sampling is {sampling!r}, expected {' or '.join(SAMPLINGS)}"
        )
    grade = claims.get("grade")
    if grade is not None and grade not in list(Grade):
        raise Refused(f"{path}: claims.grade is {grade!r}, expected {', '.join(Grade)}")
    orders = claims.get("order", {})
    if not isinstance(orders, dict) or not all(isinstance(v, int | float) for v in orders.values()):
        raise Refused(f"{path}: claims.order is {orders!r}, expected numbers by quantity")
    version, url = (str(who.get(key, "")) for key in ("version", "url"))
    return Solver(name, version, url, sampling, grade, orders)


def _read_levels(folder: Path, window: float) -> Iterator[tuple[str, dict[str, Any]]]:
    seen: set[str] = set()
    coarser = window
    for where, row in rows(folder, LEVELS, LEVEL_COLUMNS):
        name, status = row["level"], row["status"]
        if not name or name in seen:
            raise Refused(f"{where}: level {name!r} {'twice' if name else 'has no name'}")
        seen.add(name)
        if status not in (SOLVED, GAVE_UP):
            raise Refused(f"{where}: status {status!r}, expected {SOLVED!r} or {GAVE_UP!r}")
        unknowns, seconds = (
            _positive_number(where, k, row[k]) for k in ("unknowns", "cpu_seconds")
        )
        h = _parsed_number(where, "h", row["h"]) * _unit_factor(where, row["h_unit"], LENGTH)
        if not 0 < h <= coarser:
            than = "its window" if coarser == window else "the level before"
            raise Refused(
                f"{where}: h is {h:g} m, expected a length of at most {coarser:g} m, that of "
                f"{than}: levels go from coarse to fine"
            )
        coarser = h
        yield (
            name,
            {
                "h": h,
                "gave_up": {0: row["reason"] or "no reason given"} if status == GAVE_UP else {},
                "unknowns": None if unknowns is None else int(unknowns),
                "seconds": seconds,
            },
        )


def _read_values(
    folder: Path, challenge: Challenge
) -> Iterator[tuple[str, str, Key, int, float | tuple[float, float]]]:
    """Yield the numbers that another code has filled in into the file of answers.

    Rows without a value are left out. Each item has the file position, the level name, the quantity
    with its load step, the number of the point (0 for a number without points), and the value [SI].
    The value is a pair with its standard uncertainty if the code gives one.
    """
    for where, row in rows(folder, ANSWERS, ANSWER_COLUMNS):
        if not row["value"]:
            continue
        step = _step_number(where, row["load_step"])
        asked = challenge.one(row["quantity"], step)
        if asked is None:
            known = ", ".join(v.quantity for v in challenge.numbers if v.step == step) or "nothing"
            raise Refused(
                f"{where}: {row['quantity']!r} is not asked in step {step}; asked: {known}"
            )
        factor = _unit_factor(where, row["unit"], KINDS[asked.unit])
        value = factor * _parsed_number(where, "value", row["value"])
        u = _positive_number(where, "u", row["u"])
        key = asked.quantity, step
        if asked.places is not None:
            yield where, row["level"], key, _point_number(where, row.get(POINT, ""), asked), value
        elif row.get(POINT):
            raise Refused(f"{where}: {asked.quantity} is one number and has no points")
        else:
            yield where, row["level"], key, 0, value if u is None else (value, factor * u)


def _point_number(where: str, text: str, asked: AskedValue) -> int:
    if not text.isdigit() or len(text) > 6 or not 1 <= int(text) <= len(asked.value):
        raise Refused(f"{where}: point {text!r}, expected 1 to {len(asked.value)} of {POINTS}")
    return int(text)


def _step_number(where: str, text: str) -> int:
    if not text.isdigit() or len(text) > 6:
        raise Refused(f"{where}: load_step {text!r}, expected a whole number from 1")
    return int(text)


def _parsed_number(where: str, name: str, text: str) -> float:
    """Read a number from a cell of a table of an answer. Raises Refused for other texts.

    where  file and line, for the message
    name   name of the column
    text   content of the cell
    """
    try:
        return float(text)
    except ValueError:
        raise Refused(f"{where}: {name} is {text!r}, expected a number") from None


def _positive_number(where: str, name: str, text: str) -> float | None:
    """Read a number that must not be negative from a cell of a table of an answer.

    An empty cell returns None. Raises Refused for a negative or infinite number.

    where  file and line, for the message
    name   name of the column
    text   content of the cell
    """
    if not text:
        return None
    number = _parsed_number(where, name, text)
    if not 0 <= number < math.inf:
        raise Refused(f"{where}: {name} is {text}, expected a positive number, or none")
    return number


def _unit_factor(where: str, unit: str, kind: Kind) -> float:
    """Return the factor that converts a number in a unit to SI.

    Raises Refused for a missing or unsuitable unit.

    where  file and line, for the message
    unit   unit in a cell of a table of an answer
    kind   physical dimension that the required quantity has
    """
    if unit not in kind.units:
        raise Refused(f"{where}: got the unit {unit!r}, expected one of {', '.join(kind.units)}")
    return float(kind.units[unit])
