"""The normal half of the penalty model: pressure grows with the overlap of the surfaces."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Field = NDArray[np.float64]


@dataclass(frozen=True)
class Penalty:
    """How stiffly overlap is resisted, and how often the law is corrected for it.

    factor         c, stiffness ε = c E* / h with E* the contact modulus of the outermost
                   materials and h the length of a contact edge [1]
    augmentations  Uzawa updates of the multipliers in each increment; with none the pressure is
                   that of springs of stiffness ε between the surfaces
    """

    factor: float = 10.0
    augmentations: int = 1

    def __post_init__(self) -> None:
        if not 0 < self.factor < np.inf:
            raise ValueError(f"the penalty factor must be positive, not {self.factor}; try 10")
        if self.augmentations < 0:
            raise ValueError(f"augmentations cannot be negative, as {self.augmentations} is")


def penalty_stiffness(penalty: Penalty, contact_modulus: float, edge_length: float) -> float:
    """ε of a penalty [force/length^3].

    contact_modulus  E* of the outermost materials [force/length^2]
    edge_length      of a contact edge of the mesh [length]
    """
    return penalty.factor * contact_modulus / edge_length


def penalty_pressure(gap: Field, stiffness: float, multiplier: Field) -> Field:
    """p = ⟨λ − ε g⟩, never tensile (Wriggers 2006, Computational Contact Mechanics, ch. 6).

    gap         g, negative where the surfaces overlap [length]
    stiffness   ε [force/length^3]
    multiplier  λ, the pressure of the pass before [force/length^2]
    """
    return np.maximum(multiplier - stiffness * gap, 0.0)
