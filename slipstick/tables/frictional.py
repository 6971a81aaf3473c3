"""Rigid paraboloid pressed with friction on a coated half-space, for tables of reference numbers.

Numbers are in units of the Hertz contact with the same force on the bare substrate.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from math import pi

import numpy as np

from contact_scene import (
    RIGID,
    Body,
    CoulombFriction,
    IsotropicMaterial,
    Layer,
    LoadStep,
    Paraboloid,
    RadialDiscretisation,
    Scene,
)
from contact_scene.stepping.load_stepping import resumable_increments
from radial.frictional.frictional_increment import FrictionalState
from radial.frictional.frictional_indentation_steps import FrictionalSteps
from radial.normal.surface import pressure
from radial.plan import PATH_INCREMENTS
from slipstick.tables.table import RowValues

# Units of the Hertz contact on the substrate: a_H = p_H = δ_H = 1, E*_2 = π/2, W = 2π/3.
BALL = Paraboloid(radius=1.0, material=RIGID)
MODULUS = pi / 2
FORCE = 2 * pi / 3
CACHED = 16  # number of cached contacts
# Error of the stick radius of the radial solver, in contact radii.
FRONT = 1e-3
NEAR_FRONT = 0.05  # distance from the stick radius, in contact radii, with additional uncertainty
OF_RING = 2e-5  # smallest discretisation error of a traction, in p_H


def indentation_scene(place: Sequence[float]) -> Scene:
    """Build the scene of a table row: frictional indentation of a coated half-space.

    The indenter is a rigid paraboloid.

    place  E1/E2, h/a_H, ν and µ: modulus of the layer over that of the substrate, layer thickness
           over Hertz's contact radius on the substrate, Poisson's ratio of both, coefficient of
           friction
    """
    moduli, thickness, ratio, friction = place
    young = MODULUS * (1 - ratio**2)
    film, base = (
        IsotropicMaterial(young_modulus=modulus, poisson_ratio=ratio)
        for modulus in (moduli * young, young)
    )
    return Scene(
        indenter=BALL,
        body=Body(material=base, layers=(Layer(thickness=thickness, material=film),)),
        friction=CoulombFriction(coefficient=friction),
        loading=(LoadStep(normal_force=FORCE),),
    )


@lru_cache(maxsize=CACHED)
def frictional_indentation(
    place: tuple[float, ...], increments: int, fineness: int
) -> FrictionalState:
    """Solve the frictional indentation of a coated half-space by a rigid paraboloid.

    Returns the state at the full normal force.

    place       E1/E2, h/a_H, ν and µ: modulus of the layer over that of the substrate, layer
                thickness over Hertz's contact radius on the substrate, Poisson's ratio of both,
                coefficient of friction
    increments  number of increments of the normal force
    fineness    factor of the number of rings
    """
    contact = indentation_scene(place)
    solver = FrictionalSteps.of(contact, RadialDiscretisation(), fineness)
    *_, (_, point) = resumable_increments(contact, (increments,), solver, None)
    assert point.state is not None  # in contact
    return point.state


def indentation_row(place: Sequence[float], fineness: int) -> RowValues:
    """Compute contact radius, approach and stick radius of a frictional indentation.

    Contact radius and approach are relative to those of Hertz's contact with the same force on the
    bare substrate, and the stick radius is relative to the contact radius. The additional
    uncertainty of the stick radius is the resolution of the rings.

    place     E1/E2, h/a_H, ν and µ: modulus of the layer over that of the substrate, layer
              thickness over Hertz's contact radius on the substrate, Poisson's ratio of both,
              coefficient of friction
    fineness  factor of the numbers of rings and increments
    """
    found = frictional_indentation(tuple(place), PATH_INCREMENTS * fineness, fineness)
    end = found.end
    values = (end.radius, end.approach, found.front / end.radius)
    return RowValues(values, abs(end.load / FORCE - 1), (0.0, 0.0, FRONT))


def tractions_row(place: Sequence[float], fineness: int) -> RowValues:
    """Compute pressure p and q/µ at one radius of a frictional indentation.

    Here q is the radial shear and µ the coefficient of friction. Tractions are in units of Hertz's
    pressure on the bare substrate. Near the stick radius, the change of the tractions over a
    distance of `FRONT` contact radii is stated as additional uncertainty.

    place     E1/E2, h/a_H, ν, µ and x: modulus of the layer over that of the substrate, layer
              thickness over Hertz's contact radius on the substrate, Poisson's ratio of both,
              coefficient of friction, radius over the contact radius
    fineness  factor of the numbers of rings and increments
    """
    *contact, x = place
    found = frictional_indentation(tuple(contact), PATH_INCREMENTS * fineness, fineness)
    end, friction = found.end, contact[-1]

    def tractions_at(at: float) -> tuple[float, float]:
        """Compute the pressure p and the ratio q/µ of radial shear to friction coefficient.

        at  radius over the contact radius
        """
        places = np.array([at])
        p = pressure(end.contact, places) + end.rings.interpolate_traction(
            end.pressure_change, places
        )
        return float(p[0]), float(end.rings.interpolate_traction(end.shear, places)[0]) / friction

    here = tractions_at(x)
    left = [OF_RING, OF_RING]
    if abs(x - found.front / end.radius) < NEAR_FRONT:
        for off in (-FRONT, FRONT):
            moved = tractions_at(min(max(x + off, 0.0), 1.0))
            left = [max(old, abs(a - b)) for old, a, b in zip(left, moved, here, strict=True)]
    return RowValues(here, abs(end.load / FORCE - 1), tuple(left))
