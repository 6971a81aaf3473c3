"""Errors against cell side on logarithmic axes, with lines of the expected slopes."""

from collections.abc import Mapping, Sequence

from verification.cases.chart import Chart, Curve, Look, Panel, curve

Errors = Mapping[str, Sequence[float]]
BELOW = 0.6  # slope lines run under the data, by this factor


def convergence_chart(
    name: str,
    title: str,
    caption: str,
    spacings: Sequence[float],
    errors: Errors,
    slopes: Mapping[str, float],
    x_label: str = "cell side / contact radius",
) -> Chart:
    """One curve for every error and, where an order is expected, a line of that slope.

    spacings  cell sides, dimensionless
    errors    name to errors at these
    slopes    name of an error to its expected order
    """
    curves: list[Curve] = []
    for series, (label, values) in enumerate(errors.items()):
        if label in slopes:
            order = slopes[label]
            line = [BELOW * values[0] * (h / spacings[0]) ** order for h in spacings]
            curves.append(curve(f"slope {order:g}", spacings, line, Look.SLOPE, series))
        curves.append(curve(label, spacings, values, Look.POINTS, series))
    panel = Panel(x_label=x_label, y_label="relative error", curves=tuple(curves), logarithmic=True)
    return Chart(name=name, title=title, caption=caption, rows=((panel,),))
