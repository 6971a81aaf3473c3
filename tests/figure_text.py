"""The content of figures as lines of text: titles, labels, limits, ticks, texts, the numbers drawn
and the looks of all parts."""

from collections import Counter

import numpy as np
from matplotlib.artist import Artist
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import is_color_like, to_hex
from matplotlib.contour import ContourSet
from matplotlib.image import AxesImage
from matplotlib.lines import Line2D
from matplotlib.quiver import Quiver
from matplotlib.text import Text

# Properties of parts of figures that their numbers do not show.
LOOKS = """
    color facecolor edgecolor alpha linewidth linestyle marker markersize fillstyle fontsize
    fontweight rotation horizontalalignment verticalalignment unitless_position
    tick_params interpolation clim cmap aspect frame_on
"""


def figure_lines(figure, array_text):
    """Yield the contents of a figure, axes by axes."""
    yield f"size: {array_text(figure.get_size_inches())}"
    yield from _words(figure)
    for part in (figure, *figure.subfigs):
        for axes in part.axes:
            yield f"axes: {axes.get_title()} | {axes.get_xlabel()} | {axes.get_ylabel()}".replace(
                "\n", " / "
            )
            limits = array_text([*axes.get_xlim(), *axes.get_ylim()])
            yield f"limits: {limits} {axes.get_xscale()} {axes.get_yscale()}"
            yield from _words(axes)
            for axis in (axes.xaxis, axes.yaxis):
                labels = axis.get_major_formatter().format_ticks(axis.get_majorticklocs())
                yield f"ticks: {' | '.join(labels)}, {len(axis.get_minorticklocs())} between"
            for artist in axes.get_children():
                if (numbers := _drawn(artist)) is not None:
                    name = f"{type(artist).__name__} {artist.get_label()}"
                    yield f"{name}: {array_text(numbers)}"
            if legend := axes.get_legend():
                yield f"legend: {' | '.join(text.get_text() for text in legend.get_texts())}"
    looks = Counter(look for part in figure.findobj(Artist.get_visible) if (look := _look(part)))
    yield from (f"look of {number}: {look}" for look, number in looks.items())


def _words(part):
    yield from (
        f"{'text' if x.get_parse_math() else 'plain'}: {x.get_text()}".replace("\n", " / ")
        for x in part.texts
        if isinstance(x, Text) and x.get_text()
    )


def _look(part):
    """Properties of a part of a figure; empty if it draws nothing itself."""
    if isinstance(part, Text) and not part.get_text():
        return ""
    getters = {name: getattr(part, f"get_{name}", None) for name in LOOKS.split()}
    given = {name: getter() for name, getter in getters.items() if getter}
    given |= {name: value for name in ("scale", "xyann") if (value := getattr(part, name, None))}
    shown = [f"{name} {_value_text(value)}" for name, value in given.items() if value is not None]
    return " ".join([type(part).__name__, *shown]) if shown else ""


def _value_text(value):
    """Text of a property: a colour, a colour map or a number of each, or another value."""
    if is_color_like(value):
        return to_hex(value, keep_alpha=True)
    if isinstance(value, np.ndarray):
        return " ".join(dict.fromkeys(map(_value_text, value)))
    return getattr(value, "name", str(value))


def _drawn(artist):
    """Numbers of an artist of matplotlib; None if it has none."""
    if isinstance(artist, Line2D):
        return np.asarray(artist.get_xydata(), float).T
    if isinstance(artist, Quiver):
        return np.concatenate([artist.get_offsets().T.ravel(), artist.U, artist.V])
    if isinstance(artist, AxesImage):
        return np.append(
            np.ma.filled(artist.get_array().astype(float), np.nan), artist.get_extent()
        )
    if isinstance(artist, ContourSet):  # single vertices jump with round-off
        points = np.concatenate(
            [path.vertices for path in artist.get_paths()] or [np.zeros((0, 2))]
        )
        return np.array([points.min(0), points.max(0)]) if len(points) else points
    if isinstance(artist, LineCollection | PolyCollection):
        return np.concatenate(
            [path.vertices for path in artist.get_paths()] or [np.zeros((0, 2))]
        ).T
    if getattr(artist, "get_array", lambda: None)() is not None:
        return np.ma.filled(np.ma.asarray(artist.get_array(), float), np.nan)
    return None
