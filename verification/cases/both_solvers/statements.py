"""What the differences say, as statements, and the answer to the study's question."""

from __future__ import annotations

from itertools import combinations

import numpy as np

from verification.cases.apart_everywhere import listed
from verification.cases.both_solvers.contacts import CONTACTS, CheckedContact
from verification.cases.both_solvers.differences import (
    COMPARED,
    COVERAGE,
    Apart,
    Compared,
    Difference,
    Found,
    Pair,
)
from verification.cases.both_solvers.sides import (
    SIDES,
    column,
    judged_radii,
    kept_edges,
    sides_of,
)
from verification.exhibits.numbers import percent, plain
from verification.judging.outcome import Status
from verification.judging.run import SOLVER_TOLERANCE
from verification.running.row import Row
from verification.running.rules import converged
from verification.running.study import Statement


def statements(found: Found, apart: Apart) -> tuple[Statement, ...]:
    """One per quantity, then what the differences are due to."""
    return (
        *(_agreement(compared, apart) for compared in COMPARED.values()),
        _explained(apart),
        _kept(found),
        _left_out(found),
        _nearer(apart),
        _odd(apart),
        converged(
            tuple(found.values()),
            SOLVER_TOLERANCE,
            f"on {len(found)} of {len(CONTACTS)} contacts",
            asked=len(CONTACTS),
        ),
    )


def answer(apart: Apart, fineness: str) -> str:
    """Where the solvers are furthest apart, and which was nearest to references of none.

    fineness  in words
    """
    worst = {name: _worst_contact(name, apart) for name in COMPARED}
    parts = [
        f"{percent(one.value)}{_of(COMPARED[name])} in {name} ({contact.name}, "
        f"{_words(one.furthest)}; their own errors leave ± {percent(COVERAGE * one.joint)})"
        for name, found in worst.items()
        if found is not None
        for contact, one in [found]
    ]
    if not parts:
        return ""
    beyond = sum(one.value > one.required for of in apart.values() for one in of.values())
    asked = (
        "everywhere within what is asked"
        if beyond == 0
        else f"beyond what is asked in {beyond} of {sum(map(len, apart.values()))} comparisons"
    )
    apart_text = (
        f"On {len(apart)} contacts, compared up to 0.9 a, away from the axis and from the kinks of "
        f"the shear, any two of the solvers are at most {listed(parts)} apart, {asked}."
    )
    known = [text for name in COMPARED if (text := _to_reference(name, apart))]
    if not known:
        return apart_text
    return (
        f"{apart_text} Against references that none of them made (with friction these have no "
        f"increments), with {fineness}: {'; '.join(known)}."
    )


def _to_reference(name: str, apart: Apart) -> str:
    """Errors of all sides where none made the reference; empty without one."""
    known = [one for _, one in _known(name, apart)]
    errors = [one.to_reference for one in known if one.to_reference is not None]
    if not errors:
        return ""
    worst = [
        f"{side} at most {percent(max(error[side] for error in errors))} off" for side in errors[0]
    ]
    nearest = [f"{side} on {sum(one.nearer == side for one in known)}" for side in errors[0]]
    return f"{name} on {len(known)} contacts, {listed(worst)} (nearest: {', '.join(nearest)})"


def _known(name: str, apart: Apart) -> list[tuple[CheckedContact, Difference]]:
    """The contacts with a reference that no solver made."""
    return [
        (contact, of[name])
        for contact, of in apart.items()
        if name in of and of[name].to_reference is not None
    ]


def _worst_contact(name: str, apart: Apart) -> tuple[CheckedContact, Difference] | None:
    every = [(contact, of[name]) for contact, of in apart.items() if name in of]
    return max(every, key=lambda item: item[1].value, default=None)


def _of(compared: Compared) -> str:
    return f" of {compared.scale}" if compared.scale else ""


def _agreement(compared: Compared, apart: Apart) -> Statement:
    every = [of[compared.name] for of in apart.values() if compared.name in of]
    worst = max(every, key=lambda one: one.value, default=None)
    statuses = [one.status for one in every]
    counts = {status: statuses.count(status) for status in Status}
    return Statement(
        claim=f"the solvers agree: {compared.meaning}",
        outcome=_worst(statuses),
        measured=f"{counts[Status.PASS]} of {len(every)} contacts within {compared.required:g}"
        f"{_uncertain(every)}, {counts[Status.INCONCLUSIVE]} beyond it but within their own "
        f"errors; largest differences: {_largest(every)}" + _beyond(compared.name, apart),
        because=f"required {compared.required:g}",
        about=Row(
            words={"quantity": compared.name},
            measures={} if worst is None else {"difference": worst.value, "joint": worst.joint},
            counters={str(status): count for status, count in counts.items()},
        ),
    )


def _largest(every: list[Difference]) -> str:
    """Of every two sides, with its uncertainty."""
    found = []
    for pair in every[0].apart if every else ():
        one = max(every, key=lambda other: other.apart[pair])
        uncertain = plain(one.uncertainty(pair), 2)
        found.append(f"{_words(pair)} {plain(one.apart[pair], 2)} ± {uncertain}")
    return ", ".join(found) or "–"


def _words(pair: Pair) -> str:
    return " and ".join(pair)


def _uncertain(every: list[Difference]) -> str:
    """How many are within it though the errors that two sides own up to are not."""
    count = sum(one.status is Status.PASS and one.joint > one.required for one in every)
    return f" ({count} of them with own errors beyond it)" if count else ""


def _beyond(name: str, apart: Apart) -> str:
    """The contacts that are further apart than is required, by name."""
    named = [
        f"{contact.name}: {plain(of[name].value, 2)}"
        for contact, of in apart.items()
        if name in of and of[name].status is not Status.PASS
    ]
    return f"; beyond it: {'; '.join(named)}" if named else ""


def _explained(apart: Apart) -> Statement:
    every = [
        (f"{name} of {contact.name}, {_words(pair)}", one.explains(pair), one.odd)
        for contact, of in apart.items()
        for name, one in of.items()
        for pair in one.apart
    ]
    other = [f"{what} (odd: {odd})" for what, explained, odd in every if not explained]
    return Statement(
        claim="the errors that the sides own up to explain the differences",
        outcome=None,
        measured=f"{len(every) - len(other)} of {len(every)} differences within {COVERAGE:g} joint "
        f"uncertainties{'; not ' if other else ''}{'; '.join(other)}",
        because="a finding: where they do not, an error does not fall with refinement, or the "
        "coarse and the fine answer agree by chance",
    )


def _kept(found: Found) -> Statement:
    turned = {contact: kept_edges(record)[:-1] for contact, record in found.items()}
    named = [
        f"{contact.name}: at {listed([f'{edge:.3f}' for edge in edges])} a"
        for contact, edges in turned.items()
        if edges
    ]
    return Statement(
        claim="where the shear keeps a kink inside the edge of stick",
        outcome=None,
        measured="; ".join(named) or "nowhere",
        because="a finding: pressing on, stick came back to there before it spread outward again. "
        "How far it comes back follows from the coating, not from cells, elements or increments",
    )


def _left_out(found: Found) -> Statement:
    """The largest difference of shear that no verdict sees."""
    apart = {
        (contact, pair): float(
            np.max(
                np.abs(np.subtract(*(column(record, f"shear_{side}") for side in pair))),
                where=~judged_radii(record)[1],
                initial=0.0,
            )
        )
        for contact, record in found.items()
        for pair in combinations(sides_of(record), 2)
    }
    worst = max(apart, key=lambda of: apart[of], default=None)
    return Statement(
        claim="how far apart they are in the shear at its kinks, where it is not judged",
        outcome=None,
        measured="nowhere left out"
        if worst is None or apart[worst] == 0
        else f"at most {plain(apart[worst], 2)} of µp₀ ({worst[0].name}, {_words(worst[1])})",
        because="a finding: cells and elements round a kink, each in its way; nearer to the axis "
        "than two cells or elements and beyond 0.9 a nothing is compared at all",
    )


def _nearer(apart: Apart) -> Statement:
    return Statement(
        claim="which side is nearest to a reference that none of them made",
        outcome=None,
        measured=_counted(
            {name: [one.nearer for _, one in _known(name, apart)] for name in COMPARED}
        ),
        because="a finding, at these finenesses",
    )


def _odd(apart: Apart) -> Statement:
    """Of three columns that differ, which one is wrong."""
    return Statement(
        claim="which side the two that are nearest to each other leave alone",
        outcome=None,
        measured=_counted(
            {name: [of[name].odd for of in apart.values() if name in of] for name in COMPARED}
        ),
        because="a finding, at these finenesses: most of a difference is its error",
    )


def _counted(found: dict[str, list[str | None]]) -> str:
    return "; ".join(
        f"{name}: " + ", ".join(f"{side} {sides.count(side)}" for side in SIDES)
        for name, sides in found.items()
    )


def _worst(statuses: list[Status]) -> Status:
    for status in (Status.FAIL, Status.INCONCLUSIVE):
        if status in statuses:
            return status
    return Status.PASS if statuses else Status.INCONCLUSIVE
