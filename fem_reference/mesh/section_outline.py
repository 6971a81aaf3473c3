"""Outline of a section, common to all meshers: edges, interfaces and element sizes."""

from dataclasses import dataclass
from math import ceil

import numpy as np
from numpy.typing import NDArray

from contact_scene.body import Body
from contact_scene.material import IsotropicMaterial
from contact_scene.solver_errors import SolverError, UnsupportedScene
from fem_reference.mesh.element_order import ELEMENTS

GROWTH = 1.2
"""Ratio of the sizes of neighbouring elements outside the contact zone, if those of the zone have
the side GROWTH_SIZE."""
GROWTH_SIZE = 1.0 / 32
"""Side of the elements of the contact zone by default, in contact radii."""

CONTACT_ZONE = 1.1
"""Least outer radius of the zone of equal elements, in contact radii."""

LARGEST_GROWTH = 1.35
"""Largest ratio of the sizes of neighbouring elements, for fewer than 12 elements per radius."""

LAYER_ELEMENTS = ceil(4 / ELEMENTS.degree)
"""Least number of elements across a layer. They have at least five nodes, which suffice for bending
and shear of a film under a load that varies over many thicknesses. Thicker layers have more."""

SMALLEST_BOX = 2.0
THINNEST_LAYER = 1e-4
"""Least layer thickness, in element sizes of the contact zone. Flatter elements cause an
ill-conditioned matrix."""

DEEPEST_LAYERS = 1e6
"""Largest total thickness of layers, in contact radii. Material at greater depth contributes 1e-6
of the surface displacement, and elements down to this depth take much memory and time."""


@dataclass(frozen=True)
class SectionOutline:
    """Outline of the meridional section of a body: outer edges, interfaces and element sizes.

    The section covers 0 <= r <= box and 0 <= z <= depth. All lengths are in units of the contact
    radius.

    size        side of the square elements in the contact zone
    zone        outer radius of the contact zone, an even number of elements
    box         outer radius of the section
    interfaces  increasing depths of the interfaces between layers; the last value is the base
    materials   material above each of these depths; moduli in one common unit
    rigid_base  True if the base is the surface of a rigid substrate, False if the base is a cut
                through an elastic substrate
    plane       True for one half of a body in plane strain, which is long across the section and
                symmetric about r = 0; False for a body of revolution
    """

    size: float
    zone: float
    box: float
    interfaces: tuple[float, ...]
    materials: tuple[IsotropicMaterial, ...]
    rigid_base: bool
    plane: bool = False

    @property
    def power(self) -> int:
        """Power of r in the weight of integrals over the section: 0 in plane strain, else 1."""
        return 0 if self.plane else 1

    @property
    def depth(self) -> float:
        """Depth of the base of the meridional section, in units of the contact radius."""
        return self.interfaces[-1]

    @property
    def pieces(self) -> tuple[tuple[float, float], ...]:
        """Upper and lower depth of every layer of the section, in units of the contact radius.

        An elastic substrate counts as the last layer.
        """
        return tuple(zip((0.0, *self.interfaces[:-1]), self.interfaces, strict=True))


def section_outline(
    body: Body, elements_per_radius: int, box: float | None, zone: float, *, plane: bool = False
) -> SectionOutline:
    """Create the outline of the meridional section of a body: outer edges and element sizes.

    The outline is common to both meshers, tensor-product rectangles and gmsh.

    body    layers and substrate; the unit of length is the contact radius
    elements_per_radius
            number N of elements per contact radius; elements of the contact zone have the side 1/N
    box     outer radius and depth of the section; None for `sufficient_box`
    zone    least outer radius of the contact zone
    plane   True for a body in plane strain
    raises  ValueError for fewer than 2 elements per radius, UnsupportedScene for layers that are
            too thin or too thick, SolverError for a box that is too small
    """
    if elements_per_radius < 2:
        raise ValueError(f"{elements_per_radius} elements per contact radius: give at least 2")
    across = 2 * int(np.ceil(zone * elements_per_radius / 2 - 1e-9))
    size = 1.0 / elements_per_radius
    zone = across * size
    thickness = sum(layer.thickness for layer in body.layers)
    if thickness > DEEPEST_LAYERS:
        raise UnsupportedScene(
            f"the layers are {thickness:g} contact radii thick, more than {DEEPEST_LAYERS:g}, so "
            "that the substrate has no effect. Remove it and use the last layer as the body"
        )
    outer = sufficient_box(body, plane=plane) if box is None else float(box)
    depths = [float(depth) for depth in np.cumsum([x.thickness for x in body.layers])]
    materials = [layer.material for layer in body.layers]
    if isinstance(body.material, IsotropicMaterial):
        materials.append(body.material)
        depths.append(outer)
    if not (SMALLEST_BOX * zone <= outer < np.inf and depths == sorted(depths)):
        raise SolverError(
            f"a section of {outer:g} contact radii is too small for a contact zone of {zone:g} and "
            f"layers of {thickness:g}. Use a larger box"
        )
    thinnest = min([x.thickness for x in body.layers], default=np.inf)
    if thinnest < THINNEST_LAYER * size:
        raise UnsupportedScene(
            f"a layer is {thinnest:g} contact radii thick, less than {THINNEST_LAYER:g} of the "
            f"size of its elements ({size:g}). Remove it, or use more elements per radius"
        )
    rigid = not isinstance(body.material, IsotropicMaterial)
    return SectionOutline(size, zone, outer, tuple(depths), tuple(materials), rigid, plane)


def sufficient_box(body: Body, *, plane: bool = False) -> float:
    """Estimate the outer radius L that the mesh of a body requires, in units of the contact radius.

    The displacement of a half-space of the substrate material is prescribed at this radius, with an
    error due to the layers. Let x be the sum over the layers of thickness times the relative
    difference of their stiffness from the substrate. The relative error of the tangential shift is
    about x / L^2, and that of the approach is smaller. Layers that spread the load (x > 1) cause an
    error of 0.06 x^2 / L^2. The limit of the error is 1e-5.

    In plane strain the displacement by the layers decays as 1 / L, and so does the relative error:
    it is about 0.3 x / L for the tangential shift. Without layers, the pressure has an error of
    0.17 / L^2.

    body   layers and substrate; the unit of length is the contact radius
    plane  True for a body in plane strain
    """
    thickness = sum(layer.thickness for layer in body.layers)
    x = 0.0
    if isinstance(body.material, IsotropicMaterial):
        x = sum(
            layer.thickness * _stiffness_difference(layer.material, body.material)
            for layer in body.layers
        )
    if plane:
        return float(max(300.0, 3e4 * x, 10.0 * thickness))
    return float(max(100.0, 300.0 * np.sqrt(x), 100.0 * x, 10.0 * thickness))


def _stiffness_difference(layer: IsotropicMaterial, substrate: IsotropicMaterial) -> float:
    """Return the larger relative difference of the shear modulus and the plane-strain modulus."""
    return max(
        abs(layer.shear_modulus / substrate.shear_modulus - 1.0),
        abs(layer.plane_strain_modulus / substrate.plane_strain_modulus - 1.0),
    )


def graded_lines(start: float, end: float, origin: float, size: float) -> NDArray[np.float64]:
    """Compute the coordinates of graded mesh lines between two ends, both included.

    The sizes of neighbouring elements grow by about one factor with the distance from `origin`. Its
    logarithm is proportional to the k-th root of `size`, for elements of the degree k, so that a
    refinement of the contact zone refines all elements: elements whose size is a fraction s of
    their distance cause an error ~ s^2k of the compliance, which falls like the error ~ size^2 of
    the contact. There are at least LAYER_ELEMENTS elements.

    start, end  coordinates of the first and the last line
    origin      coordinate at which elements have the size `size`; it may be outside of the interval
    size        element size at `origin`
    """
    slope = min(
        np.log(LARGEST_GROWTH), np.log(GROWTH) * (size / GROWTH_SIZE) ** (1.0 / ELEMENTS.degree)
    )
    reach = size * slope / np.expm1(slope)
    lower, upper = np.log(reach + slope * (np.array([start, end]) - origin)) / slope
    count = max(LAYER_ELEMENTS, int(np.ceil(upper - lower - 1e-9)))
    lines = origin + (np.exp(slope * np.linspace(lower, upper, count + 1)) - reach) / slope
    lines[0], lines[-1] = start, end
    return lines
