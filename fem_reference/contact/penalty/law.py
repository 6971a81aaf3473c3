"""The normal half of the penalty model: pressure grows with the overlap of the surfaces."""

import numpy as np
from numpy.typing import NDArray

from fem_reference.contact.augmentation import Penalty

Field = NDArray[np.float64]


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
