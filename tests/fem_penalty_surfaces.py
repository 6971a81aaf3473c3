"""Elastic surfaces with penalty laws in units of the contact, for tests below the scene level."""

from functools import cache

import numpy as np
from fem_scenes import elements

from contact_scene import (
    RIGID,
    Body,
    CoulombFriction,
    IsotropicMaterial,
    Layer,
    LoadStep,
    Paraboloid,
    Scene,
)
from fem_reference.contact.penalty.gauss_points import gauss_points
from fem_reference.contact.penalty.newton import Iterate
from fem_reference.contact.penalty.spring_contact import PenaltyLaw
from fem_reference.contact.penalty.surface import ElasticSurface, Target
from fem_reference.model import ContactModel

NU = 0.3
# A ball of radius 1 on a half-space of modulus 1 under this force: Hertz radius 1, approach 1.
MODULUS = 1 / (1 - NU**2)
LOAD = 4 / 3 * MODULUS


@cache
def elastic_surface(components: str = "zr", ratio: float = 1.0, per_radius: int = 8):
    """Rigid ball on a coated half-space; components of z (pressure), r and t (around the axis)."""
    soft = IsotropicMaterial(young_modulus=1.0, poisson_ratio=NU)
    film = IsotropicMaterial(young_modulus=ratio, poisson_ratio=NU)
    scene = Scene(
        indenter=Paraboloid(radius=1.0, material=RIGID),
        body=Body(material=soft, layers=(Layer(thickness=1.0, material=film),)),
        loading=(LoadStep(normal_force=LOAD),),
    )
    radius = 1.25 if ratio < 1 else 1.0
    model = ContactModel.of(scene, elements(per_radius), radius)
    points = gauss_points(model.radii)
    pressing = model.compliance(0).matrix
    n, c = len(points.radii), len(components)
    compliance, motion, gap = np.zeros((c, n, c, n)), np.ones((c, n)), np.zeros((c, n))
    for i, row in enumerate(components):
        for j, column in enumerate(components):
            if "t" not in (row, column):
                block = pressing["rz".index(row), :, "rz".index(column)]
            elif row == column:
                block = model.torsion().matrix[0, :, 0]
            else:
                continue
            compliance[i, :, j] = points.trace @ block @ points.trace.T
        motion[i] *= {"z": 1.0, "r": 0.0, "t": points.radii}[row]
    gap[0] = points.radii**2 / 2
    return ElasticSurface(points.weights, compliance, motion, gap)


def law_on(surface, factor: float, mu: float, ratio: float = 1.0, per_radius: int = 8):
    """The law before any history."""
    element = (1.25 if ratio < 1 else 1.0) / per_radius
    nothing = np.zeros_like(surface.gap)
    return PenaltyLaw(
        factor * ratio * MODULUS / element, CoulombFriction(coefficient=mu), nothing, nothing[1:]
    )


def pressed(surface, part: float = 1.0, torque: float | None = None) -> Target:
    """A part of the load; a torque, or else no twist."""
    free = np.zeros(len(surface.gap), dtype=bool)
    value = np.zeros(len(surface.gap))
    free[0], value[0] = True, part * LOAD / (2 * np.pi)
    if torque is not None:
        free[-1], value[-1] = True, torque / (2 * np.pi)
    return Target(free, value)


def untouched(surface) -> Iterate:
    return Iterate(np.zeros_like(surface.gap), np.zeros(len(surface.gap)))
