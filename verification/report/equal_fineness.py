"""Which solver is nearer to a reference at as many cells as elements per contact radius."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from verification.convergence.error_line import by_size, error_line
from verification.exhibits.numbers import plain
from verification.exhibits.table import NONE, Table
from verification.judging.outcome import RefinedErrors
from verification.report.both_solvers import WORDS, SharedReference
from verification.solver import Solver

PER_RADIUS = 64  # the fineness that solvers are compared at
BEYOND = 2.0  # an error is extrapolated no further than by this factor of refinement
COVERAGE = 2.0  # standard deviations of single runs, and standard uncertainties of references
TELLING = 30.0  # errors that scatter by more than this factor either way say nothing
CHANCE = 0.1  # of the line: errors that happen to be smaller count as this
TIE = "tie"


@dataclass(frozen=True)
class TypicalError:
    """What a solver's measured order gives as its error at PER_RADIUS.

    value  on the line through the errors of all levels, relative
    low    errors of single grids or meshes fall between this
    high   and this, as single runs scatter about that line
    """

    value: float
    low: float
    high: float


@dataclass(frozen=True)
class Vote:
    """A reference that both solvers approached by refinement."""

    shared: SharedReference
    cells: TypicalError
    elements: TypicalError

    @property
    def nearer(self) -> Solver | None:
        """The solver with the smaller error; None, a tie, where the scatter of single runs or the
        uncertainty of the reference is larger than what lies between."""
        one, other = self.cells, self.elements
        overlap = one.low <= other.high and other.low <= one.high
        known_to = COVERAGE * self.shared.uncertainty
        if overlap or abs(one.value - other.value) <= known_to:
            return None
        return Solver.CELLS if one.value < other.value else Solver.ELEMENTS


def votes(shared: Iterable[SharedReference]) -> tuple[Vote, ...]:
    """Of every reference that both have refined on, each once."""
    found: dict[object, Vote] = {}
    for pair in shared:
        cells, elements = (
            typical_error(one.verdict.refined) for one in (pair.cells, pair.elements)
        )
        if cells is not None and elements is not None:
            found.setdefault(pair.reference, Vote(pair, cells, elements))
    return tuple(found.values())


def typical_error(refined: RefinedErrors | None) -> TypicalError | None:
    """The error at PER_RADIUS; None without levels, or where these are too coarse or too fine, or
    scatter too much."""
    if refined is None:
        return None
    least, most = min(refined.per_radius), max(refined.per_radius)
    if not least <= PER_RADIUS <= BEYOND * most:
        return None
    sizes = 1 / np.asarray(refined.per_radius)
    levels, means = by_size(sizes.tolist(), refined.errors)
    if min(means) <= 0:
        return None
    line = error_line(levels, means)
    off = np.log(np.maximum(np.asarray(refined.errors) / line.at(sizes), CHANCE))
    scatter = COVERAGE * float(np.sqrt(np.sum(off**2) / (len(sizes) - 2)))
    size = np.array([1 / PER_RADIUS])
    (value,), (end,) = line.at(size), line.band(size)[1]
    by = float(np.exp(np.hypot(scatter, np.log(end / value))))
    if by > TELLING:
        return None
    return TypicalError(float(value), float(value) / by, float(value) * by)


def nearer_sentences(cast: tuple[Vote, ...], shared: tuple[SharedReference, ...]) -> list[str]:
    """Who is nearer in what, and how many values do not count."""
    at = f"{PER_RADIUS} cells or elements per contact radius"
    if not cast:
        return [
            f"Which is nearer is not decided by this report: none of the {len(shared)} values that "
            f"both were judged by was refined by both to {at}, with errors that scatter by less "
            f"than {TELLING:g} times."
        ]
    left = len(shared) - len(cast)
    sentences = [f"{_throughout(cast)}: at {at}, of {_values(len(cast))}, {_counted(cast)}."]
    if left:
        sentences.append(
            f"{left} more that both were judged by {'does' if left == 1 else 'do'} not count; "
            "below the table stands why."
        )
    return sentences


def _throughout(cast: tuple[Vote, ...]) -> str:
    side, *others = {vote.nearer for vote in cast}
    if others:
        return "Neither is nearer throughout"
    if side is None:
        return "Neither is nearer"
    word = WORDS[side]
    return f"{word[0].upper()}{word[1:]}, throughout"


def _counted(cast: tuple[Vote, ...]) -> str:
    """Sides with the number of their values, and the names of those that are no tie."""
    count = Counter(vote.nearer for vote in cast)
    words = {
        Solver.ELEMENTS: f"{WORDS[Solver.ELEMENTS]} are nearer to the reference in",
        Solver.CELLS: f"{WORDS[Solver.CELLS]} are nearer in",
        None: "tied are",
    }
    names = {side: Counter(_of(vote) for vote in cast if vote.nearer == side) for side in words}
    return "; ".join(
        f"{text} {count[side]}" + ("" if side is None else f": {_listed(names[side])}")
        for side, text in words.items()
        if count[side]
    )


def _of(vote: Vote) -> str:
    return f"{vote.shared.quantity} of {vote.shared.case}"


def _listed(names: Counter[str]) -> str:
    return ", ".join(name if n == 1 else f"{name} ({n} times)" for name, n in names.items())


def silences(shared: Iterable[SharedReference]) -> dict[str, Counter[str]]:
    """Why values have no vote, and in which cases how many."""
    seen: set[object] = set()
    found: dict[str, Counter[str]] = {}
    for pair in shared:
        refined = tuple(one.verdict.refined for one in (pair.cells, pair.elements))
        reasons = [_silence(one) for one in refined if typical_error(one) is None]
        if not reasons and pair.reference in seen:
            reasons = ["the reference votes already"]
        if reasons:
            found.setdefault(reasons[0], Counter()).update([pair.case])
        else:
            seen.add(pair.reference)
    return found


def _silence(refined: RefinedErrors | None) -> str:
    if refined is None:
        return "one of the two on fewer than four levels"
    if not min(refined.per_radius) <= PER_RADIUS <= BEYOND * max(refined.per_radius):
        return "no level near this fineness"
    return f"errors of single runs scatter more than {TELLING:g} times"


def _values(count: int) -> str:
    return f"{count} {'value' if count == 1 else 'values'}"


def nearer_table(cast: tuple[Vote, ...], shared: tuple[SharedReference, ...]) -> Table:
    """Errors of both at one fineness, and which of the shared references could not vote."""
    why = "; ".join(f"{reason}: {_cases(cases)}" for reason, cases in silences(shared).items())
    return Table(
        title=f"Errors at {PER_RADIUS} cells or elements per contact radius",
        columns=("quantity and case", *(f"error, {word}" for word in WORDS.values()), "nearer"),
        rows=tuple(
            (
                vote.shared.name,
                _text(vote.cells),
                _text(vote.elements),
                TIE if vote.nearer is None else WORDS[vote.nearer],
            )
            for vote in cast
        ),
        note="Relative to a reference that neither solver made; read off the line through the "
        "errors of all levels on logarithmic axes, and extrapolated along it by a factor of "
        f"{BEYOND:g} at most. In brackets: where 95 % of single grids or meshes fall. A tie: those "
        "overlap, or the reference is too uncertain to tell. As many cells as elements per radius "
        "are not the same work: cells cover the whole surface, elements a section of a body that "
        "is round. Norms of pressure and shear have no vote: cells are compared at their centres, "
        "elements all along the radius." + (f" Nor have, by case, {why}." if why else ""),
        units=NONE,
    )


def _cases(count: Counter[str]) -> str:
    return ", ".join(f"{case} ({number})" for case, number in count.items())


def _text(error: TypicalError) -> str:
    return f"{plain(error.value, 2)} ({plain(error.low, 2)} to {plain(error.high, 2)})"
