"""Accuracy and cost at several standings: what was recorded of each case, and what became worse."""

from __future__ import annotations

import io
import subprocess
import tarfile
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path, PurePosixPath

from verification.judging.change import SHORT_COMMIT, ChangeKind
from verification.judging.outcome import FOUND_IN_A_RUN, Status
from verification.regression.baseline import Baseline, RecordedQuantity, Recording
from verification.regression.baseline_files import BASELINES, ENDING
from verification.regression.counters import counter_changes
from verification.regression.number_change import BETTER_BY_PART, WORSE_BY, grows
from verification.regression.refusal import BaselineRefused

SECONDS_FOR_GIT = 60
ALL_RUNS = "all runs"


@dataclass(frozen=True)
class Standing:
    """Cases as they were recorded at one level.

    name     the commit, or the place of a report
    date     of the commit or of the report, as text
    because  what changed, or why the numbers were accepted
    """

    name: str
    date: str
    because: str
    recordings: Mapping[str, Recording]


@dataclass(frozen=True)
class Mark:
    """What a standing has made worse since the one before it.

    at        which standing, from 0
    was, now  errors as parts of what is allowed; of a cost, counts
    """

    at: int
    case: str
    name: str
    run: str
    kind: ChangeKind
    was: float
    now: float


def part_of_allowed(quantity: RecordedQuantity) -> float | None:
    """The error over what is allowed; None for an order, where nothing is allowed, and for a value
    that is not finite."""
    if quantity.tolerance_kind == "order" or quantity.error is None or quantity.allowed == 0:
        return None
    return quantity.error / quantity.allowed


def worst(recording: Recording) -> tuple[str, float] | None:
    """The quantity with the largest part of what is allowed, and that part; None without one."""
    parts = [
        (part, quantity.name)
        for quantity in recording.quantities
        if quantity.name not in FOUND_IN_A_RUN and (part := part_of_allowed(quantity)) is not None
    ]
    if not parts:
        return None
    part, name = max(parts)
    return name, part


def marks(standings: Sequence[Standing]) -> list[Mark]:
    """What became worse or dearer from one standing to the next, in this order."""
    found: list[Mark] = []
    for at, (before, after) in enumerate(pairwise(standings), 1):
        for case, now in after.recordings.items():
            if case in before.recordings:
                found += _marks(at, case, before.recordings[case], now)
    return found


def _marks(at: int, case: str, was: Recording, now: Recording) -> Iterator[Mark]:
    earlier = {quantity.key: quantity for quantity in was.quantities}
    for quantity in now.quantities:
        old = earlier.get(quantity.key)
        kind = None if old is None else _kind(old, quantity)
        if old is not None and kind is not None:
            errors = (part_of_allowed(one) or 0.0 for one in (old, quantity))
            yield Mark(at, case, quantity.name, quantity.run, kind, *errors)
    for change in counter_changes(now, was):
        if change.kind is ChangeKind.DEARER and change.was:  # else counted for the first time
            yield Mark(at, case, change.name, ALL_RUNS, change.kind, change.was, change.now)


def _kind(was: RecordedQuantity, now: RecordedQuantity) -> ChangeKind | None:
    if now.status is Status.FAIL and was.status is not Status.FAIL:
        return ChangeKind.OUTSIDE
    least = BETTER_BY_PART * min(was.allowed, now.allowed)
    worse = now.name not in FOUND_IN_A_RUN and grows(was, now, WORSE_BY, least)
    return ChangeKind.WORSE if worse else None


def standings_of_commits(level: str, directory: Path = BASELINES) -> list[Standing]:
    """What was recorded at every commit that changed the baselines, the oldest first.

    directory  of the baselines, in a clone

    Raises BaselineRefused where git has no history of it, or one of files that are no baselines.
    """
    lines = _git(directory, "log", "--reverse", "--format=%H%x09%cs%x09%s", "--", ".").decode()
    commits = [line.split("\t", 2) for line in lines.splitlines()]
    if not commits:
        raise BaselineRefused(f"git has no commit with baselines in {directory}; name reports")
    return [
        Standing(commit[:SHORT_COMMIT], date, because, _recordings(directory, commit, level))
        for commit, date, because in commits
    ]


def recordings_at(level: str, baselines: Mapping[str, Baseline]) -> dict[str, Recording]:
    """Those of a level, by case."""
    return {
        case: baseline.levels[level]
        for case, baseline in sorted(baselines.items())
        if level in baseline.levels
    }


def _recordings(directory: Path, commit: str, level: str) -> dict[str, Recording]:
    packed = io.BytesIO(_git(directory, "archive", commit, "."))
    baselines: dict[str, Baseline] = {}
    with tarfile.open(fileobj=packed) as files:
        for member in files:
            path, content = PurePosixPath(member.name), files.extractfile(member)
            if content is None or path.suffix != ENDING:
                continue
            try:
                baselines[path.stem] = Baseline.model_validate_json(content.read())
            except ValueError as error:
                reason = str(error).splitlines()[0]
                raise BaselineRefused(
                    f"{path.name} of commit {commit[:SHORT_COMMIT]} is no baseline that this "
                    f"version reads: {reason}; name reports instead"
                ) from None
    return recordings_at(level, baselines)


def _git(directory: Path, *arguments: str) -> bytes:
    try:
        return subprocess.run(
            ["git", "-C", str(directory), *arguments],
            capture_output=True, timeout=SECONDS_FOR_GIT, check=True,
        ).stdout  # fmt: skip
    except (OSError, subprocess.SubprocessError) as error:
        raise BaselineRefused(
            f"git tells no history of {directory} ({type(error).__name__}): use a clone, or name "
            "reports"
        ) from None
