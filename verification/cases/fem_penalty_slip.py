"""Slip and its memory by finite elements with a penalty: a fretting loop, and a twisted ball."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

import numpy as np

from verification.cases.fem_levels import finest, judged_within, label
from verification.cases.fem_partial_slip import (
    ASKED,
    AT_EDGE,
    EXACT,
    LARGEST_SHIFT,
    LIMIT,
    ORDER,
    SCENE,
    SOURCE,
    WHY,
    shear_error,
)
from verification.cases.loop_history import LOADED, loop_energy
from verification.cases.torsion import EXACT as TWISTED
from verification.cases.torsion import MONOTONIC, PARTS
from verification.cases.torsion import SOURCE as TWISTING
from verification.exhibits.chart import Chart
from verification.exhibits.profile_chart import ProfileLabels
from verification.judging.case import Case, Level, Quantity, Required
from verification.judging.radial_chart import radial_chart
from verification.judging.run import SectionRun, per_radius
from verification.judging.solver import Method
from verification.problems.paper_scene import HERTZ
from verification.problems.reference import closed_form, exact_zero

if TYPE_CHECKING:
    from fem_reference import Result


def fem_penalty_slip(level: Level = Level.QUICK) -> Case:
    """The case, on a finer mesh at higher levels."""
    return fem_penalty_slip_on(finest(level))


def fem_penalty_slip_on(elements: int) -> Case:
    """The case on one mesh."""
    mesh = per_radius(elements, 0.97 * HERTZ.contact_radius)
    loop = SectionRun(f"loop, {label(elements)}, penalty", SCENE, mesh, Method.PENALTY)
    ball = SectionRun(f"torsion, {label(elements)}, penalty", MONOTONIC, mesh, Method.PENALTY)
    return Case(
        name="fem_penalty_slip",
        title="Finite elements with a penalty: fretting loop and torsion",
        problem=(
            "The loop of fem_partial_slip and the twisted ball of fem_torsion with springs along "
            "the surface and Coulomb's law by return mapping. What a point has slipped is "
            "remembered as where its spring stands without load."
        ),
        runs=(loop, ball),
        quantities=(
            *_of_loop(loop.label, (64 / elements) ** ORDER),
            *(
                quantity
                for step, part in enumerate(PARTS, 1)
                for quantity in _at(step, part, ball.label, elements)
            ),
        ),
        charts=_charts,
        limits=(
            "For ν > 0 slip has a component across the load, up to 4 % of µp_H in the shear; both "
            "the closed form and this run neglect it.",
        ),
    )  # fmt: skip


def _of_loop(run: str, factor: float) -> tuple[Quantity, ...]:
    return (
        Quantity(
            "largest_shift_error", "largest difference of the shift in any increment", "m", run,
            EXACT.largest_shift_error, exact_zero(SOURCE), Required(ASKED["shift"] * factor, WHY),
            LARGEST_SHIFT, "the largest shift of the loop",
        ),
        Quantity(
            "energy_per_cycle", "energy dissipated from 0.9 µW to -0.9 µW and back", "J", run,
            loop_energy, closed_form(EXACT.energy_per_cycle, SOURCE),
            Required(ASKED["energy"] * factor, WHY),
        ),
        Quantity(
            "shear", "largest error of the shear in any increment, a tenth of the radius to "
            "either side of every stick edge apart, over µp_H", "", run, shear_error,
            exact_zero(SOURCE), Required(ASKED["shear"] * factor, WHY), 1.0, "µp_H",
        ),
    )  # fmt: skip


def _at(step: int, part: float, run: str, elements: int) -> tuple[Quantity, ...]:
    exact, a = TWISTED[part], HERTZ.contact_radius
    factor = (64 / elements) ** ORDER
    why = "the figure of the shift of the loop, and its reason"

    def around(result: Result) -> float:
        end = result.steps[step]
        assert end.shear_circumferential is not None
        r = end.radii
        smooth = r <= judged_within(elements) * a
        smooth &= np.abs(r - exact.stick_radius) > AT_EDGE * a
        error = np.abs(end.shear_circumferential[smooth] - exact.shear(r[smooth]))
        return float(np.max(error) / LIMIT)

    return (
        Quantity(
            f"twist_at_{part:g}", f"twist at {part:g} of the sliding torque", "rad", run,
            _twist(step), closed_form(exact.twist, TWISTING),
            Required(2 * ASKED["shift"] * factor, f"twice {why}"),
        ),
        Quantity(
            f"shear_at_{part:g}", f"largest error of the shear at {part:g} of the sliding torque, "
            "a tenth of the radius to either side of the stick edge apart, over µp_H", "", run,
            around, exact_zero(TWISTING), Required(ASKED["shear"] * factor, WHY), 1.0, "µp_H",
        ),
    )  # fmt: skip


def _twist(step: int) -> Callable[[Result], float]:
    """At the end of a step; steps count from 0, the pressing."""
    return lambda result: float(result.steps[step].twist or 0.0)


def _charts(results: Mapping[str, Result]) -> tuple[Chart, ...]:
    loop, ball = results.values()
    a, r = HERTZ.contact_radius, np.linspace(0.0, HERTZ.contact_radius, 120)
    along, around = loop.steps[LOADED - 1], ball.steps[2]
    assert along.shear_along_load is not None
    assert around.shear_circumferential is not None
    drawn = (
        ("loop", "at 0.9 µW", along, along.shear_along_load, EXACT.end.shear(r)),
        ("torsion", f"at {PARTS[1]:g} of the sliding torque", around,
         around.shear_circumferential, TWISTED[PARTS[1]].shear(r)),
    )  # fmt: skip
    return tuple(
        radial_chart(
            ProfileLabels(
                f"fem_penalty_slip_{name}", f"Shear over the radius, {where}",
                "Shear at the Gauss points over the closed form, and their difference.",
                "q / µp₀", "r / a",
            ),
            a, LIMIT, increment, shear, (r, exact),
        )
        for name, where, increment, shear, exact in drawn
    )  # fmt: skip
