"""Fields below the surface of one body under given tractions.

The steps are mesh, nodal forces, one solve for each motion, and recovery of the stress.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import groupby
from math import ceil, pi

import numpy as np

from contact_scene import Body, FiniteElementDiscretisation, IsotropicMaterial
from contact_scene.array_types import Field
from contact_scene.solver_errors import UnsupportedScene
from fem_reference.elasticity.factored_section import FactoredSection
from fem_reference.elasticity.weak_form import dilatation
from fem_reference.mesh.element_order import ELEMENTS, lagrange_polynomials
from fem_reference.mesh.section_mesh import SectionMesh, section_mesh
from fem_reference.mesh.section_outline import CONTACT_ZONE, sufficient_box
from fem_reference.scales import Scales
from fem_reference.stress.recovery import recovery_of
from fem_reference.stress.section_field import SectionField
from fem_reference.stress.surface_tractions import SurfaceTractions, TractionAmplitude

POINTS_BETWEEN = 4
# Ratio of a traction amplitude to the largest one, below which the amplitude is round-off.
ROUND_OFF = 1e-12


def subsurface(
    body: Body,
    tractions: SurfaceTractions,
    discretisation: FiniteElementDiscretisation,
    *,
    upper: bool = False,
    divided: bool = True,
    widened: float = 1.0,
) -> SectionField:
    """Compute displacement and stress below the surface of one body under given tractions.

    Parameters
    ----------
    body
        Layers on a half-space or a rigid base.
    tractions
        Tractions on the lower body, also if the fields of the indenter are computed.
    discretisation
        Number of elements per radius of the loaded circle, and size of the section.
    upper
        True for the indenter. The shear is then reversed, and z points up into the indenter.
    divided
        False for the mesh whose elements are not divided into 4, to estimate the error.
    widened
        Factor of the outer radius and the depth of the section, to estimate the error.

    Raises
    ------
    ValueError
        The body is rigid.
    UnsupportedScene
        A material is nearly incompressible, so that its pressure does not follow from the strain.
    ResourceRefused
        The memory is insufficient.
    """
    if not body.deforms:
        raise ValueError("a rigid body has no stress")
    length = discretisation.contact_radius or tractions.loaded_radius
    materials = (*(layer.material for layer in body.layers), body.material)
    modulus = next(m.young_modulus for m in materials if isinstance(m, IsotropicMaterial))
    scales = Scales(length, modulus)
    edges = tractions.edges / length
    zone = max(CONTACT_ZONE, tractions.reach / length)
    dimensionless = scales.dimensionless(body)
    box = widened * (discretisation.box or sufficient_box(dimensionless, plane=tractions.plane))
    wide = discretisation.model_copy(update={"box": box})
    mesh = _undivided_mesh(dimensionless, wide, zone, plane=tractions.plane)
    section = (mesh.refined() if divided else mesh).refine_towards(edges)
    _refuse_incompressible(section)
    recovery = recovery_of(section)
    points = _create_load_points(section, tractions, length)
    found = _load_preserving_amplitudes(tractions, points, length)
    largest = max(float(np.max(np.abs(part.values))) for part in found)
    acting = [part for part in found if np.max(np.abs(part.values)) > ROUND_OFF * largest]
    parts = []
    for of, loads in groupby(acting, lambda part: part.motion):
        alike = list(loads)
        sign = np.where(np.array(of.components) == 2, 1.0, -1.0 if upper else 1.0)
        forces = [sign[:, None] * part.values / modulus @ points.weighted.T for part in alike]
        moved = FactoredSection(section, of).displacement(np.stack(forces, axis=-1))
        for k, part in enumerate(alike):
            parts.append(recovery.amplitude(of, moved[..., k], scales, turned=part.turned))
    nodes = _node_positions(body, section, recovery.points, length)
    return SectionField(nodes, recovery.material, recovery.cells, tuple(parts))


def _node_positions(body: Body, section: SectionMesh, nodes: Field, length: float) -> Field:
    """Convert node positions (2, n) from units of `length` to that of the scene.
    Depths of interfaces are exact sums of the layer thicknesses."""
    points = nodes * length
    bottoms = np.cumsum([layer.thickness for layer in body.layers])
    for depth, bottom in zip(section.outline.interfaces, bottoms, strict=False):
        points[1, nodes[1] == depth] = bottom
    return points


def _undivided_mesh(
    body: Body, discretisation: FiniteElementDiscretisation, zone: float, *, plane: bool
) -> SectionMesh:
    """Create a mesh of half the elements per radius. Divided into 4, its elements grow by half the
    factor with depth: those of the mesh for displacements cause a stress error of 2e-3."""
    coarse = max(2, ceil(discretisation.elements_per_radius / 2))
    return section_mesh(body, coarse, discretisation.box, zone, plane=plane)


def _refuse_incompressible(section: SectionMesh) -> None:
    """Raise UnsupportedScene if a material is nearly incompressible:
    its strain, from which the stress follows, does not determine the pressure."""
    if np.any(dilatation(section).mixed):
        raise UnsupportedScene(
            "a material is incompressible or nearly so, and the stress follows from the strain "
            "here; take a smaller poisson_ratio, or the semi-analytical solver for the stress"
        )


@dataclass(frozen=True, eq=False)
class _LoadPoints:
    """Integration points of the surface tractions, for their conversion to nodal forces.

    The points are between all corner nodes of the mesh and all rings on which the tractions are
    given.

    radii     radii of the integration points (k,), dimensionless
    weighted  ψ w r at the points for every node of the surface (m, k), with the trace function ψ
              and the weight w, so that ∫ ψ t r dr = weighted @ t for tractions t
              (∫ ψ t dr in plane strain)
    """

    radii: Field
    weighted: Field


def _load_preserving_amplitudes(
    tractions: SurfaceTractions, points: _LoadPoints, length: float
) -> list[TractionAmplitude]:
    """Compute amplitudes at the integration points with the normal force of the contact solve.

    The resultant of interpolated tractions differs from it: the tractions lack those between the
    last Gauss point and a rim, and err towards an edge where they are extrapolated by a root. The
    amplitudes near the edge are therefore multiplied. A factor on all tractions would change the
    stress far from the edge as well.

    length  unit of length of the mesh [length]
    """
    found = tractions.amplitudes(points.radii * length)
    if tractions.normal_force is None:
        return found
    forces = 2 * length * found[0].values[-1] * points.weighted.sum(axis=0)
    if not tractions.plane:
        forces *= pi * length
    last = points.radii * length > tractions.extrapolated_from
    lacking = tractions.normal_force - np.sum(forces)
    factor = np.where(last, 1 + lacking / np.sum(forces[last]), 1.0)
    return [replace(part, values=part.values * factor) for part in found]


def _create_load_points(
    section: SectionMesh, tractions: SurfaceTractions, length: float
) -> _LoadPoints:
    """Create the integration points of the surface tractions on the mesh of a body.

    The points serve to convert tractions to nodal forces. Between two adjacent corner nodes or
    rings there are POINTS_BETWEEN Gauss points.

    section    mesh of the meridional section, in units of `length`
    tractions  surface tractions on rings
    length     unit of length of the section [length]
    """
    nodes = section.radii
    corners = nodes[:: ELEMENTS.degree]
    rings = tractions.radii / length
    last = min(corners[-1], max(rings[-1], tractions.edges.max(initial=0.0) / length))
    ends = np.unique(np.concatenate([corners[corners < last], rings[rings < last], [last]]))
    x, w = np.polynomial.legendre.leggauss(POINTS_BETWEEN)
    width = np.diff(ends)[:, None]
    r = (ends[:-1, None] + 0.5 * width * (1 + x)).ravel()
    weight = (0.5 * width * w).ravel() * r**section.outline.power
    element = np.clip(np.searchsorted(corners, r) - 1, 0, len(corners) - 2)
    at = (r - corners[element]) / (corners[element + 1] - corners[element])
    trace = np.zeros((len(nodes), len(r)))
    node = ELEMENTS.degree * element[:, None] + np.arange(len(ELEMENTS.places))
    trace[node, np.arange(len(r))[:, None]] = lagrange_polynomials(ELEMENTS.places, at)
    return _LoadPoints(r, trace * weight)
