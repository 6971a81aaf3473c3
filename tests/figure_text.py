"""The content of figures as lines of text: titles, labels, limits, texts and the numbers drawn."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.contour import ContourSet
from matplotlib.image import AxesImage
from matplotlib.lines import Line2D
from matplotlib.quiver import Quiver
from matplotlib.text import Text


def figure_lines(figure: Any, array_text: Callable[[Any], str]) -> Iterator[str]:
    """Yield the contents of a figure, axes by axes."""
    yield from _words(figure)
    for part in (figure, *figure.subfigs):
        for axes in part.axes:
            yield f"axes: {axes.get_title()} | {axes.get_xlabel()} | {axes.get_ylabel()}".replace(
                "\n", " / "
            )
            limits = array_text([*axes.get_xlim(), *axes.get_ylim()])
            yield f"limits: {limits} {axes.get_xscale()} {axes.get_yscale()}"
            yield from _words(axes)
            for artist in axes.get_children():
                if (numbers := _drawn(artist)) is not None:
                    name = f"{type(artist).__name__} {artist.get_label()}{_look(artist)}"
                    yield f"{name}: {array_text(numbers)}"
            if legend := axes.get_legend():
                yield f"legend: {' | '.join(text.get_text() for text in legend.get_texts())}"


def _words(part: Any) -> Iterator[str]:
    yield from (
        f"{'text' if x.get_parse_math() else 'plain'}: {x.get_text()}".replace("\n", " / ")
        for x in part.texts
        if isinstance(x, Text) and x.get_text()
    )


def _look(artist: Any) -> str:
    """Properties of an artist of matplotlib that its numbers do not show."""
    if isinstance(artist, AxesImage):
        return f" {artist.get_interpolation()}"
    return f" scale {artist.scale:g}" if isinstance(artist, Quiver) else ""


def _drawn(artist: Any) -> Any:
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
