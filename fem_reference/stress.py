"""Displacement and stress of a section under tractions on its surface, recovered at the nodes.

Strains of biquadratic elements are most accurate at their 2 x 2 Gauss points (Barlow 1976). There
the stress is taken, extrapolated bilinearly to the nodes of the element, and averaged over the
elements of one material that meet at a node (Hinton and Campbell 1974). A node on an interface
keeps one value per material, so that the jump of the stress in the plane of the layers is not
smeared.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import ceil

import numpy as np
from numpy.typing import NDArray
from skfem import Basis, ElementQuad2, MeshQuad

from contact_scene import Body, FiniteElementDiscretisation, IsotropicMaterial
from contact_scene.solver_errors import UnsupportedScene
from fem_reference.elasticity import (
    SectionBasis,
    dilatation,
    section_basis,
    shear_moduli,
    strain_operator,
    volume_strain,
)
from fem_reference.factored_section import FactoredSection
from fem_reference.fields import Increment
from fem_reference.harmonics.angular_grid import end_grid, mid_grid
from fem_reference.motion import PRESSING, SHEARING, TORSION, Motion, motion
from fem_reference.scales import Scales
from fem_reference.section_mesh import SectionMesh, section_mesh
from fem_reference.section_outline import CONTACT_ZONE

Field = NDArray[np.float64]
Indices = NDArray[np.int64]

# CONVENTIONS at theta = 0: rr, tt, zz, tz, rz, rt; from the order of `strain_operator`.
ORDER = (0, 1, 2, 5, 3, 4)
AS_SINE = (3, 5)
"""Components of the stress that go as sin n theta: tz and rt."""

GAUSS = 0.5 + np.array([-0.5, 0.5]) / np.sqrt(3.0)
POINTS_BETWEEN = 4
# Amplitudes below this part of the largest are round-off.
ROUND_OFF = 1e-12
SAME_DEPTH = 1e-9


@dataclass(frozen=True, eq=False)
class SurfaceTractions:
    """What loads the lower body, linear between rings; names and signs as in `Increment`.

    radii   (rings,) [length]
    angles  None, or (angles,) where fields are (rings, angles)
    """

    radii: Field
    pressure: Field
    angles: Field | None = None
    shear_radial: Field | None = None
    shear_circumferential: Field | None = None
    shear_along_load: Field | None = None

    @classmethod
    def of(cls, increment: Increment) -> SurfaceTractions:
        """Those of an increment."""
        return cls(
            increment.radii,
            increment.pressure,
            increment.angles,
            increment.shear_radial,
            increment.shear_circumferential,
            increment.shear_along_load,
        )

    @property
    def loaded_radius(self) -> float:
        """Of the last ring with pressure [length]."""
        loaded = self.pressure.reshape(len(self.radii), -1).max(axis=1) > 0
        return float(self.radii[np.flatnonzero(loaded)[-1]])

    @property
    def reach(self) -> float:
        """Where the pressure has come to zero, or its last ring [length]."""
        beyond = self.radii[self.radii > self.loaded_radius]
        return float(beyond[0]) if beyond.size else self.loaded_radius

    def amplitudes(self) -> list[tuple[Motion, Field]]:
        """Motions with the amplitudes (c, rings) of q_r, q_theta, p that load them."""
        nothing = np.zeros_like(self.radii)
        if self.angles is not None:
            return self._on_harmonics(self.angles)
        outward = nothing if self.shear_radial is None else self.shear_radial
        found = [(PRESSING, np.stack([outward, self.pressure]))]
        if self.shear_circumferential is not None:
            found.append((TORSION, self.shear_circumferential[None]))
        if self.shear_along_load is not None:
            along = self.shear_along_load
            found.append((SHEARING, np.stack([along, -along, nothing])))
        return found

    def _on_harmonics(self, angles: Field) -> list[tuple[Motion, Field]]:
        grid = end_grid(len(angles) - 1) if angles[0] == 0 else mid_grid(len(angles))
        parts = (self.shear_radial, self.shear_circumferential, self.pressure)
        values = [np.zeros_like(self.pressure) if part is None else part for part in parts]
        amplitudes = grid.amplitudes(np.stack(values))
        motions = [motion(n) for n in range(grid.highest + 1)]
        return [(m, amplitudes[list(m.components), :, m.harmonic]) for m in motions]


@dataclass(frozen=True, eq=False)
class Amplitude:
    """Fields of one motion: cos n theta, but u_theta and the stresses tz, rt sin n theta; those of
    torsion do not depend on theta.

    displacement  u_r, u_theta, u_z (3, n) [length]
    stress        rr, tt, zz, tz, rz, rt (6, n), tension positive [force/length^2]
    """

    motion: Motion
    displacement: Field
    stress: Field


@dataclass(frozen=True, eq=False)
class SectionField:
    """Fields of one body over its section, z into it; at an interface a point for each material.

    points      r and z (2, n) [length]
    material    (n,) 0 for the outermost layer
    cells       (e, 9) points of an element: corners, midsides, middle
    parts       what adds up to the fields
    """

    points: Field
    material: Indices
    cells: Indices
    parts: tuple[Amplitude, ...]

    @property
    def is_axisymmetric(self) -> bool:
        """Whether the angle does not matter."""
        return all(part.motion.harmonic == 0 for part in self.parts)

    def displacement(self, theta: float = 0.0) -> Field:
        """u_r, u_theta, u_z (3, n) on the half plane at an angle from the load [length]."""
        return self._sum([part.displacement for part in self.parts], (1,), theta)

    def stress(self, theta: float = 0.0) -> Field:
        """rr, tt, zz, tz, rz, rt (6, n), tension positive [force/length^2]."""
        return self._sum([part.stress for part in self.parts], AS_SINE, theta)

    @cached_property
    def axis(self) -> Indices:
        """Points on the axis, downwards; those of an interface with the upper material first."""
        return self._sorted(self.points[0] == 0.0, self.points[1])

    def side(self, depth: float, material: int) -> Indices:
        """Points at the depth of an interface that belong to a material, outwards."""
        on_it = np.isclose(self.points[1], depth, rtol=SAME_DEPTH, atol=0.0)
        return self._sorted(on_it & (self.material == material), self.points[0])

    def _sorted(self, chosen: NDArray[np.bool_], along: Field) -> Indices:
        found = np.flatnonzero(chosen)
        return found[np.lexsort((self.material[found], along[found]))]

    def _sum(self, fields: list[Field], as_sine: tuple[int, ...], theta: float) -> Field:
        total = np.zeros_like(fields[0])
        for part, field in zip(self.parts, fields, strict=True):
            n = part.motion.harmonic
            factor = np.full(len(field), np.cos(n * theta))
            if n > 0:
                factor[list(as_sine)] = np.sin(n * theta)
            total += factor[:, None] * field
        return total


def subsurface(
    body: Body,
    tractions: SurfaceTractions,
    discretisation: FiniteElementDiscretisation,
    *,
    upper: bool = False,
) -> SectionField:
    """Displacement and stress of one body.

    Parameters
    ----------
    body
        Layers on a half-space or a rigid base.
    tractions
        On the lower body.
    discretisation
        Elements per radius of the loaded circle, and the size of the section.
    upper
        Whether the body is the indenter: it carries the shear reversed, and z points up into it.

    Raises
    ------
    UnsupportedScene
        A material is so nearly incompressible that its pressure is not a matter of strain.
    ResourceRefused
        The memory does not suffice.
    """
    if not body.deforms:
        raise ValueError("a rigid body has no stress")
    length = discretisation.contact_radius or tractions.loaded_radius
    materials = (*(layer.material for layer in body.layers), body.material)
    modulus = next(m.young_modulus for m in materials if isinstance(m, IsotropicMaterial))
    scales = Scales(length, modulus)
    zone = max(CONTACT_ZONE, tractions.reach / length)
    section = _section(scales.dimensionless(body), discretisation, zone)
    _refuse_incompressible(section)
    basis = section_basis(section)
    recovery = _recovery(section, basis)
    found = tractions.amplitudes()
    largest = max(float(np.max(np.abs(t))) for _, t in found)
    parts = []
    for of, amplitude in found:
        if np.max(np.abs(amplitude)) > ROUND_OFF * largest:
            sign = np.where(np.array(of.components) == 2, 1.0, -1.0 if upper else 1.0)
            forces = _forces(section, tractions.radii / length, sign[:, None] * amplitude / modulus)
            u = FactoredSection(section, of).displacement(forces[..., None])[..., 0]
            parts.append(_amplitude(section, basis, recovery, of, u, scales))
    points = _points(body, section, basis.nodes[:, recovery.node], length)
    return SectionField(points, recovery.material, recovery.cells, tuple(parts))


def _points(body: Body, section: SectionMesh, nodes: Field, length: float) -> Field:
    """(2, n) positions [length], interfaces at the very depths that the body gives them."""
    points = nodes * length
    bottoms = np.cumsum([layer.thickness for layer in body.layers])
    for depth, bottom in zip(section.outline.interfaces, bottoms, strict=False):
        points[1, nodes[1] == depth] = bottom
    return points


def _section(body: Body, discretisation: FiniteElementDiscretisation, zone: float) -> SectionMesh:
    """The mesh of half as many elements per radius with every element cut into four: elements that
    grow with depth as fast as those for displacements alone leave 2e-3 of the stress, however fine
    they are at the surface."""
    coarse = max(2, ceil(discretisation.elements_per_radius / 2))
    return section_mesh(body, coarse, discretisation.box, zone).refined()


def _refuse_incompressible(section: SectionMesh) -> None:
    if np.any(dilatation(section).mixed):
        raise UnsupportedScene(
            "a material is incompressible or nearly so, and the stress follows from the strain "
            "here; take a smaller poisson_ratio, or the semi-analytical solver for the stress"
        )


def _forces(section: SectionMesh, radii: Field, tractions: Field) -> Field:
    """(c, m) generalised forces ∫ ψ t r dr of tractions (c, rings) linear between rings.

    Integrated between all corners and rings, so exactly.
    """
    nodes = section.radii
    corners = nodes[::2]
    ends = np.unique(np.concatenate([corners[corners < radii[-1]], radii]))
    x, w = np.polynomial.legendre.leggauss(POINTS_BETWEEN)
    width = np.diff(ends)[:, None]
    r = (ends[:-1, None] + 0.5 * width * (1 + x)).ravel()
    weight = (0.5 * width * w).ravel() * r
    kept = r <= corners[-1]
    r, weight = r[kept], weight[kept]
    element = np.clip(np.searchsorted(corners, r) - 1, 0, len(corners) - 2)
    at = (r - corners[element]) / (corners[element + 1] - corners[element])
    trace = np.zeros((len(nodes), len(r)))
    point = np.arange(len(r))
    for k, shape in enumerate(((1 - at) * (1 - 2 * at), 4 * at * (1 - at), at * (2 * at - 1))):
        trace[2 * element + k, point] = shape
    return np.stack([trace @ (weight * np.interp(r, radii, t)) for t in tractions])


@dataclass(frozen=True, eq=False)
class _Recovery:
    """From the 2 x 2 points of the elements to points at the nodes, one for each material there.

    basis          shape functions at the 2 x 2 points, as in `SectionBasis.shapes` (e, 3, 9, 4)
    linear         orthonormal linear functions there (e, 3, 4)
    extrapolation  (9, 4) from these points to the nodes of an element
    cells          (e, 9) points
    node           (n,) node of every point
    material       (n,)
    share          (n,) how many elements meet at a point
    """

    shapes: Field
    linear: Field
    extrapolation: Field
    cells: Indices
    node: Indices
    material: Indices
    share: Field


def _recovery(section: SectionMesh, basis: SectionBasis) -> _Recovery:
    xi, eta = (part.ravel() for part in np.meshgrid(GAUSS, GAUSS, indexing="ij"))
    element = ElementQuad2()
    at = Basis(
        MeshQuad(section.points, section.quads),
        element,
        quadrature=(np.stack([xi, eta]), np.full(4, 0.25)),
    )
    r, z = np.asarray(at.global_coordinates())
    fields = [field[0] for field in at.basis]
    shapes = np.stack(
        [np.stack([np.broadcast_to(f, r.shape) / r, f.grad[0], f.grad[1]]) for f in fields]
    )
    middle = section.points[:, section.quads].mean(axis=1)[..., None]
    size = np.ptp(section.points[:, section.quads], axis=1)[..., None]
    linear = np.stack([np.ones_like(r), (r - middle[0]) / size[0], (z - middle[1]) / size[1]])
    weighted = basis.linear * basis.weights[:, None, :]
    gram = np.linalg.cholesky(weighted @ basis.linear.transpose(0, 2, 1))
    count = len(section.outline.materials)
    key = basis.elements * count + section.layer[:, None]
    unique, cells, share = np.unique(key, return_inverse=True, return_counts=True)
    return _Recovery(
        shapes.transpose(2, 1, 0, 3),
        np.linalg.solve(gram, linear.transpose(1, 0, 2)),
        _extrapolation(np.asarray(element.doflocs, dtype=float)),
        cells.reshape(key.shape),
        unique // count,
        unique % count,
        share.astype(float),
    )


def _extrapolation(nodes: Field) -> Field:
    """(9, 4) bilinear functions of the 2 x 2 points, first coordinate slowest, at the nodes."""
    low, high = GAUSS
    along = [np.stack([(high - c) / (high - low), (c - low) / (high - low)], -1) for c in nodes.T]
    return np.einsum("na,nb->nab", *along).reshape(len(nodes), 4)


def _amplitude(
    section: SectionMesh,
    basis: SectionBasis,
    recovery: _Recovery,
    of: Motion,
    u: Field,
    scales: Scales,
) -> Amplitude:
    """Fields of one motion from the displacement of the nodes (c, nodes)."""
    local = u[:, basis.elements]
    gradients = np.einsum("ednq,cen->cdeq", recovery.shapes, local)
    strain = np.einsum(
        "scd,cdeq->seq", strain_operator(of.harmonic)[:, of.components, :], gradients
    )
    stress = np.array([2.0, 2.0, 2.0, 1.0, 1.0, 1.0])[:, None, None] * strain
    stress *= shear_moduli(section)[:, None]
    # The volume strain resists as its projection onto linear functions does.
    expansion = volume_strain(basis, of.harmonic, of.components)
    flat = local.transpose(1, 0, 2).reshape(len(basis.elements), -1, 1)
    volume = np.einsum("ep,epq->eq", (expansion @ flat)[..., 0], recovery.linear)
    stress[:3] += dilatation(section).resistance[:, None] * volume
    at_nodes = stress @ recovery.extrapolation.T
    total = np.zeros((6, len(recovery.node)))
    for component, values in zip(total, at_nodes[list(ORDER)], strict=True):
        np.add.at(component, recovery.cells.ravel(), values.ravel())
    displacement = np.zeros((3, len(recovery.node)))
    displacement[list(of.components)] = u[:, recovery.node] * scales.length
    return Amplitude(of, displacement, total / recovery.share * scales.modulus)
