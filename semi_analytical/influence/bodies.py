"""Influence coefficients of the relative displacement of the two bodies of a scene."""

from contact_scene import Body, IsotropicMaterial
from contact_scene.disk_cache import cached_array
from contact_scene.rig import Rig, compliances
from semi_analytical.frf.stack import stack_of
from semi_analytical.influence.closed_form import HalfSpaceCoefficients
from semi_analytical.influence.coefficients import Composite, InfluenceCoefficients


def influence_coefficients(
    lower: Body,
    upper: Body,
    spacing: tuple[float, float],
    offsets: tuple[int, int],
    rig: Rig | None = None,
    reference_length: float | None = None,
) -> InfluenceCoefficients:
    """Return the influence coefficients of the relative displacement of two bodies.

    The coefficients are displacements of cell centres by a unit traction on one cell.

    lower, upper  the two bodies
    spacing       cell sides [length]
    offsets       number of offsets along x and y, including zero
    rig           springs of the test rig, which displace all cells equally: their compliance times
                  the cell area is added
    reference_length
                  distance from a line load at which the surface does not move, for the strips of a
                  line contact [length]; None for cells
    """
    down, along = (spacing[0] * spacing[1] * c for c in compliances(rig))

    def of_body(body: Body) -> tuple[InfluenceCoefficients, ...]:
        if reference_length is None or not body.deforms:
            return _body_coefficients(body, spacing, offsets)
        from semi_analytical.influence.line import StripCoefficients

        return (StripCoefficients(stack_of(body), spacing[0], offsets, reference_length),)

    return Composite(of_body(lower), of_body(upper), along, down)


def _body_coefficients(
    body: Body,
    spacing: tuple[float, float],
    offsets: tuple[int, int],
) -> tuple[InfluenceCoefficients, ...]:
    """Return the influence coefficients of one body as a tuple; an empty tuple for a rigid body.

    body     body with or without layers
    spacing  cell sides [length]
    offsets  number of offsets along x and y, including zero
    """
    if not body.deforms:
        return ()
    if body.layers or not isinstance(body.material, IsotropicMaterial):
        from semi_analytical.influence.layered import LayeredCoefficients

        return (LayeredCoefficients(stack_of(body), spacing, offsets, cached_array),)
    outer = stack_of(body).outer
    return (HalfSpaceCoefficients(spacing, offsets, *outer),)
