"""Cattaneo and Mindlin's contact and its fretting loop, by finite elements."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from contact_results.quantities import shift_along_x
from verification.cases.cattaneo_mindlin import SOURCE as CATTANEO
from verification.cases.fem_levels import MIDDLE, finest, judged_within, label, order_levels
from verification.cases.loop_history import LOADED, ExactLoop, loop_energy, loop_steps
from verification.cases.stopped_shearing import StoppedShearing
from verification.closed_forms.tangential_history import TangentialHistory
from verification.exhibits.chart import Chart
from verification.exhibits.convergence_chart import convergence_chart
from verification.exhibits.profile_chart import ProfileLabels
from verification.judging.case import Case, Level, Quantity, Required
from verification.judging.ladder import meshed
from verification.judging.order_of_convergence import Followed, OrderOfConvergence
from verification.judging.radial_chart import radial_chart
from verification.judging.run import SectionRun, per_radius
from verification.observed.end_state import stick_radius
from verification.observed.ring_errors import relative_l1
from verification.problems import paper_scene as paper
from verification.problems.paper_scene import FRICTION, HERTZ, NU_ZERO, STEEL
from verification.problems.reference import closed_form, exact_zero

if TYPE_CHECKING:
    from fem_reference import Result

SOURCE = "Mindlin and Deresiewicz 1953"
EXACT = ExactLoop(STEEL)
LARGEST_SHIFT = EXACT.end.shift
LIMIT = FRICTION * HERTZ.peak_pressure
SCENE = paper.frictional(
    "Fretting loop of two alike bodies, by finite elements",
    paper.paraboloid(STEEL),
    STEEL,
    *loop_steps(quarter=3),
)
SHEARING = StoppedShearing(NU_ZERO, (0.3, 0.45, 0.6, 0.75, 0.9))
ALSO_BY_CELLS = (0.3, 0.6, 0.9)  # of µW, as in cattaneo_mindlin
SHEARED = paper.frictional(
    "Two alike bodies with ν = 0 sheared once, by finite elements",
    paper.paraboloid(NU_ZERO),
    NU_ZERO,
    *(paper.tangential_step(part, increments=1) for part in SHEARING.parts),
)
AT_EDGE = 0.1  # contact radii to each side of a stick edge, where the shear has a cusp
# At 64 elements per radius: shift, energy, shear; and the order with which they fall.
ASKED = {"shift": 5e-4, "energy": 1e-3, "shear": 1e-2}
ORDER = 1.5
WHY = (
    "set by hand: 5e-4 of the shift, 1e-3 of the energy and 1e-2 of µp_H at 64 elements per "
    "radius, on other meshes what the order 3/2 of cusps at moving edges makes of them"
)


def fem_partial_slip(level: Level = Level.QUICK) -> Case:
    """The case, on finer meshes at higher levels, and with orders above the quick one."""
    return fem_partial_slip_on(
        finest(level), order_levels(level), orders_judged=level is not Level.QUICK
    )


def fem_partial_slip_on(
    elements: int, studied: tuple[tuple[int, float], ...] = (), *, orders_judged: bool = True
) -> Case:
    """The loop on one mesh.

    studied        meshes for the single shearing, and where in its element the edge of the
                   contact lies
    orders_judged  whether these reach far enough to tell orders from the scatter of single errors
    """
    run = SectionRun(label(elements), SCENE, per_radius(elements, 0.97 * HERTZ.contact_radius))
    sheared = tuple(
        SectionRun(
            _sheared(n, place),
            SHEARED,
            per_radius(n, meshed(HERTZ.contact_radius, n, place)),
            beyond=MIDDLE,
        )
        for n, place in studied
    )
    orders = tuple(one.label for one in sheared) if orders_judged else ()
    factor = (64 / elements) ** ORDER
    return Case(
        name="fem_partial_slip",
        title="Finite elements: fretting loop",
        problem=(
            "Two alike bodies under 1 kN, sheared to 0.9 µW, to -0.9 µW and back, as in "
            "fretting_loop. The first harmonic of the displacement carries a shear along the load "
            "that is the same all around each ring; slip across the load is neglected, as the "
            "closed form does for any ν. Shear is a quadratic program within ±µp. Orders are "
            f"judged on a single shearing with stops at {SHEARING.listed} µW, for ν = 0: nothing "
            "slips across the load there, and the closed form is exact."
        ),
        runs=(run, *sheared),
        quantities=(
            Quantity(
                "largest_shift_error", "largest difference of the shift in any increment", "m",
                run.label, EXACT.largest_shift_error, exact_zero(SOURCE),
                Required(ASKED["shift"] * factor, WHY), LARGEST_SHIFT,
                "the largest shift of the loop",
            ),
            Quantity(
                "energy_per_cycle", "energy dissipated from 0.9 µW to -0.9 µW and back", "J",
                run.label, loop_energy, closed_form(EXACT.energy_per_cycle, SOURCE),
                Required(ASKED["energy"] * factor, WHY),
            ),
            Quantity(
                "largest_stick_radius_error",
                "largest difference of the stick radius in any increment", "m", run.label,
                EXACT.largest_stick_radius_error, exact_zero(SOURCE),
                Required(0.2 / elements, "a fifth of an element: the edge is read off the last "
                         "values, which an older edge nearby disturbs"),
                HERTZ.contact_radius, "the contact radius",
            ),
            Quantity(
                "shear", "largest error of the shear in any increment, a tenth of the radius at "
                "either side of every stick edge apart, over µp_H", "", run.label, shear_error,
                exact_zero(SOURCE), Required(ASKED["shear"] * factor, WHY), 1.0, "µp_H",
            ),
            *_of_shearing(studied),
        ),
        orders=_orders(orders) if orders else (),
        charts=lambda results: _charts(
            results, run.label, orders, {one.label: one.spacing for one in sheared}
        ),
        limits=(
            "For ν > 0 slip has a component across the load, up to 4 % of µp_H in the shear; both "
            "the closed form and this run neglect it.",
        ),
    )  # fmt: skip


def _of_shearing(meshes: tuple[tuple[int, float], ...]) -> tuple[Quantity, ...]:
    """Of the finest mesh, with the edge of the contact nearest to the middle of an element."""
    if not meshes:
        return ()
    elements, place = max(meshes, key=lambda mesh: (mesh[0], -abs(mesh[1] - MIDDLE)))
    run, factor = _sheared(elements, place), (64 / elements) ** ORDER
    stops = dict(enumerate(zip(SHEARING.parts, SHEARING.stops, strict=True), 1))
    stops = {step: stop for step, stop in stops.items() if stop[0] in ALSO_BY_CELLS}
    (last, (largest, end)) = max(stops.items())
    return (
        *(_shift(step, *stop, run, factor) for step, stop in stops.items()),
        *(_stick_radius(step, *stop, run, elements) for step, stop in stops.items()),
        Quantity(
            f"energy_at_{largest:g}", f"energy dissipated up to {largest:g} µW", "J", run,
            lambda result: float(result.steps[last].dissipated_energy),
            closed_form(end.dissipated_energy, SOURCE),
            Required(ASKED["energy"] * factor, WHY),
        ),
    )  # fmt: skip


def _sheared(elements: int, place: float) -> str:
    return f"sheared once, {label(elements, place)}"


def _shift(step: int, part: float, exact: TangentialHistory, run: str, factor: float) -> Quantity:
    return Quantity(
        f"shift_at_{part:g}", f"tangential shift at {part:g} µW", "m", run,
        lambda result: shift_along_x(result.steps[step]),
        closed_form(exact.shift, CATTANEO, SHEARING.sliding_shift),
        Required(ASKED["shift"] * factor, WHY), SHEARING.sliding_shift,
        "the shift at gross sliding",
    )  # fmt: skip


def _stick_radius(
    step: int, part: float, exact: TangentialHistory, run: str, elements: int
) -> Quantity:
    return Quantity(
        f"stick_radius_at_{part:g}", f"stick radius at {part:g} µW", "m", run,
        lambda result: stick_radius(result, step),
        closed_form(exact.stick_radius, CATTANEO, HERTZ.contact_radius),
        Required(0.1 / elements, "a tenth of an element, read off the last values"),
        HERTZ.contact_radius, "the contact radius",
    )  # fmt: skip


def shear_l1_error(result: Result) -> float:
    """Root mean square over all stops of ∫|q - q_exact| r dr / ∫µp r dr."""
    return SHEARING.over_stops(
        result,
        lambda end, exact: (
            relative_l1(end, end.shear_along_load, exact.shear, HERTZ.contact_radius) / FRICTION
        ),
    )


def _orders(levels: tuple[str, ...]) -> tuple[OrderOfConvergence, ...]:
    return (
        OrderOfConvergence(
            "order_of_shear", Followed.SHEAR,
            f"∫|q - q_exact| / ∫µp at {SHEARING.listed} µW, root mean square", levels,
            shear_l1_error, ORDER,
            "square-root edges of stick zone and contact: an error of O(√h) on rings one element "
            "wide leaves O(h^3/2) in L1",
        ),
        *SHEARING.orders(
            levels, 2.0,
            "the difference of two approaches, of the contact and of the stick zone (Cattaneo); "
            "each is wrong by h²/R times a number that depends on where in its element the edge is",
            "what the area below the curve of approach over load differs from its trapezium: as "
            "wrong as the approaches at its ends",
        ),
    )  # fmt: skip


def shear_error(result: Result) -> float:
    """Largest error of the shear away from edge and stick edges, over µp_H."""
    elements = result.discretisation.elements_per_radius
    worst, edges = 0.0, []
    for increment, exact in _along(result):
        edges.append(exact.stick_radius)
        r = increment.radii
        smooth = r <= judged_within(elements) * HERTZ.contact_radius
        for edge in edges:
            smooth &= np.abs(r - edge) > AT_EDGE * HERTZ.contact_radius
        error = np.abs(increment.shear_along_load - exact.shear(r))[smooth]
        worst = max(worst, float(np.max(error, initial=0.0)))
    return worst / LIMIT


def _along(result: Result) -> Iterator[tuple[Any, TangentialHistory]]:
    """Increments and the closed form, which asks of them nothing but step and force."""
    history: Any = result
    return EXACT.along(history)


def _charts(
    results: Mapping[str, Result], loop: str, studied: tuple[str, ...],
    spacings: Mapping[str, float],
) -> tuple[Chart, ...]:  # fmt: skip
    result = results[loop]
    charts = []
    for step, name in ((LOADED, "loaded"), (LOADED + 1, "reversed")):
        end = result.steps[step - 1]
        exact = [known for found, known in _along(result) if found.step == step][-1]
        r = np.linspace(0.0, HERTZ.contact_radius, 120)
        labels = ProfileLabels(
            f"fem_partial_slip_{name}", f"Shear over the radius, {name}",
            "Shear by finite elements over the closed form at 0.9 µW, first "
            f"{'one way' if name == 'loaded' else 'and then the other'}, and their difference.",
            "q / µp₀", "r / a",
        )  # fmt: skip
        assert end.shear_along_load is not None
        charts.append(
            radial_chart(
                labels, HERTZ.contact_radius, LIMIT, end, end.shear_along_load, (r, exact.shear(r))
            )
        )
    if studied:
        runs = [results[name] for name in studied]
        charts.append(_convergence(runs, [spacings[name] for name in studied]))
    return tuple(charts)


def _convergence(runs: list[Result], spacings: list[float]) -> Chart:
    return convergence_chart(
        "fem_partial_slip_convergence",
        "Convergence under a tangential force",
        f"Errors at {SHEARING.listed} µW, root mean square, against the side of an element over "
        "the contact radius.",
        spacings,
        {
            "shear (L1)": [shear_l1_error(run) for run in runs],
            "tangential shift": [SHEARING.shift_error(run) for run in runs],
            "dissipated energy": [SHEARING.energy_error(run) for run in runs],
        },
        {"shear (L1)": ORDER, "tangential shift": 2.0, "dissipated energy": 2.0},
        x_label="element side / contact radius",
    )
