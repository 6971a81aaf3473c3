"""The numbers of every contact by all solvers."""

from __future__ import annotations

from verification.cases.both_solvers.contacts import CheckedContact
from verification.cases.both_solvers.differences import COMPARED, Apart, Difference, Found
from verification.cases.both_solvers.sides import ELEMENTS, SIDES, number, sides_of
from verification.exhibits.numbers import plain
from verification.exhibits.table import NONE, Table
from verification.judging.status_words import SYMBOLS as STATUS
from verification.problems.paper_scene import NORMAL_FORCE

SYMBOLS = tuple(compared.symbol for compared in COMPARED.values())
CONTACT = ("E1/E2", "h / a_H", "µ")


def difference_table(apart: Apart) -> Table:
    """How far the solvers are apart, with the own error of each side."""
    columns = [*CONTACT]
    for symbol in SYMBOLS:
        columns += [f"Δ{symbol}", *(f"{symbol}: {side}" for side in SIDES), f"{symbol}: odd"]
    rows = []
    for contact, of in apart.items():
        row = _coordinates(contact)
        for name in COMPARED:
            one = of.get(name)
            row += ["–"] * (2 + len(SIDES)) if one is None else _cells_of(one)
        rows.append(tuple(row))
    return Table(
        title="Largest differences, with the own error of each side",
        columns=tuple(columns),
        rows=tuple(rows),
        note="Δp over p₀, Δq over µp₀, Δδ relative, of the two that are furthest apart; behind "
        "each the change of every side from half as many cells, elements or rings, and which side "
        "the other two, nearest to each other, leave alone.",
        units=NONE,
    )


def reference_table(apart: Apart) -> Table:
    """Errors of the sides where none made the reference."""
    every = [one for of in apart.values() for one in of.values() if one.to_reference]
    sides = [side for side in SIDES if every and side in every[0].own]
    columns = [*CONTACT, *(f"{symbol}: {side}" for symbol in SYMBOLS for side in sides)]
    rows = []
    for contact, of in apart.items():
        errors = {name: one.to_reference for name, one in of.items()}
        if any(error is not None for error in errors.values()):
            row = _coordinates(contact)
            for name in COMPARED:
                error = errors.get(name)
                row += [plain(error[side], 2) if error else "–" for side in sides]
            rows.append(tuple(row))
    return Table(
        title="Errors of the sides against references that none of them made",
        columns=tuple(columns),
        rows=tuple(rows),
        note="p over p₀, q over µp₀ (its kinks left out), δ relative; the largest at any "
        "radius that is judged.",
        units=NONE,
    )


def number_table(found: Found) -> Table:
    """Radii and energies by all."""
    rows = []
    for contact, record in found.items():
        radii = {side: number(record, f"contact_radius_{side}") for side in sides_of(record)}
        least, most = min(radii.values()), max(radii.values())
        row = [*_coordinates(contact), plain(most / least - 1, 2)]
        scale = NORMAL_FORCE * number(record, f"approach_{ELEMENTS}")
        for name in ("stick_radius", "dissipated_energy"):
            for side, a in radii.items():
                if not contact.friction:
                    row.append("–")
                    continue
                value = number(record, f"{name}_{side}")
                row.append(
                    f"{value / a:.4f}" if name == "stick_radius" else plain(value / scale, 3)
                )
        rows.append(tuple(row))
    return Table(
        title="Radii and energy",
        columns=(*CONTACT, "a, largest relative difference", *(f"c/a: {side}" for side in SIDES),
                 *(f"energy: {side}" for side in SIDES)),
        rows=tuple(rows),
        note="c the stick radius; energy lost to friction over W δ. Findings, not judged.",
        units=NONE,
    )  # fmt: skip


def _cells_of(one: Difference) -> list[str]:
    return [
        f"{STATUS[one.status]} {plain(one.value, 2)}",
        *(plain(error, 2) for error in one.own.values()),
        one.odd or "–",
    ]


def _coordinates(contact: CheckedContact) -> list[str]:
    return [f"{value:g}" for value in (contact.modulus_ratio, contact.thickness, contact.friction)]
