"""Uniform bulk strain of the lower body, as in a fretting-fatigue specimen under tension.

A strain ε displaces the surface at x by ε x, in addition to the displacement by the tractions.
Layers have the strain of the substrate; each layer is in plane stress with its modulus.
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
# Tensor components exx, eyy, exy.
Strain = tuple[float, float, float]
UNSTRAINED: Strain = (0.0, 0.0, 0.0)
# Deviation from an equibiaxial strain, relative to exx, that is due to round-off.
ROUND_OFF = 1e-12


def strain_under(stress: Sequence[float], material: Material, *, line: bool = False) -> Strain:
    """Compute the strain (εxx, εyy, εxy) of an elastic material under a plane stress.

    Used for a bulk stress that a load step prescribes.

    stress    (σxx, σyy, σxy) [force/length^2]
    material  isotropic elastic material
    line      True for plane strain under σxx alone, with εyy = 0
    """
    assert isinstance(material, IsotropicMaterial)
    if line:
        return stress[0] / material.plane_strain_modulus, 0.0, 0.0
    E, nu = material.young_modulus, material.poisson_ratio
    xx, yy, xy = stress
    return (xx - nu * yy) / E, (yy - nu * xx) / E, (1 + nu) * xy / E


def stress_by(strain: Sequence[float], body: Body, layer: int) -> Vector:
    """Compute the plane stress that the bulk strain causes in one layer of the lower body.

    The bulk strain is a uniform strain parallel to the surface, equal in all layers.

    strain   (εxx, εyy, εxy) of the lower body
    body     lower body with its layers
    layer    index of the layer from the surface; the number of layers for the substrate
    returns  σxx, σyy, σzz, σyz, σxz, σxy [force/length^2], shape (6,); 0 for a rigid material
    """
    material = (*(one.material for one in body.layers), body.material)[layer]
    if not isinstance(material, IsotropicMaterial):
        return np.zeros(6)
    nu, modulus = material.poisson_ratio, material.plane_strain_modulus
    xx, yy, xy = strain
    sides = (modulus * (xx + nu * yy), modulus * (yy + nu * xx))
    return np.array([*sides, 0.0, 0.0, 0.0, 2 * material.shear_modulus * xy])


def add_bulk_strain(increment: Reported, strain: Strain | None) -> Reported:
    """Add the bulk strain of the lower body at the end of an increment to its results.

    increment  results of the increment
    strain     (εxx, εyy, εxy) of the lower body; None without bulk strain, which leaves the results
               unchanged
    """
    if strain is None:
        return increment
    changes = {"bulk_strain": strain[:2], "bulk_shear": strain[2]}
    return cast(Reported, replace(cast(Any, increment), **changes))


def requires_bulk_strain(strains: Sequence[Strain], pushed: bool) -> bool:
    """Return True if an axisymmetric solver has to apply a bulk strain of the lower body.

    The bulk strain is uniform and parallel to the surface. Such a solver can apply an equibiaxial
    strain only, without a tangential load or torsion. Raises UnsupportedScene for other strains.

    strains  bulk strains (εxx, εyy, εxy) of the load steps
    pushed   True if the scene has a tangential load or a torsion
    """
    strained = any(any(strain) for strain in strains)
    if strained and pushed:
        raise UnsupportedScene(
            "load steps prescribe a bulk strain and a tangential load or a torsion; this solver "
            "supports a bulk strain alone. Use the semi-analytical solver"
        )
    for xx, yy, xy in strains:
        if max(abs(xx - yy), abs(xy)) > ROUND_OFF * abs(xx):
            raise UnsupportedScene(
                f"the bulk strain ({xx:.4g}, {yy:.4g}, {xy:.4g}) is not equibiaxial, which this "
                "solver requires. Use the semi-analytical solver"
            )
    return strained
