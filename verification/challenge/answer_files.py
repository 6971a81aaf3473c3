"""What a folder of answers holds, as rows of text: tables of CSV, or all in one answers.json."""

from __future__ import annotations

import csv
import json
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from contact_results.directory.refusal import Refused
from verification.challenge.export import ANSWERS, FIELDS, LEVELS

IN_ONE = "answers.json"  # in place of the others
PARTS = {LEVELS: "levels", ANSWERS: "values", FIELDS: "fields"}
MAX_BYTES = 100_000_000


def rows(
    folder: Path, table: str, columns: tuple[str, ...]
) -> Iterator[tuple[str, dict[str, str]]]:
    """Place and cells of every row of LEVELS or ANSWERS. Raises Refused."""
    if (folder / IN_ONE).exists():
        for where, record in records(folder, table):
            if missing := [name for name in columns if name not in record]:
                raise Refused(f"{where}: no {', '.join(missing)}; expected {', '.join(columns)}")
            yield where, {k: "" if v is None else str(v).strip() for k, v in record.items()}
        return
    path = folder / table
    reader = csv.DictReader(text_of(path).splitlines(), restkey="more")
    columns_are_there(f"{path}:1", reader.fieldnames or (), columns)
    for row in reader:
        where = f"{path}:{reader.line_num}"
        if "more" in row:
            raise Refused(
                f"{where}: more values than columns; commas are between them, so that "
                "numbers have a decimal point"
            )
        yield where, {k: (v or "").strip() for k, v in row.items()}


def records(folder: Path, table: str) -> Iterator[tuple[str, dict[str, Any]]]:
    """Place and content of every record of one part of IN_ONE. Raises Refused."""
    path, part = folder / IN_ONE, PARTS[table]
    try:
        content = json.loads(text_of(path))
    except (ValueError, RecursionError) as error:
        raise Refused(f"{path}: {error}") from None
    found = content.get(part, []) if isinstance(content, dict) else None
    if not isinstance(found, list) or not all(isinstance(one, dict) for one in found):
        raise Refused(f"{path}: expected an object with lists of records {_words(PARTS.values())}")
    for n, record in enumerate(found):
        yield f"{path}: {part}[{n}]", record


def columns_are_there(where: str, found: Sequence[str], expected: Sequence[str]) -> None:
    """Raises Refused where one is missing, with what is there instead."""
    missing = [name for name in expected if name not in found]
    if not missing:
        return
    there = _words(found) or "nothing"
    if len(found) == 1 and any(mark in found[0] for mark in ";\t"):
        there += " (columns are separated by commas)"
    raise Refused(
        f"{where}: no column {', '.join(missing)}; expected {', '.join(expected)}; there is "
        f"{there[:200]}"
    )


def text_of(path: Path) -> str:
    """Of a regular file of a size that can be. Raises Refused."""
    try:
        if path.exists() and not path.is_file():
            raise Refused(f"{path}: is not a regular file")
        if path.stat().st_size > MAX_BYTES:
            raise Refused(f"{path}: larger than {MAX_BYTES // 10**6} MB")
        return path.read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        reason = getattr(error, "strerror", None) or "not text in UTF-8"
        raise Refused(f"{path}: {reason}") from None


def _words(names: Any) -> str:
    return ", ".join(map(repr, names))
