"""Motions of a body in one angular harmonic: components, axis conditions, resultant and far field.

The far field is the displacement of a half-space by the resultant of the tractions. It is
prescribed on the outer boundary of the mesh.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from contact_scene.array_types import Field
from contact_scene.material import IsotropicMaterial

FarField = Callable[
    [NDArray[np.float64], NDArray[np.float64], IsotropicMaterial], NDArray[np.float64]
]


@dataclass(frozen=True)
class Motion:
    """Displacement field of one angular harmonic, with its conditions on the axis and far away.

    Normal loading, torsion and a tangential load each have one motion. Far from the contact, the
    displacement of a half-space by the resultant of the tractions is prescribed, or zero if there
    is no resultant.

    In plane strain u_r and u_z are along and normal to the surface. The harmonic is 0 for a field
    that is mirror symmetric about x = 0, and 1 for the opposite sign on the other side.

    harmonic    n
    components  indices of the components in the motion: u_r (0), u_theta (1), u_z (2)
    on_axis     factor of each component in the single displacement of a node at r = 0; 0 if the
                component is zero at r = 0
    resultant   factor of the nodal forces of each component in the resultant of the tractions
    lever       power of r in the resultant: 1 for a torque, 0 for a force
    far_field   displacement of a half-space for a unit resultant; None for zero displacement
    plane       True in plane strain
    """

    harmonic: int
    components: tuple[int, ...]
    on_axis: tuple[float, ...]
    resultant: tuple[float, ...]
    lever: int
    far_field: FarField | None
    plane: bool = False

    @property
    def in_strains(self) -> int:
        """Number n in the strains: the harmonic, and 0 in plane strain."""
        return 0 if self.plane else self.harmonic

    @property
    def changes_volume(self) -> bool:
        """True if the displacement field can change the volume of the material. Torsion cannot.

        Nearly incompressible elements then need a pressure as an unknown.
        """
        return self.harmonic > 0 or self.components != TORSION.components

    def resultant_weights(self, radii: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the factors that sum the nodal forces on the surface to their resultant (c, m).

        The resultant is the normal force W, the tangential force T or the torque M_z. The forces
        are generalised forces of the c components at m surface nodes.

        radii  radii of the surface nodes (m,)
        """
        return np.multiply.outer(np.asarray(self.resultant), radii**self.lever)


def boussinesq(r: Field, z: Field, material: IsotropicMaterial) -> Field:
    """Compute the displacement of a half-space by a unit normal force at the origin (n = 0).

    Return the amplitudes u_r, u_theta and u_z (3, ...) at the points (r, z) [length/force].
    Boussinesq 1885; Johnson, Contact Mechanics (1985), Eq. 3.18.

    r, z      distance from the axis and depth of the points (...) [length]
    material  elastic constants of the half-space
    """
    G, nu = material.shear_modulus, material.poisson_ratio
    R = np.hypot(r, z)
    u_r = r * z / R**3 - (1.0 - 2.0 * nu) * r / (R * (R + z))
    u_z = 2.0 * (1.0 - nu) / R + z * z / R**3
    return np.stack([u_r, np.zeros_like(R), u_z]) / (4.0 * np.pi * G)


def cerruti(r: Field, z: Field, material: IsotropicMaterial) -> Field:
    """Compute the displacement of a half-space by a unit tangential force at the origin (n = 1).

    The force acts along theta = 0. Return the amplitudes u_r, u_theta and u_z (3, ...) at the
    points (r, z) [length/force]. Cerruti 1882; Johnson, Contact Mechanics (1985), Eq. 3.75.

    r, z      distance from the axis and depth of the points (...) [length]
    material  elastic constants of the half-space
    """
    G, nu = material.shear_modulus, material.poisson_ratio
    R = np.hypot(r, z)
    across = 1.0 / R + (1.0 - 2.0 * nu) / (R + z)
    along = r * r * (1.0 / R**3 - (1.0 - 2.0 * nu) / (R * (R + z) ** 2))
    u_z = r * (z / R**3 + (1.0 - 2.0 * nu) / (R * (R + z)))
    return np.stack([across + along, -across, u_z]) / (4.0 * np.pi * G)


def point_torque(r: Field, z: Field, material: IsotropicMaterial) -> Field:
    """Compute the displacement of a half-space by a unit torque about z at the origin (n = 0).

    Return the amplitudes u_r, u_theta and u_z (3, ...) at the points (r, z) [1/force]. With R^2 =
    r^2 + z^2, u_theta = r / (4 pi G R^3), and the others are zero. The plane z = 0 of a full space
    under Kelvin's point couple is free of traction, so that each half carries half of the couple.

    r, z      distance from the axis and depth of the points (...) [length]
    material  elastic constants of the half-space
    """
    R = np.hypot(r, z)
    u_theta = r / R**3
    zero = np.zeros_like(R)
    return np.stack([zero, u_theta, zero]) / (4.0 * np.pi * material.shear_modulus)


def line_normal(x: Field, z: Field, material: IsotropicMaterial) -> Field:
    """Compute the displacement of a half-space by a unit normal force per length on the line x = 0.

    Return the components along x, along the line and along z (3, ...) at the points (x, z)
    [length^2/force]. The surface does not move at the unit distance. Flamant 1892; Johnson, Contact
    Mechanics (1985), section 2.3, integrated.

    x, z      distance from the line along the surface, and depth (...) [length]
    material  elastic constants of the half-space
    """
    G, nu = material.shear_modulus, material.poisson_ratio
    R = np.hypot(x, z)
    u_x = x * z / R**2 - (1.0 - 2.0 * nu) * np.arctan2(x, z)
    u_z = -2.0 * (1.0 - nu) * np.log(R) + z * z / R**2
    return np.stack([u_x, np.zeros_like(R), u_z]) / (2.0 * np.pi * G)


def line_tangential(x: Field, z: Field, material: IsotropicMaterial) -> Field:
    """Compute the displacement of a half-space by a unit tangential force per length along x.

    The force acts on the line x = 0. Return the components along x, along the line and along z
    (3, ...) at the points (x, z) [length^2/force]. The surface does not move along x at the unit
    distance. Johnson, Contact Mechanics (1985), section 2.4, integrated.

    x, z      distance from the line along the surface, and depth (...) [length]
    material  elastic constants of the half-space
    """
    G, nu = material.shear_modulus, material.poisson_ratio
    R = np.hypot(x, z)
    u_x = -2.0 * (1.0 - nu) * np.log(R) - z * z / R**2
    u_z = x * z / R**2 + (1.0 - 2.0 * nu) * np.arctan2(x, z)
    return np.stack([u_x, np.zeros_like(R), u_z]) / (2.0 * np.pi * G)


def line_reference(material: IsotropicMaterial) -> float:
    """Return the displacement 2(1 - ν²)/πE per unit of ln L by a unit line force [length^2/force].

    The displacements of `line_normal` and `line_tangential` grow by it if the distance at which the
    surface does not move is L in place of 1.

    material  elastic constants of the half-space
    """
    return 2.0 / (np.pi * material.plane_strain_modulus)


PRESSING = Motion(0, (0, 2), (0.0, 1.0), (0.0, 2.0 * np.pi), 0, boussinesq)
TORSION = Motion(0, (1,), (0.0,), (2.0 * np.pi,), 1, point_torque)
# T = integral of (q_r cos^2 - q_theta sin^2) over the surface; a shift along theta = 0 has
# u_r = 1 and u_theta = -1 everywhere, on the axis as well.
SHEARING = Motion(1, (0, 1, 2), (1.0, -1.0, 0.0), (np.pi, -np.pi, 0.0), 0, cerruti)

# One half of the section carries half of the force.
LINE_PRESSING = Motion(0, (0, 2), (0.0, 1.0), (0.0, 2.0), 0, line_normal, plane=True)
LINE_SHEARING = Motion(1, (0, 2), (1.0, 0.0), (2.0, 0.0), 0, line_tangential, plane=True)


def motion(harmonic: int) -> Motion:
    """Return the form of the displacement field of a body for one angular harmonic n.

    The displacements u_r and u_z are proportional to cos n theta, u_theta is proportional to sin n
    theta. The result contains the displacement components and their conditions on the axis and far
    away. The surface tractions have the same harmonic. For n = 0 the loading is normal, not
    torsion. Raise ValueError for a negative n.

    harmonic  n >= 0
    """
    if harmonic < 0:
        raise ValueError(f"harmonic {harmonic} is not 0, 1, 2, ...")
    if harmonic < 2:
        return (PRESSING, SHEARING)[harmonic]
    return Motion(harmonic, (0, 1, 2), (0.0,) * 3, (0.0,) * 3, 0, None)
