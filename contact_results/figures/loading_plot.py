"""Normal force against approach."""

from __future__ import annotations

from typing import TYPE_CHECKING

from matplotlib.figure import Figure

from contact_results.figures import style
from contact_scene.engineering_units import engineering_unit

if TYPE_CHECKING:
    import fem_reference
    import semi_analytical

    Result = semi_analytical.Result | fem_reference.Result


def loading_plot(result: Result) -> Figure:
    """Force and approach of every increment, from first touch."""
    force = [0.0, *(increment.normal_force for increment in result.increments)]
    approach = [0.0, *(increment.approach for increment in result.increments)]
    force_unit = engineering_unit(max(force), "N")
    approach_unit = engineering_unit(max(approach), "m")
    figure = style.new_figure(5.0, 3.6)
    ax = figure.subplots()
    ax.plot([a / approach_unit.size for a in approach], [w / force_unit.size for w in force],
            color=style.LINE_COLOURS[0], marker="o", markersize=3.5)  # fmt: skip
    ax.set_xlim(left=0.0)
    ax.set_ylim(bottom=0.0)
    ax.set_xlabel(f"approach ({approach_unit.name})")
    ax.set_ylabel(f"normal force W ({force_unit.name})")
    return figure
