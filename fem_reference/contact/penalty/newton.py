"""Newton's method on the penalty model, with the consistent tangent and a residual line search.

Without the search the iteration cycles between slip to one side and to the other: a slipping
point has no tangential stiffness of its own, so that its next trial shear is arbitrary. The search
is not monotone (Grippo, Lampariello and Lucidi 1986, SIAM J. Numer. Anal. 23, 707): the residual
has kinks where points start to touch or to slip, and a monotone search stops at them.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from fem_reference.contact.penalty.spring_contact import PenaltyLaw, Response
from fem_reference.contact.penalty.step import newton_step
from fem_reference.contact.penalty.surface import ElasticSurface, Target

Field = NDArray[np.float64]
Vector = NDArray[np.float64]

MOST_ITERATIONS = 30
MOST_HALVINGS = 8
REMEMBERED = 3  # residuals; a step has to get below the largest of them
SUFFICIENT = 1e-4  # part of its linear decrease that a step has to achieve


@dataclass(frozen=True)
class Iterate:
    """Tractions (c, n) and rigid coordinates (c,), on the way or at the end.

    residual    how far the tractions miss the law and the load; see `defect`
    history     residuals from the start to this one
    iterations  linear systems solved
    sweeps      alternations between pressure and shear; 0 on Newton's way
    """

    traction: Field
    coordinates: Vector
    residual: float = np.inf
    history: tuple[float, ...] = ()
    iterations: int = 0
    sweeps: int = 0


def defect(
    surface: ElasticSurface, law: PenaltyLaw, at: Iterate, target: Target
) -> tuple[float, Response]:
    """Weighted L1 norm of traction minus law and of resultant minus load, over the normal load.

    What concerns shear is divided by µ, so that it counts the same under little friction.
    """
    response = law.response(surface.overlap(at.traction, at.coordinates))
    worth = np.ones(len(at.traction))
    worth[1:] = 1 / (law.friction.largest or 1.0)
    missed = np.sum(surface.weights * np.abs(at.traction - response.traction), axis=1)
    missed += np.where(target.free, np.abs(target.value - surface.resultant(at.traction)), 0.0) / (
        surface.lever
    )
    carried = np.maximum(np.abs(response.traction[0]), np.abs(at.traction[0]))
    load = float(np.sum(surface.weights * carried))
    if load == 0:
        return (0.0 if not np.any(missed) else np.inf), response
    return float(np.sum(worth * missed)) / load, response


def solve_by_newton(
    surface: ElasticSurface, law: PenaltyLaw, target: Target, start: Iterate, tolerance: float
) -> Iterate:
    """Iterate until the residual is within the tolerance, or no step lowers it any more.

    The caller reads from `residual` whether it has converged.
    """
    residual, response = defect(surface, law, start, target)
    at = replace(start, residual=residual, history=(residual,), iterations=0, sweeps=0)
    while at.residual > tolerance and at.iterations < MOST_ITERATIONS:
        try:
            traction, coordinates = newton_step(
                surface,
                law.stiffness,
                response,
                response.traction - at.traction,
                target.value - surface.resultant(at.traction),
                target.free,
            )
        except np.linalg.LinAlgError:
            return at
        following = _search(surface, law, target, at, traction, coordinates)
        if following is None:
            return at
        at, response = following
    return at


def _search(
    surface: ElasticSurface,
    law: PenaltyLaw,
    target: Target,
    at: Iterate,
    traction: Field,
    coordinates: Vector,
) -> tuple[Iterate, Response] | None:
    """The first of the steps 1, ½, ¼ … with a residual below a recent one; None if none has."""
    for halving in range(MOST_HALVINGS + 1):
        step = 0.5**halving
        there = replace(
            at,
            traction=at.traction + step * traction,
            coordinates=at.coordinates + step * coordinates,
            iterations=at.iterations + 1,
        )
        residual, response = defect(surface, law, there, target)
        if residual < (1 - SUFFICIENT * step) * max(at.history[-REMEMBERED:]):
            history = (*at.history, residual)
            return replace(there, residual=residual, history=history), response
    return None
