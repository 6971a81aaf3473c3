"""The paper's figures 3 and 4: pressure and shear of coated contacts in the plane y = 0."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from verification.exhibits.chart import Chart, Curve, Look, Panel, curve
from verification.studies.sliding_runs.traction_run import Profile, TractionRecord

COLUMNS = 2
SHOWN = 1.3  # Hertz radii to each side

CurvesOf = Callable[[TractionRecord, bool], tuple[Curve, ...]]


def figures(found: Mapping[float, TractionRecord]) -> tuple[Chart, ...]:
    """Pressure and shear next to y = 0, a panel per ratio of moduli."""
    pressure = Chart(
        name="figure_3_pressure",
        title="Figure 3 of the paper: pressure profiles in the plane y = 0",
        caption="Pressure over the Hertz pressure for E1 = E2 at four tangential forces. The "
        "force lowers the cusp at the centre and moves a few per cent of the pressure to the "
        "trailing side.",
        rows=_panels(found, "p / Hertz pressure", _pressures),
    )
    shear = Chart(
        name="figure_4_shear",
        title="Figure 4 of the paper: shear profiles in the plane y = 0",
        caption="Shear qₓ over µ times the Hertz pressure at four tangential forces; the thin "
        "dashed lines are the friction limit ± µp at the largest force. At T = 0 the shear pulls "
        "outwards on both sides and carries no resultant.",
        rows=_panels(found, "qₓ / (µ × Hertz pressure)", _shears),
    )
    return pressure, shear


def _panels(
    found: Mapping[float, TractionRecord], label: str, curves_of: CurvesOf
) -> tuple[tuple[Panel, ...], ...]:
    rows = []
    items = list(found.items())
    for start in range(0, len(items), COLUMNS):
        row = []
        for column, (ratio, record) in enumerate(items[start : start + COLUMNS]):
            last_row = start + COLUMNS >= len(items)
            legend = start == 0 and column == min(COLUMNS, len(items)) - 1
            row.append(
                Panel(
                    x_label="x / Hertz radius" if last_row else "",
                    y_label=label if column == 0 else "",
                    curves=curves_of(record, legend),
                    title=f"E1/E2 = {ratio:g}",
                    height=1.7,
                )
            )
        rows.append(tuple(row))
    return tuple(rows)


def _pressures(record: TractionRecord, legend: bool) -> tuple[Curve, ...]:
    x, shown = _shown(record)
    return tuple(
        curve(_label(p) if legend else "", x, np.array(p.pressure)[shown], series=n)
        for n, p in enumerate(record.profiles)
    )


def _shears(record: TractionRecord, legend: bool) -> tuple[Curve, ...]:
    x, shown = _shown(record)
    limit = np.array(record.profiles[-1].pressure)[shown]
    return (
        curve("± µp" if legend else "", x, limit, Look.BOUND),
        curve("", x, -limit, Look.BOUND),
        *(
            curve(_label(p) if legend else "", x, np.array(p.shear)[shown], series=n)
            for n, p in enumerate(record.profiles)
        ),
    )


def _shown(record: TractionRecord) -> tuple[np.ndarray, np.ndarray]:
    x = np.array(record.x)
    shown = np.abs(x) <= SHOWN
    return x[shown], shown


def _label(profile: Profile) -> str:
    return f"T = {profile.force:g} µW" if profile.force else "T = 0"
