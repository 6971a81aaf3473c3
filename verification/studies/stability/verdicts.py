"""What the map says of each solver: nothing silent, hardly anything given up, refusals due."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping

import numpy as np

from verification.exhibits.numbers import plain
from verification.running.rules import judged
from verification.running.study import Statement
from verification.studies.stability.cell import Solver, StabilityCell
from verification.studies.stability.record import CellRecord, Refusal, Verdict

Found = Mapping[StabilityCell, CellRecord]
Item = tuple[StabilityCell, CellRecord]

MAX_NAMED = 12
MAX_WAYS = 4
LEAST_SHARE = 0.99  # of the cells that are not refused
LARGEST_FORCE = 1.0  # T/µW that friction carries
NAMES = {
    Solver.SEMI_ANALYTICAL: "semi-analytical",
    Solver.COMPLEMENTARITY: "finite elements, complementarity",
    Solver.PENALTY: "finite elements, penalty",
}
WORK = {True: "linear systems", False: "convolutions"}  # by whether finite elements solve it


def statements(found: Found) -> tuple[Statement, ...]:
    """All there is to say, solver by solver."""
    told: list[Statement] = []
    for solver in Solver:
        cells = of_solver(found, solver)
        about = (nothing_silent, nearly_everything_converges, refusals_are_due, cost)
        told += (_of(solver, state(cells)) for state in about)
    return tuple(told)


def of_solver(found: Found, solver: Solver) -> Found:
    """The cells that it was asked to solve."""
    return {cell: record for cell, record in found.items() if cell.solver is solver}


def ended(found: Found, *so: Verdict) -> Found:
    """The cells that ended in one of these ways."""
    return {cell: record for cell, record in found.items() if record.verdict in so}


def answer(found: Found) -> str:
    """To the question of the map, in one sentence; empty without cells."""
    if not found:
        return ""
    ends = Counter(record.verdict for record in found.values())
    refused = ended(found, Verdict.REFUSED)
    asked = Counter(NAMES[cell.solver] for cell in found)
    return (
        f"Of {len(found)} cells ({'; '.join(f'{name}: {n}' for name, n in asked.items())}) "
        f"{ends[Verdict.CONVERGED]} converged, with "
        f"residuals of {_worst(found)} at most, and {len(refused)} were refused, "
        f"{len(_duly(refused))} of these for a force above µW or because a section cannot pose "
        "them; "
        f"{ends[Verdict.NOT_CONVERGED]} gave up and {ends[Verdict.SILENT]} are wrong in silence."
    )


def _worst(found: Found) -> str:
    """The largest residual of the cells that converged."""
    solved = ended(found, Verdict.CONVERGED).values()
    return plain(max((r.worst or 0.0 for r in solved), default=0.0), 2)


def nothing_silent(found: Found) -> Statement:
    """No answer that breaks the equations is given as if it were good."""
    silent = ended(found, Verdict.SILENT)
    return Statement(
        claim="no cell is wrong in silence",
        outcome=judged(not silent, complete=bool(found)),
        measured=f"{len(silent)} of {len(found)} cells{_list(silent)}",
        because="residuals of the solver within its tolerance, and the laws of contact and "
        "friction found again in what it returns",
    )


def nearly_everything_converges(found: Found) -> Statement:
    """Nearly every cell that has a solution gets one."""
    given_up, solved = ended(found, Verdict.NOT_CONVERGED), ended(found, Verdict.CONVERGED)
    asked = len(solved) + len(given_up)
    enough = bool(solved) and len(solved) >= LEAST_SHARE * asked
    return Statement(
        claim=f"at least {LEAST_SHARE:.0%} of the cells that are not refused converge",
        outcome=judged(enough, complete=bool(found)),
        measured=f"{len(solved)} of {asked} converged, largest residual {_worst(found)}; "
        f"{len(given_up)} not converged{_list(given_up)}",
        because="a solver that gives up says so, with its residual; every such cell has a row",
    )


def refusals_are_due(found: Found) -> Statement:
    """Refused is what asks for more than µW, and what a solver cannot pose; nothing else."""
    refused = ended(found, Verdict.REFUSED)
    due = {cell: kind for cell in found if (kind := _due(cell))}
    wrong = sorted((refused.keys() | due) - _duly(refused), key=lambda cell: cell.name)
    beyond = sum(kind is Refusal.FORCE for kind in due.values())
    unposable = len(due) - beyond
    return Statement(
        claim="refused is a force above µW"
        + (", and what is not of revolution" if unposable else "")
        + "; nothing else",
        outcome=judged(not wrong, complete=bool(found)),
        measured=f"{len(refused)} refused, {beyond} ask for more than µW"
        + (f", {unposable} are not of revolution" if unposable else "")
        + _list(wrong),
        because="the only cells of the map that have no solution, or none on a section: one "
        "of each kind",
    )


def cost(found: Found) -> Statement:
    """What the cells took: a finding."""
    solved = ended(found, Verdict.CONVERGED).values()
    if not solved:
        return Statement(claim="cost", outcome=None, measured="no cell converged")
    by_elements = next(iter(found)).solver.by_elements
    per_increment = [r.work / r.increments for r in solved]
    ways = Counter(r.way for r in solved).most_common(MAX_WAYS)
    halved = sum(r.halvings > 0 for r in solved)
    return Statement(
        claim="cost",
        outcome=None,
        measured=f"{np.median(per_increment):.0f} {WORK[by_elements]} per increment in the median "
        f"cell, {max(per_increment):.0f} in the dearest; {halved} cells halved increments. Most "
        "often: " + ", ".join(f"{way}: {count}" for way, count in ways),
        because="deterministic counts; increments are as large as can be, T comes in one step",
    )


def _due(cell: StabilityCell) -> Refusal:
    """What a cell has to be refused for; nothing if it has a solution."""
    if not cell.posable:
        return Refusal.POSE
    return Refusal.FORCE if cell.push > LARGEST_FORCE else Refusal.NONE


def _duly(refused: Found) -> set[StabilityCell]:
    """Those that are refused for what they have to be."""
    return {cell for cell, r in refused.items() if r.refused_for and r.refused_for is _due(cell)}


def _of(solver: Solver, statement: Statement) -> Statement:
    return statement.model_copy(update={"claim": f"{NAMES[solver]}: {statement.claim}"})


def _list(cells: Iterable[StabilityCell]) -> str:
    """Their names, the first of them."""
    names = [cell.name for cell in cells]
    if not names:
        return ""
    more = f" and {len(names) - MAX_NAMED} more" if len(names) > MAX_NAMED else ""
    return ": " + ", ".join(names[:MAX_NAMED]) + more
