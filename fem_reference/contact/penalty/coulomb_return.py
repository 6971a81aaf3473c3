"""The tangential half of the penalty model: return of a trial shear to Coulomb's cone.

One component (radial, circumferential or along x) or two: the component is the first index.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Field = NDArray[np.float64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True)
class CoulombReturn:
    """The admissible shear and how it follows its arguments, at k components of n points.

    shear     q (k, n) [force/length^2]
    in_slip   points where the trial shear was outside the cone (n,)
    by_trial  ∂q/∂q_trial (k, k, n) [1]
    by_limit  ∂q/∂(µp) (k, n) [1]; not zero: with it the tangent loses its symmetry
    """

    shear: Field
    in_slip: Mask
    by_trial: Field
    by_limit: Field


def coulomb_return(trial: Field, limit: Field) -> CoulombReturn:
    """The point of the disc |q| ≤ limit nearest to the trial shear, with the consistent tangent.

    Radial return (Giannakopoulos 1989, Comput. Struct. 32, 157; Simo and Laursen 1992, Comput.
    Struct. 42, 97): stick keeps the trial shear, slip scales it back to the limit.

    trial  q_trial (k, n) [force/length^2]
    limit  µp ≥ 0 (n,) [force/length^2]
    """
    size = np.hypot.reduce(np.abs(trial), axis=0)
    in_slip = size > limit
    size = np.where(in_slip, size, 1.0)
    kept = np.where(in_slip, limit / size, 1.0)
    direction = np.where(in_slip, trial / size, 0.0)
    turning = np.eye(len(trial))[:, :, None] - direction[:, None] * direction[None, :]
    return CoulombReturn(
        shear=np.where(in_slip, limit * direction, trial),
        in_slip=in_slip,
        by_trial=kept * turning,
        by_limit=direction,
    )
