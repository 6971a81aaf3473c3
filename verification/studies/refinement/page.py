"""What a refinement study shows: statements, tables, charts and files."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Mapping, Sequence

from contact_results.quantities import unit_of
from verification.convergence.level_record import PRESSURE, SHEAR, LevelRecord
from verification.convergence.observed_order import (
    ILLEGIBLE,
    ORDER_OFF,
    ORDER_WIDTH,
    TRIPLETS_AGREE,
)
from verification.exhibits.chart import Chart, Curve, Look, Panel, curve
from verification.exhibits.numbers import plain, value_text
from verification.exhibits.table import Table
from verification.judging.outcome import Status
from verification.running.study import Statement
from verification.studies.refinement.fit import (
    APPROACHING,
    FEWEST_JUDGED,
    NEARING,
    Fit,
    field_changes,
)

NOTE_AT = 0.06  # part of a slope line, from its finer end
BELOW = 0.5  # slope lines run under the data, by this factor
RULE = (
    f"An order is judged from {FEWEST_JUDGED} levels on, where its 95 % interval is no wider than "
    f"± {ORDER_WIDTH:g} and the orders by two triplets of levels, about a factor of two apart "
    f"where there are enough, differ by no more than {TRIPLETS_AGREE:g}; else it is inconclusive. "
    f"The expected order lies within the interval or {ORDER_OFF:g} of the observed one, or what is "
    "said with it. Where the "
    f"finer triplet comes nearer to it by {APPROACHING:.0%} and more, {NEARING:g} is near enough. "
    f"None is read off levels whose interval is ± {ILLEGIBLE:g} or wider."
)
LIMITS = (
    RULE,
    "The limit is Richardson's value with the expected order, by least squares over all levels; "
    "its uncertainty is the scatter of the fit together with the limits that the two finest levels "
    "and the observed order give.",
    "Pressure and shear are fields: shown is their change to the next level, Σ|Δp| / Σp and "
    "Σ|Δq| / Σµp. The limit of one kind of refinement still has the error of the others.",
)


def statement(fit: Fit, to_try: str) -> Statement:
    """The verdict on one quantity.

    to_try  what may help where it is inconclusive
    """
    because = "no order is expected here: reported, not judged"
    if fit.expected is not None:
        because = f"expected {fit.expected.order:g}: {fit.expected.because}"
    return Statement(
        claim=f"order of the {label(fit.name)}",
        outcome=fit.status,
        measured=f"{order_text(fit)}{_by_triplets(fit)}; left on the finest level "
        f"{plain(fit.remaining, 2)}{_not_judged(fit, to_try)}",
        because=because,
    )


def _not_judged(fit: Fit, to_try: str) -> str:
    """Why a verdict is inconclusive, and what to do about it."""
    if fit.status is not Status.INCONCLUSIVE:
        return ""
    return f"; not judged: {fit.unsettled}; try {to_try}"


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
    if name in (PRESSURE, SHEAR):
        return f"{name} (L1)"
    stem, _, axis = name.rpartition("_")
    return f"{stem} along {axis}".replace("_", " ") if axis in "xy" else name.replace("_", " ")


def unit_of_fit(fit: Fit) -> str | None:
    """The unit of a scalar; None for a field."""
    return None if fit.is_field else unit_of(fit.name)


def order_text(fit: Fit) -> str:
    """An observed order with its interval."""
    if fit.observed is None:
        return "no order can be read"
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
        note="Left on the finest: relative to the value, for components to the vector, for "
        "fields to Σp or Σµp.",
    )  # fmt: skip


def level_table(records: Sequence[LevelRecord], names: Sequence[str]) -> Table:
    """One row per level, in their order.

    names  of the scalars that are shown
    """
    fields, counted = records[-1].fields, records[-1].work
    rows = []
    for number, record in enumerate(records):
        changes = (field_changes(field, records[number : number + 2]) for field in fields)
        rows.append((
            record.level, str(sum(record.increments)),
            *(value_text(record.values[name], unit_of(name)) for name in names),
            *(plain(change[0], 3) if change else "–" for change in changes),
            plain(record.largest_residual, 2), *(str(record.work[kind]) for kind in counted),
        ))  # fmt: skip
    heads = [label(name) for name in names] + [f"change of {field}" for field in fields]
    return Table(
        title="Levels",
        columns=("level", "increments", *heads, "largest residual", *counted),
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
        caption="Distance from the limit, relative to it; for pressure and shear the change to "
        "the next level over Σp or Σµp. Dashed, with their orders: the slopes that are expected. A "
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


def level_csv(records: Sequence[LevelRecord]) -> str:
    """All scalars on all levels, in SI, the changes of the fields to the next level, and what was
    counted."""
    names, fields, counted = records[-1].values, records[-1].fields, records[-1].work
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    units = [f"{name} [{unit_of(name)}]" for name in names]
    changes = [f"{field}_change [1]" for field in fields]
    table.writerow(["level", "increments", "size", *units, *changes, *counted])
    for number, record in enumerate(records):
        table.writerow([
            record.level, sum(record.increments), record.size,
            *(record.values.get(name) for name in names),
            *(next(iter(field_changes(f, records[number : number + 2])), None) for f in fields),
            *(record.work[kind] for kind in counted),
        ])  # fmt: skip
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
        "unsettled": fit.unsettled,
        "expected": None if fit.expected is None else fit.expected.order,
        "because": None if fit.expected is None else fit.expected.because,
        "status": fit.status,
        "sizes": fit.sizes,
        "errors": fit.errors,
    }


def _by_triplets(fit: Fit) -> str:
    return "" if fit.observed is None else f"; by triplets {_triplets(fit)}"


def _triplets(fit: Fit) -> str:
    if fit.observed is None:
        return "–"
    return ", ".join("–" if order is None else f"{order:.2f}" for order in fit.triplets)


def _in_unit(fit: Fit, value: float | None, digits: int = 7) -> str:
    return "–" if value is None else value_text(value, unit_of(fit.name), digits)
