"""Contact state at the end of an increment, on the points of the surface."""

from dataclasses import dataclass

import numpy as np

from contact_scene.array_types import Field, Mask, Vector
from contact_scene.quantities.residuals import Residuals
from contact_scene.quantities.summary import ContactStatus
from fem_reference.loads import Loads, Triple


@dataclass(frozen=True)
class PointState:
    """Converged contact state at the points of the surface, at the end of an increment.

    Vectors (2, points) have the components r and θ. On Path.SHEARING, a tangential load without
    coupling of pressure and shear, the first component is the one along the load, and the second is
    zero.

    axisymmetric    True if each point represents a whole ring
    pressure        pressure (points,) [force/length^2]
    shear           shear on the lower body (2, points) [force/length^2]
    displacement    tangential displacement of the lower surface relative to the upper one (2,
                    points) [length]
    multiplier      tractions without the contribution of the penalty springs, r, θ, z (3, points);
                    zero for the exact law
    gap             gap between the surfaces (points,), negative for an overlap [length]
    slip            slip of the lower body relative to the indenter, accumulated since the start (2,
                    points) [length]
    in_stick        True for points in the stick zone (points,)
    status          full stick, partial slip, gross sliding, or no stick area left
    loads           tangential forces along and across the load [force], torque [force length]
    motions         shifts along and across the load [length], twist [radian]; None at the friction
                    limit under prescribed loads
    twist           prescribed twist [radian]; None if the torque is prescribed
    dissipated_energy
                    energy lost to friction since the start; None if the motions are None
    friction_changed
                    magnitude of the change of the shear times that of the slip in the last
                    increment, integrated over the contact [force length]
    overlap         largest overlap that the penalty springs permit [length]
    moved           largest mean tangential displacement by shear in the history, weighted with the
                    shear [length]
    outer_iterations, solves
                    numbers of outer iterations and of linear iterations
    augmentations   number of augmented-Lagrangian updates of the multipliers
    strain          equibiaxial strain imposed on the lower body since first contact [1]
    algorithm       algorithm that solved pressure and shear; None if they are not coupled
    prescribed      loads and motions that the increment prescribes; None before first contact
    """

    axisymmetric: bool
    pressure: Vector
    shear: Field
    displacement: Field
    multiplier: Field
    gap: Vector
    slip: Field
    in_stick: Mask
    status: ContactStatus
    normal_force: float
    approach: float
    loads: Triple
    motions: Triple | None
    twist: float | None
    dissipated_energy: float | None
    residuals: Residuals
    friction_changed: float = 0.0
    overlap: float = 0.0
    moved: float = 0.0
    outer_iterations: int = 0
    solves: int = 0
    augmentations: int = 0
    strain: float = 0.0
    algorithm: str | None = None
    prescribed: Loads | None = None

    @property
    def tractions(self) -> Field:
        """Shear and pressure of a contact state at all points, in one array (3, points).

        The components are r, θ, z [force/length^2].
        """
        return np.concatenate([self.shear, self.pressure[None]])
