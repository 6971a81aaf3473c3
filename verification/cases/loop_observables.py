"""What is judged of a fretting loop as a whole; the answer to it is an `ExactLoop`."""

from __future__ import annotations

from verification.judging.observable import Observable, error_norm
from verification.problems.loop_history import OVER_LARGEST_SHIFT, loop_energy
from verification.problems.problem import OVER_RADIUS

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
