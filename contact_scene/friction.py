"""Friction between the two bodies."""

from typing import Annotated, Any

import numpy as np
from pydantic import Discriminator, Tag, model_validator

from contact_scene.array_file import FileKey
from contact_scene.description import Description
from contact_scene.quantity import FrictionCoefficient
from contact_scene.refusal import refusal


class FrictionMap(Description):
    """Coefficients of friction that vary over the surface."""

    map: FileKey
    """A `.npy` file with one coefficient for every cell of the surface, index [i, j] = (x, y)."""

    @model_validator(mode="after")
    def _is_never_negative(self) -> "FrictionMap":
        if np.any(self.map.values < 0.0):
            raise refusal(
                f"the map {self.map} holds {self.map.values.min():.6g}", "coefficients not below 0"
            )
        return self


def _kind(value: Any) -> str:
    return "<mapped>" if isinstance(value, dict | FrictionMap) else "<uniform>"


Coefficient = Annotated[
    Annotated[FrictionCoefficient, Tag("<uniform>")] | Annotated[FrictionMap, Tag("<mapped>")],
    Discriminator(_kind),
]


class CoulombFriction(Description):
    """Coulomb's law: the shear never exceeds coefficient times pressure; slip opposes it."""

    coefficient: Coefficient
    """Coefficient of friction mu >= 0, or a map of it."""
