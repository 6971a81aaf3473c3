"""Loads against motions: the fretting loop, and normal force against approach."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from contact_results.figures import style
from contact_results.figures.shown_steps import AT_MOST, on_axis
from contact_results.natural_sizes import SI, Units
from contact_scene.engineering_units import quantity

if TYPE_CHECKING:
    from contact_results.surface import Increment, Result

Values = NDArray[np.float64]

SAME_PLACE = 0.02  # of the axis: points whose numbers would cover each other


class Loop(NamedTuple):
    """A load and its motion at the ends of all increments that have both, by name.

    along  in which direction, in words
    """

    path: list[Increment]
    force: str
    forces: Values
    motion: str
    motions: Values
    along: str

    @property
    def work(self) -> float:
        """Put in and taken out."""
        return float(np.sum(np.abs((self.forces[1:] + self.forces[:-1]) * np.diff(self.motions))))


def moved(increments: Sequence[Increment]) -> int:
    """How many increments end with a tangential load and its defined motion."""
    loops = _loops(increments)
    return max((int(np.count_nonzero(loop.forces)) for loop in loops), default=0)


def hysteresis_plot(result: Result, units: Units = SI) -> Figure:
    """The loop by itself."""
    figure = style.new_figure(5.2, 4.0)
    draw_loop(figure.subplots(), result, units)
    return figure


def draw_loop(ax: Any, result: Result, units: Units = SI) -> None:
    """Force and shift of every increment along the direction of the largest force, or torque and
    twist where they do more work."""
    path, force, forces, motion, motions, along = max(
        _loops(result.increments), key=lambda loop: loop.work
    )
    x, across = on_axis(motion, motions, along, units)
    y, upward = on_axis(force, forces, along, units)

    ax.axhline(0.0, color=style.GREY, linewidth=0.5)
    ax.axvline(0.0, color=style.GREY, linewidth=0.5)
    ax.plot(x, y, color=style.LINE_COLOURS[0], marker=".", markersize=3.5, linewidth=1.2)
    ends = [n for n, i in enumerate(path) if i.index == i.increments_in_step]
    label = "end of a loading step"
    ax.plot(x[ends], y[ends], "o", color=style.LINE_COLOURS[1], markersize=5, label=label)
    if len(ends) <= AT_MOST:
        _number(ax, x[ends], y[ends], [path[n].step for n in ends])
    ax.margins(0.08)
    ax.set_xlabel(across)
    ax.set_ylabel(upward)
    energy = path[-1].dissipated_energy
    if energy is not None:
        ax.plot([], [], " ", label=f"dissipated in all: {quantity(energy, 'J')}")
    ax.legend(loc="best")


def _loops(increments: Sequence[Increment]) -> list[Loop]:
    found = []
    path = [i for i in increments if i.tangential_shift is not None]
    force = np.array([i.tangential_force for i in path])
    if np.any(force):
        direction = _direction(force)
        shift = np.array([i.tangential_shift for i in path]) @ direction
        found.append(
            Loop(
                path, "tangential_force", force @ direction, "tangential_shift", shift,
                _along(direction),
            )
        )  # fmt: skip
    path = [i for i in increments if i.torque is not None and i.twist is not None]
    torque = np.array([i.torque for i in path])
    if np.any(torque):
        twist = np.array([i.twist for i in path])
        found.append(Loop(path, "torque", torque, "twist", twist, ""))
    return found


def _number(ax: Any, x: Values, y: Values, steps: Sequence[int]) -> None:
    """Write the steps' numbers next to their points; points at the same place share a text."""
    distance = np.hypot(np.subtract.outer(x, x) / np.ptp(x), np.subtract.outer(y, y) / np.ptp(y))
    together = distance < SAME_PLACE
    for n, neighbours in enumerate(together):
        if np.argmax(neighbours) == n:  # the first of its place writes for all
            text = ", ".join(
                str(step) for step, here in zip(steps, neighbours, strict=True) if here
            )
            offset = (0, 6 if y[n] >= 0 else -13)
            ax.annotate(text, (x[n], y[n]), offset, textcoords="offset points", ha="center")


def _direction(force: Values) -> Values:
    """Unit vector along the largest force, turned so that its largest component is positive."""
    largest = force[np.argmax(np.hypot(force[:, 0], force[:, 1]))]
    largest = largest * np.sign(largest[np.argmax(np.abs(largest))])
    return np.asarray(largest / np.hypot(*largest))


def _along(direction: Values) -> str:
    degrees = np.degrees(np.arctan2(direction[1], direction[0]))
    names = {0: "along x", 90: "along y"}
    return names.get(round(degrees, 3), f"at {degrees:.1f}° to x")


def loading_plot(result: Result, units: Units = SI) -> Figure:
    """The curve by itself."""
    figure = style.new_figure(5.0, 3.6)
    draw_loading(figure.subplots(), result, units)
    return figure


def draw_loading(ax: Any, result: Result, units: Units = SI) -> None:
    """Force and approach of every increment, from first touch."""
    path = [(0.0, 0.0), *((i.approach, i.normal_force) for i in result.increments)]
    approach, force = np.array(path).T
    x, along = on_axis("approach", approach, units=units)
    y, upward = on_axis("normal_force", force, "W", units)
    # A line between touch and one end would be no path that the contact took.
    line = "-" if len(path) > 3 else ""
    ax.plot(x, y, color=style.LINE_COLOURS[0], linestyle=line, marker="o", markersize=3.5)
    ax.set_xlim(left=0.0)
    ax.set_ylim(bottom=0.0)
    ax.set_xlabel(along)
    ax.set_ylabel(upward)
