"""The study of what is promised under attack: what was tried, how often, and how it ended."""

from __future__ import annotations

import math
from dataclasses import dataclass

from verification.exhibits.numbers import plain
from verification.exhibits.table import NONE, Table
from verification.judging.case import Level
from verification.running.row import CaseRecord
from verification.running.rules import judged
from verification.running.study import Conclusion, Records, Settings, Statement, Study
from verification.studies.promises.promise import Promise
from verification.studies.promises.promises import PROMISES

TRIED, KEPT, WORST, BROKEN = "tried", "kept", "worst", "broken"


@dataclass(frozen=True)
class Trial:
    """A promise, tried so often."""

    promise: str
    count: int

    @property
    def name(self) -> str:
        """That of the promise."""
        return self.promise

    def compute(self) -> CaseRecord:
        """Try it; what broke it first is told."""
        tried = list(PROMISES[self.promise].attempts(self.count))
        broken = [attempt.told for attempt in tried if not attempt.kept]
        sizes = [attempt.measure for attempt in tried if attempt.measure is not None]
        worst = max(sizes, default=None)
        return CaseRecord(
            parameters={"promise": self.promise},
            counters={TRIED: len(tried), KEPT: len(tried) - len(broken)},
            measures={} if worst is None else {WORST: worst if math.isfinite(worst) else None},
            words={BROKEN: broken[0][:500]} if broken else {},
        )


def cases(settings: Settings) -> tuple[Trial, ...]:
    """Every promise as often as its level says."""
    return tuple(Trial(name, of.count(settings.level)) for name, of in PROMISES.items())


def conclude(settings: Settings, records: Records) -> Conclusion:
    """A statement and a line of the table for every promise."""
    found = {name: records[name] for name in PROMISES if name in records}
    tried = sum(record.counters[TRIED] for record in found.values())
    broken = tried - sum(record.counters[KEPT] for record in found.values())
    return Conclusion(
        answer=f"{len(PROMISES)} promises, tried {tried} times; broken {broken} times.",
        statements=tuple(
            _statement(PROMISES[name], record, settings.level) for name, record in found.items()
        ),
        tables=(
            Table(
                title="What was tried, how often, and how it ended",
                columns=("promise", "what was tried", "how often", "kept", "worst"),
                rows=tuple(_line(PROMISES[name], record) for name, record in found.items()),
                name="promises",
                units=NONE,
            ),
        ),
    )


def _statement(promise: Promise, record: CaseRecord, level: Level) -> Statement:
    tried, kept = record.counters[TRIED], record.counters[KEPT]
    return Statement(
        claim=promise.claim,
        outcome=judged(kept == tried, complete=tried >= promise.count(level)),
        measured=f"{kept} of {tried} tries{_worst(promise, record, ', worst ')}",
        because=record.words.get(BROKEN, ""),
    )


def _line(promise: Promise, record: CaseRecord) -> tuple[str, ...]:
    counts = (str(record.counters[TRIED]), str(record.counters[KEPT]))
    return (promise.claim, promise.attempt, *counts, _worst(promise, record) or "–")


def _worst(promise: Promise, record: CaseRecord, before: str = "") -> str:
    worst = record.measures.get(WORST)
    return f"{before}{plain(worst, 2)} {promise.measured}" if WORST in record.measures else ""


STUDY = Study(
    name="promises",
    title="Under attack: what is promised, and how often it was tried",
    question="Damaged and hostile scene files, kills, interrupts, damaged caches, absurd contacts, "
    "numbers that are none: does everything end in an answer or one clear error, and is nothing "
    "lost or silently wrong?",
    cases=cases,
    conclude=conclude,
)
