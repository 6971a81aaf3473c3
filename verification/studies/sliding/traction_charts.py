"""The paper's figures 3 and 4: pressure and shear of coated contacts in the plane y = 0."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from verification.exhibits.chart import Chart, Curve, Look, Panel, curve, stacked
from verification.running.row import CaseRecord

COLUMNS = 2
SHOWN = 1.3  # Hertz radii to each side

Field = NDArray[np.float64]
CurvesOf = Callable[[CaseRecord, bool], tuple[Curve, ...]]


@dataclass(frozen=True)
class Profile:
    """Tractions along y = 0: x over a_H, p over p_H, q_x over µp_H; the force over µW."""

    force: float
    x: Field
    pressure: Field
    shear: Field


def profiles(record: CaseRecord) -> list[Profile]:
    """At the end of each loading step."""
    of_step: dict[object, list[list[float | None]]] = {}
    for part in record.parts:
        if "profile" in part.parameters:
            row = [part.number("x_over_aH"), *part.measures.values()]
            of_step.setdefault(part.parameters["profile"], []).append(row)
    return [
        Profile(float(force[0]), x, pressure, shear)
        for x, force, pressure, shear in (
            np.array(rows, dtype=float).T for rows in of_step.values()
        )
    ]


def figures(found: Mapping[float, CaseRecord]) -> tuple[Chart, ...]:
    """Pressure and shear next to y = 0, a panel per ratio of moduli."""
    return (
        stacked(
            "figure_3_pressure",
            "Figure 3 of the paper: pressure profiles in the plane y = 0",
            "Pressure over the Hertz pressure for E1 = E2 at four tangential forces. The "
            "force lowers the cusp at the centre and moves a few per cent of the pressure to the "
            "trailing side.",
            *_panels(found, "p / Hertz pressure", _pressures),
        ),
        stacked(
            "figure_4_shear",
            "Figure 4 of the paper: shear profiles in the plane y = 0",
            "Shear qₓ over µ times the Hertz pressure at four tangential forces; the thin "
            "dashed lines are the friction limit ± µp at the largest force. At T = 0 the shear "
            "pulls outwards on both sides and carries no resultant.",
            *_panels(found, "qₓ / (µ × Hertz pressure)", _shears),
        ),
    )


def _panels(
    found: Mapping[float, CaseRecord], label: str, curves_of: CurvesOf
) -> list[tuple[Panel, ...]]:
    last_row = len(found) - 1 - (len(found) - 1) % COLUMNS
    panels = [
        Panel(
            x_label="x / Hertz radius" if number >= last_row else "",
            y_label="" if number % COLUMNS else label,
            curves=curves_of(record, number == min(COLUMNS, len(found)) - 1),
            title=f"E1/E2 = {ratio:g}",
            height=1.7,
        )
        for number, (ratio, record) in enumerate(found.items())
    ]
    return [tuple(panels[start : start + COLUMNS]) for start in range(0, len(panels), COLUMNS)]


def _pressures(record: CaseRecord, legend: bool) -> tuple[Curve, ...]:
    return tuple(
        _curve(profile, profile.pressure, n, legend) for n, profile in enumerate(profiles(record))
    )


def _shears(record: CaseRecord, legend: bool) -> tuple[Curve, ...]:
    known = profiles(record)
    shown = np.abs(known[-1].x) <= SHOWN
    x, limit = known[-1].x[shown], known[-1].pressure[shown]
    return (
        curve("± µp" if legend else "", x, limit, Look.BOUND),
        curve("", x, -limit, Look.BOUND),
        *(_curve(profile, profile.shear, n, legend) for n, profile in enumerate(known)),
    )


def _curve(profile: Profile, values: Field, series: int, legend: bool) -> Curve:
    shown = np.abs(profile.x) <= SHOWN
    label = _label(profile) if legend else ""
    return curve(label, profile.x[shown], values[shown], series=series)


def _label(profile: Profile) -> str:
    return f"T = {profile.force:g} µW" if profile.force else "T = 0"
