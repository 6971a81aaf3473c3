"""Compliance of rings: displacement of rings per traction on rings, for each angular harmonic."""

from dataclasses import dataclass

import numpy as np

from contact_scene.array_types import Field, Matrix, Vector
from contact_scene.body_pair import coupling, outermost_beta
from fem_reference.compliance.angular_grid import THETA, R, Z
from fem_reference.compliance.gauss_points import (
    DEGREE,
    POINTS_PER_EDGE,
    GaussPoints,
    gauss_points,
)
from fem_reference.compliance.ring_edge import (
    Edge,
    GaussEdge,
    HatEdge,
    beyond_pressure,
    contact_edge,
)
from fem_reference.elasticity.hat_functions import TractionBasis
from fem_reference.elasticity.motion import TORSION
from fem_reference.elasticity.motion import motion as motion_of
from fem_reference.loads import ALONG, TWIST
from fem_reference.model import ContactModel
from fem_reference.plan import TWISTED, UNCOUPLED, Path


@dataclass(frozen=True)
class RingCompliance:
    """Displacement amplitudes of surface rings per traction amplitude, for all angular harmonics.

    A ring goes through a corner node or a Gauss point. In plane strain it is a pair of lines at
    equal distances from the middle. Tractions are sums of functions φ(r), one for each ring.
    Displacements and gaps are integrated with the same functions φ.

    radii      ascending radii of the rings (rings,) [length]
    areas      ∫ φ r dr (rings,) [length^2]
    gap        undeformed gap, the mean weighted with φ (rings,) [length]
    harmonics  for n = 0, 1, …: ∫ φ_i u r dr of the components r, θ, z of the displacement, lower
               body minus indenter, per traction with the profile φ_k (3, rings, 3, rings)
               [length^5/force], symmetric. On Path.SHEARING component r is the direction of the
               load
    path       tractions of the solve
    motions    displacement of the rings per unit shift along the load, shift across the load, and
               twist of the indenter (3, 2, rings), for tractions that do not depend on θ; zero for
               a motion that symmetry or the path excludes
    stretch    radius of the rings, the mean weighted with φ (rings,) [length]
    reach      outer end of the last element [length]
    edge       rule that determines the radius of the contact edge between rings
    beta       Dundurs' constant of the outermost materials [1]
    plane      True in plane strain: integrals over dr in place of r dr
    """

    radii: Vector
    areas: Vector
    gap: Vector
    harmonics: tuple[Matrix, ...]
    path: Path
    motions: Field
    stretch: Vector
    reach: float
    edge: Edge
    beta: float
    plane: bool

    def contact_edge(self, pressure: Vector, shear: Vector | None = None) -> float:
        """Compute the radius of the contact edge from the pressure at the rings [length].

        The pressure decreases to zero at the contact edge, which may lie between two rings.

        pressure  pressure at the rings (rings,) [force/length^2]
        shear     outward shear at the rings (rings,) [force/length^2]; None without shear
        """
        coupled = None if shear is None else self.beta * shear
        return contact_edge(self.radii, pressure, self.edge, self.reach, coupled)


def ring_compliance(
    model: ContactModel, path: Path, highest: int = 0, at_gauss_points: bool = False
) -> RingCompliance:
    """Compute the compliance of the surface rings from the compliance of the surface nodes.

    Nodal compliances that the model has not computed yet are computed here.

    model            the two bodies with their meshes, nodal compliances and undeformed gap
    path             tractions that the solve computes, such as pressure alone
    highest          highest angular harmonic; zero unless pressure and shear are coupled
    at_gauss_points  True for rings through the Gauss points of the element edges, False for rings
                     through the corner nodes
    """
    nodes = model.radii
    basis: TractionBasis = (
        gauss_points(nodes, model.rim, model.power) if at_gauss_points else model.hats
    )
    rings = len(basis.radii)
    motions, stretch = np.zeros((3, 2, rings)), basis.arms / basis.weights
    harmonics = [np.zeros((3, rings, 3, rings)) for _ in range(highest + 1)]
    if path in UNCOUPLED:
        # Without coupling only the normal compliance is required, and that of the one component of
        # shear, if there is one.
        (A,) = harmonics
        A[Z, :, Z] = basis.compliance(model.compliance(model.pressing).matrix[1, :, 1])
    else:
        uncoupled = path is Path.WHOLE_CIRCLE and not coupling(model.scene)[0]
        for n, A in enumerate(harmonics):
            condensed = model.compliance(motion_of(n))
            for i, a in enumerate(condensed.motion.components):
                for j, b in enumerate(condensed.motion.components):
                    if not (uncoupled and (a == Z) != (b == Z)):
                        A[a, :, b] = basis.compliance(condensed.matrix[i, :, j])
    if path in TWISTED:
        torsion = model.compliance(TORSION).matrix[0, :, 0]
        harmonics[0][THETA, :, THETA] = basis.compliance(torsion)
        motions[TWIST, THETA] = stretch
    elif path is Path.SHEARING:
        harmonics[0][R, :, R] = basis.compliance(model.along_load())
        motions[ALONG, R] = 1.0
    edge: Edge
    if isinstance(basis, GaussPoints):
        edge, reach = (
            GaussEdge(float(nodes[DEGREE] - nodes[0]), power=model.power),
            float(nodes[DEGREE * (rings // POINTS_PER_EDGE)]),
        )
    else:
        edge = HatEdge(beyond_pressure(model.scene.body, model.scene.indenter))
        reach = float(basis.radii[-1])
    gap = basis.integrate(model.gap) / basis.weights
    return RingCompliance(
        basis.radii,
        basis.weights,
        gap,
        tuple(harmonics),
        path,
        motions,
        stretch,
        reach,
        edge,
        outermost_beta(model.scene),
        model.plane,
    )
