"""A body: a substrate under perfectly bonded layers."""

from itertools import takewhile
from math import inf, log

from pydantic import Field

from contact_scene.material import IsotropicMaterial, Material
from contact_scene.reading.description import Description
from contact_scene.reading.quantity import PositiveLength

# Materials that differ by less are one, as far as a grid has to resolve them: of ln E, and of ν.
ALIKE = 0.1, 0.01


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

    @property
    def thinnest(self) -> float:
        """The least depth over which the body is of one material, or of some that hardly differ
        [length]; infinite if all of it is. Cutting a layer in two changes nothing."""
        return min(map(self._depth_alike, range(len(self.layers))), default=inf)

    def _depth_alike(self, layer: int) -> float:
        materials = (*(other.material for other in self.layers), self.material)
        thickness = (*(other.thickness for other in self.layers), inf)

        def alike(other: int) -> bool:
            return _alike(materials[layer], materials[other])

        above = takewhile(alike, range(layer - 1, -1, -1))
        below = takewhile(alike, range(layer + 1, len(materials)))
        return thickness[layer] + sum(thickness[other] for other in (*above, *below))


def _alike(one: Material, other: Material) -> bool:
    if not (isinstance(one, IsotropicMaterial) and isinstance(other, IsotropicMaterial)):
        return False
    stiffer, wider = ALIKE
    return (
        abs(log(one.young_modulus / other.young_modulus)) < stiffer
        and abs(one.poisson_ratio - other.poisson_ratio) < wider
    )
