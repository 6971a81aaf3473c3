"""Tractions over the radius by the solvers, and their differences."""

from __future__ import annotations

import numpy as np

from verification.cases.both_solvers.contacts import (
    FRICTIONS,
    RATIOS,
    THICKNESSES,
    CheckedContact,
    is_its_own,
)
from verification.cases.both_solvers.differences import COMPARED, Found
from verification.cases.both_solvers.sides import CELLS, ELEMENTS, RADIAL, column, judged_radii
from verification.exhibits.chart import Chart, Curve, Look, Panel, curve
from verification.running.row import CaseRecord

PER_MILLE = 1e3
THINNED = 4  # places per point of a curve, apart from the one with the largest difference


def difference_chart(found: Found, name: str, side: str) -> Chart:
    """Of pressure or shear by a side less that on radii: thicknesses side by side, ratios of moduli
    one below the other."""
    of = COMPARED[name]
    return Chart(
        name=f"{name}_{side}_differences",
        title=f"{name.capitalize()} by {side} less that of the radial solver, 10³ Δ{of.symbol} / "
        f"{of.scale}",
        caption=f"Difference of the {name} over the radius for six ratios of moduli (rows) and "
        f"three thicknesses (columns), in thousandths of {of.scale}; required is "
        f"{PER_MILLE * of.required:g}. Each panel has its own scale."
        + (
            " The shear is left out at its kinks, where the edge of stick is or turned back."
            if name == "shear"
            else ""
        ),
        rows=tuple(
            tuple(_panel(found, name, side, ratio, thickness) for thickness in THICKNESSES)
            for ratio in RATIOS
        ),
    )


def _panel(found: Found, name: str, side: str, ratio: float, thickness: float) -> Panel:
    """Names of row and column stand at the outer panels, the legend at the first row's end."""
    top, left = ratio == RATIOS[0], thickness == THICKNESSES[0]
    legend = top and thickness == THICKNESSES[-1]
    contacts = [CheckedContact(ratio, thickness, mu) for mu in FRICTIONS]
    return Panel(
        x_label="r / a" if ratio == RATIOS[-1] else "",
        y_label=f"E1/E2 = {ratio:g}" if left else "",
        curves=tuple(
            _difference_curve(contact, found[contact], name, side, series, legend)
            for series, contact in enumerate(contacts)
            if contact in found and (contact.friction or name == "pressure")
        ),
        title=f"h = {thickness:g} a_H" if top else "",
        height=0.9,
        notes=() if is_its_own(ratio, thickness) else ((0.5, 0.0, "the same body"),),
    )


def _difference_curve(
    contact: CheckedContact, record: CaseRecord, name: str, side: str, series: int, legend: bool
) -> Curve:
    apart = column(record, f"{name}_{side}") - column(record, f"{name}_{RADIAL}")
    r, judged = judged_radii(record)
    seen = np.flatnonzero(judged if name == "shear" else np.ones(len(r), dtype=bool))
    largest = seen[np.argmax(np.abs(apart[seen]))] if len(seen) else 0
    every = np.arange(len(seen))[::-1] % THINNED == 0  # the outermost is one
    shown = seen[every | (seen == largest)]
    label = f"µ = {contact.friction:g}" if legend else ""
    return curve(label, r[shown], PER_MILLE * apart[shown], series=series)


def profile_chart(found: Found) -> Chart:
    """Tractions of every contact."""
    rows = tuple(
        tuple(
            Panel(
                x_label="r / a",
                y_label=f"{COMPARED[name].symbol} / {COMPARED[name].scale}",
                curves=(
                    curve(
                        ELEMENTS if number == 0 else "",
                        r,
                        column(record, f"{name}_{ELEMENTS}"),
                        Look.REFERENCE,
                    ),
                    curve(CELLS if number == 0 else "", r, column(record, f"{name}_{CELLS}")),
                ),
                title=contact.name if name == "pressure" else "",
                height=1.4,
            )
            for name in ("pressure", "shear")
        )
        for number, (contact, record) in enumerate(found.items())
        for r, _ in [judged_radii(record)]
    )
    return Chart(
        name="cross_check_profiles",
        title="Tractions by both solvers",
        caption="Pressure (left) and outward shear (right) over the radius: finite elements in "
        "grey, cells on top of them, for each contact of the case.",
        rows=rows,
    )  # fmt: skip
