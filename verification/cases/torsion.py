"""Torsion: a ball twisted into partial slip and back, and a stuck flat punch."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

import numpy as np
from scipy.integrate import quad

from contact_results.quantities import energy_between, shear_of
from contact_scene import Body, CoulombFriction, FlatPunch, LoadStep, Scene
from verification.closed_forms.torsion import StuckTorsion, TorsionalPartialSlip
from verification.exhibits.chart import Chart
from verification.exhibits.convergence_chart import convergence_chart
from verification.judging.case import Case, Derived, Level, Quantity, Required
from verification.judging.ladder import cells_label
from verification.judging.order_of_convergence import Followed, OrderOfConvergence
from verification.judging.refinement import part_of_a_cell, refinement
from verification.judging.run import Run
from verification.norms import shear_error
from verification.observed.end_state import stick_radius
from verification.problems import paper_scene as paper
from verification.problems.paper_scene import FRICTION, HERTZ, STEEL
from verification.problems.reference import closed_form, exact_zero

if TYPE_CHECKING:
    from semi_analytical import Increment, Result
    from semi_analytical.grid import SurfaceGrid

SOURCE = "Lubkin 1951"
MASING = "Lubkin 1951, with Masing's rule for the reversal"
STUCK = "Reissner and Sagoci 1944"
HALF_A_PER_CENT = "0.5 % of the twist was asked for at 128 x 128"
MODULUS = STEEL.shear_modulus / 2
PARTS = (0.5, 0.9, 0.99)  # of the sliding torque, one loading step each
AMPLITUDE = 0.9
PUNCH_RADIUS = 0.4e-3
PUNCH_WINDOW_PER_RADIUS = 2.2


def virgin(torque: float) -> TorsionalPartialSlip:
    """The paper's ball, twisted for the first time by a torque >= 0."""
    return TorsionalPartialSlip.under_moment(
        torque, HERTZ.contact_radius, HERTZ.peak_pressure, FRICTION, MODULUS
    )


SLIDING_TORQUE = virgin(0.0).sliding_moment
EXACT = {part: virgin(part * SLIDING_TORQUE) for part in PARTS}


def twisted(title: str, *steps: LoadStep) -> Scene:
    """The paper's ball under its force, then these steps."""
    return paper.frictional(title, paper.paraboloid(STEEL), STEEL, *steps)


def torque_step(part: float) -> LoadStep:
    """Torque up to a part of the sliding torque in one increment: exact, as the load goes
    straight."""
    return LoadStep(torque=part * SLIDING_TORQUE, increments=1)


MONOTONIC = twisted("Ball in torsion", *(torque_step(part) for part in PARTS))
LOOP = twisted(
    "Ball in torsion to and fro",
    *(torque_step(part) for part in (AMPLITUDE, 0.0, -AMPLITUDE, AMPLITUDE)),
)
LED = twisted(
    "Ball in torsion by a given twist", LoadStep(twist=EXACT[AMPLITUDE].twist, increments=1)
)
# q/p is largest at the rim, 3M/(2Wa) = 0.45: nothing slips.
STUCK_TORQUE = 0.3 * paper.NORMAL_FORCE * PUNCH_RADIUS
STUCK_PUNCH = Scene(
    title="Flat punch in torsion without slip",
    indenter=FlatPunch(radius=PUNCH_RADIUS, material=STEEL),
    body=Body(material=STEEL),
    friction=CoulombFriction(coefficient=1.0),
    loading=(
        LoadStep(normal_force=paper.NORMAL_FORCE, increments=1),
        LoadStep(torque=STUCK_TORQUE, increments=1),
    ),
)


def torsion(level: Level = Level.QUICK) -> Case:
    """The case, on finer grids above the quick level."""
    return torsion_on(refinement(32, 128 if level is Level.QUICK else 256))


def torsion_on(cells: tuple[int, ...]) -> Case:
    """The case on square grids of these many cells per side."""
    finest = cells[-1]
    grid = paper.hertz_grid(finest)
    levels = tuple(cells_label(n) for n in cells)
    return Case(
        name="torsion",
        title="Torsion with partial slip",
        problem=(
            "The paper's ball under 1 kN, twisted by 0.5, 0.9 and 0.99 of the torque at which all "
            "slips; to and fro by 0.9 of it; led to the twist of that torque; and a flat punch "
            "that sticks all over. Torsion moves the surfaces in circles, which no pressure "
            "couples with, so that the closed form holds for any pair of alike bodies."
        ),
        runs=(
            *(Run(cells_label(n), MONOTONIC, paper.hertz_grid(n)) for n in cells),
            Run("to and fro", LOOP, grid),
            Run("given twist", LED, grid),
            *(Run(_punch(n, finest), STUCK_PUNCH, _punch_grid(n)) for n in cells[::-2]),
        ),
        quantities=(
            *(q for number, part in enumerate(PARTS, 1) for q in _at(number, part, levels, finest)),
            *_to_and_fro(),
            Quantity(
                "torque_of_given_twist", f"torque at the twist of {AMPLITUDE:g} of the limit",
                "N m", "given twist", lambda result: _number(result.steps[-1].torque),
                closed_form(EXACT[AMPLITUDE].moment, SOURCE),
                Required(1e-3, "a fifth of what was asked of the twist: near the limit the torque "
                         "hardly depends on it"),
            ),
            Quantity(
                "stuck_twist", "twist of the stuck punch", "rad", "stuck punch",
                lambda result: _number(result.steps[-1].twist),
                closed_form(StuckTorsion(PUNCH_RADIUS, MODULUS, STUCK_TORQUE).twist, STUCK),
                Required(1.5 * PUNCH_WINDOW_PER_RADIUS / finest,
                         "the twist goes as 1/radius³, and the rim is a staircase by which the "
                         "radius seems to be wrong by up to half a cell"),
            ),
            Quantity(
                "stuck_area", "stick area over contact area of the stuck punch", "", "stuck punch",
                _stuck_part, closed_form(1.0, STUCK),
                Required(1e-12, "µ is twice what would make the rim slip"),
            ),
        ),
        orders=(
            OrderOfConvergence(
                "order_of_shear", Followed.SHEAR,
                "Σ|q - q_exact| / Σµp at 0.9 of the limit", levels,
                error_at(PARTS.index(AMPLITUDE) + 1, AMPLITUDE), 1.5,
                "square-root edges of stick zone and contact, as in the Cattaneo-Mindlin case",
            ),
        ),
        charts=_charts,
    )  # fmt: skip


def _punch(cells: int, finest: int) -> str:
    return "stuck punch" if cells == finest else f"stuck punch, {cells_label(cells)}"


def _punch_grid(cells: int) -> SurfaceGrid:
    return paper.square_grid(cells, PUNCH_WINDOW_PER_RADIUS / 2 * PUNCH_RADIUS)


def error_at(step: int, part: float) -> Callable[[Result], float]:
    """Σ|q - q_exact| / Σµp at the end of a step; steps count from 0, the pressing."""

    def error(result: Result) -> float:
        end = result.steps[step]
        x, y = result.grid.coordinates()
        r = np.hypot(x, y)
        inside = r < HERTZ.contact_radius
        exact = np.where(inside, EXACT[part].shear(np.minimum(r, HERTZ.contact_radius)), 0.0)
        across = np.stack([-y, x]) / np.where(r > 0, r, 1.0)
        return shear_error(shear_of(end), exact * across, FRICTION * end.pressure)

    return error


def _at(step: int, part: float, levels: tuple[str, ...], cells: int) -> tuple[Quantity, ...]:
    exact, finest = EXACT[part], levels[-1]

    def twist(result: Result) -> float:
        return _number(result.steps[step].twist)

    return (
        Quantity(
            f"twist_at_{part:g}", f"twist at {part:g} of the sliding torque", "rad", finest, twist,
            closed_form(exact.twist, SOURCE),
            Derived(levels, 1.5, 5e-3, f"order 1.5 as the shear; the cap: {HALF_A_PER_CENT}"),
        ),
        Quantity(
            f"stick_radius_at_{part:g}", f"√(stick area / π) at {part:g} of the sliding torque",
            "m", finest, lambda result: stick_radius(result, step),
            closed_form(exact.stick_radius, SOURCE, HERTZ.contact_radius),
            Derived(levels, 1.0, part_of_a_cell(0.25, cells, paper.WINDOW_PER_RADIUS),
                    "order 1: the border is known to a part of a cell; the cap is a quarter"),
            HERTZ.contact_radius, "the contact radius",
        ),
        Quantity(
            f"shear_at_{part:g}", f"Σ|q - q_exact| / Σµp at {part:g} of the sliding torque", "",
            finest, error_at(step, part), exact_zero(SOURCE),
            Required(2e-3, "as required of the Cattaneo-Mindlin shear on these grids"),
            1.0, "Σµp",
        ),
    )  # fmt: skip


def _to_and_fro() -> tuple[Quantity, ...]:
    """The virgin curve gives the loop: from a reversal at M* on, the twist changes by twice what
    half the change of torque would give (Masing)."""
    reached = EXACT[AMPLITUDE].twist
    back = reached - 2 * virgin(0.5 * AMPLITUDE * SLIDING_TORQUE).twist
    # Area of the loop: 4 φ* M* - 8 ∫ φ dM along the virgin curve.
    area = quad(
        lambda torque: virgin(torque).twist, 0, AMPLITUDE * SLIDING_TORQUE, epsrel=1e-10, epsabs=0
    )[0]
    energy = 4 * reached * AMPLITUDE * SLIDING_TORQUE - 8 * area
    exact = {3: back, 4: -reached, 5: reached}
    names = {3: "twist_unloaded", 4: "twist_reversed", 5: "twist_closed"}

    def twist(step: int) -> Callable[[Result], float]:
        return lambda result: _number(result.steps[step - 1].twist)

    return (
        *(
            Quantity(
                names[step], f"twist after step {step} of the loop", "rad", "to and fro",
                twist(step), closed_form(value, MASING, reached),
                Required(1e-3, f"a fifth of what was asked: {HALF_A_PER_CENT}"),
                reached, "the largest twist",
            )
            for step, value in exact.items()
        ),
        Quantity(
            "energy_per_cycle", "energy lost from the first to the second torque of + 0.9", "J",
            "to and fro", lambda result: energy_between(result, 2, 5),
            closed_form(energy, MASING),
            Required(5e-3, f"as the twist: {HALF_A_PER_CENT}"),
        ),
    )  # fmt: skip


def _number(value: float | None) -> float:
    return float("nan") if value is None else float(value)


def _stuck_part(result: Result) -> float:
    end: Increment = result.steps[-1]
    return _number(end.stick_area) / end.contact_area


def _charts(results: Mapping[str, Result]) -> tuple[Chart, ...]:
    runs = [run for run in results.values() if run.scene == MONOTONIC]
    return (
        convergence_chart(
            "torsion_convergence",
            "Convergence of torsion",
            "Σ|q - q_exact| / Σµp against cell side for three torques, with a line of the expected "
            "slope 3/2.",
            [run.grid.spacing[0] / HERTZ.contact_radius for run in runs],
            {
                f"{part:g} of the limit": [error_at(step, part)(run) for run in runs]
                for step, part in enumerate(PARTS, 1)
            },
            {"0.9 of the limit": 1.5},
        ),
    )
