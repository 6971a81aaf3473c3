"""Model of a scene on one mesh: compliance, gap and friction."""

from dataclasses import replace
from functools import cached_property

import numpy as np

from contact_scene import (
    Body,
    FiniteElementDiscretisation,
    Scene,
)
from contact_scene.array_types import Field
from contact_scene.friction import FRICTIONLESS, CoulombFriction
from contact_scene.rig import compliances
from fem_reference.elasticity.compliance import NodalCompliance, composite
from fem_reference.elasticity.hat_functions import Hats, hats_on
from fem_reference.elasticity.motion import PRESSING, SHEARING, TORSION, Motion, motion
from fem_reference.mesh.section_mesh import SectionMesh, section_mesh
from fem_reference.scales import Scales


class ContactModel:
    """Two bodies of a scene with their meshes. A compliance is computed at its first use and
    stored.

    Lengths and forces are those of the scene. Only the meshes are in units of `scales`.

    sections        lower and upper mesh; None for a rigid body
    factorizations  number of sparse factorisations
    settled         names of condensed motions, and of motions counted by an interrupted part of the
                    history
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
        """Return the model for contacts up to a radius [length]."""
        scales = Scales(radius, outermost_modulus(scene))
        lower, upper = (scales.dimensionless(body) for body in (scene.body, scene.indenter))
        section = _section(lower, discretisation)
        other = section if lower == upper else _section(upper, discretisation)
        return cls(scene, scales, (section, other))

    @cached_property
    def radii(self) -> Field:
        """Radii of the nodes in the contact zone, corner and midside alternating [length]."""
        section = next(section for section in self.sections if section is not None)
        return np.asarray(section.radii * self.scales.length)

    @cached_property
    def hats(self) -> Hats:
        """Hat functions of the corners that can carry traction. They end at a rim."""
        return hats_on(self.radii, self.rim)

    @property
    def rim(self) -> float:
        """Radius beyond which the indenter cannot touch; infinite without a rim [length]."""
        rim = self.scene.indenter.rim
        return np.inf if rim is None else rim

    @property
    def ends_at_rim(self) -> bool:
        """True if the rim of the indenter bounds the contact at any load."""
        return self.scene.indenter.rim is not None

    @property
    def friction(self) -> CoulombFriction:
        """Friction between the two bodies, equal everywhere."""
        return self.scene.friction or FRICTIONLESS

    def gap(self, r: Field) -> Field:
        """Undeformed gap at a radius [length], taken where a particle was before any load."""
        return np.asarray(self.scene.indenter.initial_gap(r, 0.0))

    def compliance(self, harmonic: int) -> NodalCompliance:
        """Return the displacement of the lower surface relative to the upper per nodal force
        [length/force].

        For n = 0 the motion is normal loading. For n >= 1 its components are (r, theta, z).
        """
        return self._condensed(motion(harmonic))

    def torsion(self) -> NodalCompliance:
        """Return the circumferential displacement per circumferential nodal force
        [length/force]."""
        return self._condensed(TORSION)

    def along_load(self) -> Field:
        """Return the mean displacement along x around the axis, per nodal force f(r) along x
        [length/force].

        With q_r = f cos θ and q_θ = -f sin θ, the mean of u_x is (u_r - u_θ)/2 in the amplitudes of
        n = 1. Mindlin's approximation neglects the part of u_x ∝ cos 2θ, and u_y.
        """
        C = self.compliance(1).matrix
        return np.asarray(0.5 * (C[0, :, 0] - C[0, :, 1] - C[1, :, 0] + C[1, :, 1]))

    def _condensed(self, of: Motion) -> NodalCompliance:
        if of not in self._compliances:
            condensed = composite(*self.sections, of)
            name = f"{of.harmonic} {of.components}"
            if name not in self.settled:
                self.factorizations += condensed.factorizations
                self.settled.add(name)
            matrix = condensed.matrix / (self.scales.modulus * self.scales.length)
            self._compliances[of] = replace(
                condensed, radii=self.radii, matrix=matrix + self._springs(of)[:, None, :, None]
            )
        return self._compliances[of]

    def _springs(self, of: Motion) -> Field:
        """Return the displacement of all nodes by the springs of a rig, per nodal force (c, c)
        [length/force]."""
        down, along = compliances(self.scene.rig)
        compliance = {PRESSING: down, SHEARING: along}.get(of, 0.0)
        return np.asarray(compliance * np.multiply.outer(of.on_axis, of.resultant))


def _section(body: Body, discretisation: FiniteElementDiscretisation) -> SectionMesh | None:
    if not body.deforms:
        return None
    make = section_mesh
    if discretisation.mesher == "gmsh":
        # Imported here because gmsh requires libraries that are not installed everywhere.
        from fem_reference.mesh.gmsh_mesh import gmsh_section_mesh as make
    return make(body, discretisation.elements_per_radius, discretisation.box)


def outermost_modulus(scene: Scene) -> float:
    """Return Young's modulus of the outermost elastic material [force/length^2].

    It is that of the indenter if the lower body has no elastic material.
    """
    for body in (scene.body, scene.indenter):
        for material in body.elastic_materials:
            return material.young_modulus
    raise ValueError("two rigid bodies")
