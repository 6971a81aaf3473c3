"""How a body moves in one angular harmonic: components, axis, resultant and far field."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from contact_scene.material import IsotropicMaterial
from fem_reference.elasticity.far_field import boussinesq, cerruti, point_torque

FarField = Callable[
    [NDArray[np.float64], NDArray[np.float64], IsotropicMaterial], NDArray[np.float64]
]


@dataclass(frozen=True)
class Motion:
    """One harmonic of the displacement, and what the axis and the far field know of it.

    harmonic    n
    components  which of u_r (0), u_theta (1), u_z (2) take part
    on_axis     by component: 0 where it vanishes at r = 0, else its factor of the one displacement
                that is left there
    resultant   by component: factor of the nodal forces in the resultant of the surface tractions
    lever       power of r in the resultant
    far_field   displacement of a half-space for a unit resultant; None: a body at rest
    """

    harmonic: int
    components: tuple[int, ...]
    on_axis: tuple[float, ...]
    resultant: tuple[float, ...]
    lever: int
    far_field: FarField | None

    @property
    def changes_volume(self) -> bool:
        """Whether it can; torsion cannot."""
        return self.harmonic > 0 or self.components != TORSION.components

    def resultant_weights(self, radii: NDArray[np.float64]) -> NDArray[np.float64]:
        """(c, m) factors of the generalised nodal forces in the resultant: W, T or M_z."""
        return np.multiply.outer(np.asarray(self.resultant), radii**self.lever)


PRESSING = Motion(0, (0, 2), (0.0, 1.0), (0.0, 2.0 * np.pi), 0, boussinesq)
TORSION = Motion(0, (1,), (0.0,), (2.0 * np.pi,), 1, point_torque)
# T = integral of (q_r cos^2 - q_theta sin^2) over the surface; a shift along theta = 0 has
# u_r = 1 and u_theta = -1 everywhere, on the axis as well.
SHEARING = Motion(1, (0, 1, 2), (1.0, -1.0, 0.0), (np.pi, -np.pi, 0.0), 0, cerruti)


def motion(harmonic: int) -> Motion:
    """The motion under tractions of the harmonic; pressing for n = 0 (not TORSION)."""
    if harmonic < 0:
        raise ValueError(f"harmonic {harmonic}: give 0, 1, 2, ...")
    if harmonic < 2:
        return (PRESSING, SHEARING)[harmonic]
    return Motion(harmonic, (0, 1, 2), (0.0,) * 3, (0.0,) * 3, 0, None)
