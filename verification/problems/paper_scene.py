"""Data of the standard ball of the verification, from the reference paper, and scenes with this
ball.

A ball of radius 18 mm is pressed on a half-space with 1 kN. The paper prints a contact radius of
0.388 mm and a peak pressure of 3.1684 GPa. These values belong to the compliance of one body with E
= 210 GPa, ν = 0.3. Two identical bodies with E = 420 GPa have the same total compliance and are
uncoupled, as the closed form assumes. Two bodies with ν = 0 and E = 2 E* have this compliance as
well; for these bodies the closed form of the tangential problem is exact.
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
    """Create a square grid of cells × cells on the window |x|, |y| <= `half_width` [length]."""
    return SurfaceGrid((cells, cells), (2 * half_width, 2 * half_width))


def hertz_grid(cells: int) -> SurfaceGrid:
    """Create a square grid of cells × cells on a window whose side is 3 Hertz contact radii."""
    return square_grid(cells, WINDOW_PER_RADIUS / 2 * HERTZ.contact_radius)


def paraboloid(material: IsotropicMaterial) -> Paraboloid:
    """Create the standard ball (radius 18 mm) as a paraboloid of the given material.

    Hertz theory assumes this shape.
    """
    return Paraboloid(radius=RADIUS, material=material)


def frictionless(title: str, indenter: Indenter, body: IsotropicMaterial, load: LoadStep) -> Scene:
    """Create the scene of an indenter on a half-space without friction under one load step."""
    return Scene(title=title, indenter=indenter, body=Body(material=body), loading=(load,))


def frictional(
    title: str, indenter: Indenter, body: IsotropicMaterial, *loading: LoadStep
) -> Scene:
    """Create the scene of an indenter that is pressed with 1 kN and friction 0.1, then loaded
    further.

    The bodies must be uncoupled. The pressure then does not depend on the load history, so that one
    increment is sufficient for the normal force.

    body     material of the half-space
    loading  load steps after the normal loading
    """
    return Scene(
        title=title,
        indenter=indenter,
        body=Body(material=body),
        friction=CoulombFriction(coefficient=FRICTION),
        loading=(pressing(1), *loading),
    )


def pressing(increments: int | None = None) -> LoadStep:
    """Create the load step to a normal force of 1 kN, with the given number of increments."""
    return LoadStep(normal_force=NORMAL_FORCE, increments=increments)


def tangential_step(part_of_limit: float, increments: int) -> LoadStep:
    """Create a load step to a tangential force along x.

    part_of_limit  force at the end of the step over the friction limit µW
    increments     number of increments
    """
    force = part_of_limit * FRICTION_LIMIT
    return LoadStep(tangential_force=(force, 0.0), increments=increments)


def partial_slip(material: IsotropicMaterial, tangential_force: float) -> PartialSlip:
    """Create the Cattaneo-Mindlin state of the standard ball under a tangential force [force].

    Both bodies are of the given material. Forces above the friction limit are reduced to the limit.
    """
    constants = (material.young_modulus, material.poisson_ratio)
    modulus = tangential_modulus(constants, constants)
    limited = math.copysign(min(abs(tangential_force), FRICTION_LIMIT), tangential_force)
    return PartialSlip(NORMAL_FORCE, HERTZ.contact_radius, FRICTION, modulus, limited)
