"""Layered body: a substrate under bonded layers."""

from itertools import takewhile
from math import inf, log

from pydantic import Field, field_validator

from contact_scene.material import IsotropicMaterial, Material
from contact_scene.reading.description import Description
from contact_scene.reading.quantity import (
    PositiveInterfaceStiffness,
    PositiveLength,
    PositivePressure,
)

# Differences of ln E and of ν below which a grid need not resolve two materials separately.
NEARLY_EQUAL = 0.1, 0.01


class InterfaceStrength(Description):
    """Limits of the stress on the interface below a layer, for 'slipstick limit'."""

    shear: PositivePressure | None = None
    """Limit of the shear stress on the interface [force/length^2]; absent: no limit."""

    tension: PositivePressure | None = None
    """Limit of the tensile stress normal to the interface [force/length^2]; absent: no limit."""


class InterfaceStiffness(Description):
    """Springs of a compliant bond: traction on the interface per jump of the displacement.

    The bond is linear: it carries tension, and its sides may overlap by the jump.
    """

    normal: PositiveInterfaceStiffness | None = None
    """Normal traction per opening [force/length^3]; absent: the bond does not open."""

    shear: PositiveInterfaceStiffness | None = None
    """Shear traction per tangential jump [force/length^3]; absent: the bond does not shift."""

    @property
    def given(self) -> tuple[float, ...]:
        """Stiffnesses that are given [force/length^3]."""
        return tuple(each for each in (self.normal, self.shear) if each is not None)


class Layer(Description):
    """Elastic layer of constant thickness, bonded to the layer or substrate below it."""

    thickness: PositiveLength
    """Thickness of the layer [length]."""

    material: IsotropicMaterial
    """Material of the layer."""

    interface_strength: InterfaceStrength | None = None
    """Strength of the bond to the layer or substrate below; absent: no limit."""

    interface_stiffness: InterfaceStiffness | None = None
    """Stiffness of the bond to the layer or substrate below; absent: a rigid bond."""

    @field_validator("interface_stiffness")
    @classmethod
    def _drop_rigid_bond(cls, bond: InterfaceStiffness | None) -> InterfaceStiffness | None:
        return bond if bond is not None and bond.given else None


class Body(Description):
    """Half-space with layers."""

    material: Material
    """Material of the substrate: an elastic material, or "rigid"."""

    layers: tuple[Layer, ...] = Field(default=(), max_length=100)
    """Layers on the substrate, outermost first."""

    @property
    def elastic_materials(self) -> tuple[IsotropicMaterial, ...]:
        """Elastic materials of the body: its layers, outermost first, then an elastic substrate."""
        substrate = (self.material,) if isinstance(self.material, IsotropicMaterial) else ()
        return *(layer.material for layer in self.layers), *substrate

    @property
    def deforms(self) -> bool:
        """True if the body can deform elastically: if a layer or the substrate is elastic."""
        return bool(self.elastic_materials)

    @property
    def thinnest(self) -> float:
        """Smallest depth of nearly uniform material in the layered body [length].

        A grid or mesh must resolve this depth. Adjacent layers with a rigid bond count as one layer
        if their materials differ by less than `NEARLY_EQUAL`. The depth is infinite for a uniform
        body.
        """
        return min(map(self._uniform_depth, range(len(self.layers))), default=inf)

    def _uniform_depth(self, layer: int) -> float:
        materials = (*(other.material for other in self.layers), self.material)
        thickness = (*(other.thickness for other in self.layers), inf)
        equal = [_nearly_equal(materials[layer], other) for other in materials]
        rigid = [other.interface_stiffness is None for other in self.layers]
        above = takewhile(lambda n: equal[n] and rigid[n], range(layer - 1, -1, -1))
        below = takewhile(lambda n: equal[n] and rigid[n - 1], range(layer + 1, len(materials)))
        return thickness[layer] + sum(thickness[other] for other in (*above, *below))


def _nearly_equal(one: Material, other: Material) -> bool:
    if not (isinstance(one, IsotropicMaterial) and isinstance(other, IsotropicMaterial)):
        return False
    return (
        abs(log(one.young_modulus / other.young_modulus)) < NEARLY_EQUAL[0]
        and abs(one.poisson_ratio - other.poisson_ratio) < NEARLY_EQUAL[1]
    )
