"""Plots of loads over displacements: the fretting loop, and normal force over approach."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from contact_results.figures import style
from contact_results.figures.shown_steps import scale_for_axis
from contact_scene.quantities.per_length import shown_unit
from contact_scene.reading.engineering_units import quantity

if TYPE_CHECKING:
    from contact_results.surface import Increment

Values = NDArray[np.float64]


class Loop(NamedTuple):
    """Loop of a load over its displacement: force over shift, or torque over twist.

    Force and shift are components along the largest force.

    path     increments that have both load and displacement
    force    name of the load: tangential_force or torque
    forces   values of the load at the ends of these increments (n,)
    motion   name of the displacement: tangential_shift or twist
    motions  values of the displacement (n,)
    along    unit vector of the force and the shift (2,); None for torque
    """

    path: list[Increment]
    force: str
    forces: Values
    motion: str
    motions: Values
    along: Values | None

    @property
    def work(self) -> float:
        """Sum of the magnitudes of the work of the load in all increments, by the trapezoidal rule.

        Work put in and work recovered both count as positive.
        """
        return float(np.sum(np.abs((self.forces[1:] + self.forces[:-1]) * np.diff(self.motions))))


def load_loop(increments: Sequence[Increment]) -> Loop | None:
    """Return the loop of a load history with more work: force over shift, or torque over twist.

    Returns None if tangential force and torque are zero in all increments.
    """
    found = []
    for force, motion in (("tangential_force", "tangential_shift"), ("torque", "twist")):
        names = (force, motion)
        path = [i for i in increments if all(getattr(i, name) is not None for name in names)]
        forces, motions = (np.array([getattr(i, name) for i in path]) for name in names)
        if np.any(forces):
            along = _force_direction(forces) if forces.ndim > 1 else None
            if along is not None:
                forces, motions = forces @ along, motions @ along
            found.append(Loop(path, force, forces, motion, motions, along))
    return max(found, key=lambda loop: loop.work, default=None)


def draw_loop(ax: Any, loop: Loop) -> None:
    """Draw the fretting loop: tangential force over shift, or torque over twist.

    ax  axes of matplotlib
    """
    words = "" if loop.along is None else _direction_name(loop.along)
    motions = [loop.motions]
    actuator = [i.actuator_shift for i in loop.path]
    if loop.along is not None and all(shift is not None for shift in actuator):
        motions.append(np.array(actuator) @ loop.along)
    line = loop.path[0].is_line
    (x, *of_actuator), across = scale_for_axis(loop.motion, np.array(motions), words, line=line)
    y, upward = scale_for_axis(loop.force, loop.forces, words, line=line)
    ax.axhline(0.0, color=style.GREY, linewidth=0.5)
    ax.axvline(0.0, color=style.GREY, linewidth=0.5)
    ax.plot(x, y, color=style.LINE_COLOURS[0], marker=".", markersize=3.5, linewidth=1.2)
    for values in of_actuator:
        style_of = {"color": style.LINE_COLOURS[2], "linestyle": "--", "linewidth": 1.0}
        ax.plot(values, y, label="actuator", **style_of)
    ends = [n for n, i in enumerate(loop.path) if i.index == i.increments_in_step]
    ax.plot(x[ends], y[ends], "o", color=style.LINE_COLOURS[1], markersize=5, label="end of a step")
    ax.margins(0.08)
    ax.set_xlabel(across)
    ax.set_ylabel(upward)
    energy = loop.path[-1].dissipated_energy
    if energy is not None:
        ax.plot([], [], " ", label=f"dissipated: {quantity(energy, shown_unit('J', line=line))}")
    style.legend_above(ax)


def _force_direction(force: Values) -> Values:
    """Return the unit vector along the largest force (n, 2), its largest component positive."""
    largest = force[np.argmax(np.hypot(force[:, 0], force[:, 1]))]
    largest = largest * np.sign(largest[np.argmax(np.abs(largest))])
    return np.asarray(largest / np.hypot(*largest))


def _direction_name(direction: Values) -> str:
    degrees = np.degrees(np.arctan2(direction[1], direction[0]))
    names = {0: "along x", 90: "along y"}
    return names.get(round(degrees, 3), f"at {degrees:.1f}° to x")


def draw_loading(ax: Any, increments: Sequence[Increment]) -> None:
    """Draw normal force over approach at the end of every increment, from the first contact.

    Without an approach the contact radius takes its place.

    ax  axes of matplotlib
    """
    end, given = increments[-1], "approach"
    if end.approach is None:
        given = "contact_radius"
    path = [(0.0, 0.0), *((getattr(i, given) or 0.0, i.normal_force) for i in increments)]
    motion, force = np.array(path).T
    x, along = scale_for_axis(given, motion, line=end.is_line)
    y, upward = scale_for_axis("normal_force", force, "W", line=end.is_line)
    # With one or two increments, a line between the points would not show the load history.
    line = "-" if len(path) > 3 else ""
    ax.plot(x, y, color=style.LINE_COLOURS[0], linestyle=line, marker="o", markersize=3.5)
    ax.set_xlim(left=0.0)
    ax.set_ylim(bottom=0.0)
    ax.set_xlabel(along)
    ax.set_ylabel(upward)
