"""The set of admissible shears: every vector within its disc, and the resultant T if that is given.

Discs are the same in (q_r, q_θ) as in (q_x, q_y).
"""

import numpy as np

from contact_scene.array_types import Field, Vector

MAX_STEPS = 200
ROUND_OFF = 4e-16


def into_discs(q: Field, bound: Vector) -> Field:
    """Restrict vectors q (2, points) to discs of radius `bound` by projection."""
    length = np.sqrt(q[0] ** 2 + q[1] ** 2)
    longer = length > bound
    return np.asarray(q * np.where(longer, bound / np.where(longer, length, 1.0), 1.0))


def project(
    q: Field, bound: Vector, stiffness: Vector, along: Field, total: float | None
) -> tuple[Field, float]:
    """Return the projection of q onto the admissible shears in the metric Σ d |·|².

    stiffness  d (points,) > 0
    along      (2, points); the total is Σ along · q
    total      T, smaller than Σ bound |along|; None without this condition
    returns    P(q + λ along/d) with the λ that gives the total

    The total increases with λ, so that Newton's method within a shrinking bracket converges.
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
        slope = _slope(moved, bound, along, push)
        step = -defect / slope if slope > 0 else np.copysign(np.inf, -defect)
        guess = multiplier + step
        if not low < guess < high or abs(step) > 10 * jump:
            guess = _between(low, high, jump)
            jump *= 2
        if guess in (low, high):
            break
        multiplier = guess
    return inside, multiplier


def _slope(moved: Field, bound: Vector, along: Field, push: Field) -> float:
    """Compute the derivative of the total by the multiplier; vectors at their bound only turn."""
    length = np.sqrt(moved[0] ** 2 + moved[1] ** 2)
    outside = length > bound
    safe = np.where(outside, length, 1.0)
    across = (along[0] * moved[1] - along[1] * moved[0]) / safe
    pushed = (push[0] * moved[1] - push[1] * moved[0]) / safe
    inside = np.where(outside, 0.0, np.sum(along * push, axis=0))
    return float(np.sum(np.where(outside, bound / safe * across * pushed, inside)))


def _between(low: float, high: float, jump: float) -> float:
    """A point inside bounds that may be infinite."""
    if np.isinf(high):
        return low + jump
    return high - jump if np.isinf(low) else 0.5 * (low + high)
