"""Tables and charts of the contacts by both solvers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from verification.cases.cross_check_sides import Sides
from verification.cases.cross_check_stress import stress_of_section
from verification.exhibits.chart import Chart, Curve, Look, Panel, curve
from verification.exhibits.numbers import plain
from verification.exhibits.table import Table


def tables(sides: Sequence[Sides], results: Mapping[str, Any]) -> tuple[Table, ...]:
    """Which solver is nearer to a reference that neither made, contact by contact."""
    rows = []
    for one in sides:
        pair = results[one.on_cells[1].label], results[one.on_elements[1].label]
        radii = one.contact.radii(one.elements // 2, one.cells)
        known = one.contact.reference(radii)
        approach = one.contact.reference_approach
        row = [one.contact.name]
        for result in pair:
            if known is None or approach is None:
                row += ["–"] * 3
                continue
            found = one.profiles(result, radii)
            row.append(plain(float(np.max(np.abs(found.pressure - known.pressure))), 2))
            row.append(plain(float(np.max(np.abs(found.shear - known.shear))), 2))
            row.append(plain(abs(result.steps[-1].approach / approach - 1), 2))
        rows.append(tuple(row))
    return (
        Table(
            title="Which is nearer to a reference that neither made",
            columns=("contact", "p: cells", "q: cells", "δ: cells", "p: elements", "q: elements",
                     "δ: elements"),
            rows=tuple(rows),
            note="Largest errors over p₀, µp₀ (the edge of stick included) and relative; with "
            "friction the reference has no increments.",
        ),
    )  # fmt: skip


def charts(sides: Sequence[Sides], results: Mapping[str, Any]) -> tuple[Chart, ...]:
    """Tractions of every contact, and the stress below the first."""
    rows: list[tuple[Panel, ...]] = []
    for one in sides:
        pair = results[one.on_cells[1].label], results[one.on_elements[1].label]
        r = one.contact.radii(one.elements // 2, one.cells)
        on_cells, on_elements = (one.profiles(result, r) for result in pair)
        rows.append((
            _panel(one, r, (on_cells.pressure, on_elements.pressure), "p / p₀", len(rows)),
            _panel(one, r, (on_cells.shear, on_elements.shear), "q / µp₀", len(rows)),
        ))  # fmt: skip
    return (
        Chart(
            name="cross_check_profiles",
            title="Tractions by both solvers",
            caption="Pressure (left) and outward shear (right) over the radius: finite elements in "
            "grey, cells on top of them, for each contact of the case.",
            rows=tuple(rows),
        ),
        stress_of_section(sides[0].contact, results[sides[0].on_cells[1].label],
                          results[sides[0].on_elements[1].label]),
    )  # fmt: skip


def _panel(one: Sides, r: Any, values: tuple[Any, Any], label: str, row: int) -> Panel:
    curves: list[Curve] = [
        curve("elements" if row == 0 else "", r, values[1], Look.REFERENCE),
        curve("cells" if row == 0 else "", r, values[0]),
    ]
    return Panel(
        x_label="r / a",
        y_label=label,
        curves=tuple(curves),
        title=one.contact.name if label.startswith("p") else "",
        height=1.4,
    )
