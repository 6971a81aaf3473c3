"""What a refinement study shows: statements, tables, charts and files."""

from __future__ import annotations

from collections.abc import Sequence

from verification.convergence.observed_order import (
    ILLEGIBLE,
    ORDER_OFF,
    ORDER_WIDTH,
    TRIPLETS_AGREE,
)
from verification.convergence.stored_field import PRESSURE, SHEAR
from verification.exhibits.chart import Chart, Curve, Look, Panel, curve, stacked
from verification.exhibits.log_chart import drawable, point_curves
from verification.exhibits.numbers import plain, value_text
from verification.exhibits.table import Table, table_of
from verification.judging.outcome import Status
from verification.quantities import unit_of
from verification.running.row import CaseRecord, Row
from verification.running.row_views import Text, number
from verification.running.rules import RESIDUAL
from verification.running.study import Statement
from verification.studies.refinement.fit import (
    APPROACHING,
    FEWEST_JUDGED,
    NEARING,
    Fit,
    field_changes,
)
from verification.studies.refinement.level_row import INCREMENTS, work_of

NOTE_AT = 0.06  # part of a slope line, from its finer end
BELOW = 0.5  # slope lines run under the data, by this factor
RULE = (
    f"An order is judged from {FEWEST_JUDGED} levels on, where its 95 % interval is no wider than "
    f"± {ORDER_WIDTH:g} and the orders by two triplets of levels, about a factor of two apart "
    f"where there are enough, differ by no more than {TRIPLETS_AGREE:g}; else it is inconclusive. "
    f"At 95 % the order is no lower than {ORDER_OFF:g} below the expected one, or what is said "
    "with it, and not known to be as much higher. Where the "
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
        about=order_row(fit),
    )


def _not_judged(fit: Fit, to_try: str) -> str:
    """Why a verdict is inconclusive, and what to do about it."""
    if fit.status is not Status.INCONCLUSIVE:
        return ""
    return f"; not judged: {fit.unsettled}; try {to_try}"


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
    return table_of(
        "Orders and limits",
        {
            "quantity": lambda fit: label(fit.name),
            "finest": lambda fit: _in_unit(fit, fit.finest),
            "limit": lambda fit: _in_unit(fit, fit.limit),
            "uncertainty": lambda fit: _in_unit(fit, fit.uncertainty, 2),
            "left on the finest": lambda fit: plain(fit.remaining, 2),
            "observed order": order_text,
            "by triplets": _triplets,
            "expected": lambda fit: f"{fit.expected.order:g}" if fit.expected else "–",
        },
        fits,
        "Left on the finest: relative to the value, for components to the vector, for "
        "fields to Σp or Σµp.",
    )


def level_table(records: Sequence[CaseRecord], names: Sequence[str]) -> Table:
    """One row per level, in their order.

    names  of the scalars that are shown
    """
    fields = records[-1].fields
    rows = []
    for place, record in enumerate(records):
        changes = {f: field_changes(f, records[place : place + 2]) for f in fields}
        known = {f"change of {field}": change[0] for field, change in changes.items() if change}
        rows.append(record.model_copy(update={"measures": record.measures | known}))
    columns: dict[str, Text] = {
        "level": lambda row: str(row.parameters["level"]),
        INCREMENTS: _count(INCREMENTS),
        **{label(name): _with_unit(name) for name in names},
        **{name: _if_known(name) for name in (f"change of {field}" for field in fields)},
        "largest residual": number(RESIDUAL),
        **{kind: _count(kind) for kind in work_of(records[-1])},
    }
    return table_of("Levels", columns, rows)


def _with_unit(name: str) -> Text:
    return lambda row: value_text(row.measures[name], row.units[name])


def _if_known(name: str) -> Text:
    return lambda row: plain(row.measures[name]) if name in row.measures else "–"


def _count(name: str) -> Text:
    return lambda row: str(row.counters[name])


def error_chart(name: str, x_label: str, fits: Sequence[Fit], unit: float) -> Chart:
    """Errors against refinement.

    unit  what sizes are divided by on the axis
    """
    shapes = [fit for fit in fits if unit_of_fit(fit) in ("m", "rad")]
    loads = [fit for fit in fits if fit not in shapes]
    groups = [("motion and radii", shapes), ("tractions, loads, energy", loads)]
    *above, last = (_panel(title, group, unit) for title, group in groups if group)
    return stacked(
        name,
        "Errors under refinement",
        "Distance from the limit, relative to it; for pressure and shear the change to "
        "the next level over Σp or Σµp. Dashed, with their orders: the slopes that are expected. A "
        "scalar's error on the finest level rests on the extrapolation and is the least certain.",
        *above,
        last.model_copy(update={"x_label": x_label}),
    )


def _panel(title: str, fits: Sequence[Fit], unit: float) -> Panel:
    lines = [(label(f.name), drawable(zip(f.sizes, f.errors, strict=True))) for f in fits]
    curves = point_curves((name, [(h / unit, e) for h, e in line]) for name, line in lines)
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


def order_row(fit: Fit) -> Row:
    """Order and limit of a quantity, in SI: in its unit, which stands beside it."""
    last, before = fit.triplets
    known, expected = fit.observed, fit.expected
    measures = {
        "finest": fit.finest,
        "limit": fit.limit,
        "uncertainty": fit.uncertainty,
        "left_on_finest": fit.remaining,
        "order": None if known is None else known.order,
        "half_width": None if known is None else known.half_width,
        "triplet": last,
        "triplet_before": before,
    }
    words = {"status": fit.status, "unsettled": fit.unsettled}
    return Row(
        parameters={
            "quantity": fit.name,
            "unit": unit_of_fit(fit) or "1",
            "expected": None if expected is None else expected.order,
        },
        measures=measures,
        units=dict.fromkeys(("finest", "limit", "uncertainty"), "its unit"),
        words={name: word for name, word in words.items() if word is not None},
    )


def _by_triplets(fit: Fit) -> str:
    return "" if fit.observed is None else f"; by triplets {_triplets(fit)}"


def _triplets(fit: Fit) -> str:
    if fit.observed is None:
        return "–"
    return ", ".join("–" if order is None else f"{order:.2f}" for order in fit.triplets)


def _in_unit(fit: Fit, value: float | None, digits: int = 7) -> str:
    return "–" if value is None else value_text(value, unit_of(fit.name), digits)
