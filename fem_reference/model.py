"""Model of a contact scene on one mesh: compliances of the bodies, undeformed gap and friction.

The contact methods in `fem_reference.contact` read all properties of the two bodies from this
model.
"""

from dataclasses import replace
from functools import cached_property

import numpy as np

from contact_scene import (
    Body,
    FiniteElementDiscretisation,
    IsotropicMaterial,
    Scene,
)
from contact_scene.array_types import Field
from contact_scene.friction import FRICTIONLESS, CoulombFriction
from contact_scene.geometry import LineShape
from contact_scene.rig import compliances
from fem_reference.elasticity.compliance import NodalCompliance, composite
from fem_reference.elasticity.hat_functions import Hats, hats_on
from fem_reference.elasticity.motion import (
    LINE_PRESSING,
    LINE_SHEARING,
    PRESSING,
    SHEARING,
    Motion,
    line_reference,
)
from fem_reference.mesh.section_mesh import SectionMesh, section_mesh
from fem_reference.scales import Scales


class ContactModel:
    """Two bodies in contact with their meshes, and the compliances of their surfaces.

    The contact methods read the elasticity, the undeformed gap and the friction from this class. A
    compliance is computed at its first use and stored. Lengths and forces have the units of the
    scene. Only the meshes are in the units of `scales`.

    sections        meshes of the lower body and of the indenter; None for a rigid body
    factorizations  number of sparse factorisations
    settled         names of the motions whose factorisations are already counted, in this run or
                    before the checkpoint from which the run resumes
    """

    def __init__(
        self,
        scene: Scene,
        scales: Scales,
        sections: tuple[SectionMesh | None, SectionMesh | None],
    ) -> None:
        self.scene = scene
        self.scales = scales
        self.sections = sections
        self.factorizations = 0
        self.settled: set[str] = set()
        self._compliances: dict[Motion, NodalCompliance] = {}

    @classmethod
    def of(
        cls, scene: Scene, discretisation: FiniteElementDiscretisation, radius: float
    ) -> "ContactModel":
        """Create the model of a scene, with meshes of both bodies for contacts up to one radius.

        scene           contact problem
        discretisation  number of elements per radius, outer radius of the mesh, and mesher
        radius          largest expected contact radius, the unit of length of the meshes [length]
        """
        scales = Scales(radius, outermost_modulus(scene))
        lower, upper = (scales.dimensionless(body) for body in (scene.body, scene.indenter))
        plane = scene.indenter.is_line
        section = _create_section(lower, discretisation, plane=plane)
        other = section if lower == upper else _create_section(upper, discretisation, plane=plane)
        return cls(scene, scales, (section, other))

    @cached_property
    def radii(self) -> Field:
        """Radii of the surface nodes of the meshes in the contact zone (m,) [length].

        An edge has further nodes between its corners.
        """
        section = next(section for section in self.sections if section is not None)
        return np.asarray(section.radii * self.scales.length)

    @cached_property
    def hats(self) -> Hats:
        """Hat functions of the tractions over the radius, one for each corner node on the surface.

        If the indenter has a rim, the functions end at the rim.
        """
        return hats_on(self.radii, self.rim, self.power)

    @property
    def plane(self) -> bool:
        """True for a line contact: the bodies are in plane strain, and loads are per length."""
        return self.scene.indenter.is_line

    @property
    def power(self) -> int:
        """Power of r in the weight of integrals over the surface: 0 in plane strain, else 1."""
        return 0 if self.plane else 1

    @property
    def around(self) -> float:
        """Factor of these integrals: the angle 2π of a circle, or the two halves of a strip."""
        return 2.0 if self.plane else 2.0 * np.pi

    @property
    def pressing(self) -> Motion:
        """Displacement field of normal loading."""
        return LINE_PRESSING if self.plane else PRESSING

    @property
    def rim(self) -> float:
        """Radius of the indenter's rim, beyond which no contact is possible [length].

        The radius is infinite if the indenter has no rim.
        """
        rim = self.scene.indenter.rim
        return np.inf if rim is None else rim

    @property
    def ends_at_rim(self) -> bool:
        """True if the indenter has a rim, which bounds the contact radius at any load."""
        return self.scene.indenter.rim is not None

    @property
    def friction(self) -> CoulombFriction:
        """Coulomb friction between the two bodies, equal at all points of the surface."""
        return self.scene.friction or FRICTIONLESS

    def gap(self, r: Field) -> Field:
        """Compute the gap between the undeformed surfaces at first contact, at radii [length].

        The gap follows from the shape of the indenter.

        r  radii of surface particles before any load [length]
        """
        return np.asarray(self.scene.indenter.initial_gap(r, 0.0))

    def compliance(self, of: Motion) -> NodalCompliance:
        """Return the compliance of the two surfaces for one kind of loading, in units of the scene.

        The matrix contains the displacement of the lower surface relative to the upper surface, per
        unit generalised nodal force [length/force], in plane strain per force per length. The
        compliance is computed at its first use and stored. The springs of a rig are included.

        of  displacement field of one angular harmonic, such as PRESSING, SHEARING or TORSION
        """
        if of not in self._compliances:
            condensed = composite(*self.sections, of)
            name = f"{of.harmonic} {of.components} {of.on_axis}"
            if name not in self.settled:
                self.factorizations += condensed.factorizations
                self.settled.add(name)
            matrix = condensed.matrix / (self.scales.modulus * self.scales.length**self.power)
            self._compliances[of] = replace(
                condensed,
                radii=self.radii,
                matrix=matrix + self._spring_compliance(of)[:, None, :, None],
            )
        return self._compliances[of]

    def along_load(self) -> Field:
        """Compute the surface compliance along a tangential load in Mindlin's approximation (m, m).

        The load acts along x. An entry is the displacement u_x of a surface node, averaged over the
        angle θ, per unit nodal force f(r) along x at a node [length/force]. With q_r = f cos θ and
        q_θ = -f sin θ, the mean of u_x is (u_r - u_θ)/2 in the amplitudes of the harmonic n = 1.
        Mindlin's approximation neglects u_y and the part of u_x ∝ cos 2θ. In plane strain the entry
        is u_x, without approximation.
        """
        if self.plane:
            return np.asarray(self.compliance(LINE_SHEARING).matrix[0, :, 0])
        C = self.compliance(SHEARING).matrix
        return np.asarray(0.5 * (C[0, :, 0] - C[0, :, 1] - C[1, :, 0] + C[1, :, 1]))

    def _spring_compliance(self, of: Motion) -> Field:
        """Compute the uniform displacement by springs of the rig per nodal force (c, c)
        [length/force]; in plane strain with the motion by the reference length of the scene."""
        down, along = (own + self._reference_compliance() for own in compliances(self.scene.rig))
        moved = {PRESSING: down, LINE_PRESSING: down, SHEARING: along, LINE_SHEARING: along}
        compliance = moved.get(of, 0.0)
        return np.asarray(compliance * np.multiply.outer(of.on_axis, of.resultant))

    def _reference_compliance(self) -> float:
        """Compute the uniform displacement of the surfaces in plane strain per force per length.

        The sections count displacements from the unit of length of the meshes, the scene counts
        them from its reference length (1 m without one) [length^2/force]. Bodies of revolution and
        rigid bases have no such displacement.
        """
        indenter = self.scene.indenter
        if not isinstance(indenter, LineShape):
            return 0.0
        bases = [body.material for body in (self.scene.body, indenter)]
        elastic = [material for material in bases if isinstance(material, IsotropicMaterial)]
        farther = (indenter.reference_length or 1.0) / self.scales.length
        return float(np.log(farther) * sum(map(line_reference, elastic)))


def _create_section(
    body: Body, discretisation: FiniteElementDiscretisation, *, plane: bool
) -> SectionMesh | None:
    """Create the mesh of the meridional section of a body, or return None for a rigid body.

    body   layers and substrate in units of the expected contact radius
    plane  True for a body in plane strain
    """
    if not body.deforms:
        return None
    make = section_mesh
    if discretisation.mesher == "gmsh":
        # Imported here because gmsh requires libraries that are not installed everywhere.
        from fem_reference.mesh.gmsh_mesh import gmsh_section_mesh as make
    return make(body, discretisation.elements_per_radius, discretisation.box, plane=plane)


def outermost_modulus(scene: Scene) -> float:
    """Return Young's modulus of the outermost elastic material of the lower body [force/length^2].

    If the lower body is rigid, return the modulus of the outermost material of the indenter. Raise
    ValueError if both bodies are rigid.
    """
    for body in (scene.body, scene.indenter):
        for material in body.elastic_materials:
            return material.young_modulus
    raise ValueError("two rigid bodies")
