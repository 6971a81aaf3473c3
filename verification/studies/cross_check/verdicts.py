"""What the differences say, as statements, and the answer to the study's question."""

from __future__ import annotations

from verification.exhibits.numbers import plain
from verification.judging.outcome import Status
from verification.judging.run import SOLVER_TOLERANCE
from verification.running.study import Statement
from verification.studies.cross_check.contacts import (
    Apart,
    Found,
    Key,
    contact_text,
    expected_contacts,
)
from verification.studies.cross_check.difference import (
    CELLS,
    COVERAGE,
    ELEMENTS,
    REQUIRED,
    Difference,
)

MEANINGS = {
    "pressure": "pressure, r < 0.9 a, over p₀",
    "shear": "shear, r < 0.9 a and away from its kinks, over µp₀",
    "approach": "approach, relative",
}
UNITS = {"pressure": " of p₀", "shear": " of µp₀", "approach": ""}


def statements(found: Found, apart: Apart) -> tuple[Statement, ...]:
    """One per quantity, then what the differences are due to."""
    return (
        *(_agreement(name, apart) for name in REQUIRED),
        _explained(apart),
        _kept(found),
        _left_out(found),
        _nearer(apart),
        _converged(found),
    )


def answer(apart: Apart, fineness: str) -> str:
    """Where the solvers are furthest apart, and which was nearer to references of neither.

    fineness  of both solvers, in words
    """
    worst = {name: _worst_contact(name, apart) for name in REQUIRED}
    parts = [
        f"{_percent(one.value)}{UNITS[name]} in {name} ({contact_text(key)}; their own errors "
        f"leave ± {_percent(COVERAGE * one.joint)})"
        for name, found in worst.items()
        if found is not None
        for key, one in [found]
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
        f"the shear, they are at most {_listed(parts)} apart, {asked}."
    )
    known = [text for name in REQUIRED if (text := _to_reference(name, apart))]
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
        f"{name} on {len(known)} contacts, {CELLS} at most {_percent(cells)} off and {ELEMENTS} "
        f"{_percent(elements)} ({CELLS} nearer on {nearer}, {ELEMENTS} on {len(known) - nearer})"
    )


def _known(name: str, apart: Apart) -> list[tuple[Key, Difference]]:
    """The contacts with a reference that neither solver made."""
    return [
        (key, of[name])
        for key, of in apart.items()
        if name in of and of[name].to_reference is not None
    ]


def _worst_contact(name: str, apart: Apart) -> tuple[Key, Difference] | None:
    every = [(key, of[name]) for key, of in apart.items() if name in of]
    return max(every, key=lambda item: item[1].value, default=None)


def _agreement(name: str, apart: Apart) -> Statement:
    every = [of[name] for of in apart.values() if name in of]
    worst = max(every, key=lambda one: one.value, default=None)
    statuses = [one.status for one in every]
    counts = {status: statuses.count(status) for status in Status}
    return Statement(
        claim=f"both solvers agree: {MEANINGS[name]}",
        outcome=_worst(statuses),
        measured=f"{counts[Status.PASS]} of {len(every)} contacts within {REQUIRED[name]:g}"
        f"{_uncertain(every)}, {counts[Status.INCONCLUSIVE]} beyond it but within their own "
        "errors; largest difference "
        + ("–" if worst is None else f"{plain(worst.value, 2)} ± {plain(worst.joint, 2)}")
        + _beyond(name, apart),
        because=f"required {REQUIRED[name]:g}",
    )


def _uncertain(every: list[Difference]) -> str:
    """How many are within it though the errors that both sides own up to are not."""
    count = sum(one.status is Status.PASS and one.joint > one.required for one in every)
    return f" ({count} of them with own errors beyond it)" if count else ""


def _beyond(name: str, apart: Apart) -> str:
    """The contacts that are further apart than is required, by name."""
    named = [
        f"{contact_text(key)}: {plain(of[name].value, 2)}"
        for key, of in apart.items()
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
    turned = {key: record.stick_edges[:-1] for key, record in found.items()}
    named = [
        f"{contact_text(key)}: at {_listed([f'{edge:.3f}' for edge in edges])} a"
        for key, edges in turned.items()
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
        key: max(
            (
                abs(one - other)
                for one, other, judged in zip(
                    record.semi_analytical.shear, record.finite_elements.shear,
                    record.shear_judged, strict=True,
                )
                if not judged
            ),
            default=0.0,
        )
        for key, record in found.items()
    }  # fmt: skip
    worst = max(apart, key=lambda key: apart[key], default=None)
    return Statement(
        claim="how far apart both are in the shear at its kinks, where it is not judged",
        outcome=None,
        measured="nowhere left out"
        if worst is None or apart[worst] == 0
        else f"at most {plain(apart[worst], 2)} of µp₀ ({contact_text(worst)})",
        because="a finding: cells and elements round a kink, each in its way; nearer to the axis "
        "than two cells or elements and beyond 0.9 a nothing is compared at all",
    )


def _nearer(apart: Apart) -> Statement:
    parts = []
    for name in REQUIRED:
        known = _known(name, apart)
        cells = sum(one.nearer == CELLS for _, one in known)
        parts.append(f"{name}: {CELLS} {cells}, {ELEMENTS} {len(known) - cells}")
    return Statement(
        claim="which side is nearer to a reference that neither made",
        outcome=None,
        measured="; ".join(parts),
        because="a finding, at these finenesses",
    )


def _converged(found: Found) -> Statement:
    worst = max(
        (s.residual for r in found.values() for s in (r.semi_analytical, r.finite_elements)),
        default=0.0,
    )
    expected = len(expected_contacts())
    good = Status.PASS if worst <= SOLVER_TOLERANCE else Status.FAIL
    return Statement(
        claim="every increment converged",
        outcome=good if len(found) == expected else Status.INCONCLUSIVE,
        measured=f"largest residual {plain(worst, 2)}; {len(found)} of {expected} contacts",
        because=f"allowed {SOLVER_TOLERANCE:g}",
    )


def _worst(statuses: list[Status]) -> Status:
    for status in (Status.FAIL, Status.INCONCLUSIVE):
        if status in statuses:
            return status
    return Status.PASS if statuses else Status.INCONCLUSIVE


def _percent(value: float) -> str:
    return f"{plain(100 * value, 2)} %"


def _listed(parts: list[str]) -> str:
    """With commas, and a word before the last."""
    return parts[0] if len(parts) == 1 else f"{', '.join(parts[:-1])} and {parts[-1]}"
