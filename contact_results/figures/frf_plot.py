"""The surface FRF of a body against the wavenumber."""

from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from contact_results.directory.atomic_file import atomic_file
from contact_results.figures import style
from contact_results.files.frequency_response import FIGURES, MEANINGS, FrequencyResponse

# Beyond this ratio of the largest to the smallest value a linear axis shows one curve only.
WIDE = 30.0


def write_frf_figures(response: FrequencyResponse, directory: Path, title: str) -> None:
    """Write `frf.png` and `frf.svg`."""
    with style.figure_style():
        figure = frf_plot(response, title)
        for name in FIGURES:
            with atomic_file(directory / name) as path:
                style.save(figure, path)


def frf_plot(response: FrequencyResponse, title: str) -> Figure:
    """Magnitudes in m³/N on the left, dimensionless on the right; call within `figure_style`."""
    figure = style.new_figure(9.6, 4.0)
    figure.suptitle(title, fontsize=9.0, parse_math=False)
    left, right = figure.subplots(1, 2)
    for n, (name, values) in enumerate(response.columns.items()):
        look: dict[str, Any] = {
            "color": style.LINE_COLOURS[n], "linestyle": style.LINE_STYLES[n]
        }  # fmt: skip
        magnitude = np.abs(values)
        left.plot(response.alpha, np.where(magnitude > 0, magnitude, np.nan), **look)
        right.plot(
            response.alpha, response.dimensionless[name], label=f"{name}: {MEANINGS[name]}", **look
        )
    left.set_xscale("log")
    left.set_yscale("log")
    left.set_ylabel("|F| (m³/N)")
    right.set_xscale("log")
    right.set_ylabel("α G F, G of the outermost material")
    _scale(right, np.array(list(response.dimensionless.values())))
    for ax in (left, right):
        _mark_thicknesses(ax, response)
        ax.set_xlabel("wavenumber α (1/m)")
        ax.grid(True, color="#DDDDDD", linewidth=0.4)
    figure.legend(*right.get_legend_handles_labels(), loc="outside lower center", ncols=2)
    return figure


def _scale(ax: Any, values: NDArray[np.float64]) -> None:
    """Logarithmic on both sides of zero where the values, all but C positive, spread wide."""
    largest, smallest = float(values[:-1].max()), float(values[:-1].min())
    if largest > WIDE * smallest:
        ax.set_yscale("symlog", linthresh=max(smallest, 1e-6 * largest))
    else:
        ax.axhline(0.0, color="#1a1a1a", linewidth=0.5)


def _mark_thicknesses(ax: Any, response: FrequencyResponse) -> None:
    """A line where the wave is as long as a layer is thick: alpha h = 1."""
    low, high = response.alpha[[0, -1]]
    for n, film in enumerate(response.stack.layers, 1):
        if low < 1 / film.thickness < high:
            ax.axvline(1 / film.thickness, color=style.GREY, linewidth=0.7, linestyle=":")
            ax.annotate(
                f"α h{n if len(response.stack.layers) > 1 else ''} = 1",
                (1 / film.thickness, 1.0), xycoords=("data", "axes fraction"),
                xytext=(2, -9), textcoords="offset points", color=style.GREY, fontsize=7.5,
            )  # fmt: skip
