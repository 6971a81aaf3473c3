"""Chart of relative errors against cell size on logarithmic axes.

The chart shows fitted lines with their confidence bands, and lines of the expected orders.
"""

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from verification.convergence.observed_order import ErrorLine, ObservedOrder, by_size, error_line
from verification.exhibits.chart import Chart, Curve, Look, Panel, curve

Errors = Mapping[str, Sequence[float]]
BELOW = 0.4  # lines of expected slopes run under the data, by this factor
LEAST, LEAST_JUDGED = 4, 3  # levels that a line is drawn through
ALONG = 9  # points along a band, which is curved
SHOWN = 0.005  # smallest half-width that two decimals show


def convergence_chart(
    name: str,
    title: str,
    caption: str,
    spacings: Sequence[float],
    errors: Errors,
    slopes: Mapping[str, float],
    x_label: str = "cell side / contact radius",
    judged: Mapping[str, int] | None = None,
) -> Chart:
    """Create a chart of errors against cell size, with fitted lines and lines of the expected
    orders.

    spacings  cell sides over the contact radius (solves,); errors of equal sides are replaced by
              their
              root mean square
    errors    relative errors (solves,) at these cell sides, of either sign, by name of the quantity
    slopes    expected convergence order, by name of the quantity
    judged    number of finest levels to which the line of a quantity is fitted, by name, because
              the
              order is judged on these; no line is drawn for fewer than 3 levels. Without an entry,
    all
              levels are fitted if there are at least 4
    """
    curves: list[Curve] = []
    for series, (label, values) in enumerate(errors.items()):
        sizes, root_mean_squares = by_size(spacings, values)
        count = (judged or {}).get(label)
        if count is None:
            count = len(sizes) if len(sizes) >= LEAST else 0
        curves += _error_curves(label, sizes, root_mean_squares, count, slopes.get(label), series)
    panel = Panel(x_label=x_label, y_label="relative error", curves=tuple(curves), logarithmic=True)
    legend = (
        "Numbers are the slopes of the fitted lines with their 95 % intervals, bands those of the "
        "lines. Dashed below: the expected slopes."
    )
    return Chart(name=name, title=title, caption=f"{caption} {legend}", rows=((panel,),))


def _error_curves(
    label: str, sizes: list[float], errors: list[float], count: int, expected: float | None,
    series: int,
) -> list[Curve]:  # fmt: skip
    """Return the chart curves of one error: points, fitted line with 95 % band, and expected slope.

    label     name of the quantity, for the legend
    sizes     cell sides over the contact radius
    errors    magnitudes of the relative error at these sizes
    count     number of finest levels to which the line is fitted; with fewer than 3, points only
    expected  expected convergence order; None for no slope line
    series    number that determines the colour
    """
    ends = np.array([max(sizes), min(sizes)])
    fitted = slice(len(sizes) - count, None)
    if count < LEAST_JUDGED or min(errors[fitted]) <= 0:
        curves = [curve(label, sizes, errors, Look.POINTS, series)]
        start = errors[int(np.argmax(sizes))]
    else:
        line = error_line(sizes[fitted], errors[fitted])
        ends = np.array([max(sizes[fitted]), min(sizes[fitted])])
        curves = [
            _confidence_band(line, ends, series),
            curve("", ends, line.at(ends), Look.FITTED, series),
            curve(f"{label}: {_order_text(line.observed)}", sizes, errors, Look.LEVELS, series),
        ]
        start = float(line.at(ends[:1])[0])
    if expected is not None:
        shown = BELOW * start * (ends / ends[0]) ** expected
        curves.append(curve(f"slope {expected:g}", ends, shown, Look.SLOPE, series))
    return curves


def _order_text(observed: ObservedOrder) -> str:
    if not observed.is_legible:
        return "no order can be read"
    digits = ".2f" if observed.half_width >= SHOWN else ".1g"
    return f"{observed.order:.2f} ± {observed.half_width:{digits}}"


def _confidence_band(line: ErrorLine, ends: NDArray[np.float64], series: int) -> Curve:
    """Return the outline of the 95 % confidence band of a line that is fitted to errors, as a chart
    curve.

    line    line fitted to the logarithms of errors and cell sizes
    ends    largest and smallest cell size
    series  number that determines the colour
    """
    along = np.geomspace(ends[0], ends[1], ALONG)
    low, high = line.band(along)
    return curve("", [*along, *along[::-1]], [*low, *high[::-1]], Look.BAND, series)
