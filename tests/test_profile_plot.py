"""The line through the axis shows what acts on it, whichever solver found it."""

from dataclasses import replace
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from synthetic_result import synthetic_result

from contact_results.figures.profile_plot import profile_plot
from contact_results.figures.style import figure_style
from contact_results.surface import Surface, surface_of


def shown(figure: Figure | None) -> list[str]:
    """What the axes say, without units."""
    assert figure is not None
    return [ax.get_ylabel().rpartition(" (")[0] for ax in figure.axes]


def turned(result: Any, turn: Any) -> Any:
    """The result with other shears."""
    increments = tuple(replace(i, shear=turn(i.shear)) for i in result.increments)
    return replace(result, increments=increments)


def drawn(result: Any, surface: Surface) -> list[str]:
    with figure_style():
        return shown(profile_plot(result, surface))


def test_components_that_the_line_carries_are_drawn() -> None:
    result = synthetic_result()
    grid = surface_of(result)
    assert drawn(result, grid) == ["pressure p", "shear $q_{x}$"]
    assert drawn(turned(result, lambda q: q[::-1]), grid) == ["pressure p", "shear $q_{y}$"]
    both = turned(result, lambda q: np.stack([q[0], 0.5 * q[0]]))
    assert drawn(both, grid) == ["pressure p", "shear $q_{x}$", "shear $q_{y}$"]
    assert drawn(synthetic_result(friction=False), grid) == ["pressure p"]
