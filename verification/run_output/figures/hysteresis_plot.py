"""Tangential force against shift: the fretting loop."""

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from semi_analytical import Increment, Result
from verification.run_output.engineering_units import engineering_unit, quantity
from verification.run_output.figures import style
from verification.run_output.figures.shown_steps import AT_MOST


def moved(increments: Sequence[Increment]) -> list[Increment]:
    """The increments that end with a tangential force and a defined shift."""
    return [i for i in increments if i.tangential_shift is not None and np.any(i.tangential_force)]


def hysteresis_plot(result: Result) -> Figure:
    """Force and shift of every increment along the direction of the largest force."""
    path = [i for i in result.increments if i.tangential_shift is not None]
    force = np.array([i.tangential_force for i in path])
    shift = np.array([i.tangential_shift for i in path])
    direction = _direction(force)
    T, omega = force @ direction, shift @ direction
    force_unit = engineering_unit(float(np.max(np.abs(T))), "N")
    shift_unit = engineering_unit(float(np.max(np.abs(omega))), "m")

    figure = style.new_figure(5.2, 4.0)
    ax = figure.subplots()
    ax.axhline(0.0, color=style.GREY, linewidth=0.5)
    ax.axvline(0.0, color=style.GREY, linewidth=0.5)
    ax.plot(omega / shift_unit.size, T / force_unit.size, color=style.LINE_COLOURS[0],
            marker=".", markersize=3.5, linewidth=1.2)  # fmt: skip
    ends = [n for n, i in enumerate(path) if i.index == i.increments_in_step]
    ax.plot(omega[ends] / shift_unit.size, T[ends] / force_unit.size, "o",
            color=style.LINE_COLOURS[1], markersize=5, label="end of a loading step")  # fmt: skip
    if len(ends) <= AT_MOST:
        for n in ends:
            ax.annotate(
                str(path[n].step),
                (omega[n] / shift_unit.size, T[n] / force_unit.size),
                xytext=(0, 6 if T[n] >= 0 else -13),
                textcoords="offset points",
                ha="center",
            )
    ax.margins(0.08)
    ax.set_xlabel(f"tangential shift {_along(direction)} ({shift_unit.name})")
    ax.set_ylabel(f"tangential force {_along(direction)} ({force_unit.name})")
    energy = path[-1].dissipated_energy
    if energy is not None:
        ax.plot([], [], " ", label=f"dissipated in all: {quantity(energy, 'J')}")
    ax.legend(loc="upper left")
    return figure


def _direction(force: NDArray[np.float64]) -> NDArray[np.float64]:
    """Unit vector along the largest force, turned so that its largest component is positive."""
    largest = force[np.argmax(np.hypot(force[:, 0], force[:, 1]))]
    largest = largest * np.sign(largest[np.argmax(np.abs(largest))])
    return np.asarray(largest / np.hypot(*largest))


def _along(direction: NDArray[np.float64]) -> str:
    degrees = np.degrees(np.arctan2(direction[1], direction[0]))
    names = {0: "along x", 90: "along y"}
    return names.get(round(degrees, 3), f"at {degrees:.1f}° to x")
