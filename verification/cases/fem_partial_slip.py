"""Cattaneo and Mindlin's contact and its fretting loop, by finite elements."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from verification.cases.levels import finest, order_levels
from verification.cases.loop_observables import (
    ENERGY_PER_CYCLE,
    LARGEST_SHIFT_ERROR,
    LARGEST_STICK_RADIUS_ERROR,
)
from verification.closed_forms.tangential_history import TangentialHistory
from verification.exhibits.chart import Chart
from verification.exhibits.profile_chart import ProfileLabels
from verification.judging.case import Case, Level
from verification.judging.declared_case import Drawing, Falls, Row, Within, case, judged
from verification.judging.drawings import convergence
from verification.judging.field_errors import away_from_edges
from verification.judging.ladder import (
    Ladder,
    asked,
    on_elements,
    part_of_side,
    with_edge_at,
)
from verification.judging.observable import error_norm
from verification.judging.observables import (
    ENERGY,
    SHEAR,
    SHIFT,
    STICK_RADIUS,
    WORK,
)
from verification.judging.radial_chart import radial_chart
from verification.observed.ring_errors import judged_within
from verification.problems.loop_history import LOADED, fretting_loop
from verification.problems.paper_scene import HERTZ, STEEL
from verification.problems.problem import Problem
from verification.problems.sheared import OVER_LIMIT, sheared

LOOP = fretting_loop("Fretting loop of two alike bodies, by finite elements", STEEL, quarter=3)
STOPPED = {1: 0.3, 2: 0.45, 3: 0.6, 4: 0.75, 5: 0.9}  # parts of µW, by step
ALSO_BY_CELLS = {step: part for step, part in STOPPED.items() if part in (0.3, 0.6, 0.9)}
SHEARED = sheared(
    "Two alike bodies with ν = 0 sheared once, by finite elements", tuple(STOPPED.values())
)
# At 64 elements per radius: shift, energy, shear; and the order with which they fall.
ORDER = 1.5
OF_SHIFT, OF_ENERGY, OF_SHEAR = asked(5e-4, ORDER), asked(1e-3, ORDER), asked(1e-2, ORDER)
WHY = (
    "set by hand: 5e-4 of the shift, 1e-3 of the energy and 1e-2 of µp_H at 64 elements per "
    "radius, on other meshes what the order 3/2 of cusps at moving edges makes of them"
)
ACROSS = (
    "For ν > 0 slip has a component across the load, up to 4 % of µp_H in the shear; both the "
    "closed form and this run neglect it."
)


def _shear_error(result: Any, _: int, problem: Problem) -> float:
    within = judged_within(result.discretisation.elements_per_radius)
    worst, edges = 0.0, []
    for increment, exact in _along(result, problem):
        edges.append(exact.stick_radius)
        r = increment.radii
        smooth = away_from_edges(r, within, edges, problem.radius)
        error = np.abs(increment.shear_along_load - exact.shear(r))[smooth]
        worst = float(np.maximum(worst, np.max(error, initial=0.0)))
    return worst / problem.scale(OVER_LIMIT)


def _along(result: Any, problem: Problem) -> Iterator[tuple[Any, TangentialHistory]]:
    """Increments and the closed form, which asks of them nothing but step and force."""
    exact: Iterator[tuple[Any, TangentialHistory]] = problem.ends[-1].along(result)
    return exact


LOOP_SHEAR = error_norm(
    "shear",
    "largest error of the shear in any increment, a tenth of the radius to either side of every "
    "stick edge apart, over µp_H",
    _shear_error,
    OVER_LIMIT,
)
OF_LOOP = (
    Within(LARGEST_SHIFT_ERROR, OF_SHIFT, WHY),
    Within(ENERGY_PER_CYCLE, OF_ENERGY, WHY),
    Within(LOOP_SHEAR, OF_SHEAR, WHY),
)
STICK_OF_LOOP = Within(
    LARGEST_STICK_RADIUS_ERROR, part_of_side(0.2),
    "a fifth of an element: the edge is read off the last values, which an older edge nearby "
    "disturbs",
)  # fmt: skip
OF_SHEARING = (
    *(Within(SHIFT.at(step, part, "µW"), OF_SHIFT, WHY) for step, part in ALSO_BY_CELLS.items()),
    *(
        Within(
            STICK_RADIUS.at(step, part, "µW"), part_of_side(0.1),
            "a tenth of an element, read off the last values",
        )
        for step, part in ALSO_BY_CELLS.items()
    ),
    Within(ENERGY.at(5, STOPPED[5], "µW"), OF_ENERGY, WHY),
)  # fmt: skip
# Where edges of stick lie in their elements depends on the mesh, too.
PER_OCTAVE = 10  # meshes of the orders
LISTED = "0.3, 0.45, 0.6, 0.75 and 0.9 µW"
ORDERS = (
    Falls(
        SHEAR.over_stops(LISTED), ORDER,
        "square-root edges of stick zone and contact: an error of O(√h) on rings one element wide "
        "leaves O(h^3/2) in L1",
    ),
    Falls(
        SHIFT.over_stops(LISTED), 2.0,
        "the difference of two approaches, of the contact and of the stick zone (Cattaneo); each "
        "is wrong by h²/R times a number that depends on where in its element the edge is",
    ),
    Falls(
        WORK.over_stops(LISTED), 2.0,
        "what the area below the curve of approach over load differs from its trapezium: as wrong "
        "as the approaches at its ends",
    ),
)  # fmt: skip


def fem_partial_slip(level: Level = Level.QUICK) -> Case:
    """The case, on finer meshes at higher levels, and with orders above the quick one."""
    return fem_partial_slip_on(
        finest(level),
        order_levels(level, PER_OCTAVE),
        orders_judged=level is not Level.QUICK,
    )


def fem_partial_slip_on(
    elements: int, studied: tuple[tuple[int, float], ...] = (), *, orders_judged: bool = True
) -> Case:
    """The loop on one mesh.

    studied        meshes for the single shearing, and where in its element the edge of the
                   contact lies
    orders_judged  whether these reach far enough to tell orders from the scatter of single errors
    """
    loop = on_elements(LOOP, (elements,), over=0.97)
    shearing = [with_edge_at(SHEARED, (), studied, "sheared once")] if studied else []
    rows: tuple[Row, ...] = (*OF_SHEARING, *ORDERS) if orders_judged else OF_SHEARING
    return case(
        "fem_partial_slip",
        "Finite elements: fretting loop",
        "Two alike bodies under 1 kN, sheared to 0.9 µW, to -0.9 µW and back, as in "
        "fretting_loop. The first harmonic of the displacement carries a shear along the load "
        "that is the same all around each ring; slip across the load is neglected, as the "
        "closed form does for any ν. Shear is a quadratic program within ±µp. Orders are "
        f"judged on a single shearing with stops at {LISTED}, for ν = 0: nothing slips across the "
        "load there, and the closed form is exact.",
        judged(loop, (*OF_LOOP, STICK_OF_LOOP)),
        *(judged(one, rows) for one in shearing),
        charts=(
            *(
                loop_profile(
                    loop, step, f"fem_partial_slip_{name}", name,
                    f"Shear by finite elements over the closed form at {force} µW, and their "
                    "difference.", "cattaneo_mindlin" if step == LOADED else "",
                )
                for step, name, force in DRAWN
            ),
            *(
                convergence(
                    one,
                    ORDERS,
                    "fem_partial_slip_convergence",
                    "Convergence under a tangential force",
                    f"Errors at {LISTED}, root mean square, against the side of an element over "
                    "the contact radius.",
                )
                for one in shearing
                if orders_judged
            ),
        ),
        limits=(ACROSS,),
    )  # fmt: skip


DRAWN = ((LOADED, "loaded", "0.9"), (LOADED + 1, "reversed", "-0.9"))


def loop_profile(
    loop: Ladder, step: int, name: str, when: str, caption: str, profile: str = ""
) -> Drawing:
    """The shear at the end of a step of the loop.

    profile  by which a page finds it drawn by both solvers
    """

    def draw(results: Any) -> Chart:
        result = results[loop.judged.run.label]
        end = result.steps[step - 1]
        *_, exact = (known for found, known in _along(result, LOOP) if found.step == step)
        r = np.linspace(0.0, HERTZ.contact_radius, 120)
        labels = ProfileLabels(name, f"Shear over the radius, {when}", caption, "q / µp₀", "r / a")
        limit = LOOP.scale(OVER_LIMIT)
        return radial_chart(
            labels,
            HERTZ.contact_radius,
            limit,
            end,
            end.shear_along_load,
            (r, exact.shear(r)),
            profile,
        )

    return draw
