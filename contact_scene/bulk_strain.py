"""Uniform strain of the lower body along its surface, as of a fretting-fatigue specimen.

A strain E displaces the surface by E x about the origin, in addition to the displacement by the
tractions, and layers as much as their base: each is then in plane stress of its own modulus.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, TypeVar, cast

import numpy as np

from contact_scene.array_types import Vector
from contact_scene.body import Body
from contact_scene.material import IsotropicMaterial, Material
from contact_scene.solver_errors import UnsupportedScene

Reported = TypeVar("Reported")
# exx, eyy and exy of the tensor: half the change of the angle.
Strain = tuple[float, float, float]
UNSTRAINED: Strain = (0.0, 0.0, 0.0)
# Of a strain that is the same all around, relative to it.
ROUND_OFF = 1e-12


def strain_under(stress: Sequence[float], material: Material) -> Strain:
    """Strain under a stress [σxx, σyy, σxy] of a body that is free below and at its sides."""
    assert isinstance(material, IsotropicMaterial)
    E, nu = material.young_modulus, material.poisson_ratio
    xx, yy, xy = stress
    return (xx - nu * yy) / E, (yy - nu * xx) / E, (1 + nu) * xy / E


def stress_by(strain: Sequence[float], body: Body, layer: int) -> Vector:
    """Stress xx, yy, zz, yz, xz, xy of a layer, or of the base below all of them, by a strain
    (6,) [force/length^2]."""
    materials = (*(one.material for one in body.layers), body.material)
    material = materials[layer]
    if not isinstance(material, IsotropicMaterial):
        return np.zeros(6)
    nu, modulus = material.poisson_ratio, material.plane_strain_modulus
    xx, yy, xy = strain
    sides = (modulus * (xx + nu * yy), modulus * (yy + nu * xx))
    return np.array([*sides, 0.0, 0.0, 0.0, 2 * material.shear_modulus * xy])


def reported(increment: Reported, strain: Strain | None) -> Reported:
    """Return an increment with the strain at its end, where one is named."""
    if strain is None:
        return increment
    changes = {"bulk_strain": strain[:2], "bulk_shear": strain[2]}
    return cast(Reported, replace(cast(Any, increment), **changes))


def around_axis(strains: Sequence[Strain], pushed: bool) -> bool:
    """Whether an axisymmetric solver has strains to take into account; raises UnsupportedScene for
    those that are not the same all around.

    pushed  whether there is a tangential load or a torsion
    """
    strained = any(any(strain) for strain in strains)
    if strained and pushed:
        raise UnsupportedScene(
            "steps name a bulk strain and a tangential load or a torsion, and this solver takes a "
            "bulk strain alone; solve the scene with the semi-analytical solver"
        )
    for xx, yy, xy in strains:
        if max(abs(xx - yy), abs(xy)) > ROUND_OFF * abs(xx):
            raise UnsupportedScene(
                f"the bulk strain ({xx:.4g}, {yy:.4g}, {xy:.4g}) is not the same all around, and "
                "this solver takes equibiaxial strains; solve the scene with the semi-analytical "
                "solver"
            )
    return strained
