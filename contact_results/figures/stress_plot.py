"""Stress below a contact: sections, lines down the axis, and lines along the interfaces."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from textwrap import fill
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from contact_results.directory.atomic_file import atomic_file
from contact_results.figures import style
from contact_scene.engineering_units import EngineeringUnit, engineering_unit
from semi_analytical.frf.depth import Level
from semi_analytical.stress import SubsurfaceField, principal_stresses, von_mises

SECTION, AXIS, INTERFACES = "stress_section.png", "stress_axis.png", "stress_interfaces.png"
MOST_INTERFACES = 4
XX, ZZ, XZ = 0, 2, 4
LINES = 400  # of a section, downward

Values = NDArray[np.float64]


def write_stress_figures(
    section: SubsurfaceField, sides: tuple[tuple[Level, ...], ...], directory: Path, title: str
) -> None:
    """Write the figures of the section y = 0; without layers there is none of interfaces."""
    figures: dict[str, Callable[[], Figure]] = {
        SECTION: lambda: section_plot(section, title),
        AXIS: lambda: axis_plot(section, title),
    }
    if sides:
        figures[INTERFACES] = lambda: interface_plot(section, sides, title)
    with style.figure_style():
        for name, draw in figures.items():
            with atomic_file(directory / name) as path:
                style.save(draw(), path)


def section_plot(section: SubsurfaceField, title: str) -> Figure:
    """Four stresses on the section, z downward, interfaces dashed; call within `figure_style`."""
    stress = section.stress[..., 0]
    panels = {
        "von Mises": von_mises(stress, axis=1),
        "σ_xx": stress[:, XX],
        "σ_xz": stress[:, XZ],
        "tension (largest principal)": np.maximum(principal_stresses(stress, axis=1)[:, 0], 0.0),
    }
    length = engineering_unit(float(section.x[-1]), "m")
    figure = _titled(9.0, 6.4, title)
    axes = figure.subplots(2, 2, sharex=True, sharey=True)
    for ax, (name, values) in zip(axes.flat, panels.items(), strict=True):
        _draw_section(figure, ax, section, values, name, length)
    for ax in axes[-1]:
        ax.set_xlabel(f"x at y = 0 ({length.name})")
    for ax in axes[:, 0]:
        ax.set_ylabel(f"depth z ({length.name})")
    return figure


def _draw_section(
    figure: Figure,
    ax: Any,
    section: SubsurfaceField,
    values: Values,
    name: str,
    length: EngineeringUnit,
) -> None:
    largest = float(np.abs(values).max())
    unit = engineering_unit(largest, "Pa")
    signed = bool(np.any(values < 0))
    limit = largest / unit.size or 1.0
    deepest = float(section.depths[-1])
    depths = (np.arange(LINES) + 0.5) / LINES * deepest
    half = (section.x[-1] + (section.x[1] - section.x[0]) / 2) / length.size
    image = ax.imshow(
        _at_depths(section, values, depths) / unit.size,
        extent=(-half, half, deepest / length.size, 0.0),
        interpolation="nearest",
        cmap=style.SIGNED_MAP if signed else style.MAGNITUDE_MAP,
        vmin=-limit if signed else 0.0,
        vmax=limit,
    )
    for depth in _interface_depths(section):
        ax.axhline(depth / length.size, color=style.GREY, linewidth=0.7, linestyle="--")
    figure.colorbar(image, ax=ax, label=f"{name} ({unit.name})")


def _at_depths(section: SubsurfaceField, values: Values, depths: Values) -> Values:
    """Values between the levels, linear within a material so that a jump stays one."""
    shown = np.empty((len(depths), values.shape[1]))
    layers = np.array([level.layer for level in section.levels])
    for layer in np.unique(layers):
        inside = np.flatnonzero(layers == layer)
        known = section.depths[inside]
        lines = np.flatnonzero(depths >= known[0] if layer else depths >= 0)
        place = np.interp(depths[lines], known, inside)
        lower = np.floor(place).astype(int)
        upper = np.minimum(lower + 1, inside[-1])
        part = (place - lower)[:, None]
        shown[lines] = (1 - part) * values[lower] + part * values[upper]
    return shown


def _interface_depths(section: SubsurfaceField) -> list[float]:
    pairs = zip(section.levels, section.levels[1:], strict=False)
    return [below.depth for above, below in pairs if below.layer > above.layer]


def _titled(width: float, height: float, title: str) -> Figure:
    figure = style.new_figure(width, height)
    figure.suptitle(fill(title, int(13 * width)), fontsize=9.0)
    return figure


def axis_plot(section: SubsurfaceField, title: str) -> Figure:
    """Stresses down the axis, one line per material; call within `figure_style`."""
    _, stress = section.below()
    lines = {
        "σ_xx": stress[:, XX],
        "σ_zz": stress[:, ZZ],
        "σ_xz": stress[:, XZ],
        "von Mises": von_mises(stress, axis=1),
    }
    length = engineering_unit(float(section.depths[-1]), "m")
    unit = engineering_unit(float(max(np.abs(v).max() for v in lines.values())), "Pa")
    figure = _titled(5.2, 4.8, title)
    ax = figure.subplots()
    layers = np.array([level.layer for level in section.levels])
    for n, (name, values) in enumerate(lines.items()):
        for layer in np.unique(layers):
            inside = layers == layer
            ax.plot(
                values[inside] / unit.size, section.depths[inside] / length.size,
                color=style.LINE_COLOURS[n], linestyle=style.LINE_STYLES[n],
                label=name if layer == layers[0] else None,
            )  # fmt: skip
    for depth in _interface_depths(section):
        ax.axhline(depth / length.size, color=style.GREY, linewidth=0.7, linestyle="--")
    ax.axvline(0.0, color="black", linewidth=0.5)
    ax.set_ylim(section.depths[-1] / length.size, 0.0)
    ax.set_xlabel(f"stress at x = y = 0 ({unit.name})")
    ax.set_ylabel(f"depth z ({length.name})")
    ax.legend(loc="center left", bbox_to_anchor=(1.01, 0.5))
    return figure


def interface_plot(
    section: SubsurfaceField, sides: tuple[tuple[Level, ...], ...], title: str
) -> Figure:
    """What an interface carries, and what jumps there; call within `figure_style`."""
    shown = sides[:MOST_INTERFACES]
    length = engineering_unit(float(section.x[-1]), "m")
    stress = section.stress[..., 0]
    unit = engineering_unit(float(np.abs(stress).max()), "Pa")
    figure = _titled(9.6, 2.6 * len(shown) + 0.5, title)
    axes = figure.subplots(len(shown), 2, sharex=True, squeeze=False)
    for number, (pair, (carried, jumping)) in enumerate(zip(shown, axes, strict=True), 1):
        for n, (name, k) in enumerate({"σ_zz": ZZ, "σ_xz": XZ}.items()):
            values = stress[section.levels.index(pair[0]), k] / unit.size
            carried.plot(section.x / length.size, values, label=name, **_line(n))
        for n, (side, level) in enumerate(zip(("above", "below"), pair, strict=False)):
            at = stress[section.levels.index(level)]
            jumping.plot(
                section.x / length.size, at[XX] / unit.size, label=f"σ_xx {side}", **_line(2 * n)
            )
            jumping.plot(
                section.x / length.size, von_mises(at) / unit.size,
                label=f"von Mises {side}", **_line(2 * n + 1),
            )  # fmt: skip
        depth = length.text(pair[0].depth)
        for ax in (carried, jumping):
            ax.axhline(0.0, color="black", linewidth=0.5)
            ax.set_ylabel(f"stress ({unit.name})")
            ax.set_title(f"interface {number}, z = {depth}")
            ax.legend(loc="center left", bbox_to_anchor=(1.01, 0.5), fontsize=7.5)
    for ax in axes[-1]:
        ax.set_xlabel(f"x at y = 0 ({length.name})")
    return figure


def _line(number: int) -> dict[str, Any]:
    return {"color": style.LINE_COLOURS[number], "linestyle": style.LINE_STYLES[number]}
