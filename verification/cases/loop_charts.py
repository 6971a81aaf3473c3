"""Figures of the fretting loop: hysteresis, and the paper's figures 1 and 2 done again."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from verification.exhibits.chart import Chart, Look, Panel, curve
from verification.exhibits.profile_chart import Section
from verification.problems import paper_scene as paper
from verification.problems.loop_history import AMPLITUDE, PRESSED, ExactLoop
from verification.problems.paper_scene import FRICTION, HERTZ
from verification.quantities import force_along_x, shear_of, shift_along_x

if TYPE_CHECKING:
    from semi_analytical import Increment, Result
    from verification.closed_forms.tangential_history import TangentialHistory

MICROMETRE = 1e-6
NEWTON_TO_LIMIT = 1 / paper.FRICTION_LIMIT
FINE = 40  # points of the closed form per branch

# Marked states of the loop: name, loading step, T/µW.
STATES = (
    ("A", 2, 0.45), ("B", 2, 0.9),
    ("C", 3, 0.45), ("D", 3, 0.0), ("E", 3, -0.45), ("F", 3, -0.9),
    ("G", 4, -0.45), ("H", 4, 0.0), ("I", 4, 0.45), ("J", 4, 0.9),
)  # fmt: skip
BRANCHES = {2: "loading", 3: "unloading", 4: "reloading"}


def hysteresis_chart(name: str, result: Result, exact: ExactLoop) -> Chart:
    """Tangential force against shift, with the closed form in grey."""
    forces, shifts = _closed_form_loop(exact)
    moved = [i for i in result.increments if i.step >= PRESSED]
    panel = Panel(
        x_label="tangential shift (µm)",
        y_label="T / µW",
        curves=(
            curve("closed form", shifts / MICROMETRE, forces, Look.REFERENCE),
            curve(
                "computed",
                [shift_along_x(i) / MICROMETRE for i in moved],
                [force_along_x(i) * NEWTON_TO_LIMIT for i in moved],
                Look.POINTS,
            ),
        ),
    )
    return Chart(
        name=name,
        title="Hysteresis loop",
        caption="Tangential force against tangential shift, one point per increment. The area of "
        "the closed loop is the energy that friction takes per cycle.",
        rows=((panel,),),
    )


def loading_history_chart(result: Result) -> Chart:
    """The paper's figure 1: the load history, with the states of figure 2 marked."""
    count = len(result.increments) - 1
    time = [number / count for number, _ in enumerate(result.increments)]
    force = [force_along_x(i) * NEWTON_TO_LIMIT for i in result.increments]
    marked = [
        (time[number], force[number], name)
        for name, step, part in STATES
        for number in [_number_of(result, step, part)]
    ]
    panel = Panel(
        x_label="time / τ",
        y_label="T / µW",
        curves=(
            curve("", time, force, series=0),
            curve(
                "states of figure 2", [t for t, _, _ in marked], [f for _, f, _ in marked],
                Look.MARKS,
            ),
        ),
        notes=tuple(marked),
    )  # fmt: skip
    return Chart(
        name="paper_figure_1",
        title="Figure 1 of the paper: the loading history in a fretting loop",
        caption="Tangential force over the friction limit against time, at constant normal force; "
        "the letters mark the states whose tractions figure 2 shows.",
        rows=((panel,),),
    )


def tractions_chart(result: Result, exact: ExactLoop) -> Chart:
    """The paper's figure 2: shear and friction limit along y = 0 in the marked states."""
    section = Section(result.grid, HERTZ.contact_radius)
    scale = FRICTION * HERTZ.peak_pressure
    x = section.x / HERTZ.contact_radius
    by_increment = {(i.step, i.index): state for i, state in exact.along(result)}
    limit = section.of(FRICTION * result.increments[-1].pressure) / scale
    panels = []
    for step, branch in BRANCHES.items():
        names = [(name, part) for name, s, part in STATES if s == step]
        states = [(n, result.increments[_number_of(result, step, part)]) for n, part in names]
        grey = [
            curve(
                "closed form" if n == 0 else "",
                x,
                by_increment[i.step, i.index].shear(section.r) / scale,
                Look.REFERENCE,
            )
            for n, (_, i) in enumerate(states)
        ]
        colour = [
            curve(_state_label(name, i), x, section.of(shear_of(i)[0]) / scale, series=n)
            for n, (name, i) in enumerate(states)
        ]
        bounds = [curve("± µp / µp₀", x, limit, Look.BOUND), curve("", x, -limit, Look.BOUND)]
        panels.append(
            (Panel(
                x_label="x / a" if step == max(BRANCHES) else "", y_label="qₓ / µp₀",
                curves=(*bounds, *grey, *colour), title=branch, height=1.4,
            ),)
        )  # fmt: skip
    return Chart(
        name="paper_figure_2",
        title="Figure 2 of the paper: contact tractions in a fretting loop",
        caption="Shear next to y = 0 over its largest possible value µp₀, in the states of figure "
        "1. The closed form is grey, as in the paper; the thin outer lines are the friction limit "
        "± µp, which is the pressure in these units.",
        rows=tuple(panels),
    )


def _number_of(result: Result, step: int, part: float) -> int:
    """Index of the increment of a step whose force is nearest to a part of µW."""
    distances = [
        abs(force_along_x(i) * NEWTON_TO_LIMIT - part) if i.step == step else np.inf
        for i in result.increments
    ]
    return int(np.argmin(distances))


def _state_label(name: str, increment: Increment) -> str:
    return f"{name}: {force_along_x(increment) * NEWTON_TO_LIMIT:+.2f} µW".replace("+0.00", "0")


def _closed_form_loop(exact: ExactLoop) -> tuple[np.ndarray, np.ndarray]:
    forces, shifts = [], []
    state: TangentialHistory = exact.virgin
    for start, end in pairwise((0.0, AMPLITUDE, -AMPLITUDE, AMPLITUDE)):
        for part in np.linspace(start, end, FINE):
            state = state.loaded_to(part * paper.FRICTION_LIMIT)
            forces.append(part)
            shifts.append(state.shift)
    return np.array(forces), np.array(shifts)
