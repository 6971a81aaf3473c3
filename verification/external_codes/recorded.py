"""Recorded results of CalculiX, extrapolated to stiff springs, with their uncertainty.

A penalty leaves an error that goes with the inverse of its stiffness: twice the result of the stiff
springs less that of springs half as stiff has none of it to first order. Stiffnesses of 100, 300
and 1000 (coated, no friction) show that a fiftieth of the correction is left; a twentieth is put
down. To that, in squares, comes what half the elements change, and for the force that the gap is
measured where the surface has moved to.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from verification.closed_forms.hertz import PointContact
from verification.references import load_reference

Field = NDArray[np.float64]
LEFT_OF_CORRECTION = 1 / 20
NAME = "external_code_calculix"
# The recorded ball: R [mm], W [N], E [MPa], ν. Its gap is measured on the moved surface, which
# raises the load by (1-2ν)(1+ν) p_H / 2E.
RADIUS, FORCE, MODULUS, RATIO = 1800.0, 10.0, 210e3, 0.3
PEAK = PointContact.under_load(FORCE, RADIUS, MODULUS / (1 - RATIO**2)).peak_pressure
MOVED_GAP = (1 - 2 * RATIO) * (1 + RATIO) * PEAK / (2 * MODULUS)


class Certain(NamedTuple):
    """A number, and its standard uncertainty."""

    value: float
    uncertainty: float


class Profile(NamedTuple):
    """A traction over p_H at some radii over a_H, and its standard uncertainty, the same at all."""

    radii: Field
    values: Field
    uncertainty: float


@dataclass(frozen=True)
class Recorded:
    """One scene's record: coarse, fine, and the fine mesh with half the stiffness."""

    record: Mapping[str, Any]

    def __post_init__(self) -> None:
        """Raises ValueError if the runs are not those three."""
        coarse, fine, soft = self.record["runs"]
        if not (
            fine["elements"] == soft["elements"] == 2 * coarse["elements"]
            and fine["stiffness"] == coarse["stiffness"] == 2 * soft["stiffness"]
        ):
            raise ValueError("expected runs: coarse, twice as fine, and that half as stiff")

    @property
    def normal_force(self) -> Certain:
        """Over the nominal force."""
        coarse, fine, soft = (float(run["normal_force"]) for run in self.record["runs"])
        correction, refinement = fine - soft, fine - coarse
        errors = (LEFT_OF_CORRECTION * correction, refinement, MOVED_GAP * fine)
        return Certain(fine + correction, math.hypot(*errors))

    @cached_property
    def edge(self) -> float:
        """Outermost radius that is touched on all three runs, over a_H."""
        return float(min(run["radii"][-1] for run in self.record["runs"]))

    def profile(self, traction: str, first: float, last: float) -> Profile:
        """Pressure or shear at the radii that both meshes have, from `first` to `last` of a_H."""
        coarse, fine, soft = self.record["runs"]
        radii = np.array(coarse["radii"])
        chosen = np.flatnonzero((radii >= first) & (radii <= last))

        def at_common_radii(run: Mapping[str, Any]) -> Field:
            every = 1 if run is coarse else 2
            return np.array(run[traction])[every * chosen]

        rough, good, weak = (at_common_radii(run) for run in (coarse, fine, soft))
        correction, refinement = good - weak, good - rough
        errors = np.hypot(LEFT_OF_CORRECTION * correction, refinement)
        return Profile(radii[chosen], good + correction, float(np.max(errors)))


def recorded(name: str) -> Recorded:
    """The record of the scene of this name; KeyError if there is none."""
    scenes = {each["name"]: each for each in load_reference(NAME)["scenes"]}
    return Recorded(scenes[name])
