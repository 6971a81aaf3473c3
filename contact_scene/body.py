"""A body: a substrate under perfectly bonded layers."""

from pydantic import Field

from contact_scene.description import Description
from contact_scene.material import IsotropicMaterial, Material
from contact_scene.quantity import PositiveLength


class Layer(Description):
    """An elastic layer of constant thickness, perfectly bonded to what lies below it."""

    thickness: PositiveLength
    """Thickness of the layer [length]."""

    material: IsotropicMaterial
    """What the layer is made of."""


class Body(Description):
    """A half-space: its substrate, and the layers on it."""

    material: Material
    """The substrate: an elastic material, or "rigid"."""

    layers: tuple[Layer, ...] = Field(default=(), max_length=100)
    """Layers on the substrate, outermost first."""

    @property
    def elastic_materials(self) -> tuple[IsotropicMaterial, ...]:
        """What can deform, outermost first."""
        substrate = (self.material,) if isinstance(self.material, IsotropicMaterial) else ()
        return *(layer.material for layer in self.layers), *substrate

    @property
    def deforms(self) -> bool:
        """Whether any part of the body is elastic."""
        return bool(self.elastic_materials)
