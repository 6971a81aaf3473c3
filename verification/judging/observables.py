"""The observables that several cases judge."""

from __future__ import annotations

from dataclasses import replace

from verification.judging import field_errors
from verification.judging.observable import Observable, error_norm, number
from verification.judging.order_of_convergence import Followed
from verification.observed.end_state import central_pressure
from verification.problems.cattaneo_mindlin import (
    OVER_LIMIT,
    OVER_SLIDING_SHIFT,
    OVER_SLIDING_WORK,
)
from verification.problems.loop_history import OVER_LARGEST_SHIFT, loop_energy
from verification.problems.problem import OVER_PEAK, OVER_RADIUS

APPROACH = number("approach", "approach of the bodies since first touch", of=Followed.APPROACH)
PEAK_PRESSURE = number(
    "peak_pressure", "largest pressure of any {point}", of=Followed.PEAK_PRESSURE
)
CONTACT_RADIUS = number("contact_radius", "{edge}", of=Followed.CONTACT_RADIUS)
NORMAL_FORCE = number("normal_force", "force that the approach takes", exact="load")
CENTRAL_PRESSURE = Observable(
    "central_pressure", "pressure {axis}", "Pa",
    lambda result, step, _: central_pressure(result, step),
    lambda exact: float(exact.pressure(0.0)), of=Followed.PEAK_PRESSURE, label="central pressure",
)  # fmt: skip
SHIFT = number(
    "shift", "tangential shift{when}", quantity="tangential_shift_x", over=OVER_SLIDING_SHIFT,
    of=Followed.SHIFT,
)  # fmt: skip
STICK_RADIUS = number("stick_radius", "{stick}{when}", over=OVER_RADIUS)
ENERGY = number(
    "energy", "energy dissipated{when}", quantity="dissipated_energy",
    exact="dissipated_energy", of=Followed.ENERGY, source="Mindlin and Deresiewicz 1953",
)  # fmt: skip
WORK = replace(ENERGY, over=OVER_SLIDING_WORK)
TWIST = number("twist", "twist{when}", of=Followed.TWIST)
PRESSURE_L1 = error_norm(
    "pressure",
    "pressure over the {domain}, L1",
    field_errors.pressure_l1,
    of=Followed.PRESSURE,
    norm="L1",
)
PRESSURE_L2 = error_norm(
    "pressure",
    "pressure over the {domain}, L2",
    field_errors.pressure_l2,
    of=Followed.PRESSURE,
    norm="L2",
)
PRESSURE_WITHIN = error_norm(
    "pressure", "largest error of the pressure within {within} of the radius, over p_H",
    field_errors.largest_pressure_error, OVER_PEAK,
)  # fmt: skip
SHEAR = error_norm(
    "shear",
    "{sum}|q - q_exact| / {sum}µp{when}",
    field_errors.shear_error,
    "Σµp",
    of=Followed.SHEAR,
)
SHEAR_AROUND = error_norm(
    "shear",
    "largest error of the shear{when}, a tenth of the radius to either side of the stick edge "
    "apart, over µp_H",
    field_errors.shear_around_error,
    OVER_LIMIT,
)
# Of a fretting loop as a whole; the answer to it is an `ExactLoop`.
LARGEST_SHIFT_ERROR = error_norm(
    "largest_shift_error",
    "largest difference of the shift in any increment",
    lambda result, _, problem: problem.ends[-1].largest_shift_error(result),
    unit="m",
    over=OVER_LARGEST_SHIFT,
)
LARGEST_STICK_RADIUS_ERROR = error_norm(
    "largest_stick_radius_error",
    "largest difference of the stick radius in any increment",
    lambda result, _, problem: problem.ends[-1].largest_stick_radius_error(result),
    unit="m",
    over=OVER_RADIUS,
)
LARGEST_SHEAR_ERROR = error_norm(
    "largest_shear_error",
    "largest Σ|q - q_exact| / Σµp of any increment",
    lambda result, _, problem: problem.ends[-1].largest_shear_error(result),
    "Σµp",
)
ENERGY_PER_CYCLE = Observable(
    "energy_per_cycle",
    "energy dissipated from 0.9 µW to -0.9 µW and back",
    "J",
    lambda result, *_: loop_energy(result),
    lambda loop: float(loop.energy_per_cycle),
    scalar=("energy_per_cycle", 0),
)
