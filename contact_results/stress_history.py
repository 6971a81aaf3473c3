"""Stress at chosen points over the increments of a load history: CSV table and figure."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.ticker import MaxNLocator

from contact_results.directory.atomic_file import atomic_file
from contact_results.directory.run_directory import files_at_once
from contact_results.figures import style
from contact_results.files.csv_file import STEP, Column, write_meanings, write_table
from contact_results.stress.files import INVARIANTS, PLACE
from contact_results.stress.points import COMPONENTS, StressPoints
from contact_results.stress.stress_maxima import layer_name
from contact_scene import Body
from contact_scene.array_types import Field
from contact_scene.reading.engineering_units import engineering_unit, quantity

TABLE, MEANINGS, FIGURE = "stress_history.csv", "stress_history_columns.csv", "stress_history.png"
SHOWN = ("xx", "zz", "xz")
COLUMNS = (
    Column("point", None, "Number of the point, in the order of the options."),
    *PLACE,
    Column("material", None, "layer 1 is the outermost; base is below all layers."),
    STEP,
    Column("increment", None, "Increment within the step, from 1."),
    *(Column(f"sigma_{k}", "Pa", "Component of stress, tension positive.") for k in COMPONENTS),
    Column(
        "error", "Pa", "Error of every component by cells or rings, without that of increments."
    ),
    *INVARIANTS,
)


@dataclass(frozen=True, eq=False)
class StressIncrement:
    """Stress at chosen points of a body at the end of one increment.

    step    load step, from 1
    index   increment within the load step, from 1; None if the history has the ends of load steps
            only
    points  stress at the n points
    errors  stated error of every stress component, one number per point (n,) [force/length^2]
    """

    step: int
    index: int | None
    points: StressPoints
    errors: Field


def write_history(
    history: Sequence[StressIncrement], body: Body, directory: Path, convention: str, title: str
) -> None:
    """Write the table and the figure of the stress at chosen points over all increments.

    The files replace earlier ones atomically.

    history     stress at the points at the end of each increment
    body        lower body or indenter, which contains the points
    directory   output directory
    convention  text about axes and signs, for the table of columns
    title       title of the figure
    """
    layers, count = len(body.layers), len(history[0].errors)
    rows = (
        (
            n + 1,
            *(float(field[n]) for field in (p.x, p.y, p.depth)),
            _material(p, n, layers),
            each.step,
            each.index,
            *p.stress[:, n].tolist(),
            float(each.errors[n]),
            *(float(field[n]) for field in (p.von_mises, *p.principal)),
        )
        for n in range(count)
        for each in history
        for p in [each.points]
    )
    with files_at_once(directory, TABLE, ()) as staging:
        write_table(staging / TABLE, COLUMNS, rows)
        write_meanings(staging / MEANINGS, {TABLE: COLUMNS}, convention)
        with style.figure_style(), atomic_file(staging / FIGURE) as path:
            figure = style.new_figure(6.4, 0.5 + 2.6 * count)
            figure.suptitle(title, fontsize=style.STYLE["axes.titlesize"])
            axes = figure.subplots(count, sharex=True, squeeze=False)[:, 0]
            for n, ax in enumerate(axes):
                _draw(ax, history, n, layers)
            axes[-1].set_xlabel("increment; dotted: ends of load steps")
            style.save(figure, path)


def _draw(ax: Any, history: Sequence[StressIncrement], n: int, layers: int) -> None:
    """Draw σ_xx, σ_zz, σ_xz and the largest principal stress of one point over the increments.

    The stated errors are drawn as error bars. Dotted lines mark the ends of load steps.

    ax      axes of matplotlib
    n       index of the point
    layers  number of layers of the body
    """
    values = {
        f"$σ_{{{name}}}$": [each.points.components[name][n] for each in history] for name in SHOWN
    }
    values["$σ_1$"] = [each.points.principal[0][n] for each in history]
    errors = np.array([each.errors[n] for each in history])
    unit = engineering_unit(float(np.max(np.abs(list(values.values())))), "Pa")
    numbers = np.arange(1, len(history) + 1)
    for number, (label, stress) in enumerate(values.items()):
        bars, y = errors / unit.size, np.array(stress) / unit.size
        ax.errorbar(numbers, y, bars, label=label, linewidth=1.2, **style.line(number))
    for k in np.flatnonzero(np.diff([each.step for each in history])):
        ax.axvline(k + 1, color=style.GREY, linewidth=0.7, linestyle=":")
    point = history[0].points
    place = (quantity(float(field[n]), "m") for field in (point.x, point.y, point.depth))
    ax.set_title(f"x, y, depth = {', '.join(place)}, {_material(point, n, layers)}")
    ax.set_ylabel(unit.labelled("stress"))
    ax.xaxis.set_major_locator(MaxNLocator(integer=True))
    style.legend_beside(ax)


def _material(points: StressPoints, n: int, layers: int) -> str:
    """Return the name of the material at point n: a layer, the base, or "body" without layers."""
    return layer_name(int(points.material[n]), layers) if layers else "body"
