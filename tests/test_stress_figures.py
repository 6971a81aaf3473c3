"""Figures of stress show what was computed: interfaces at their depths, jumps, both edges."""

from typing import Any

import numpy as np
import pytest
from matplotlib.figure import Figure

from contact_results.figures.stress_plot import (
    axis_plot,
    section_plot,
)
from contact_results.figures.style import figure_style
from contact_results.stress.points import StressField, StressPoints
from contact_scene import Body, IsotropicMaterial, Layer

STEEL = IsotropicMaterial(young_modulus=210e9, poisson_ratio=0.3)
FILM = Layer(thickness=0.2e-3, material=STEEL)
BODY = Body(material=STEEL, layers=(FILM,))
RADIUS, TRAILING = 0.3e-3, 2e9
X = np.linspace(-0.6e-3, 0.6e-3, 25)
DEPTHS = np.array([0.0, 0.1, 0.2, 0.2, 0.4, 0.6]) * 1e-3
MATERIALS = np.array([0, 0, 0, 1, 1, 1])


def points(x: Any, depth: Any, material: Any, cells: Any = None) -> StressPoints:
    """σ_xx is a tension at the edge behind, and jumps to nothing below the film."""
    stress = np.zeros((6, *x.shape))
    stress[0] = np.where(material == 0, TRAILING * np.exp(-(((x + RADIUS) / 1e-4) ** 2)), -1e8)
    nothing = np.zeros((3, *x.shape))
    return StressPoints(
        x, np.zeros(x.shape), depth, material, nothing, stress, np.zeros(x.shape, bool), cells
    )


def field() -> StressField:
    depth, x = np.meshgrid(DEPTHS, X, indexing="ij")
    material = np.broadcast_to(MATERIALS[:, None], x.shape)
    index = np.arange(x.size).reshape(x.shape)
    rows = np.flatnonzero(np.equal(MATERIALS[:-1], MATERIALS[1:]))
    top, bottom = index[rows], index[rows + 1]
    corners = [top[:, :-1], top[:, 1:], bottom[:, 1:], bottom[:, :-1]]
    cells = ("quad", np.stack(corners, axis=-1).reshape(-1, 4))
    section = points(x, depth, material, cells)
    axis = points(np.zeros(len(DEPTHS)), DEPTHS, MATERIALS)
    shown = (0.6e-3, 0.6e-3)
    return StressField(
        section, None, section, axis, None, "x", shown, {"contact_radius": RADIUS}
    )  # fmt: skip


def drawn(draw: Any, of: StressField | None = None) -> Figure:
    with figure_style():
        figure: Figure = draw(of or field(), BODY, "title")
    return figure


@pytest.mark.parametrize("draw", [section_plot, axis_plot])
def test_an_interface_is_drawn_at_its_depth(draw: Any) -> None:
    for ax in drawn(draw).axes:
        if ax.get_label() == "<colorbar>":
            continue
        level = [line for line in ax.lines if len(set(line.get_ydata())) == 1]
        assert [line.get_ydata()[0] for line in level if line.get_linestyle() == "--"] == [
            pytest.approx(0.2)
        ]


def test_the_edge_shown_is_the_one_in_tension() -> None:
    _, edge = drawn(axis_plot).axes
    assert edge.get_title() == "below the edge, x = -0.3 mm"
    assert np.max([np.max(line.get_xdata()) for line in edge.lines]) == pytest.approx(2.0)
