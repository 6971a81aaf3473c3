"""Far field of a resultant on the surface of a half-space: displacements on the outer boundary."""

import numpy as np

from contact_scene.array_types import Field
from contact_scene.material import IsotropicMaterial


def boussinesq(r: Field, z: Field, material: IsotropicMaterial) -> Field:
    """Compute amplitudes u_r, u_theta, u_z (3, ...) of a unit force along z at the origin, n = 0.

    Boussinesq 1885; Johnson, Contact Mechanics (1985), Eq. 3.18.
    """
    G, nu = material.shear_modulus, material.poisson_ratio
    R = np.hypot(r, z)
    u_r = r * z / R**3 - (1.0 - 2.0 * nu) * r / (R * (R + z))
    u_z = 2.0 * (1.0 - nu) / R + z * z / R**3
    return np.stack([u_r, np.zeros_like(R), u_z]) / (4.0 * np.pi * G)


def cerruti(r: Field, z: Field, material: IsotropicMaterial) -> Field:
    """Compute amplitudes u_r, u_theta, u_z (3, ...) of a unit force along theta = 0, n = 1.

    Cerruti 1882; Johnson, Contact Mechanics (1985), Eq. 3.75.
    """
    G, nu = material.shear_modulus, material.poisson_ratio
    R = np.hypot(r, z)
    across = 1.0 / R + (1.0 - 2.0 * nu) / (R + z)
    along = r * r * (1.0 / R**3 - (1.0 - 2.0 * nu) / (R * (R + z) ** 2))
    u_z = r * (z / R**3 + (1.0 - 2.0 * nu) / (R * (R + z)))
    return np.stack([across + along, -across, u_z]) / (4.0 * np.pi * G)


def point_torque(r: Field, z: Field, material: IsotropicMaterial) -> Field:
    """Compute amplitudes u_r, u_theta, u_z (3, ...) of a unit torque about z at the origin, n = 0.

    It is half of Kelvin's point couple in the full space, whose plane z = 0 is free of traction.
    """
    R = np.hypot(r, z)
    u_theta = r / R**3
    zero = np.zeros_like(R)
    return np.stack([zero, u_theta, zero]) / (4.0 * np.pi * material.shear_modulus)
