"""The numbers of every contact by both solvers."""

from __future__ import annotations

from verification.cases.both_solvers.contacts import CheckedContact
from verification.cases.both_solvers.differences import COMPARED, Apart, Difference, Found
from verification.cases.both_solvers.sides import ELEMENTS, SIDES, number
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
        columns += [f"Δ{symbol}", f"{symbol}: cells", f"{symbol}: elements", f"{symbol}: nearer"]
    rows = []
    for contact, of in apart.items():
        row = _coordinates(contact)
        for name in COMPARED:
            one = of.get(name)
            row += ["–"] * 4 if one is None else _cells_of(one)
        rows.append(tuple(row))
    return Table(
        title="Differences, with the own error of each side",
        columns=tuple(columns),
        rows=tuple(rows),
        note="Δp over p₀, Δq over µp₀, Δδ relative; behind each the change of that side from half "
        "as many cells or elements, and which side is nearer to the reference.",
        units=NONE,
    )


def reference_table(apart: Apart) -> Table:
    """Errors of both sides where neither made the reference."""
    columns = [*CONTACT]
    for symbol in SYMBOLS:
        columns += [f"{symbol}: cells", f"{symbol}: elements"]
    rows = []
    for contact, of in apart.items():
        errors = {name: one.to_reference for name, one in of.items()}
        if any(error is not None for error in errors.values()):
            row = _coordinates(contact)
            for name in COMPARED:
                error = errors.get(name)
                row += ["–"] * 2 if error is None else [plain(side, 2) for side in error]
            rows.append(tuple(row))
    return Table(
        title="Errors of both sides against references that neither made",
        columns=tuple(columns),
        rows=tuple(rows),
        note="p over p₀, q over µp₀ (its kinks left out), δ relative; the largest at any "
        "radius that is judged.",
        units=NONE,
    )


def number_table(found: Found) -> Table:
    """Radii and energies by both."""
    rows = []
    for contact, record in found.items():
        a, b = (number(record, f"contact_radius_{side}") for side in SIDES)
        row = [*_coordinates(contact), plain(a / b - 1, 2)]
        if contact.friction:
            c, d = (number(record, f"stick_radius_{side}") for side in SIDES)
            scale = NORMAL_FORCE * number(record, f"approach_{ELEMENTS}")
            energies = (number(record, f"dissipated_energy_{side}") / scale for side in SIDES)
            row += [f"{c / a:.4f}", f"{d / b:.4f}", *(plain(energy, 3) for energy in energies)]
        else:
            row += ["–"] * 4
        rows.append(tuple(row))
    return Table(
        title="Radii and energy",
        columns=(*CONTACT, "a, relative difference", "c/a: cells", "c/a: elements",
                 "energy: cells", "energy: elements"),
        rows=tuple(rows),
        note="c the stick radius; energy lost to friction over W δ. Findings, not judged.",
        units=NONE,
    )  # fmt: skip


def _cells_of(one: Difference) -> list[str]:
    return [
        f"{STATUS[one.status]} {plain(one.value, 2)}",
        plain(one.cells, 2),
        plain(one.elements, 2),
        one.nearer,
    ]


def _coordinates(contact: CheckedContact) -> list[str]:
    return [f"{value:g}" for value in (contact.modulus_ratio, contact.thickness, contact.friction)]
