"""Whether the tangent that Newton's method solves with is the derivative of the equations."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from contact_scene import CoulombFriction
from contact_scene.quantities.residuals import worst
from fem_reference.compliance.angular_grid import end_grid
from fem_reference.compliance.point_compliance import PointCompliance
from fem_reference.compliance.ring_compliance import RingCompliance
from fem_reference.compliance.ring_edge import HatEdge
from fem_reference.contact.alternating_iteration import CoupledProblem
from fem_reference.contact.natural_map import Equations, Iterate
from fem_reference.loads import NormalTarget, TangentialTarget
from fem_reference.plan import Path
from verification.judging.case import Check, Required
from verification.problems.reference import identity

Field = NDArray[np.float64]

RINGS, HIGHEST, STATES = 5, 4, 8
SPRINGS = 0.3  # of the penalty law, beside the exact law
STEP = 1e-5  # of values of order one
LEAST_PRESSURE = 0.1  # shears in slip bend with the radius of the friction limit
SEED = 7


def consistent_tangent() -> Check:
    """Tangent against central differences, for the exact law and for springs.

    A wrong one leaves all results as they are and only costs iterations.
    """
    return Check(
        "consistent_tangent", "largest difference between the tangent of the equations and their "
        "central differences", "", f"{2 * STATES} random states on {RINGS} rings", _worst,
        identity(0.0, "the derivative of the equations; Newton's method converges linearly with "
                 "another"),
        Required(1e-8, f"central differences of step {STEP:g} of values of order one: what they "
                 "neglect is a sixth of its square times a third derivative of 160, and rounding"),
        1.0, "a traction of order one",
    )  # fmt: skip


def _worst() -> float:
    return worst(*(_error(springs, seed) for springs in (0.0, SPRINGS) for seed in range(STATES)))


def _error(springs: float, seed: int) -> float:
    random = np.random.default_rng((SEED, seed))
    compliance = PointCompliance(_rings(random), end_grid(HIGHEST), springs)
    points = len(compliance.areas)
    problem = CoupledProblem(
        compliance,
        random.uniform(-0.5, 0.5, points),
        CoulombFriction(coefficient=0.4),
        random.uniform(-0.1, 0.1, (2, points)),
        NormalTarget(force=1.0),
        TangentialTarget(load=0.2),
    )
    equations = Equations(problem)
    tractions = np.concatenate(
        [random.uniform(-0.2, 0.2, 2 * points), random.uniform(0, 1, points)]
    )
    here = Iterate(tractions, 0.1, 0.5, 0.2)
    _, tangent, _ = equations.linearised(here)
    largest, values = 0.0, here.values
    for column in range(len(values)):
        step = STEP * (np.arange(len(values)) == column)
        above, below = Iterate.of(values + step), Iterate.of(values - step)
        smooth = np.append(np.tile(_on_one_side(equations, above, below), 3), [True, True])
        difference = (equations.missed(above) - equations.missed(below)) / (2 * STEP)
        largest = worst(largest, *np.abs(difference - tangent[:, column])[smooth])
    return largest


def _on_one_side(equations: Equations, above: Iterate, below: Iterate) -> Any:
    """Points that neither start to touch nor to slip between two iterates: there is no kink."""
    sides = []
    for at in (above, below):
        _, _, in_slip = equations.linearised(at)
        sides.append((equations.solution(at, in_slip, 0).pressure, in_slip))
    (p, slips), (p_below, slips_below) = sides
    apart = (p == 0) & (p_below == 0)
    return (apart | (np.minimum(p, p_below) > LEAST_PRESSURE)) & (slips == slips_below)


def _rings(random: np.random.Generator) -> RingCompliance:
    """Rings with random symmetric positive definite harmonics."""
    harmonics = []
    for _ in range(HIGHEST + 1):
        factor = random.normal(size=(3 * RINGS, 3 * RINGS))
        harmonics.append((factor @ factor.T).reshape(3, RINGS, 3, RINGS) / RINGS)
    radii = np.arange(RINGS) / RINGS
    return RingCompliance(
        radii=radii,
        areas=random.uniform(0.5, 1.0, RINGS),
        gap=0.0 * radii,
        harmonics=tuple(harmonics),
        path=Path.HARMONICS,
        motion=np.zeros((2, RINGS)),
        stretch=0.0 * radii,
        reach=1.0,
        edge=HatEdge(),
    )
