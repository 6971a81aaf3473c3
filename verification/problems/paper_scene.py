"""Data of the paper: a ball on a half-space, bodies with the paper's E*, and grids.

The paper prints a contact radius of 0.388 mm and a peak pressure of 3.1684 GPa under 1 kN. These
belong to the compliance of one body of E = 210 GPa, ν = 0.3. Two identical bodies of 420 GPa have
the same total compliance and are uncoupled, as the closed form assumes. Two bodies with ν = 0 and E
= 2 E* have it as well; for these the closed form of the tangential problem is exact.
"""

import math

from contact_scene import (
    Body,
    CoulombFriction,
    IsotropicMaterial,
    LoadStep,
    Paraboloid,
    Scene,
)
from contact_scene.geometry import Indenter
from semi_analytical.grid import SurfaceGrid
from verification.closed_forms.cattaneo_mindlin import PartialSlip
from verification.closed_forms.hertz import PointContact, contact_modulus, tangential_modulus

RADIUS = 18e-3
NORMAL_FORCE = 1e3
FRICTION = 0.1
FRICTION_LIMIT = FRICTION * NORMAL_FORCE

STEEL = IsotropicMaterial(young_modulus=420e9, poisson_ratio=0.3)
CONTACT_MODULUS = contact_modulus((420e9, 0.3), (420e9, 0.3))
NU_ZERO = IsotropicMaterial(young_modulus=2 * CONTACT_MODULUS, poisson_ratio=0.0)

HERTZ = PointContact.under_load(NORMAL_FORCE, RADIUS, CONTACT_MODULUS)
WINDOW_PER_RADIUS = 3.0


def square_grid(cells: int, half_width: float) -> SurfaceGrid:
    """Return a square grid on the window |x|, |y| <= `half_width`."""
    return SurfaceGrid((cells, cells), (2 * half_width, 2 * half_width))


def hertz_grid(cells: int) -> SurfaceGrid:
    """Return a square grid on a window of three Hertz radii."""
    return square_grid(cells, WINDOW_PER_RADIUS / 2 * HERTZ.contact_radius)


def paraboloid(material: IsotropicMaterial) -> Paraboloid:
    """Return the ball as a paraboloid, as in Hertz's theory."""
    return Paraboloid(radius=RADIUS, material=material)


def frictionless(title: str, indenter: Indenter, body: IsotropicMaterial, load: LoadStep) -> Scene:
    """Return the scene of an indenter on a half-space under one load step."""
    return Scene(title=title, indenter=indenter, body=Body(material=body), loading=(load,))


def frictional(
    title: str, indenter: Indenter, body: IsotropicMaterial, *loading: LoadStep
) -> Scene:
    """Return the scene of an indenter with the paper's friction and force, followed by `loading`.

    The bodies are uncoupled: the pressure does not depend on the load path, so that one increment
    is sufficient for the normal force.
    """
    return Scene(
        title=title,
        indenter=indenter,
        body=Body(material=body),
        friction=CoulombFriction(coefficient=FRICTION),
        loading=(pressing(1), *loading),
    )


def pressing(increments: int | None = None) -> LoadStep:
    """Return the load step of the paper's force."""
    return LoadStep(normal_force=NORMAL_FORCE, increments=increments)


def tangential_step(part_of_limit: float, increments: int) -> LoadStep:
    """Return the load step of a tangential force along x to a fraction of µW."""
    force = part_of_limit * FRICTION_LIMIT
    return LoadStep(tangential_force=(force, 0.0), increments=increments)


def partial_slip(material: IsotropicMaterial, tangential_force: float) -> PartialSlip:
    """Return the Cattaneo-Mindlin state of two identical bodies of a material."""
    constants = (material.young_modulus, material.poisson_ratio)
    modulus = tangential_modulus(constants, constants)
    limited = math.copysign(min(abs(tangential_force), FRICTION_LIMIT), tangential_force)
    return PartialSlip(NORMAL_FORCE, HERTZ.contact_radius, FRICTION, modulus, limited)
