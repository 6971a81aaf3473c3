"""How well a state fulfils the equations of contact: dimensionless, independent of the mesh."""

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

Field = NDArray[np.float64]

# Slip below this part of the tangential displacement is judged by the displacement instead:
# with no slip at all its direction means nothing.
LEAST_SLIP = 1e-3


@dataclass(frozen=True)
class Residuals:
    """Convergence measures of one increment; None where the effect or the control is off.

    complementarity         Σ|gap| p / (approach Σp)
    penetration             max(-gap) / approach
    normal_equilibrium      |Σp - W| / W, under force control
    friction_cone           max(|q| - µp) / max(µp)
    slip_direction          Σ(µp|Δs| + q·Δs) / Σµp|Δs|, Δs the slip increment
    tangential_equilibrium  |Σq - T| / Σµp, under force control
    moment_equilibrium      |Σp (y, x) - M| / Σp r, under force control of the tilt
    torque_equilibrium      |Σ(q_y x - q_x y) - M_z| / Σµp r, under force control of the twist
    """

    complementarity: float
    penetration: float
    normal_equilibrium: float | None
    friction_cone: float | None = None
    slip_direction: float | None = None
    tangential_equilibrium: float | None = None
    moment_equilibrium: float | None = None
    torque_equilibrium: float | None = None

    @property
    def worst(self) -> float:
        """The largest of those that apply."""
        values = (getattr(self, f.name) for f in fields(self))
        return max(value for value in values if value is not None)


def complementarity(p: Field, g: Field, approach: float) -> float:
    """Σ|g| p / (approach Σp); gaps where p = 0 do not matter and may be infinite."""
    pressed = p > 0
    return float(np.sum(np.abs(g[pressed]) * p[pressed]) / (np.sum(p) * abs(approach)))


def penetration(g: Field, approach: float) -> float:
    """max(-g) / approach, zero if the bodies nowhere overlap."""
    return float(max(0.0, -np.min(g)) / abs(approach))


def friction_cone(q: Field, bound: Field) -> float:
    """max(|q| - bound) / max(bound), zero if the bound is nowhere exceeded."""
    excess = np.max(np.sqrt(q[0] ** 2 + q[1] ** 2) - bound)
    return float(max(0.0, excess) / np.max(bound))


def slip_direction(q: Field, bound: Field, slip: Field, displacement: Field) -> float:
    """Σ(bound |w| - q·w) / Σ bound |w|: zero if q has full length along w wherever w is not zero.

    q             shear (2, nx, ny)
    bound         friction limit (nx, ny), zero outside the contact
    slip          w (2, nx, ny), of the indenter relative to the body, so that q follows w
    displacement  tangential displacement (2, nx, ny): the scale where slip nearly vanishes
    """
    work = bound * np.sqrt(slip[0] ** 2 + slip[1] ** 2)
    missing = np.sum(work - q[0] * slip[0] - q[1] * slip[1])
    contact = bound > 0
    largest = max(np.max(np.abs(displacement[:, contact])), np.max(np.abs(slip[:, contact])))
    least = LEAST_SLIP * largest * np.sum(bound)
    return float(missing / max(np.sum(work), least)) if largest > 0 else 0.0
