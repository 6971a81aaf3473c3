"""How well a state fulfils the equations of contact: dimensionless, independent of the mesh.

All sums run over rings. Tractions are nodal values, gaps and slips are integrals over the hat
functions, so that the sum of their products is the integral of the product of the fields.
"""

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

Field = NDArray[np.float64]

# Slip below this part of what the surfaces move is measured against the motion instead: without
# any slip its direction means nothing.
LEAST_SLIP = 1e-3


@dataclass(frozen=True)
class Residuals:
    """Convergence measures of one increment; None where the effect or the control is off.

    complementarity         ∫|gap| p dA / (approach W)
    penetration             largest overlap / approach
    normal_equilibrium      |∫p dA - W| / W, under force control
    friction_cone           largest |q| - µp / largest µp
    slip_direction          ∫(µp|Δs| + q·Δs) dA / ∫µp|Δs| dA, Δs the slip increment
    tangential_equilibrium  |∫q dA - T| / ∫µp dA, under force control
    moment_equilibrium      none: the indenter stays upright
    torque_equilibrium      |∫q r dA - M| / ∫µp r dA, under torque control
    """

    complementarity: float
    penetration: float
    normal_equilibrium: float | None = None
    friction_cone: float | None = None
    slip_direction: float | None = None
    tangential_equilibrium: float | None = None
    moment_equilibrium: float | None = None
    torque_equilibrium: float | None = None

    @property
    def worst(self) -> float:
        """The largest of those that apply; NaN wins."""
        values = [getattr(self, field.name) for field in fields(self)]
        return float(np.max([value for value in values if value is not None]))


def complementarity(p: Field, gap: Field, weights: Field, approach: float) -> float:
    """Σ|g| p / (approach Σ w p), g the integral of the gap over a hat and w of the hat."""
    return float(np.sum(np.abs(gap) * p) / (np.sum(weights * p) * abs(approach)))


def penetration(gap: Field, weights: Field, approach: float) -> float:
    """Largest overlap as a mean over a hat, relative to the approach."""
    return float(max(0.0, -np.min(gap / weights)) / abs(approach))


def friction_cone(size: Field, bound: Field) -> float:
    """Largest excess of the shear over its bound, relative to the largest bound."""
    largest = np.max(bound)
    return float(max(0.0, np.max(size - bound)) / largest) if largest > 0 else 0.0


def slip_direction(q: Field, bound: Field, slip: Field, moved: Field) -> float:
    """Σ(b|s| + q s) / Σ b|s|: zero if all that slips carries its bound against the slip.

    slip   slip increment over the hats
    moved  motion of the surfaces over the hats: the scale where slip nearly vanishes
    """
    work = bound * np.abs(slip)
    missing = np.sum(work + q * slip)
    scale = max(np.sum(work), LEAST_SLIP * np.sum(bound * np.abs(moved)))
    return float(missing / scale) if scale > 0 else 0.0
