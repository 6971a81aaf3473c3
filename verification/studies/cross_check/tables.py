"""The numbers of every contact."""

from __future__ import annotations

from verification.exhibits.numbers import plain
from verification.exhibits.table import Table
from verification.judging.status_words import SYMBOLS
from verification.problems.paper_scene import NORMAL_FORCE
from verification.studies.cross_check.contacts import Apart, Found
from verification.studies.cross_check.difference import Difference

SYMBOL = {"pressure": "p", "shear": "q", "approach": "δ"}
CONTACT = ("E1/E2", "h / a_H", "µ")


def difference_table(apart: Apart) -> Table:
    """How far the solvers are apart, with the own error of each side."""
    columns = [*CONTACT]
    for symbol in SYMBOL.values():
        columns += [f"Δ{symbol}", f"{symbol}: cells", f"{symbol}: elements", f"{symbol}: nearer"]
    rows = []
    for key, of in apart.items():
        row = [f"{value:g}" for value in key]
        for name in SYMBOL:
            one = of.get(name)
            row += ["–"] * 4 if one is None else _cells_of(one)
        rows.append(tuple(row))
    return Table(
        title="Differences, with the own error of each side",
        columns=tuple(columns),
        rows=tuple(rows),
        note="Δp over p₀, Δq over µp₀, Δδ relative; behind each the change of that side from half "
        "as many cells or elements, and which side is nearer to the reference.",
    )


def reference_table(apart: Apart) -> Table:
    """Errors of both sides where neither made the reference."""
    columns = [*CONTACT]
    for symbol in SYMBOL.values():
        columns += [f"{symbol}: cells", f"{symbol}: elements"]
    rows = []
    for key, of in apart.items():
        errors = {name: one.to_reference for name, one in of.items()}
        if any(error is not None for error in errors.values()):
            row = [f"{value:g}" for value in key]
            for name in SYMBOL:
                error = errors.get(name)
                row += ["–"] * 2 if error is None else [plain(side, 2) for side in error]
            rows.append(tuple(row))
    return Table(
        title="Errors of both sides against references that neither made",
        columns=tuple(columns),
        rows=tuple(rows),
        note="p over p₀, q over µp₀ (its kinks left out), δ relative; the largest at any "
        "radius that is judged.",
    )


def number_table(found: Found) -> Table:
    """Radii and energies by both."""
    rows = []
    for key, record in found.items():
        one, other = record.semi_analytical.numbers, record.finite_elements.numbers
        a, b = one["contact_radius"], other["contact_radius"]
        row = [*(f"{value:g}" for value in key), plain(a / b - 1, 2)]
        if "stick_radius" in one and "stick_radius" in other:
            row += [f"{one['stick_radius'] / a:.4f}", f"{other['stick_radius'] / b:.4f}"]
            scale = NORMAL_FORCE * other["approach"]
            row += [
                plain(side["dissipated_energy"] / scale, 3) if "dissipated_energy" in side else "–"
                for side in (one, other)
            ]
        else:
            row += ["–"] * 4
        rows.append(tuple(row))
    return Table(
        title="Radii and energy",
        columns=(*CONTACT, "a, relative difference", "c/a: cells", "c/a: elements",
                 "energy: cells", "energy: elements"),
        rows=tuple(rows),
        note="c the stick radius; energy lost to friction over W δ. Findings, not judged.",
    )  # fmt: skip


def _cells_of(one: Difference) -> list[str]:
    return [
        f"{SYMBOLS[one.status]} {plain(one.value, 2)}",
        plain(one.semi_analytical, 2),
        plain(one.finite_elements, 2),
        one.nearer,
    ]
