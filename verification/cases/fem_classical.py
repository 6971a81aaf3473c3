"""Cone and flat punch by finite elements: an infinite pressure at the apex or at the rim."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from verification.cases import cone_contact as cone
from verification.cases import flat_punch as punch
from verification.cases.fem_levels import allowed, label, levels
from verification.exhibits.chart import Chart
from verification.exhibits.convergence_chart import convergence_chart
from verification.judging.case import Case, Level, Quantity, Required
from verification.judging.order_of_convergence import Followed, NotYetAsymptotic, OrderOfConvergence
from verification.judging.run import SectionRun, per_radius
from verification.observed.end_state import approach, central_pressure, contact_radius
from verification.problems.reference import closed_form, exact_zero

if TYPE_CHECKING:
    from fem_reference import Result

BECAUSE = "set by hand at 64 elements per radius, on other meshes what the order makes of it"
RIM = "what hats cannot follow of the infinite pressure at the rim has an energy of O(h)"
SLOWLY = NotYetAsymptotic(
    0.15,
    "the error is A h - B h² with B = 3.5 A / a: neighbours from 22 elements per radius on give "
    "0.86, 0.90, 0.93",
)
JUDGED = (0.2, 0.8)  # part of the radius of the cone, away from apex and edge


def fem_classical(level: Level = Level.QUICK) -> Case:
    """The case, on finer meshes at higher levels."""
    return fem_classical_on(levels(level))


def fem_classical_on(elements: tuple[int, ...]) -> Case:
    """The case on meshes of so many elements per contact radius."""
    n = elements[-1]
    cones = tuple(SectionRun(_cone(m), cone.SCENE, per_radius(m, _meshed(m))) for m in elements)
    punches = tuple(SectionRun(_punch(m), punch.SCENE, per_radius(m)) for m in elements)
    return Case(
        name="fem_classical",
        title="Finite elements: cone and flat punch",
        problem=(
            "The scenes of cone_contact and flat_punch by finite elements. Below the punch the "
            "hats of the pressure end at the rim with half a hat."
        ),
        runs=(*cones, *punches),
        quantities=(
            Quantity(
                "approach_of_cone", "approach since first touch", "m", _cone(n), approach,
                closed_form(cone.EXACT.approach, cone.SOURCE),
                Required(allowed(1e-4, n, 2), BECAUSE),
            ),
            Quantity(
                "radius_of_cone", "where the pressure ends, from its last two values", "m",
                _cone(n), contact_radius, closed_form(cone.EXACT.contact_radius, cone.SOURCE),
                Required(0.05 / n, "a twentieth of an element"),
            ),
            Quantity(
                "pressure_of_cone", "largest error of the pressure over its exact value, from 0.2 "
                "to 0.8 of the radius", "", _cone(n), cone_error,
                exact_zero(cone.SOURCE), Required(allowed(5e-4, n, 2), BECAUSE),
                1.0, "the exact one",
            ),
            Quantity(
                "approach_of_punch", "approach since first touch", "m", _punch(n), approach,
                closed_form(punch.EXACT.approach, punch.SOURCE),
                Required(allowed(5e-4, n, 1), f"{BECAUSE}; {RIM}"),
            ),
            Quantity(
                "central_pressure_of_punch", "pressure on the axis", "Pa", _punch(n),
                central_pressure, closed_form(float(punch.EXACT.pressure(0.0)), punch.SOURCE),
                Required(allowed(1e-3, n, 1), f"{BECAUSE}; {RIM}"),
            ),
        ),
        orders=(
            OrderOfConvergence(
                "order_of_central_pressure", Followed.PEAK_PRESSURE,
                "pressure on the axis below the punch",
                tuple(map(_punch, elements)), central_error, 1.0, RIM, SLOWLY,
            ),
            OrderOfConvergence(
                "order_of_approach", Followed.APPROACH, "approach of the punch",
                tuple(map(_punch, elements)), approach_error, 1.0, RIM,
            ),
        ),
        charts=_charts,
    )  # fmt: skip


def _cone(elements: int) -> str:
    return f"cone, {label(elements)}"


def _punch(elements: int) -> str:
    return f"punch, {label(elements)}"


def _meshed(elements: int) -> float:
    """So that the edge lies in the middle of an element on every mesh."""
    return cone.EXACT.contact_radius * elements / (elements + 0.5)


def cone_error(result: Result) -> float:
    """Largest relative error of the pressure away from apex and edge."""
    end = result.steps[-1]
    r = end.radii
    a = cone.EXACT.contact_radius
    judged = (r > JUDGED[0] * a) & (r < JUDGED[1] * a)
    return float(max(abs(end.pressure[judged] / cone.EXACT.pressure(r[judged]) - 1)))


def central_error(result: Result) -> float:
    """Relative error of the pressure on the axis below the punch."""
    return abs(central_pressure(result) / float(punch.EXACT.pressure(0.0)) - 1)


def approach_error(result: Result) -> float:
    """Relative error of the approach of the punch."""
    return abs(approach(result) / punch.EXACT.approach - 1)


def _charts(results: Mapping[str, Result]) -> tuple[Chart, ...]:
    punches = [result for name, result in results.items() if name.startswith("punch")]
    cones = [result for name, result in results.items() if name.startswith("cone")]
    return (
        convergence_chart(
            "fem_classical_convergence",
            "Convergence of cone and punch",
            "Relative errors against the side of an element over the contact radius.",
            [1 / result.discretisation.elements_per_radius for result in punches],
            {
                "central pressure, punch": [central_error(result) for result in punches],
                "approach, punch": [approach_error(result) for result in punches],
                "approach, cone": [
                    abs(approach(result) / cone.EXACT.approach - 1) for result in cones
                ],
            },
            {"central pressure, punch": 1.0, "approach, punch": 1.0},
            x_label="element side / contact radius",
        ),
    )
