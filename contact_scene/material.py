"""Materials of bodies and layers."""

from enum import Enum
from typing import Annotated, Any

from pydantic import Discriminator, Tag

from contact_scene.reading.description import Description
from contact_scene.reading.quantity import (
    PoissonRatio,
    PositivePressure,
)


class IsotropicMaterial(Description):
    """Homogeneous, isotropic, linear elastic material."""

    young_modulus: PositivePressure
    """Young's modulus E, positive [force/length^2]."""

    poisson_ratio: PoissonRatio
    """Poisson's ratio nu, -1 < nu <= 0.5."""

    yield_strength: PositivePressure | None = None
    """Limit of the equivalent stress of von Mises, for 'slipstick limit' [force/length^2]. Absent:
    no limit."""

    tensile_strength: PositivePressure | None = None
    """Limit of the largest principal stress, for 'slipstick limit' [force/length^2]. Absent: no
    limit."""

    @property
    def shear_modulus(self) -> float:
        """Shear modulus G = E / 2(1 + nu) [force/length^2]."""
        return self.young_modulus / (2.0 * (1.0 + self.poisson_ratio))

    @property
    def plane_strain_modulus(self) -> float:
        """Plane-strain modulus E' = E / (1 - nu^2) [force/length^2]."""
        return self.young_modulus / ((1.0 - self.poisson_ratio) * (1.0 + self.poisson_ratio))


class Rigid(Enum):
    """Material of a body that does not deform."""

    RIGID = "rigid"


RIGID = Rigid.RIGID


def _material_kind(value: Any) -> str:
    return "<rigid>" if isinstance(value, str | Rigid) else "<elastic>"


Material = Annotated[
    Annotated[IsotropicMaterial, Tag("<elastic>")] | Annotated[Rigid, Tag("<rigid>")],
    Discriminator(_material_kind),
]
