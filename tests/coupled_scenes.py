"""Scenes in which pressure and shear are coupled: a rigid ball on soft or coated bodies."""

import contact_scenes
from contact_scenes import LOAD, MU, RADIUS, A

from contact_scene import (
    RIGID,
    Body,
    IsotropicMaterial,
    Layer,
    Paraboloid,
    Scene,
)

# Under a rigid ball it has the contact of the two alike bodies of `contact_scenes`.
SUBSTRATE = IsotropicMaterial(young_modulus=210e9, poisson_ratio=0.3)
BALL = Paraboloid(radius=RADIUS, material=RIGID)


def bulk(poisson_ratio=0.3) -> Body:
    """A half-space with the E* of the substrate."""
    modulus = SUBSTRATE.plane_strain_modulus * (1 - poisson_ratio**2)
    return Body(material=IsotropicMaterial(young_modulus=modulus, poisson_ratio=poisson_ratio))


def coated(ratio=2.0, thickness=1.0, poisson_ratio=0.3) -> Body:
    """A film of so many substrate moduli, so many contact radii thick."""
    film = IsotropicMaterial(
        young_modulus=ratio * SUBSTRATE.young_modulus, poisson_ratio=poisson_ratio
    )
    return Body(material=SUBSTRATE, layers=(Layer(thickness=thickness * A, material=film),))


def scene(*loading, body=None, indenter=BALL, friction=MU) -> Scene:
    """Loading steps as keyword tables; without friction if that is None."""
    return contact_scenes.scene(
        *loading, body=body or coated(), indenter=indenter, friction=friction
    )


def press(load=1.0, increments=3, **more) -> dict:
    """A normal force in parts of the full load."""
    return {"normal_force": load * LOAD, "increments": increments, **more}


def push(x, y=0.0, *, friction=MU, increments=2, **more) -> dict:
    """A tangential force in parts of the friction limit under the full load."""
    limit = friction * LOAD
    return {"tangential_force": (x * limit, y * limit), "increments": increments, **more}
