"""Units of length and stress of the dimensionless quantities in this package."""

from dataclasses import dataclass

from contact_scene.body import Body, Layer
from contact_scene.material import IsotropicMaterial, Material


@dataclass(frozen=True)
class Scales:
    """Unit of length and unit of stress of a dimensionless problem.

    length   expected contact radius [length]
    modulus  elastic modulus of one of the bodies [force/length^2]
    """

    length: float
    modulus: float

    @property
    def force(self) -> float:
        """Unit of force [force]."""
        return self.modulus * self.length * self.length

    @property
    def moment(self) -> float:
        """Unit of moment and torque [force length]."""
        return self.force * self.length

    def dimensionless(self, body: Body) -> Body:
        """Return the body with thicknesses and moduli in these units, without its shape."""
        layers = tuple(
            Layer(thickness=layer.thickness / self.length, material=self._scaled(layer.material))
            for layer in body.layers
        )
        material: Material = body.material
        if isinstance(material, IsotropicMaterial):
            material = self._scaled(material)
        return Body(material=material, layers=layers)

    def _scaled(self, material: IsotropicMaterial) -> IsotropicMaterial:
        return IsotropicMaterial(
            young_modulus=material.young_modulus / self.modulus,
            poisson_ratio=material.poisson_ratio,
        )
