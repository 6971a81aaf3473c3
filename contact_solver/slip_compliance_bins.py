"""Bins of the local slip compliance, for the preconditioner of the tangential problem.

In a slipping point a change of the shear direction has a compliance d in addition to that of the
surface. It grows from zero at the stick border to many times the self-compliance K₀, the
displacement of a point by unit shear on the point. Bin j has the compliance d_j = K₀ 8^(j-1); bin 0
has none. The squared weights χ_j² of a point in the bins are hat functions of log d with the sum 1.
"""

import numpy as np

from contact_scene.array_types import Field, Vector

RATIO = 8.0
# Compliances over the self-compliance. More or closer bins do not reduce the Krylov iterations.
COMPLIANCES: Vector = np.array([1.0, RATIO])


def shares(compliance: Field) -> Field:
    """Compute the weights of slipping points in the bins of slip compliance (1 + bins, …).

    The preconditioner of the tangential problem divides slipping points among a few bins of the
    slip compliance d. The sum of the squared weights is 1 up to the last bin.

    compliance  d/K₀ (…): slip compliance over the self-compliance of a point
    """
    place = np.log(np.maximum(compliance, 1 / RATIO)) / np.log(RATIO) + 1
    number = np.arange(len(COMPLIANCES) + 1).reshape(-1, *np.ones(place.ndim, dtype=int))
    found = np.sqrt(np.maximum(0.0, 1 - np.abs(np.minimum(place, len(COMPLIANCES)) - number)))
    # The compliance of the last bin is too small for points beyond it.
    last = COMPLIANCES[-1]
    found[-1] *= np.sqrt((1 + last) / (1 + np.maximum(compliance, last)))
    return np.asarray(found)


def beyond(compliance: Field) -> Field:
    """Compute the degree, from 0 to 1, to which a slip compliance exceeds the last bin.

    The preconditioner treats such points separately, because their slip compliance dominates. The
    result is 0 up to the compliance of the last bin, 1 from RATIO times this value on, and linear
    in the logarithm between.

    compliance  d/K₀ (…): slip compliance over the self-compliance of a point
    """
    last = COMPLIANCES[-1]
    return np.asarray(np.clip(np.log(np.maximum(compliance, last) / last) / np.log(RATIO), 0, 1))
