"""A case of the catalogue as work for a worker process, and the record that it leaves."""

from __future__ import annotations

import os
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING

from contact_scene.reading.description import Description
from verification.judging.outcome import CaseOutcome
from verification.judging.verdicts import lost as without_result

if TYPE_CHECKING:
    from verification.judging.case import Case

CACHE = "SLIPSTICK_CACHE_DIR"
NOWHERE = os.devnull  # a file, so nothing is found in it and nothing can be put there
_lock = threading.Lock()
_inside = 0
_before: str | None = None


class JudgedCase(Description):
    """What came out of a case, and the wall seconds it took."""

    outcome: CaseOutcome
    seconds: float


@dataclass(frozen=True)
class CaseToJudge:
    """A case by its name and level: what it consists of cannot be sent to another process.

    level  by name, in capitals
    """

    name: str
    level: str

    def compute(self) -> JudgedCase:
        """Solve and judge it. What is kept on disk is left alone: what is judged must be what the
        code computes now, not what it computed before somebody changed it."""
        from verification.cases.catalogue import case_of
        from verification.judging.case import Level
        from verification.judging.judgement import judge

        case, started = case_of(self.name, Level[self.level]), time.perf_counter()
        with _no_cache_on_disk():
            outcome = judge(case)
        seconds = time.perf_counter() - started
        return JudgedCase(outcome=outcome, seconds=seconds)


def lost(case: Case, reason: str) -> CaseOutcome:
    """The outcome of a case that has no record: one failed verdict."""
    return CaseOutcome(
        name=case.name,
        title=case.title,
        problem=case.problem,
        scenes=(),
        runs=(),
        verdicts=(without_result("all", f"the case has no outcome: {reason}", "case"),),
        findings=(),
        charts=(),
        limits=case.limits,
    )


@contextmanager
def _no_cache_on_disk() -> Iterator[None]:
    """For all threads of this process: a worker of a cluster may judge several cases at a time."""
    global _inside, _before
    with _lock:
        if not _inside:
            _before = os.environ.get(CACHE)
            os.environ[CACHE] = NOWHERE
        _inside += 1
    try:
        yield
    finally:
        with _lock:
            _inside -= 1
            if not _inside:
                del os.environ[CACHE]
                if _before is not None:
                    os.environ[CACHE] = _before
