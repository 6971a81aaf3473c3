"""Elastic constants of a layered body: layers from the surface down, then the base.

The frequency response functions use this description of a body.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite
from typing import NamedTuple

from contact_scene.body import Body, InterfaceStiffness, Layer
from contact_scene.material import IsotropicMaterial


class HalfSpace(NamedTuple):
    """Elastic constants of a homogeneous isotropic half-space.

    shear_modulus  G [force/length^2]
    poisson_ratio  Poisson's ratio
    """

    shear_modulus: float
    poisson_ratio: float


class Film(NamedTuple):
    """Isotropic layer of uniform thickness, bonded to the material below.

    shear_modulus    G [force/length^2]
    poisson_ratio    Poisson's ratio
    thickness        thickness [length]
    normal_opening   opening of the bond per normal traction [length^3/force]; 0 for a rigid bond
    tangential_jump  tangential jump at the bond per shear traction [length^3/force]
    """

    shear_modulus: float
    poisson_ratio: float
    thickness: float
    normal_opening: float = 0.0
    tangential_jump: float = 0.0


@dataclass(frozen=True)
class Stack:
    """Layered body: bonded layers, outermost first, on a half-space or a rigid base.

    Plain tuples are accepted. A rigid base without layers is a rigid body.

    layers  constants of each layer, see `Film`; layers of zero thickness with a rigid bond are
            removed
    base    (shear modulus, Poisson's ratio) of the half-space below, or None for a rigid base

    Raises ValueError unless G > 0, -1 < nu <= 1/2, thickness and compliances of the bond >= 0, all
    finite, and for a layer of zero thickness with a compliant bond.
    """

    layers: tuple[Film, ...]
    base: HalfSpace | None

    def __init__(
        self,
        layers: Sequence[tuple[float, ...]] = (),
        base: tuple[float, float] | None = None,
    ) -> None:
        films = tuple(Film(*map(float, layer)) for layer in layers)
        half_space = None if base is None else HalfSpace(*map(float, base))
        for film in films:
            _check_material(film.shear_modulus, film.poisson_ratio)
            if not (isfinite(film.thickness) and film.thickness >= 0):
                raise ValueError(
                    f"thickness of a layer is {film.thickness}, expected a finite length >= 0"
                )
            if not all(isfinite(each) and each >= 0 for each in film[3:]):
                raise ValueError(f"compliances of a bond are {film[3:]}, expected finite ones >= 0")
            if film.thickness == 0 and any(film[3:]):
                raise ValueError("a layer of zero thickness has a compliant bond")
        if half_space is not None:
            _check_material(*half_space)
        object.__setattr__(self, "layers", tuple(film for film in films if film.thickness > 0))
        object.__setattr__(self, "base", half_space)

    @property
    def is_rigid(self) -> bool:
        """True if the body is rigid, which means a rigid base without layers."""
        return self.base is None and not self.layers

    @property
    def outer(self) -> HalfSpace:
        """Half-space of the outermost material, which determines the response to short waves.

        Raises ValueError for a rigid body.
        """
        if self.layers:
            return HalfSpace(self.layers[0].shear_modulus, self.layers[0].poisson_ratio)
        if self.base is None:
            raise ValueError("a rigid body has no outer material")
        return self.base


def stack_of(body: Body) -> Stack:
    """Return the layers and the base of a body of the scene, with their elastic constants."""
    base = body.material
    return Stack(
        [
            (*_elastic_constants(layer.material), layer.thickness, *_bond_compliances(layer))
            for layer in body.layers
        ],
        _elastic_constants(base) if isinstance(base, IsotropicMaterial) else None,
    )


def _elastic_constants(material: IsotropicMaterial) -> HalfSpace:
    """Return the shear modulus and Poisson's ratio of an isotropic material."""
    return HalfSpace(material.shear_modulus, material.poisson_ratio)


def _bond_compliances(layer: Layer) -> tuple[float, float]:
    """Return opening and tangential jump of the bond below a layer per traction, 0 if rigid."""
    bond = layer.interface_stiffness or InterfaceStiffness()
    return tuple(0.0 if each is None else 1 / each for each in (bond.normal, bond.shear))  # type: ignore[return-value]


def _check_material(shear_modulus: float, poisson_ratio: float) -> None:
    """Raise ValueError unless the elastic constants have a positive strain energy."""
    if not (isfinite(shear_modulus) and shear_modulus > 0):
        raise ValueError(f"shear modulus is {shear_modulus}, expected a finite value > 0")
    if not -1 < poisson_ratio <= 0.5:
        raise ValueError(f"Poisson's ratio is {poisson_ratio}, expected -1 < ratio <= 0.5")
