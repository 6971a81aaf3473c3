"""The line through the axis shows what acts on it, whichever solver found it."""

from dataclasses import replace
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from synthetic_result import synthetic_result

from contact_results.figures.profile_plot import profile_plot
from contact_results.figures.style import figure_style
from contact_results.surface import Rings, Surface, surface_of


def shown(figure: Figure | None) -> list[str]:
    """What the axes say, without units."""
    assert figure is not None
    return [ax.get_ylabel().rpartition(" (")[0] for ax in figure.axes]


def turned(result: Any, turn: Any) -> Any:
    """The result with other shears."""
    increments = tuple(replace(i, shear=turn(i.shear)) for i in result.increments)
    return replace(result, increments=increments)


class OnRings:
    """A result of rings under a tangential load, or a torque."""

    def __init__(self, component: str) -> None:
        radii = np.linspace(0.0, 1.2, 25)
        pressure = np.sqrt(np.maximum(1 - radii**2, 0.0))
        parts = ("radial", "circumferential", "along_load")
        scene = synthetic_result().scene
        self.scene, self.steps = scene, [Step(radii, pressure, parts, component)]


class Step:
    step, peak_pressure, in_stick = 1, 1.0, None

    def __init__(self, radii: Any, pressure: Any, parts: tuple[str, ...], component: str) -> None:
        self.radii, self.pressure = radii, pressure
        for part in parts:
            field = 0.1 * radii * pressure if part == component else None
            setattr(self, f"shear_{part}", field)
            setattr(self, f"slip_{part}", None if field is None else -field)


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


def test_rings_name_components_by_what_loads_them() -> None:
    radii = np.linspace(0.0, 1.2, 25)
    for component, direction, symbol in (
        ("circumferential", (1.0, 0.0), "θ"),
        ("radial", (1.0, 0.0), "r"),
        ("along_load", (1.0, 0.0), "x"),
        ("along_load", (0.6, 0.8), r"\parallel"),
    ):
        result: Any = OnRings(component)
        surface = Rings(radii, None, direction, polar=component != "along_load")
        assert drawn(result, surface) == ["pressure p", f"shear $q_{{{symbol}}}$"]


def test_line_is_cut_to_the_contact_with_its_edge_in_view() -> None:
    result = synthetic_result()
    with figure_style():
        figure = profile_plot(result, surface_of(result))
    left, right = figure.axes[0].get_xlim()
    (line, *_) = figure.axes[0].lines
    x, pressure = (np.asarray(data, dtype=float) for data in line.get_data())
    beyond = np.abs(x[pressure > 0]).max() + x[1] - x[0]
    assert -left == right
    assert 1.1 * beyond < right < 1.2 * beyond
