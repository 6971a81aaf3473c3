"""What the differences say, as statements, and the answer to the study's question."""

from __future__ import annotations

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
)
from verification.cases.both_solvers.sides import (
    CELLS,
    ELEMENTS,
    column,
    judged_radii,
    kept_edges,
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
        converged(
            tuple(found.values()),
            SOLVER_TOLERANCE,
            f"on {len(found)} of {len(CONTACTS)} contacts",
            asked=len(CONTACTS),
        ),
    )


def answer(apart: Apart, fineness: str) -> str:
    """Where the solvers are furthest apart, and which was nearer to references of neither.

    fineness  of both solvers, in words
    """
    worst = {name: _worst_contact(name, apart) for name in COMPARED}
    parts = [
        f"{percent(one.value)}{_of(COMPARED[name])} in {name} ({contact.name}; their own errors "
        f"leave ± {percent(COVERAGE * one.joint)})"
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
        f"the shear, they are at most {listed(parts)} apart, {asked}."
    )
    known = [text for name in COMPARED if (text := _to_reference(name, apart))]
    if not known:
        return apart_text
    return (
        f"{apart_text} Against references that neither made (with friction these have no "
        f"increments), with {fineness}: {'; '.join(known)}."
    )


def _to_reference(name: str, apart: Apart) -> str:
    """Errors of both sides where neither made the reference; empty without one."""
    known = [one for _, one in _known(name, apart)]
    errors = [one.to_reference for one in known if one.to_reference is not None]
    if not errors:
        return ""
    cells, elements = (max(error[side] for error in errors) for side in (0, 1))
    nearer = sum(one.nearer == CELLS for one in known)
    return (
        f"{name} on {len(known)} contacts, {CELLS} at most {percent(cells)} off and {ELEMENTS} "
        f"{percent(elements)} ({CELLS} nearer on {nearer}, {ELEMENTS} on {len(known) - nearer})"
    )


def _known(name: str, apart: Apart) -> list[tuple[CheckedContact, Difference]]:
    """The contacts with a reference that neither solver made."""
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
        claim=f"both solvers agree: {compared.meaning}",
        outcome=_worst(statuses),
        measured=f"{counts[Status.PASS]} of {len(every)} contacts within {compared.required:g}"
        f"{_uncertain(every)}, {counts[Status.INCONCLUSIVE]} beyond it but within their own "
        "errors; largest difference "
        + ("–" if worst is None else f"{plain(worst.value, 2)} ± {plain(worst.joint, 2)}")
        + _beyond(compared.name, apart),
        because=f"required {compared.required:g}",
        about=Row(
            words={"quantity": compared.name},
            measures={} if worst is None else {"difference": worst.value, "joint": worst.joint},
            counters={str(status): count for status, count in counts.items()},
        ),
    )


def _uncertain(every: list[Difference]) -> str:
    """How many are within it though the errors that both sides own up to are not."""
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
    every = [one for of in apart.values() for one in of.values()]
    explained = sum(one.is_explained for one in every)
    return Statement(
        claim="the errors that both sides own up to explain the differences",
        outcome=None,
        measured=f"{explained} of {len(every)} differences within {COVERAGE:g} joint uncertainties",
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
        contact: float(
            np.max(
                np.abs(column(record, f"shear_{CELLS}") - column(record, f"shear_{ELEMENTS}")),
                where=~judged_radii(record)[1],
                initial=0.0,
            )
        )
        for contact, record in found.items()
    }
    worst = max(apart, key=lambda contact: apart[contact], default=None)
    return Statement(
        claim="how far apart both are in the shear at its kinks, where it is not judged",
        outcome=None,
        measured="nowhere left out"
        if worst is None or apart[worst] == 0
        else f"at most {plain(apart[worst], 2)} of µp₀ ({worst.name})",
        because="a finding: cells and elements round a kink, each in its way; nearer to the axis "
        "than two cells or elements and beyond 0.9 a nothing is compared at all",
    )


def _nearer(apart: Apart) -> Statement:
    parts = []
    for name in COMPARED:
        known = _known(name, apart)
        cells = sum(one.nearer == CELLS for _, one in known)
        parts.append(f"{name}: {CELLS} {cells}, {ELEMENTS} {len(known) - cells}")
    return Statement(
        claim="which side is nearer to a reference that neither made",
        outcome=None,
        measured="; ".join(parts),
        because="a finding, at these finenesses",
    )


def _worst(statuses: list[Status]) -> Status:
    for status in (Status.FAIL, Status.INCONCLUSIVE):
        if status in statuses:
            return status
    return Status.PASS if statuses else Status.INCONCLUSIVE
