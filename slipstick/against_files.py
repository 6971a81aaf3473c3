"""Files of a comparison with a measurement: the numbers as JSON, and both curves in one picture."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from contact_results.directory.atomic_file import atomic_file
from contact_scene.reading.engineering_units import engineering_unit
from slipstick.against import ComparedCurve, Comparison
from slipstick.identification import FittedInput

NUMBERS = "against.json"
PICTURE = "against.png"


def write_comparison(
    comparison: Comparison, directory: Path, title: str, fitted: Sequence[FittedInput] = ()
) -> None:
    """Write the numbers and the picture of a comparison into a directory, which is created.

    title   title of the picture: names of table and run
    fitted  inputs of the scene that were fitted to the table
    """
    directory.mkdir(parents=True, exist_ok=True)
    numbers = {
        each.name.replace(" ", "_"): {
            **{name: value for name, value in vars(each).items() if name != "differences"},
            "ratio": each.ratio,
            "ours": each.ours,
        }
        for each in comparison.numbers
    }
    record: dict[str, object] = {"title": title, "numbers": numbers}
    if fitted:
        record["fitted"] = [vars(one) for one in fitted]
    text = json.dumps(record, indent=1, ensure_ascii=False) + "\n"
    with atomic_file(directory / NUMBERS) as temporary:
        temporary.write_text(text, encoding="utf-8", newline="\n")
    draw_curves(comparison.curves, directory / PICTURE, title)


def draw_curves(curves: tuple[ComparedCurve, ...], path: Path, title: str) -> None:
    """Draw measured points over computed curves into an image file, one panel per curve.

    title  title of the picture
    """
    from contact_results.figures import style

    with style.figure_style(), atomic_file(path) as temporary:
        figure = style.new_figure(5.2, 0.4 + 3.2 * len(curves))
        figure.suptitle(title, fontsize=style.STYLE["axes.titlesize"], parse_math=False)
        for ax, curve in zip(
            figure.subplots(len(curves), squeeze=False)[:, 0], curves, strict=True
        ):
            both = np.concatenate([curve.measured, curve.computed], axis=1)
            across, upward = (
                engineering_unit(float(np.max(np.abs(values))), unit)
                for values, unit in zip(both, (curve.place_unit, curve.unit), strict=True)
            )
            size = np.array([[across.size], [upward.size]])
            ax.plot(*(curve.computed / size), label="computed", **style.line_style(0))
            measured = {"color": style.LINE_COLOURS[1], "marker": ".", "linestyle": "none"}
            ax.plot(*(curve.measured / size), label="measured", **measured)
            ax.set_xlabel(across.labelled(curve.place))
            ax.set_ylabel(upward.labelled(curve.name))
            style.legend_above(ax)
        style.save(figure, temporary)
