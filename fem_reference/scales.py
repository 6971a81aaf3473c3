"""Units of length and stress that make the elasticity problem dimensionless."""

from dataclasses import dataclass

from contact_scene.body import Body, Layer
from contact_scene.material import IsotropicMaterial, Material


@dataclass(frozen=True)
class Scales:
    """Unit of length and unit of stress of the dimensionless elasticity problem.

    length   radius for which the mesh is laid out, usually the expected contact radius [length]
    modulus  Young's modulus of the outermost material of one body [force/length^2]
    """

    length: float
    modulus: float

    def dimensionless(self, body: Body) -> Body:
        """Return a copy of a body in dimensionless units, for its mesh and its stiffness matrix.

        Layer thicknesses are divided by the unit of length, Young's moduli by the unit of stress.
        The copy has no surface shape, because the mesh requires the layers and materials only.

        body  body in the units of the scene
        """
        layers = tuple(
            Layer(
                thickness=layer.thickness / self.length,
                material=self._scale_material(layer.material),
            )
            for layer in body.layers
        )
        material: Material = body.material
        if isinstance(material, IsotropicMaterial):
            material = self._scale_material(material)
        return Body(material=material, layers=layers)

    def _scale_material(self, material: IsotropicMaterial) -> IsotropicMaterial:
        return IsotropicMaterial(
            young_modulus=material.young_modulus / self.modulus,
            poisson_ratio=material.poisson_ratio,
        )
