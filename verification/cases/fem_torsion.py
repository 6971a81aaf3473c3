"""Torsion by finite elements: a ball twisted into partial slip, and a stuck flat punch."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

import numpy as np

from verification.cases.fem_levels import (
    MIDDLE,
    allowed,
    judged_within,
    label,
    levels,
    order_levels,
)
from verification.cases.torsion import (
    EXACT,
    MODULUS,
    MONOTONIC,
    PARTS,
    PUNCH_RADIUS,
    SOURCE,
    STUCK,
    STUCK_PUNCH,
    STUCK_TORQUE,
)
from verification.closed_forms.torsion import StuckTorsion
from verification.exhibits.chart import Chart
from verification.exhibits.profile_chart import ProfileLabels
from verification.judging.case import Case, Level, Quantity, Required
from verification.judging.ladder import meshed
from verification.judging.order_of_convergence import Followed, OrderOfConvergence
from verification.judging.radial_chart import radial_chart
from verification.judging.run import SectionRun, per_radius
from verification.problems.paper_scene import FRICTION, HERTZ
from verification.problems.reference import closed_form, exact_zero

if TYPE_CHECKING:
    from fem_reference import Result

LIMIT = FRICTION * HERTZ.peak_pressure
STUCK_TWIST = StuckTorsion(PUNCH_RADIUS, MODULUS, STUCK_TORQUE).twist
AT_EDGE = 0.1  # contact radii to each side of the stick edge
CUSP = (
    "set by hand: at 64 elements per radius 2e-3 of the twist and 5e-3 of µp_H, on other meshes "
    "what the order 3/2 of the cusps at both edges makes of it"
)
RIM = "what hats cannot follow of the infinite shear at the rim has an energy of O(h)"


def fem_torsion(level: Level = Level.QUICK) -> Case:
    """The case, on finer meshes at higher levels."""
    return fem_torsion_on(levels(level), order_levels(level))


def fem_torsion_on(elements: tuple[int, ...], studied: tuple[tuple[int, float], ...] = ()) -> Case:
    """The case on meshes of so many elements per contact radius.

    studied  more meshes for the ball, and where in its element the edge of the contact lies
    """
    n = elements[-1]
    balls = tuple(_ball(*mesh) for mesh in dict.fromkeys(((n, MIDDLE), *studied)))
    ball = balls[0]
    punches = tuple(SectionRun(_punch(m), STUCK_PUNCH, per_radius(m)) for m in elements)
    return Case(
        name="fem_torsion",
        title="Finite elements: torsion",
        problem=(
            "The paper's ball under 1 kN, twisted by 0.5, 0.9 and 0.99 of the torque at which all "
            "slips, and a flat punch that sticks all over, as in torsion. One unknown "
            "displacement, around the axis; pressure does not enter but by the friction limit."
        ),
        runs=(*balls, *punches),
        quantities=(
            *(q for step, part in enumerate(PARTS, 1) for q in _at(step, part, ball.label, n)),
            Quantity(
                "stuck_twist", "twist of the stuck punch", "rad", punches[-1].label, _twist(1),
                closed_form(STUCK_TWIST, STUCK),
                Required(allowed(1e-3, n, 1),
                         f"set by hand: 1e-3 at 64 elements per radius; {RIM}"),
            ),
        ),
        orders=(
            OrderOfConvergence(
                "order_of_twist", Followed.TWIST,
                "twist of the stuck punch",
                tuple(run.label for run in punches), twist_error, 1.0, RIM,
            ),
        ),
        charts=_charts,
    )  # fmt: skip


def _ball(elements: int, place: float) -> SectionRun:
    mesh = per_radius(elements, meshed(HERTZ.contact_radius, elements, place))
    return SectionRun(f"ball, {label(elements, place)}", MONOTONIC, mesh, beyond=MIDDLE)


def _punch(elements: int) -> str:
    return f"stuck punch, {label(elements)}"


def _twist(step: int) -> Callable[[Result], float]:
    """At the end of a step; steps count from 0, the pressing."""
    return lambda result: float(result.steps[step].twist or 0.0)


def twist_error(result: Result) -> float:
    """Relative error of the stuck punch's twist."""
    return abs(_twist(1)(result) / STUCK_TWIST - 1)


def _at(step: int, part: float, run: str, elements: int) -> tuple[Quantity, ...]:
    exact = EXACT[part]

    def stick_radius(result: Result) -> float:
        return float(result.steps[step].stick_radius or 0.0)

    def shear_error(result: Result) -> float:
        end = result.steps[step]
        assert end.shear_circumferential is not None
        r, a = end.radii, HERTZ.contact_radius
        smooth = r <= judged_within(elements) * a
        smooth &= np.abs(r - exact.stick_radius) > AT_EDGE * a
        error = np.abs(end.shear_circumferential[smooth] - exact.shear(r[smooth]))
        return float(np.max(error) / LIMIT)

    return (
        Quantity(
            f"twist_at_{part:g}", f"twist at {part:g} of the sliding torque", "rad", run,
            _twist(step), closed_form(exact.twist, SOURCE),
            Required(allowed(2e-3, elements, 1.5), CUSP),
        ),
        Quantity(
            f"stick_radius_at_{part:g}", f"stick radius at {part:g} of the sliding torque", "m",
            run, stick_radius, closed_form(exact.stick_radius, SOURCE, HERTZ.contact_radius),
            Required(0.1 / elements, "a tenth of an element, read off the last values"),
            HERTZ.contact_radius, "the contact radius",
        ),
        Quantity(
            f"shear_at_{part:g}", f"largest error of the shear at {part:g} of the sliding torque, "
            "a tenth of the radius at either side of the stick edge apart, over µp_H", "", run,
            shear_error, exact_zero(SOURCE), Required(allowed(5e-3, elements, 1.5), CUSP),
            1.0, "µp_H",
        ),
    )  # fmt: skip


def _charts(results: Mapping[str, Result]) -> tuple[Chart, ...]:
    result = next(iter(results.values()))
    r = np.linspace(0.0, HERTZ.contact_radius, 120)
    charts = []
    for step, part in enumerate(PARTS, 1):
        end = result.steps[step]
        assert end.shear_circumferential is not None
        labels = ProfileLabels(
            f"fem_torsion_{step}", f"Shear over the radius at {part:g} of the sliding torque",
            "Circumferential shear by finite elements over the closed form, and their difference: "
            "a cusp at the edge of stick.", "q / µp₀", "r / a",
        )  # fmt: skip
        exact = (r, EXACT[part].shear(r))
        charts.append(
            radial_chart(labels, HERTZ.contact_radius, LIMIT, end, end.shear_circumferential, exact)
        )
    return tuple(charts)
