"""Baselines on disk: one file per case, in the package or in a folder of your own."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from types import MappingProxyType

from contact_results.directory.atomic_file import atomic_file
from verification.judging.case import Level
from verification.regression.baseline import BASELINE_VERSION, Baseline, Recording
from verification.regression.refusal import BaselineRefused

BASELINES = Path(__file__).resolve().parents[1] / "baselines"
ENDING, REMOVED = ".json", "REMOVED.md"
REMOVED_HEAD = """# Removed baseline keys

Each removed key of an accepted baseline, with its successor or the reason for its removal.

| case | quantity [run] | successor, or reason |
| --- | --- | --- |
"""
REMEDY = "restore it from the repository, or delete it and accept it anew"


def read_baselines(directory: Path | None = None) -> dict[str, Baseline]:
    """Every baseline of a folder by the name of its case; none is a state, not an error.

    directory  None: those of the package

    Raises BaselineRefused for the first file that is not a whole baseline of the case it is named
    after.
    """
    folder = BASELINES if directory is None else directory
    files = sorted(folder.glob(f"*{ENDING}")) if folder.is_dir() else []
    return {path.stem: _read(path) for path in files}


def write_baselines(
    recordings: Mapping[str, Recording | None],
    level: str,
    directory: Path,
    removed: Mapping[str, Sequence[str]] = MappingProxyType({}),
    reason: str = "",
) -> tuple[Path, ...]:
    """Record cases at a level; their recordings at other levels stay.

    recordings  by case; None deletes the recording
    removed     keys by case that are no longer recorded, for `REMOVED.md`

    Everything is read before anything is written. Raises BaselineRefused for a file in the way
    that is no baseline.
    """
    texts: dict[Path, str] = {}
    for case, recorded in recordings.items():
        path = directory / f"{case}{ENDING}"
        levels = _read(path).levels if path.exists() else {}
        levels = {name: one for name, one in levels.items() if name != level}
        if recorded is not None:
            levels[level] = recorded
        ordered = {name: levels[name] for name in _in_order(levels)}
        texts[path] = dump_baseline(Baseline(case=case, levels=ordered)) if ordered else ""
    if removed:
        path = directory / REMOVED
        head = path.read_text(encoding="utf-8") if path.exists() else REMOVED_HEAD
        because = reason.replace("|", "/")
        rows = (
            f"| {case} | {', '.join(keys).replace('|', '/')} | {level}: {because} |\n"
            for case, keys in removed.items()
        )
        texts[path] = head + "".join(rows)
    for path, text in texts.items():
        if not text:
            path.unlink()
            continue
        with atomic_file(path) as temporary:
            temporary.write_text(text, encoding="utf-8", newline="\n")
    return tuple(path for path in texts if path.suffix == ENDING)


def dump_baseline(baseline: Baseline) -> str:
    """The text of its file; equal baselines give equal text, and every bit of a number returns."""
    content = baseline.model_dump(mode="json")
    return json.dumps(content, indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def _in_order(levels: Iterable[str]) -> list[str]:
    return sorted(levels, key=lambda name: Level[name.upper()])


def _read(path: Path) -> Baseline:
    if path.exists() and not path.is_file():
        raise BaselineRefused(f"baseline {path} is not a regular file")
    try:
        baseline = Baseline.model_validate_json(path.read_bytes())
    except OSError as error:
        raise BaselineRefused(f"baseline {path} cannot be read: {error.strerror}") from error
    except ValueError as error:
        problem = " ".join(str(error).splitlines()[:3])
        raise BaselineRefused(f"baseline {path} is damaged: {problem}; {REMEDY}") from None
    unknown = sorted(baseline.levels.keys() - {level.name.lower() for level in Level})
    for wrong, text in (
        (baseline.schema_version != BASELINE_VERSION, f"is of version {baseline.schema_version}"),
        (baseline.case != path.stem, f"is of case {baseline.case!r}"),
        (bool(unknown), f"has a level {', '.join(unknown)}"),
    ):
        if wrong:
            raise BaselineRefused(f"baseline {path} {text}; {REMEDY}")
    return baseline
