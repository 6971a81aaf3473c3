"""What the map says: nothing silent, nothing given up, refusals for the load alone."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping

import numpy as np

from verification.cases.outcome import Status
from verification.report.numbers import plain
from verification.studies.running.study import Statement
from verification.studies.stability.cell import StabilityCell
from verification.studies.stability.record import CellRecord, Verdict

Found = Mapping[StabilityCell, CellRecord]

MOST_NAMED = 12
LARGEST_FORCE = 1.0  # T/µW that friction carries


def nothing_silent(found: Found) -> Statement:
    """No answer that breaks the equations is given as if it were good."""
    silent = _named(found, Verdict.SILENT)
    return Statement(
        claim="no cell is wrong in silence",
        outcome=_judged(found, not silent),
        measured=f"{len(silent)} of {len(found)} cells{_list(silent)}",
        because="residuals of the solver within its tolerance, and the laws of contact and "
        "friction found again in the fields it returns",
    )


def everything_converges(found: Found) -> Statement:
    """Every cell that has a solution gets one."""
    given_up = _named(found, Verdict.NOT_CONVERGED)
    solved = [r for r in found.values() if r.verdict is Verdict.CONVERGED]
    worst = max((r.worst or 0.0 for r in solved), default=0.0)
    return Statement(
        claim="every cell that is not refused converges",
        outcome=_judged(found, not given_up),
        measured=f"{len(solved)} converged, largest residual {plain(worst, 2)}; "
        f"{len(given_up)} not converged{_list(given_up)}",
        because="a solver that gives up says so, with its residual; the map lists every such cell",
    )


def refusals_are_due(found: Found) -> Statement:
    """Refused is what asks for more than µW, all of it and nothing else."""
    refused = {c for c, r in found.items() if r.verdict is Verdict.REFUSED}
    beyond = {c for c in found if c.push > LARGEST_FORCE}
    wrong = sorted(c.name for c in refused ^ beyond)
    return Statement(
        claim="refused is a force above µW, and nothing else",
        outcome=_judged(found, not wrong),
        measured=f"{len(refused)} refused, {len(beyond)} ask for more than µW{_list(wrong)}",
        because="the only cells of the map that have no solution",
    )


def cost(found: Found) -> Statement:
    """What the cells took: a finding."""
    solved = [r for r in found.values() if r.verdict is Verdict.CONVERGED]
    if not solved:
        return Statement(claim="cost", outcome=None, measured="no cell converged")
    per_increment = [r.convolutions / r.increments for r in solved]
    ways = Counter(r.way for r in solved)
    halved = sum(r.halvings > 0 for r in solved)
    return Statement(
        claim="cost",
        outcome=None,
        measured=f"{np.median(per_increment):.0f} convolutions per increment in the median cell, "
        f"{max(per_increment):.0f} in the dearest; "
        f"{halved} cells halved increments; "
        + ", ".join(f"{way}: {count}" for way, count in sorted(ways.items())),
        because="deterministic counts; increments are as large as can be, T comes in one step",
    )


def _named(found: Found, verdict: Verdict) -> list[str]:
    return [cell.name for cell, record in found.items() if record.verdict is verdict]


def _list(names: list[str]) -> str:
    if not names:
        return ""
    more = f" and {len(names) - MOST_NAMED} more" if len(names) > MOST_NAMED else ""
    return ": " + ", ".join(names[:MOST_NAMED]) + more


def _judged(found: Found, good: bool) -> Status:
    if not found:
        return Status.INCONCLUSIVE
    return Status.PASS if good else Status.FAIL
