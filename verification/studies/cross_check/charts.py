"""Differences over the radius: a panel per coating, a curve per friction coefficient."""

from __future__ import annotations

import numpy as np

from verification.cases.cross_check_contacts import FRICTIONS, RATIOS, THICKNESSES
from verification.exhibits.chart import Chart, Curve, Panel, curve
from verification.studies.cross_check.contacts import Found, Key, is_its_own
from verification.studies.cross_check.difference import REQUIRED

PER_MILLE = 1e3
SCALES = {"pressure": ("Δp", "p₀"), "shear": ("Δq", "µp₀")}


def difference_chart(found: Found, name: str) -> Chart:
    """Of pressure or shear: thicknesses side by side, ratios of moduli one below the other."""
    symbol, scale = SCALES[name]
    return Chart(
        name=f"{name}_differences",
        title=f"{name.capitalize()} by cells less that by elements, 10³ {symbol} / {scale}",
        caption=f"Difference of the {name} over the radius for six ratios of moduli (rows) and "
        f"three thicknesses (columns), in thousandths of {scale}; required is "
        f"{PER_MILLE * REQUIRED[name]:g}. Each panel has its own scale."
        + (
            " The shear is left out at its kinks, where the edge of stick is or turned back."
            if name == "shear"
            else ""
        ),
        rows=tuple(
            tuple(_panel(found, name, ratio, thickness) for thickness in THICKNESSES)
            for ratio in RATIOS
        ),
    )


def _panel(found: Found, name: str, ratio: float, thickness: float) -> Panel:
    """Names of row and column stand at the outer panels, the legend at the first row's end."""
    top, left = ratio == RATIOS[0], thickness == THICKNESSES[0]
    legend = top and thickness == THICKNESSES[-1]
    keys = {mu: (ratio, thickness, mu) for mu in FRICTIONS if mu > 0 or name == "pressure"}
    return Panel(
        x_label="r / a" if ratio == RATIOS[-1] else "",
        y_label=f"E1/E2 = {ratio:g}" if left else "",
        curves=tuple(
            _difference_curve(found, keys[mu], name, series, legend)
            for series, mu in enumerate(FRICTIONS)
            if mu in keys and keys[mu] in found
        ),
        title=f"h = {thickness:g} a_H" if top else "",
        height=0.9,
        notes=() if is_its_own(ratio, thickness) else ((0.5, 0.0, "the same body"),),
    )


def _difference_curve(found: Found, key: Key, name: str, series: int, legend: bool) -> Curve:
    record = found[key]
    one, other = (
        np.array(getattr(side, name)) for side in (record.semi_analytical, record.finite_elements)
    )
    shown = np.array(record.shear_judged) if name == "shear" else np.ones(len(one), dtype=bool)
    r = np.array(record.radii)[shown]
    label = f"µ = {key[2]:g}" if legend else ""
    return curve(label, r, PER_MILLE * (one - other)[shown], series=series)
