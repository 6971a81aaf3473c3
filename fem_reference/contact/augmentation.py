"""Springs between surfaces, and Uzawa's update: tractions of a pass are multipliers of the next."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from contact_scene.solver_errors import SurfacesOverlap

P = TypeVar("P")


@dataclass(frozen=True)
class Penalty:
    """How stiffly overlap is resisted, and how often the law is corrected for it.

    factor         c, stiffness ε = c E* / h with E* the contact modulus of the outermost
                   materials and h the length of a contact edge [1]
    augmentations  most Uzawa updates of the multipliers in each increment; with none the pressure
                   is that of springs of stiffness ε between the surfaces
    overlap        that may be left, relative to what the bodies move [1]
    """

    factor: float = 10.0
    augmentations: int = 100
    overlap: float = 1e-3

    def __post_init__(self) -> None:
        if not 0 < self.factor < np.inf:
            raise ValueError(f"the penalty factor must be positive, not {self.factor}; try 10")
        if self.augmentations < 0:
            raise ValueError(f"augmentations cannot be negative, as {self.augmentations} is")


def augmented(
    first: P,
    again: Callable[[P], P],
    left: Callable[[P], float],
    penalty: Penalty,
    fewest: int,
) -> list[P]:
    """All passes of an increment, the last one the best.

    (Alart and Curnier 1991, Comput. Methods Appl. Mech. Eng. 92, 353; Simo and Laursen 1992,
    Comput. Struct. 42, 97.) One update of stiff springs takes away nearly all of the penalty's
    error. It ends as soon as what is left is allowed: at Gauss points, that can carry more
    pressures than the displacements can tell apart, further ones pile up ripples.

    again   from a pass to the next, whose multipliers are its tractions
    left    what a pass leaves of overlap, relative to what the bodies move
    fewest  updates that are made in any case, if so many are allowed
    raises  SurfacesOverlap: more is left than allowed after the last update
    """
    passes = [first]
    for update in range(penalty.augmentations + 1):
        remains = left(passes[-1])
        if remains <= penalty.overlap and update >= min(fewest, penalty.augmentations):
            return passes
        if update < penalty.augmentations:
            passes.append(again(passes[-1]))
    raise SurfacesOverlap(remains, penalty.augmentations, penalty.overlap)
