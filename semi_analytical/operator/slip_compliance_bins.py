"""Slip graded by how much it is held back.

Where a cell slips, turning its shear takes a stiffness d besides that of the surface, which grows
from nothing at the border of stick to many times the self-compliance K₀. With hats χ_j² over log d,
which add up to one, every cell has its shares of grades of stiffness d_j = K₀ 8^(j-1), and χ_0 of
no stiffness at all.
"""

import numpy as np

from contact_scene.array_types import Field, Vector

RATIO = 8.0
# Over the self-compliance. More grades, or nearer ones, save no step of a Krylov solver.
STIFFNESSES: Vector = np.array([1.0, RATIO])


def shares(stiffness: Field) -> Field:
    """χ (1 + grades, …) of stiffnesses d/K₀ (…)."""
    grade = np.log(np.maximum(stiffness, 1 / RATIO)) / np.log(RATIO) + 1
    number = np.arange(len(STIFFNESSES) + 1).reshape(-1, *np.ones(grade.ndim, dtype=int))
    found = np.sqrt(np.maximum(0.0, 1 - np.abs(np.minimum(grade, len(STIFFNESSES)) - number)))
    # Beyond the last grade its stiffness is too small.
    last = STIFFNESSES[-1]
    found[-1] *= np.sqrt((1 + last) / (1 + np.maximum(stiffness, last)))
    return np.asarray(found)


def beyond(stiffness: Field) -> Field:
    """Part of stiffnesses d/K₀ (…) that lies beyond the last grade: all from the next one on."""
    last = STIFFNESSES[-1]
    return np.asarray(np.clip(np.log(np.maximum(stiffness, last) / last) / np.log(RATIO), 0, 1))
