"""The penalty law and Uzawa's update: tractions of a pass are multipliers of the next.

Springs of stiffness ε between the surfaces carry t = λ + ε (overlap): the pressure is
p = ⟨λ − ε g⟩ (Wriggers 2006, Computational Contact Mechanics, ch. 6), the shear λ_t + ε v returned
to Coulomb's cone (Giannakopoulos 1989, Comput. Struct. 32, 157). This is the exact law of contact
and friction between bodies on which the springs, of compliance 1/ε, lie in series.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from contact_scene.solver_errors import SurfacesOverlap

P = TypeVar("P")


@dataclass(frozen=True)
class Penalty:
    """Stiffness of the springs, and limits on the updates of the multipliers.

    factor         c, stiffness ε = c E* / h with E* the contact modulus of the outermost materials
                   and h the length of a contact edge [1]
    augmentations  largest number of Uzawa updates of the multipliers in each increment; without any
                   the pressure is that of springs of stiffness ε between the surfaces
    overlap        largest overlap over the displacement of the bodies [1]
    """

    factor: float = 10.0
    augmentations: int = 100
    overlap: float = 1e-3

    def __post_init__(self) -> None:
        if not 0 < self.factor < np.inf:
            raise ValueError(f"the penalty factor must be positive, not {self.factor}; try 10")
        if self.augmentations < 0:
            raise ValueError(f"augmentations cannot be negative, as {self.augmentations} is")

    def stiffness(self, contact_modulus: float, edge_length: float) -> float:
        """Compute ε [force/length^3].

        contact_modulus  E* of the outermost materials [force/length^2]: it is them that an overlap
                         as short as an edge presses
        edge_length      of a contact edge of the mesh [length]
        """
        return self.factor * contact_modulus / edge_length


def augmented(
    first: P,
    again: Callable[[P], P],
    left: Callable[[P], float],
    penalty: Penalty,
    fewest: int,
) -> list[P]:
    """Return all passes of an increment, the last one the best.

    (Alart and Curnier 1991, Comput. Methods Appl. Mech. Eng. 92, 353; Simo and Laursen 1992,
    Comput. Struct. 42, 97.) One update of stiff springs removes nearly all of the penalty's error.
    The updates end when the remaining error is allowed. At Gauss points the displacements do not
    determine all pressures, and further updates would accumulate oscillations.

    again   function from a pass to the next, whose multipliers are its tractions
    left    function of a pass: its overlap over the displacement of the bodies
    fewest  least number of updates, if their limit allows it
    raises  SurfacesOverlap if the overlap after the last update is not allowed
    """
    passes = [first]
    for update in range(penalty.augmentations + 1):
        remains = left(passes[-1])
        if remains <= penalty.overlap and update >= min(fewest, penalty.augmentations):
            return passes
        if update < penalty.augmentations:
            passes.append(again(passes[-1]))
    raise SurfacesOverlap(remains, penalty.augmentations, penalty.overlap)
