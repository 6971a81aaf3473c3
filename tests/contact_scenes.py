"""Contact scenes for tests of the semi-analytical solver: the ball of the paper, and variations."""

import numpy as np

from contact_scene import (
    RIGID,
    Body,
    Cone,
    CoulombFriction,
    Ellipsoid,
    FlatPunch,
    IsotropicMaterial,
    LoadStep,
    Paraboloid,
    Scene,
    Sphere,
)
from semi_analytical import SurfaceGrid
from verification.closed_forms.hertz import PointContact, contact_modulus

RADIUS = 0.018
YOUNG = 420e9
NU = 0.3
MU = 0.1
LOAD = 1e3
# All of the history below refers to this: the friction limit under the full load.
LIMIT = MU * LOAD


def steel(poisson_ratio: float = NU, young_modulus: float = YOUNG) -> IsotropicMaterial:
    return IsotropicMaterial(young_modulus=young_modulus, poisson_ratio=poisson_ratio)


def hertz(load: float = LOAD, poisson_ratio: float = NU) -> PointContact:
    """Hertz's contact of the paraboloid and the half-space of these scenes."""
    modulus = contact_modulus((YOUNG, poisson_ratio), (YOUNG, poisson_ratio))
    return PointContact.under_load(load, RADIUS, modulus)


A = hertz().contact_radius
APPROACH = hertz().approach


def paraboloid(material=None):
    return Paraboloid(radius=RADIUS, material=material or steel())


def scene(*loading, friction=MU, indenter=None, body=None) -> Scene:
    """Loading steps as keyword tables; `friction` None: frictionless; a body or its material."""
    return Scene(
        indenter=indenter or paraboloid(),
        body=body if isinstance(body, Body) else Body(material=body or steel()),
        friction=None if friction is None else CoulombFriction(coefficient=friction),
        loading=[LoadStep(**step) for step in loading],
    )


def grid(cells: int = 32, contacts: float = 1.5, radius: float = A) -> SurfaceGrid:
    """A square window of so many contact diameters."""
    return SurfaceGrid((cells, cells), (2 * contacts * radius, 2 * contacts * radius))


PRESS = {"normal_force": LOAD}


def push(x: float, y: float = 0.0, **more) -> dict:
    """A tangential force in parts of the friction limit under the full load."""
    return {"tangential_force": (x * LIMIT, y * LIMIT), **more}


def slide(x: float, y: float = 0.0, **more) -> dict:
    """A tangential shift in units of a tenth of the approach."""
    return {"tangential_shift": (0.1 * x * APPROACH, 0.1 * y * APPROACH), **more}


INDENTERS = {
    "sphere": Sphere(radius=RADIUS, material=steel()),
    "paraboloid": paraboloid(),
    "ellipsoid": Ellipsoid(radii=(RADIUS, 4 * RADIUS), material=steel()),
    "cone": Cone(slope_angle=0.02, material=steel()),
    "flat punch": FlatPunch(radius=A, material=steel()),
}
RIGID_BALL = Paraboloid(radius=RADIUS, material=RIGID)


def bump(cells: int, spacing: float) -> np.ndarray:
    """Heights of the paraboloid at the centres of cells."""
    x = (np.arange(cells) - 0.5 * (cells - 1)) * spacing
    return (x[:, None] ** 2 + x[None, :] ** 2) / (2 * RADIUS)
