"""Definition of a verification problem: a scene, its known answer, and the source of the answer."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any

import numpy as np
from numpy.typing import NDArray

from contact_scene import Scene
from verification.problems.paper_scene import HERTZ

ROUNDING = 1e-12  # relative uncertainty of a closed form in double precision


class ReferenceKind(StrEnum):
    """Kind of the source of a reference value, from closed forms to results of other programs."""

    CLOSED_FORM = "closed form"
    SEMI_CLOSED = "semi-closed"
    THEORY = "theory"
    EXTERNAL_CODE = "external code"
    OTHER_SOLVER = "other solver"
    OWN_REFINEMENT = "own refinement"  # the same solver on a coarser discretisation
    IDENTITY = "identity"  # holds exactly by a theorem or by the equations themselves


@dataclass(frozen=True)
class Reference:
    """Hold the reference value with which a measured number is compared.

    value        reference value, in the unit of the number
    kind         kind of the source
    source       description of the source
    uncertainty  standard uncertainty u_ref, in the unit of the value
    """

    value: float
    kind: ReferenceKind
    source: str
    uncertainty: float = 0.0


def closed_form(value: float, source: str, scale: float | None = None) -> Reference:
    """Create a reference value from a closed form, whose uncertainty is rounding.

    value   value of the closed form
    source  description of the source
    scale   magnitude to which the rounding error is relative; None: the value
    """
    uncertainty = ROUNDING * abs(value if scale is None else scale)
    return Reference(value, ReferenceKind.CLOSED_FORM, source, uncertainty)


def identity(value: float, source: str) -> Reference:
    """Create a reference value that follows exactly from the equations, without uncertainty.

    value   expected value
    source  law from which the value follows
    """
    return Reference(value, ReferenceKind.IDENTITY, source)


Field = NDArray[np.float64]
OVER_RADIUS, OVER_PEAK = "the contact radius", "p_H"


@dataclass(frozen=True)
class Problem:
    """Verification problem: a scene with its known answer.

    scene        bodies and loads
    ends         exact answer at the end of every load step: records with the attribute names of the
                 quantities of a result; fields are functions of the distance from the axis, or of x
                 and y if the contact is not round
    radius       contact radius, or semi-axis of the contact along x [length]
    source       source of the answer
    kind         kind of the source
    uncertainty  standard uncertainty of the numbers, relative to their scale
    scales       error scales by name, in addition to the contact radius
    across       semi-axis of the contact along y; None if the contact is round [length]
    equations    governing equations of the answer, in LaTeX
    """

    scene: Scene
    ends: tuple[Any, ...]
    radius: float
    source: str
    kind: ReferenceKind = ReferenceKind.CLOSED_FORM
    uncertainty: float = ROUNDING
    scales: Mapping[str, float] = field(default_factory=dict)
    across: float | None = None
    equations: tuple[str, ...] = ()

    def scale(self, name: str) -> float:
        """Return the number by which errors with the given name of their scale are divided.

        Raises KeyError for an unknown name.
        """
        return self.radius if name == OVER_RADIUS else self.scales[name]

    def on_surface(self, exact: Callable[..., Field], x: Field, y: Field | float) -> Field:
        """Evaluate an exact field, such as the pressure, at points of the surface.

        exact  function of the distance from the axis, or of x and y if the contact is not round
        x, y   coordinates of the points [length]
        """
        return exact(np.hypot(x, y)) if self.across is None else exact(x, y)

    def reference(self, value: float, scale: float | None = None) -> Reference:
        """Create the reference for a number of the exact answer, with the uncertainty of the
        problem.

        value  exact number
        scale  magnitude to which the uncertainty is relative; None: the value
        """
        uncertainty = self.uncertainty * abs(value if scale is None else scale)
        return Reference(value, self.kind, self.source, uncertainty)


@dataclass(frozen=True, eq=False)
class TabulatedContact:
    """Hold a reference contact from a table: numbers, and tractions at a few radii.

    row  row of the table; its numbers are relative to the Hertz contact of the substrate
    """

    row: Mapping[str, Any]

    @property
    def contact_radius(self) -> float:
        """Contact radius from the reference table [length]."""
        return float(self.row["a_over_aH"]) * HERTZ.contact_radius

    @property
    def approach(self) -> float:
        """Approach of the bodies since first touch, from the reference table [length]."""
        return float(self.row["delta_over_deltaH"]) * HERTZ.approach

    @property
    def friction(self) -> float:
        """Coefficient of friction µ of the tabulated contact."""
        return float(self.row["mu"])

    @property
    def radii(self) -> Field:
        """Distances from the axis at which the tractions are tabulated [length]."""
        return np.array(self.row["r_over_a"]) * self.contact_radius

    def pressure(self, r: Field) -> Field:
        """Interpolate the pressure of the reference table linearly to radii r [force/length²]."""
        return np.interp(r, self.radii, np.array(self.row["p_over_pH"]) * HERTZ.peak_pressure)

    def shear(self, r: Field) -> Field:
        """Interpolate the radial shear of the reference table linearly to radii r [force/length²].

        Positive shear points outwards.
        """
        limit = self.friction * HERTZ.peak_pressure
        return np.interp(r, self.radii, np.array(self.row["q_over_mu_pH"]) * limit)
