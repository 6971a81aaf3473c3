"""Set of admissible shears: every shear vector lies within the friction limit of its point.

The friction limit is a disc for each point. If the tangential load is prescribed, the resultant of
the shear is equal to the load T. A disc has the same form in the components (q_r, q_θ) and (q_x,
q_y).
"""

import numpy as np

from contact_scene.array_types import Field, Vector

MAX_STEPS = 200
ROUND_OFF = 4e-16


def into_discs(q: Field, bound: Vector) -> Field:
    """Limit the shear at every point to the friction limit, without a change of direction.

    Shear vectors longer than the friction limit are shortened to the limit. All others are
    unchanged. The result has the shape (2, points).

    q      shear vectors (2, points) [force/length^2]
    bound  friction limit of each point (points,) [force/length^2]
    """
    length = np.sqrt(q[0] ** 2 + q[1] ** 2)
    longer = length > bound
    return np.asarray(q * np.where(longer, bound / np.where(longer, length, 1.0), 1.0))


def project(
    q: Field, bound: Vector, stiffness: Vector, along: Field, total: float | None
) -> tuple[Field, float]:
    """Compute the admissible shear that is nearest to a given shear field.

    A shear is admissible if every vector is within the friction limit of its point and, under a
    prescribed load T, the resultant is equal to T. Distances are measured by Σ d |·|² with the
    weights d. Return P(q + λ along/d), where P limits each vector to its friction limit, and the
    multiplier λ of the load. λ is found by Newton's method within a shrinking bracket.

    q          shear vectors (2, points) [force/length^2]
    bound      friction limit (points,) [force/length^2]
    stiffness  d > 0 (points,), mean diagonal of the compliance matrix at each point
    along      factors of the shear in the resultant Σ along · q (2, points)
    total      T, smaller than Σ bound |along|; None if the load is not prescribed, then λ = 0
    """
    if total is None:
        return into_discs(q, bound), 0.0
    push = along / stiffness
    low, high, step = -np.inf, np.inf, 0.0
    rate = np.sum(along * push)
    limit = np.sum(bound * np.sqrt(along[0] ** 2 + along[1] ** 2))
    multiplier, jump = 0.0, limit / rate
    for _ in range(MAX_STEPS):
        moved = q + multiplier * push
        inside = into_discs(moved, bound)
        defect = float(np.sum(along * inside)) - total
        if abs(defect) <= ROUND_OFF * limit:
            break
        low, high = (multiplier, high) if defect < 0 else (low, multiplier)
        slope = _load_slope(moved, bound, along, push)
        step = -defect / slope if slope > 0 else np.copysign(np.inf, -defect)
        guess = multiplier + step
        if not low < guess < high or abs(step) > 10 * jump:
            # The middle of the bracket, or a longer step from its finite end.
            finite = low + jump if np.isinf(high) else high - jump
            guess = finite if np.isinf(high - low) else 0.5 * (low + high)
            jump *= 2
        if guess in (low, high):
            break
        multiplier = guess
    return inside, multiplier


def _load_slope(moved: Field, bound: Vector, along: Field, push: Field) -> float:
    """Compute the derivative of the tangential load with respect to its Lagrange multiplier λ.

    λ shifts all shear vectors in the direction of the load. The vectors are then limited to the
    friction limit, and the load is their resultant. Vectors that exceed the limit change their
    direction only. Used by the Newton iteration that finds λ for a prescribed load.

    moved  shear vectors for the current λ, before the limitation (2, points)
    bound  friction limit of each point (points,)
    along  factors of the shear in the resultant Σ along · q (2, points)
    push   derivative of the shear vectors by λ (2, points)
    """
    length = np.sqrt(moved[0] ** 2 + moved[1] ** 2)
    outside = length > bound
    safe = np.where(outside, length, 1.0)
    across = (along[0] * moved[1] - along[1] * moved[0]) / safe
    pushed = (push[0] * moved[1] - push[1] * moved[0]) / safe
    inside = np.where(outside, 0.0, np.sum(along * push, axis=0))
    return float(np.sum(np.where(outside, bound / safe * across * pushed, inside)))
