"""The observables that several cases judge."""

from __future__ import annotations

from typing import Any

from contact_results.quantities import shear_of, shift_along_x
from verification import norms
from verification.judging.observable import Observable, error_norm, number
from verification.judging.order_of_convergence import Followed
from verification.observed import ring_errors
from verification.observed.end_state import central_pressure
from verification.observed.ring_errors import judged_within
from verification.problems.paper_scene import FRICTION
from verification.problems.problem import OVER_RADIUS, Problem

SLIDING_SHIFT = "the shift at gross sliding"
PEAK = "p_H"

APPROACH = number("approach", "approach of the bodies since first touch", "m", of=Followed.APPROACH)
PEAK_PRESSURE = number(
    "peak_pressure", "largest pressure of any {point}", "Pa", of=Followed.PEAK_PRESSURE
)
CONTACT_RADIUS = number("contact_radius", "{edge}", "m", of=Followed.CONTACT_RADIUS)
NORMAL_FORCE = number("normal_force", "force that the approach takes", "N", exact="load")
CENTRAL_PRESSURE = Observable(
    "central_pressure", "pressure {axis}", "Pa",
    lambda result, step, _: central_pressure(result, step),
    lambda exact: float(exact.pressure(0.0)), of=Followed.PEAK_PRESSURE, label="central pressure",
)  # fmt: skip
SHIFT = number(
    "shift", "tangential shift{when}", "m", read=shift_along_x, over=SLIDING_SHIFT,
    of=Followed.SHIFT,
)  # fmt: skip
STICK_RADIUS = number("stick_radius", "{stick}{when}", "m", over=OVER_RADIUS)
DISSIPATED = number("dissipated_energy", "energy dissipated up to{when}", "J", of=Followed.ENERGY)
TWIST = number("twist", "twist{when}", "rad", of=Followed.TWIST)


def _pressure_l2(result: Any, step: int, problem: Problem) -> float:
    end, exact = result.steps[step], problem.ends[step].pressure
    if hasattr(result, "grid"):
        known = problem.on_surface(exact, *result.grid.coordinates())
        return norms.relative_l2(end.pressure, known)
    return ring_errors.relative_l2(end, end.pressure, exact, problem.radius)


def _largest_pressure_error(result: Any, step: int, problem: Problem) -> float:
    end, exact = result.steps[step], problem.ends[step]
    within = judged_within(result.discretisation.elements_per_radius) * problem.radius
    error = ring_errors.largest_error(end, end.pressure, exact, exact.pressure, 0.0, within)
    return error / problem.scale(PEAK)


def _shear_error(result: Any, step: int, problem: Problem) -> float:
    end = result.steps[step]
    exact = problem.on_surface(problem.ends[step].shear, *result.grid.coordinates())
    return norms.shear_error(shear_of(end), exact, FRICTION * end.pressure)


PRESSURE_L2 = error_norm(
    "pressure", "pressure over the {domain}, L2", _pressure_l2, of=Followed.PRESSURE, norm="L2"
)
PRESSURE_WITHIN = error_norm(
    "pressure", "largest error of the pressure within {within} of the radius, over p_H",
    _largest_pressure_error, PEAK,
)  # fmt: skip
SHEAR = error_norm("shear", "Σ|q - q_exact| / Σµp{when}", _shear_error, "Σµp", of=Followed.SHEAR)
