"""Compliance of the surface: displacement of surface nodes per force on the surface nodes.

The contact algorithms need no other information about the elasticity of the bodies. Compliances are
cached on disk.
"""

import hashlib
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import scipy
import skfem
from numpy.typing import NDArray

from contact_scene.disk_cache import cached_array, sources_digest
from fem_reference.elasticity.factored_section import FactoredSection
from fem_reference.elasticity.motion import Motion
from fem_reference.mesh.section_mesh import SectionMesh

PACKAGE = Path(__file__).resolve().parents[1]
# Folders whose source code determines a compliance matrix to the last bit.
FOLDERS = ("mesh", "elasticity")
LIBRARIES = (np.__version__, scipy.__version__, skfem.__version__)


@dataclass(frozen=True, eq=False)
class NodalCompliance:
    """Compliance of the surface nodes in the contact zone: displacement per generalised force.

    The nodes are those of the elements. A generalised force is the integral of psi_i t r dr, with t
    the amplitude of the traction and psi_i the trace function of the node. It does not contain the
    factor 2 pi or pi of the angle. In plane strain it is the integral of psi_i t dr on one half of
    the surface.

    motion          harmonic n and components: (r, z) for n = 0, (theta) in torsion, else (r, theta,
                    z)
    radii           radii of the nodes (m,), those of edges between corners; radii[0] = 0
    matrix          compliance (c, m, c, m) for c components, symmetric
    factorizations  number of sparse factorisations. A matrix from the cache counts too, so that the
                    cost of a scene does not depend on previous solves
    """

    motion: Motion
    radii: NDArray[np.float64]
    matrix: NDArray[np.float64]
    factorizations: int


def condense(section: SectionMesh, motion: Motion) -> NodalCompliance:
    """Compute the compliance of the surface of one body for one kind of loading.

    The matrix contains displacements of the surface nodes per generalised nodal force. All other
    nodes are eliminated by one sparse factorisation. The matrix is read from the cache if it was
    computed before. Raise ResourceRefused if the memory is insufficient.

    section  mesh of the meridional section of the body
    motion   displacement field of one angular harmonic, such as that of normal loading or torsion
    """
    shape = (len(motion.components), section.radii.size) * 2
    matrix = cached_array(
        _cache_key(section, motion), shape, lambda: FactoredSection(section, motion).compliance()
    )
    return NodalCompliance(motion, section.radii, matrix, 1)


def composite(
    lower: SectionMesh | None, upper: SectionMesh | None, motion: Motion
) -> NodalCompliance:
    """Compute the compliance of two surfaces in contact: the sum of the compliances of both bodies.

    The displacement is that of the lower surface relative to the upper, per force on the lower
    surface. With z into each body, the shear on the upper body has the opposite sign. The sum is
    therefore C1 + J C2 J with the compliances C1 and C2 of the bodies and J = diag(1, 1, -1). Raise
    ValueError for two rigid bodies, or for bodies with different contact nodes.

    lower, upper  meshes of the two bodies; None for a rigid body. Equal bodies may share one mesh
    motion        displacement field of one angular harmonic, such as that of normal loading or
                  torsion
    """
    bodies = [section for section in (lower, upper) if section is not None]
    if not bodies:
        raise ValueError("two rigid bodies have no compliance")
    if any(not np.array_equal(body.radii, bodies[0].radii) for body in bodies):
        raise ValueError("the contact nodes of the two bodies differ: mesh both with the same N")
    distinct = {id(body): body for body in bodies}
    parts = {key: condense(body, motion) for key, body in distinct.items()}
    J = np.array([1.0, 1.0, -1.0])[list(motion.components)]
    matrix = np.zeros_like(parts[id(bodies[0])].matrix)
    if lower is not None:
        matrix += parts[id(lower)].matrix
    if upper is not None:
        matrix += J[:, None, None, None] * parts[id(upper)].matrix * J[:, None]
    return NodalCompliance(motion, bodies[0].radii, matrix, len(parts))


def _cache_key(section: SectionMesh, motion: Motion) -> str:
    """Compute the key under which the compliance matrix of a body is stored in the disk cache.

    The key is a hash of all data that determine the matrix: mesh, materials, angular harmonic and
    source code.

    section  mesh of the meridional section of the body
    motion   displacement field of one angular harmonic
    """
    outline = section.outline
    materials = [(m.young_modulus, m.poisson_ratio) for m in outline.materials]
    sizes = (outline.zone, outline.box, outline.interfaces, outline.rigid_base, outline.plane)
    far_field = getattr(motion.far_field, "__name__", None)
    moving = (motion.harmonic, motion.components, motion.on_axis, far_field)
    sources = sources_digest(PACKAGE, FOLDERS, LIBRARIES)
    described = (sources, moving, materials, sizes)
    identity = hashlib.sha256(repr(described).encode())
    for array in (section.points, section.quads.astype(np.int64)):
        identity.update(np.ascontiguousarray(array).tobytes())
    return identity.hexdigest()
