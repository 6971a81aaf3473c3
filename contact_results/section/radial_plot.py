"""Tractions and slip over the radius, or on the line of the tangential load."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from contact_results.figures import style
from contact_results.figures.shown_steps import SAME, selected
from contact_scene import FrictionMap
from contact_scene.engineering_units import EngineeringUnit, engineering_unit
from fem_reference import Increment, Result

Values = NDArray[np.float64]

SHOWN = 1.15  # contact radii
COMPONENTS = {
    "radial": ("$q_r$", "outward"),
    "circumferential": ("$q_θ$", "around the axis"),
    "along_load": ("$q_x$", "along the load"),
}


@dataclass(frozen=True)
class Line:
    """Where values are shown: over the radius, or where fields depend on the angle from one edge
    to the other along the load."""

    result: Result

    @property
    def through_axis(self) -> bool:
        """Whether it goes on behind the axis."""
        return any(increment.angles is not None for increment in self.result.increments)

    @property
    def x(self) -> Values:
        """Positions [length]."""
        radii = self.result.increments[0].radii
        return np.concatenate([-radii[::-1], radii]) if self.through_axis else radii

    @property
    def label(self) -> str:
        """What the positions are."""
        return "distance from the axis along the load" if self.through_axis else "radius r"

    def of(self, increment: Increment, field: Values, *, turns: bool = False) -> Values:
        """Values along the line.

        turns  whether the sign changes behind the axis, where outwards is against the load
        """
        if not self.through_axis:
            return field
        ahead, behind = (field, field) if increment.angles is None else (field[:, 0], field[:, -1])
        return np.concatenate([(-behind if turns else behind)[::-1], ahead])


def traction_plot(result: Result) -> Figure:
    """Pressure, and shear where there is any, at the end of the loading steps."""
    line = Line(result)
    shear = _component(result, "shear")
    figure = style.new_figure(6.0, 3.2 if shear is None else 5.6)
    axes = figure.subplots(1 if shear is None else 2, 1, sharex=True, squeeze=False)[:, 0]
    steps = selected(result.steps)
    unit = engineering_unit(max(step.peak_pressure for step in steps), "Pa")
    length = _length(result)
    for group, number in _numbered(steps, "pressure"):
        values = line.of(group[0], group[0].pressure) / unit.size
        axes[0].plot(line.x / length.size, values, label=_span(group), **_look(number))
    axes[0].set_ylim(bottom=0.0)
    axes[0].set_ylabel(f"pressure p ({unit.name})")
    if shear is not None:
        _draw_bound(axes[1], line, steps, length, _shear_unit(steps, f"shear_{shear}"))
        _draw(axes[1], line, steps, f"shear_{shear}", length)
        symbol, _ = COMPONENTS[shear]
        if line.through_axis:
            symbol = "$q_x$"
        axes[1].set_ylabel(f"shear {symbol} ({_shear_unit(steps, f'shear_{shear}').name})")
    _finish(axes, line, length, result)
    return figure


def slip_plot(result: Result) -> Figure | None:
    """Slip since the start of the history at the end of the loading steps; None without slip."""
    component = _component(result, "slip")
    if component is None:
        return None
    line, steps, length = Line(result), selected(result.steps), _length(result)
    figure = style.new_figure(6.0, 3.2)
    ax = figure.subplots()
    unit = _draw(ax, line, steps, f"slip_{component}", length)
    where = "along the load" if line.through_axis else COMPONENTS[component][1]
    ax.set_ylabel(f"slip {where} ({unit.name})")
    _finish([ax], line, length, result)
    return figure


def _component(result: Result, kind: str) -> str | None:
    """The component that a path has and that is somewhere not zero; outward before around."""
    for name in COMPONENTS:
        fields = (getattr(step, f"{kind}_{name}") for step in result.steps)
        if any(field is not None and np.any(field) for field in fields):
            return name
    return None


def _draw(
    ax: Any, line: Line, steps: Sequence[Increment], name: str, length: EngineeringUnit
) -> EngineeringUnit:
    kind = "Pa" if name.startswith("shear") else "m"
    largest = max(float(np.max(np.abs(_values(step, name)))) for step in steps)
    unit = engineering_unit(largest, kind)
    for group, number in _numbered(steps, name):
        field = _values(group[0], name)
        values = line.of(group[0], field, turns=name.endswith("radial")) / unit.size
        ax.plot(line.x / length.size, values, label=_span(group), **_look(number))
    ax.axhline(0.0, color="black", linewidth=0.5)
    return unit


def _draw_bound(
    ax: Any,
    line: Line,
    steps: Sequence[Increment],
    length: EngineeringUnit,
    unit: EngineeringUnit,
) -> None:
    """± µp in grey."""
    friction = line.result.scene.friction
    if friction is None or isinstance(friction.coefficient, FrictionMap):
        return
    for group, number in _numbered(steps, "pressure"):
        bound = friction.coefficient * line.of(group[0], group[0].pressure) / unit.size
        x = line.x / length.size
        ax.fill_between(x, -bound, bound, color=style.GREY, alpha=0.12, linewidth=0)
        for sign in (1, -1):
            label = "± µp" if number == 0 and sign == 1 else None
            ax.plot(x, sign * bound, color=style.GREY, linewidth=0.8, label=label)


def _finish(axes: Any, line: Line, length: EngineeringUnit, result: Result) -> None:
    reach = SHOWN * max(step.contact_radius for step in result.steps) / length.size
    axes[-1].set_xlabel(f"{line.label} ({length.name})")
    axes[-1].set_xlim(-reach if line.through_axis else 0.0, reach)
    for ax in axes:
        ax.legend(loc="center left", bbox_to_anchor=(1.01, 0.5), handlelength=2.6)


def _numbered(steps: Sequence[Increment], name: str) -> list[tuple[list[Increment], int]]:
    """Neighbouring steps whose field looks the same, each group with its number."""
    groups: list[list[Increment]] = []
    for step in steps:
        if groups and _looks_same(_values(groups[-1][0], name), _values(step, name)):
            groups[-1].append(step)
        else:
            groups.append([step])
    return [(group, number) for number, group in enumerate(groups)]


def _looks_same(one: Values, other: Values) -> bool:
    if one.shape != other.shape:
        return False
    return bool(np.max(np.abs(one - other)) <= SAME * np.max(np.abs(one)))


def _values(step: Increment, name: str) -> Values:
    """The field; zero where the step has none."""
    field = getattr(step, name)
    return np.zeros_like(step.pressure) if field is None else np.asarray(field)


def _shear_unit(steps: Sequence[Increment], name: str) -> EngineeringUnit:
    return engineering_unit(max(float(np.max(np.abs(_values(s, name)))) for s in steps), "Pa")


def _length(result: Result) -> EngineeringUnit:
    return engineering_unit(max(step.contact_radius for step in result.steps), "m")


def _span(group: Sequence[Increment]) -> str:
    first, last = group[0].step, group[-1].step
    return f"step {first}" if first == last else f"steps {first}–{last}"


def _look(number: int) -> dict[str, Any]:
    return {"color": style.LINE_COLOURS[number], "linestyle": style.LINE_STYLES[number]}
