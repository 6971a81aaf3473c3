"""Chart of a parameter sweep: curves with error bars for one key, maps for two keys."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.ticker import NullLocator
from numpy.typing import NDArray

from contact_results.directory.atomic_file import atomic_file
from contact_results.figures import style
from contact_scene.reading.engineering_units import (
    EngineeringUnit,
    engineering_unit,
)
from slipstick.sweep import Variation

PERCENTILES = (5.0, 50.0, 95.0)
MAX_KEYS = 2
MAX_LABEL = 30  # characters in a line beside a panel


@dataclass(frozen=True, eq=False)
class SweptQuantity:
    """Values of one quantity at all points of a parameter sweep, to draw the chart of the sweep.

    name, unit      name of the quantity and its SI unit
    values, errors  values and stated errors (..., sample), with one index for each spaced key and
                    the last index for the sample of distributed keys [unit]; NaN where the scene
                    has no solution
    """

    name: str
    unit: str
    values: NDArray[np.float64]
    errors: NDArray[np.float64]

    @property
    def label(self) -> str:
        """Name in words with the suited unit, as the label of an axis."""
        words = self.name.replace("_", " ")
        return self.suited.labelled(words) if self.unit else words

    @property
    def suited(self) -> EngineeringUnit:
        """Unit with the SI prefix in which the largest value is readable, such as µm or MPa."""
        known = np.abs(self.values[np.isfinite(self.values)])
        return engineering_unit(float(np.max(known, initial=0.0)), self.unit)

    @property
    def in_order(self) -> SweptQuantity:
        """Values of a single sample in ascending order (n, 1), for a cumulative distribution."""
        order = np.argsort(self.values)[:, None]
        return replace(self, values=self.values[order], errors=self.errors[order])

    @property
    def percentiles(self) -> NDArray[np.float64]:
        """Percentiles of the sample with lower and upper bounds (3, percentile, ...) [suited unit].

        The first index selects percentile, lower bound and upper bound. A percentile is monotonic
        in every value, so that the percentiles of value - error and value + error are bounds.
        Unknown errors give NaN.
        """
        values, errors = self.values / self.suited.size, self.errors / self.suited.size
        shifted, known = np.stack([values, values - errors, values + errors]), np.isfinite(values)
        found = np.full((3, len(PERCENTILES), *known.shape[:-1]), np.nan)
        for at in np.ndindex(known.shape[:-1]):
            if np.any(known[at]):
                sample = shifted[(slice(None), *at)][:, known[at]]
                found[(..., *at)] = np.percentile(sample, PERCENTILES, axis=1, method="hazen").T
        return found


def write_sweep_chart(
    keys: Sequence[Variation], quantities: Sequence[SweptQuantity], path: Path, title: str
) -> None:
    """Draw the chart of a parameter sweep to a file, with one panel per quantity.

    A panel is a curve for one spaced key, a map for two keys, and a cumulative distribution without
    spaced keys.

    keys        spaced keys, at most two
    quantities  values of the quantities at all points of the sweep
    path        path of the image file
    title       title of the chart
    """
    if not keys:
        quantities = [quantity.in_order for quantity in quantities]
        shares = 100 * (np.arange(len(quantities[0].values)) + 0.5) / len(quantities[0].values)
        keys = [Variation("part of the sample below", "%", tuple(shares.tolist()))]
    with style.figure_style(), atomic_file(path) as temporary:
        figure = style.new_figure(5.2, 0.4 + 2.9 * len(quantities))
        figure.suptitle(title, fontsize=style.STYLE["axes.titlesize"], parse_math=False)
        axes = figure.subplots(len(quantities), squeeze=False)[:, 0]
        for ax, quantity in zip(axes, quantities, strict=True):
            (_draw_curve, _draw_map)[len(keys) - 1](ax, quantity, *keys)
            for key, axis in zip(keys, "xy", strict=False):
                _label(ax, key, axis)
        style.save(figure, temporary)


def _draw_curve(ax: Any, quantity: SweptQuantity, key: Variation) -> None:
    """Draw a quantity over one key, with error bars of the numerical errors.

    For distributed keys, the curve shows medians, and a band shows the range of percentiles.
    """
    (lower, middle, upper), (_, low, _), (_, high, _) = quantity.percentiles
    bars = np.nan_to_num([middle - low, high - middle])
    ax.errorbar(key.values, middle, bars, marker=".", capsize=3, **style.line_style(0))
    if quantity.values.shape[-1] > 1:
        label = f"{PERCENTILES[0]:g} to {PERCENTILES[-1]:g} % of the sample"
        ax.fill_between(key.values, lower, upper, color=style.STICK_COLOUR, alpha=0.2, label=label)
        ax.legend(loc="best")
    ax.set_ylabel(quantity.label)


def _draw_map(ax: Any, quantity: SweptQuantity, across: Variation, upward: Variation) -> None:
    """Draw the medians as a colour map over two keys, with the largest stated error as title."""
    middle, low, high = quantity.percentiles[:, 1]
    image = ax.pcolormesh(
        across.values, upward.values, middle.T, shading="nearest", cmap=style.MAGNITUDE_MAP
    )
    ax.figure.colorbar(image, ax=ax, label=quantity.label)
    widths = high - low
    if np.any(np.isfinite(widths)):  # else without errors
        largest = np.nanmax(widths) / 2
        ax.set_title(f"largest numerical error: {largest:.2g} {quantity.suited.name}".rstrip())
    for key, axis in ((across, ax.xaxis), (upward, ax.yaxis)):
        if (
            len(key.values) <= style.MAX_TICKS
        ):  # the fields reach beyond the values, which the ticks mark
            axis.set_ticks(key.values)


def _label(ax: Any, key: Variation, axis: str) -> None:
    """Label one axis of a panel with its key, with round ticks on a logarithmic axis.

    axis  "x" or "y"
    """
    label = f"{key.key} ({key.unit})" if key.unit else key.key
    if axis == "y" and len(label) > MAX_LABEL:
        table, _, last = label.rpartition(".")
        label = f"{table}\n.{last}"
    ax.set(**{f"{axis}label": label})
    if key.is_log:
        ax.set(**{f"{axis}scale": "log"})
        shown = style.round_ticks(min(key.values), max(key.values))
        ax.set(**{f"{axis}ticks": shown, f"{axis}ticklabels": [f"{tick:g}" for tick in shown]})
        getattr(ax, f"{axis}axis").set_minor_locator(NullLocator())
