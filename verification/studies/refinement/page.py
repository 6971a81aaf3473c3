"""What a refinement study shows: statements, tables, charts and files."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Mapping, Sequence

from verification.cases.chart import Chart, Curve, Look, Panel, curve
from verification.cases.outcome import Status
from verification.cases.table import Table
from verification.convergence import ORDER_WIDTH, TRIPLETS_AGREE
from verification.quantities import unit_of
from verification.report.numbers import plain, value_text
from verification.studies.refinement.expected import SHEAR
from verification.studies.refinement.fit import FEWEST_JUDGED, Fit
from verification.studies.refinement.level_record import LevelRecord
from verification.studies.running.study import Statement

NOTE_AT = 0.06  # part of a slope line, from its finer end
BELOW = 0.5  # slope lines run under the data, by this factor
RULE = (
    f"An order is judged from {FEWEST_JUDGED} levels on, where its 95 % interval is no wider than "
    f"± {ORDER_WIDTH:g} and the orders by two triplets of levels, about a factor of two apart "
    f"where there are enough, differ by no more than {TRIPLETS_AGREE:g}; else it is inconclusive. "
    "So is an order that is not the expected one but comes nearer to it with refinement."
)
LIMITS = (
    RULE,
    "The limit is Richardson's value with the expected order, by least squares over all levels; "
    "its uncertainty is the scatter of the fit together with the limits that the two finest levels "
    "and the observed order give.",
    "The shear is a field: shown is its change to the next finer level, Σ|Δq| / Σµp. The limit of "
    "one kind of refinement still has the error of the other kind.",
)


def statement(fit: Fit) -> Statement:
    """The verdict on one quantity."""
    because = "no order is expected here: reported, not judged"
    if fit.expected is not None:
        because = f"expected {fit.expected.order:g}: {fit.expected.because}"
    return Statement(
        claim=f"order of the {label(fit.name)}",
        outcome=fit.status,
        measured=f"{order_text(fit)}; by triplets {_triplets(fit)}; left on the finest level "
        f"{plain(fit.remaining, 2)}",
        because=because,
    )


def converged(records: Sequence[LevelRecord], tolerance: float) -> Statement:
    """Whether every increment of every level ended within the tolerance."""
    worst = max(record.largest_residual for record in records)
    return Statement(
        claim="every increment converged",
        outcome=Status.PASS if worst <= tolerance else Status.FAIL,
        measured=f"largest residual {plain(worst, 2)} on {len(records)} levels",
        because=f"allowed {tolerance:g}",
    )


def label(name: str) -> str:
    """A quantity in words."""
    if name == SHEAR:
        return "shear (L1)"
    stem, _, axis = name.rpartition("_")
    return f"{stem} along {axis}".replace("_", " ") if axis in "xy" else name.replace("_", " ")


def unit_of_fit(fit: Fit) -> str | None:
    """The unit of a scalar; None for a field."""
    return None if fit.name == SHEAR else unit_of(fit.name)


def order_text(fit: Fit) -> str:
    """An observed order with its interval."""
    if fit.observed is None:
        return "no order explains the values"
    return f"{fit.observed.order:.2f} ± {fit.observed.half_width:.2f}"


def order_table(fits: Sequence[Fit]) -> Table:
    """One row per quantity."""
    return Table(
        title="Orders and limits",
        columns=(
            "quantity", "finest", "limit", "uncertainty", "left on the finest", "observed order",
            "by triplets", "expected",
        ),
        rows=tuple(
            (
                label(fit.name), _in_unit(fit, fit.finest), _in_unit(fit, fit.limit),
                _in_unit(fit, fit.uncertainty, 2), plain(fit.remaining, 2), order_text(fit),
                _triplets(fit), f"{fit.expected.order:g}" if fit.expected else "–",
            )
            for fit in fits
        ),
        note="Left on the finest: relative to the value, for components to the vector, for the "
        "shear to Σµp.",
    )  # fmt: skip


def level_table(records: Sequence[LevelRecord], fits: Sequence[Fit]) -> Table:
    """One row per level, coarse to fine."""
    names = [fit.name for fit in fits if fit.name != SHEAR]
    shear = next((fit for fit in fits if fit.name == SHEAR), None)
    changes = [*(shear.errors if shear else ())]
    rows = []
    for number, record in enumerate(records):
        change = plain(changes[number], 3) if number < len(changes) else "–"
        rows.append((
            f"{record.cells[0]} x {record.cells[1]}", str(sum(record.increments)),
            *(value_text(record.values[name], unit_of(name)) for name in names),
            *([change] if shear else []), plain(record.largest_residual, 2),
            str(record.convolutions) if record.convolutions is not None else "–",
        ))  # fmt: skip
    heads = [label(name) for name in names] + (["change of shear"] if shear else [])
    return Table(
        title="Levels",
        columns=("cells", "increments", *heads, "largest residual", "convolutions"),
        rows=tuple(rows),
    )


def error_chart(name: str, x_label: str, fits: Sequence[Fit], unit: float) -> Chart:
    """Errors against refinement.

    unit  what sizes are divided by on the axis
    """
    shapes = [fit for fit in fits if unit_of_fit(fit) in ("m", "rad")]
    loads = [fit for fit in fits if fit not in shapes]
    groups = [("motion and radii", shapes), ("tractions, loads, energy", loads)]
    panels = [(_panel(title, group, unit),) for title, group in groups if group]
    panels[-1] = (panels[-1][0].model_copy(update={"x_label": x_label}),)
    return Chart(
        name=name,
        title="Errors under refinement",
        caption="Distance from the limit, relative to it; for the shear the change to the next "
        "finer level over Σµp. Dashed, with their orders: the slopes that are expected. A "
        "scalar's error on the finest level rests on the extrapolation and is the least certain.",
        rows=tuple(panels),
    )


def _panel(title: str, fits: Sequence[Fit], unit: float) -> Panel:
    curves: list[Curve] = []
    for series, fit in enumerate(fits):
        points = [(h / unit, e) for h, e in zip(fit.sizes, fit.errors, strict=True) if e > 0]
        x, y = ([point[k] for point in points] for k in (0, 1))
        curves.append(curve(label(fit.name), x, y, Look.POINTS, series))
    orders = sorted({fit.expected.order for fit in fits if fit.expected})
    slopes = _slopes(curves, orders)
    return Panel(
        x_label="",
        y_label="relative error",
        curves=(*curves, *slopes),
        title=title,
        logarithmic=True,
        height=2.2,
        notes=tuple((*_inside(s), f"{p:g}") for s, p in zip(slopes, orders, strict=True)),
    )


def _slopes(curves: Sequence[Curve], orders: Sequence[float]) -> list[Curve]:
    """Lines of the expected slopes below the points of the coarsest level, where they meet."""
    if not curves:
        return []
    left, right = min(min(c.x) for c in curves), max(max(c.x) for c in curves)
    top = BELOW * min(c.y[0] for c in curves)
    return [
        curve("", [right, left], [top, top * (left / right) ** order], Look.BOUND)
        for order in orders
    ]


def _inside(line: Curve) -> tuple[float, float]:
    """A point of a slope near its finer end."""
    (right, left), (high, low) = line.x, line.y
    x, y = (fine * (coarse / fine) ** NOTE_AT for coarse, fine in ((right, left), (high, low)))
    return x, y


def level_csv(records: Sequence[LevelRecord], fits: Sequence[Fit]) -> str:
    """All scalars on all levels, in SI, and the change of the shear to the next level."""
    shear = next((fit for fit in fits if fit.name == SHEAR), None)
    changes = [*(shear.errors if shear else ())]
    names = list(records[-1].values)
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    units = [f"{name} [{unit_of(name)}]" for name in names]
    table.writerow(["cells_x", "cells_y", "increments", "size", *units, "shear_change [1]"])
    for number, record in enumerate(records):
        values = [record.values.get(name) for name in names]
        change = changes[number] if number < len(changes) else None
        table.writerow([*record.cells, sum(record.increments), record.size, *values, change])
    return text.getvalue()


def order_json(fits: Sequence[Fit]) -> str:
    """Orders and limits, in SI."""
    return json.dumps({fit.name: _values(fit) for fit in fits}, indent=1) + "\n"


def _values(fit: Fit) -> Mapping[str, object]:
    return {
        "unit": unit_of_fit(fit) or "1",
        "finest": fit.finest,
        "limit": fit.limit,
        "uncertainty": fit.uncertainty,
        "left_on_finest": fit.remaining,
        "order": None if fit.observed is None else fit.observed.order,
        "half_width": None if fit.observed is None else fit.observed.half_width,
        "triplets": fit.triplets,
        "expected": None if fit.expected is None else fit.expected.order,
        "because": None if fit.expected is None else fit.expected.because,
        "status": fit.status,
        "sizes": fit.sizes,
        "errors": fit.errors,
    }


def _triplets(fit: Fit) -> str:
    return ", ".join("–" if order is None else f"{order:.2f}" for order in fit.triplets)


def _in_unit(fit: Fit, value: float | None, digits: int = 7) -> str:
    return "–" if value is None else value_text(value, unit_of(fit.name), digits)
