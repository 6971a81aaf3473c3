"""Penalty law of contact, and Uzawa's update of the multipliers (augmented Lagrangian).

Springs of stiffness ε between the surfaces carry the traction t = λ + ε (overlap), with the
multiplier λ. The pressure is p = ⟨λ − ε g⟩ with the gap g (Wriggers 2006, Computational Contact
Mechanics, ch. 6). The shear λ_t + ε v, with the tangential strain v of the springs, is returned to
Coulomb's cone (Giannakopoulos 1989, Comput. Struct. 32, 157). In each pass the multipliers are the
tractions of the previous pass. The penalty law is equal to the exact law between bodies with the
springs, of compliance 1/ε, in series.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from contact_scene.solver_errors import SurfacesOverlap

P = TypeVar("P")


@dataclass(frozen=True)
class Penalty:
    """Parameters of the penalty method: spring stiffness, and limits on the multiplier updates.

    The penalty method places springs between the surfaces, so that the surfaces overlap. Updates of
    the multipliers (augmented Lagrangian) reduce this overlap.

    factor         c of the stiffness ε = c E* / h [1], with the contact modulus E* of the outermost
                   materials and the length h of an element edge in contact
    augmentations  largest number of Uzawa updates of the multipliers in each increment. With 0
                   updates the pressure is that of springs of stiffness ε between the surfaces
    overlap        largest allowed overlap over the displacement of the bodies [1]
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
        """Compute the stiffness ε = c E* / h of the penalty springs per area [force/length^3].

        The springs act between the two surfaces in contact. c is the factor of the penalty method.

        contact_modulus
                     E* of the outermost materials [force/length^2]. An overlap is shorter than an
                     element edge and therefore deforms these materials only
        edge_length  h, length of an element edge on the contact surface [length]
        """
        return self.factor * contact_modulus / edge_length


def repeat_passes(
    first: P,
    again: Callable[[P], P],
    left: Callable[[P], float],
    penalty: Penalty,
    fewest: int,
) -> list[P]:
    """Repeat the penalty solve of an increment with updated multipliers until the overlap is small.

    Each solve is a pass. The tractions of a pass are the multipliers of the next pass. Return the
    solutions of all passes; the last one is the best. One update of stiff springs removes nearly
    all of the error of the penalty (Alart and Curnier 1991, Comput. Methods Appl. Mech. Eng. 92,
    353; Simo and Laursen 1992, Comput. Struct. 42, 97). At Gauss points the displacements do not
    determine all pressures, and updates beyond the allowed error would accumulate oscillations.

    first    solution of the first pass
    again    function that computes the next pass from the solution of a pass
    left     function that returns the relative error of a pass that the penalty causes [1], such as
             overlap over approach
    penalty  largest number of updates, and largest allowed error `penalty.overlap`
    fewest   least number of updates, unless `penalty.augmentations` is smaller
    raises   SurfacesOverlap if the error after the last update is not allowed
    """
    passes = [first]
    for update in range(penalty.augmentations + 1):
        remains = left(passes[-1])
        if remains <= penalty.overlap and update >= min(fewest, penalty.augmentations):
            return passes
        if update < penalty.augmentations:
            passes.append(again(passes[-1]))
    raise SurfacesOverlap(remains, penalty.augmentations, penalty.overlap)
