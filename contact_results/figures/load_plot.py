"""Plots of loads over displacements: the fretting loop, and normal force over approach."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from contact_results.figures import style
from contact_results.figures.shown_steps import on_axis
from contact_scene.reading.engineering_units import quantity

if TYPE_CHECKING:
    from contact_results.surface import Increment, Result

Values = NDArray[np.float64]


class Loop(NamedTuple):
    """Loop of a load over its displacement: force over shift, or torque over twist.

    The values are those at the ends of all increments that have both.

    path      these increments
    force     name of the load: tangential_force or torque
    forces    values of the load (n,)
    motion    name of the displacement: tangential_shift or twist
    motions   values of the displacement (n,)
    along     direction of the force and the shift, in words; empty for torque
    actuator  shift of the actuator of a test rig (n,); None without one
    """

    path: list[Increment]
    force: str
    forces: Values
    motion: str
    motions: Values
    along: str
    actuator: Values | None = None

    @property
    def work(self) -> float:
        """Sum over all increments of the magnitude of the work of the load, by the trapezoidal
        rule.

        Work put in and work recovered both count as positive.
        """
        return float(np.sum(np.abs((self.forces[1:] + self.forces[:-1]) * np.diff(self.motions))))


def moved(increments: Sequence[Increment]) -> int:
    """Count the increments with a non-zero tangential force or torque.

    Force and torque are counted separately, and the larger count is returned. A fretting loop is
    drawn only if there are enough of these increments.
    """
    loops = _loops(increments)
    return max((int(np.count_nonzero(loop.forces)) for loop in loops), default=0)


def draw_loop(ax: Any, result: Result) -> None:
    """Draw the fretting loop: tangential force over shift, or torque over twist.

    The loop with more work is drawn. Force and shift are components along the largest force.

    ax  axes of matplotlib
    """
    path, force, forces, motion, motions, along, actuator = max(
        _loops(result.increments), key=lambda loop: loop.work
    )
    x, across = on_axis(motion, motions, along)
    y, upward = on_axis(force, forces, along)

    ax.axhline(0.0, color=style.GREY, linewidth=0.5)
    ax.axvline(0.0, color=style.GREY, linewidth=0.5)
    ax.plot(x, y, color=style.LINE_COLOURS[0], marker=".", markersize=3.5, linewidth=1.2)
    if actuator is not None:
        unit = motions @ x / (motions @ motions)  # factor from SI to the unit of the axis
        style_of = {"color": style.LINE_COLOURS[2], "linestyle": "--", "linewidth": 1.0}
        ax.plot(unit * actuator, y, label="actuator", **style_of)
    ends = [n for n, i in enumerate(path) if i.index == i.increments_in_step]
    ax.plot(x[ends], y[ends], "o", color=style.LINE_COLOURS[1], markersize=5, label="end of a step")
    ax.margins(0.08)
    ax.set_xlabel(across)
    ax.set_ylabel(upward)
    energy = path[-1].dissipated_energy
    if energy is not None:
        ax.plot([], [], " ", label=f"dissipated: {quantity(energy, 'J')}")
    style.legend_above(ax)


def _loops(increments: Sequence[Increment]) -> list[Loop]:
    """Return the loops of a load history: force over shift, and torque over twist.

    A loop is omitted if its load is zero in all increments.
    """
    found = []
    path = [i for i in increments if i.tangential_shift is not None]
    force = np.array([i.tangential_force for i in path])
    if np.any(force):
        direction = _direction(force)
        shift = np.array([i.tangential_shift for i in path]) @ direction
        found.append(
            Loop(
                path, "tangential_force", force @ direction, "tangential_shift", shift,
                _along(direction), _actuator(path, direction),
            )
        )  # fmt: skip
    path = [i for i in increments if i.torque is not None and i.twist is not None]
    torque = np.array([i.torque for i in path])
    if np.any(torque):
        twist = np.array([i.twist for i in path])
        found.append(Loop(path, "torque", torque, "twist", twist, ""))
    return found


def _actuator(path: Sequence[Increment], direction: Values) -> Values | None:
    """Return the shift of the actuator along a direction at each increment (n,).

    Returns None if an increment has no such shift.

    direction  unit vector (2,)
    """
    shifts = [i.actuator_shift for i in path]
    if any(shift is None for shift in shifts):
        return None
    return np.array(shifts) @ direction


def _direction(force: Values) -> Values:
    """Return the unit vector along the largest force, with a positive largest component.

    force  tangential force of each increment (n, 2)
    """
    largest = force[np.argmax(np.hypot(force[:, 0], force[:, 1]))]
    largest = largest * np.sign(largest[np.argmax(np.abs(largest))])
    return np.asarray(largest / np.hypot(*largest))


def _along(direction: Values) -> str:
    """Return the name of a direction in the plane of contact, such as "along x".

    direction  unit vector (2,)
    """
    degrees = np.degrees(np.arctan2(direction[1], direction[0]))
    names = {0: "along x", 90: "along y"}
    return names.get(round(degrees, 3), f"at {degrees:.1f}° to x")


def draw_loading(ax: Any, result: Result) -> None:
    """Draw normal force over approach at the end of every increment, from the first contact.

    ax  axes of matplotlib
    """
    path = [(0.0, 0.0), *((i.approach, i.normal_force) for i in result.increments)]
    approach, force = np.array(path).T
    x, along = on_axis("approach", approach)
    y, upward = on_axis("normal_force", force, "W")
    # With one or two increments, a line between the points would not show the load history.
    line = "-" if len(path) > 3 else ""
    ax.plot(x, y, color=style.LINE_COLOURS[0], linestyle=line, marker="o", markersize=3.5)
    ax.set_xlim(left=0.0)
    ax.set_ylim(bottom=0.0)
    ax.set_xlabel(along)
    ax.set_ylabel(upward)
