"""Influence coefficients of the two bodies of a scene."""

from contact_scene import Body, IsotropicMaterial
from semi_analytical.errors import UnsupportedScene
from semi_analytical.influence.closed_form import HalfSpaceCoefficients, RectangleIntegrals
from semi_analytical.influence.coefficients import Composite, InfluenceCoefficients


def influence_coefficients(
    lower: Body, upper: Body, spacing: tuple[float, float], offsets: tuple[int, int]
) -> InfluenceCoefficients:
    """Relative displacement of the two bodies; a rigid one contributes nothing.

    spacing  cell sides [length]
    offsets  number of offsets along x and y, the zero offset included
    """
    integrals = RectangleIntegrals(*spacing, offsets)
    return Composite(_of_body(lower, integrals), _of_body(upper, integrals))


def _of_body(body: Body, integrals: RectangleIntegrals) -> tuple[InfluenceCoefficients, ...]:
    if not body.deforms:
        return ()
    if body.layers or not isinstance(body.material, IsotropicMaterial):
        raise UnsupportedScene("layered bodies are not supported yet; remove the layers")
    material = body.material
    return (HalfSpaceCoefficients(integrals, material.shear_modulus, material.poisson_ratio),)
