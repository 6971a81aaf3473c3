"""Stress below a contact on a section: a map of the equivalent stress, and curves on the axis."""

from __future__ import annotations

from pathlib import Path
from textwrap import wrap

import numpy as np
from matplotlib.figure import Figure
from matplotlib.tri import Triangulation

from contact_results.figures import style
from contact_results.section.stress_planes import StressPlane
from contact_scene.engineering_units import engineering_unit

MAP, PROFILE = "stress_section.png", "stress_axis.png"
SHOWN = 2.0  # loaded radii to each side and in depth
CONTOURS = 16
TITLE = 48  # letters in a line
# Quarters around the middle of a nine-node element.
QUARTERS = ((0, 4, 8, 7), (4, 1, 5, 8), (8, 5, 2, 6), (7, 8, 6, 3))


def write_section_stress_figures(
    plane: StressPlane, loaded_radius: float, directory: Path, title: str
) -> None:
    """Draw both; equal results give equal bytes on equal libraries."""
    with style.figure_style():
        style.save(_map(plane, loaded_radius, title), directory / MAP)
        style.save(_profile(plane, loaded_radius, title), directory / PROFILE)


def _map(plane: StressPlane, radius: float, title: str) -> Figure:
    length = engineering_unit(radius, "m")
    reach = SHOWN * radius
    near = (np.abs(plane.x[plane.cells]).min(axis=1) <= reach) & (
        plane.z[plane.cells].min(axis=1) <= reach
    )
    quarters = plane.cells[near][:, np.array(QUARTERS)].reshape(-1, 4)
    triangles = np.concatenate([quarters[:, [0, 1, 2]], quarters[:, [0, 2, 3]]])
    x, z = plane.x / length.size, plane.z / length.size
    shown = plane.von_mises[np.unique(triangles)]
    unit = engineering_unit(float(shown.max()), "Pa")
    figure = style.new_figure(5.6 if plane.x.min() < 0 else 4.2, 3.6)
    ax = figure.subplots()
    levels = np.linspace(0, float(shown.max()) / unit.size, CONTOURS + 1)
    drawn = ax.tricontourf(
        Triangulation(x, z, triangles),
        plane.von_mises / unit.size,
        levels,
        cmap=style.MAGNITUDE_MAP,
    )
    left = -reach if plane.x.min() < 0 else 0.0
    ax.set_xlim(left / length.size, reach / length.size)
    ax.set_ylim(reach / length.size, 0.0)
    ax.set_aspect("equal")
    ax.set_xlabel(f"{'x along the load' if left else 'radius r'} ({length.name})")
    ax.set_ylabel(f"depth z ({length.name})")
    ax.set_title("\n".join(wrap(title, TITLE)))
    figure.colorbar(drawn, ax=ax, shrink=0.8, label=f"equivalent stress ({unit.name})")
    return figure


def _profile(plane: StressPlane, radius: float, title: str) -> Figure:
    axis = np.flatnonzero((plane.x == 0.0) & (plane.z <= 1.5 * SHOWN * radius))
    axis = axis[np.lexsort((plane.material[axis], plane.z[axis]))]
    length = engineering_unit(radius, "m")
    curves = {
        "σ_rr": plane.stress[0],
        "σ_tt": plane.stress[1],
        "σ_zz": plane.stress[2],
        "von Mises": plane.von_mises,
    }
    unit = engineering_unit(
        float(max(np.abs(values[axis]).max() for values in curves.values())), "Pa"
    )
    figure = style.new_figure(5.0, 3.6)
    ax = figure.subplots()
    for number, (name, values) in enumerate(curves.items()):
        ax.plot(
            values[axis] / unit.size,
            plane.z[axis] / length.size,
            color=style.LINE_COLOURS[number],
            linestyle=style.LINE_STYLES[number],
            label=name,
        )
    ax.axvline(0.0, color="black", linewidth=0.5)
    ax.invert_yaxis()
    ax.set_xlabel(f"stress on the axis ({unit.name})")
    ax.set_ylabel(f"depth z ({length.name})")
    ax.set_title("\n".join(wrap(title, TITLE)))
    ax.legend()
    return figure
