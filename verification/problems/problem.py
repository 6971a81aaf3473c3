"""Problems with a known answer: the scene, the reference and its source."""

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
    """Kind of source of a reference."""

    CLOSED_FORM = "closed form"
    SEMI_CLOSED = "semi-closed"
    THEORY = "theory"
    EXTERNAL_CODE = "external code"
    OTHER_SOLVER = "other solver"
    OWN_REFINEMENT = "own refinement"  # the same solver on a coarser discretisation
    IDENTITY = "identity"  # holds exactly by a theorem or by the equations themselves


@dataclass(frozen=True)
class Reference:
    """Number from another source than the run.

    uncertainty  standard uncertainty u_ref, in the unit of the value
    """

    value: float
    kind: ReferenceKind
    source: str
    uncertainty: float = 0.0


def closed_form(value: float, source: str, scale: float | None = None) -> Reference:
    """Return a closed form whose uncertainty is rounding, of its value or of the scale of the
    comparison."""
    uncertainty = ROUNDING * abs(value if scale is None else scale)
    return Reference(value, ReferenceKind.CLOSED_FORM, source, uncertainty)


def identity(value: float, source: str) -> Reference:
    """Return a value that follows from the equations."""
    return Reference(value, ReferenceKind.IDENTITY, source)


Field = NDArray[np.float64]
OVER_RADIUS, OVER_PEAK = "the contact radius", "p_H"


@dataclass(frozen=True)
class Problem:
    """Scene and its answer.

    ends         exact answer at the end of every load step: records with the attribute names of the
                 quantities of a result; fields are functions of the distance from the axis, or of x
                 and y where the contact is not round
    radius       of the contact, or its semi-axis along x [length]
    source       source of the answer
    scales       scales of errors by name, in addition to the contact radius
    uncertainty  of the numbers, relative to their scale
    across       semi-axis along y; None where the contact is round [length]
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
        """Return the scale of errors by name; raise KeyError for an unknown name."""
        return self.radius if name == OVER_RADIUS else self.scales[name]

    def on_surface(self, exact: Callable[..., Field], x: Field, y: Field | float) -> Field:
        """Evaluate a field of the answer at positions on the surface [length]."""
        return exact(np.hypot(x, y)) if self.across is None else exact(x, y)

    def reference(self, value: float, scale: float | None = None) -> Reference:
        """Return a number of the answer; its uncertainty is relative to the number or to the
        error scale."""
        uncertainty = self.uncertainty * abs(value if scale is None else scale)
        return Reference(value, self.kind, self.source, uncertainty)

    def no_error(self, scale: float) -> Reference:
        """Return the reference of an error norm: zero, with the uncertainty of the answer."""
        return Reference(0.0, self.kind, self.source, self.uncertainty * scale)


@dataclass(frozen=True, eq=False)
class TabulatedContact:
    """Tabulated numbers of a contact, with profiles at a few radii.

    row  of the reference: numbers relative to Hertz's contact of the substrate
    """

    row: Mapping[str, Any]

    @property
    def contact_radius(self) -> float:
        """[length]."""
        return float(self.row["a_over_aH"]) * HERTZ.contact_radius

    @property
    def approach(self) -> float:
        """[length]."""
        return float(self.row["delta_over_deltaH"]) * HERTZ.approach

    @property
    def friction(self) -> float:
        """µ."""
        return float(self.row["mu"])

    @property
    def radii(self) -> Field:
        """Distances from the axis at which profiles are given [length]."""
        return np.array(self.row["r_over_a"]) * self.contact_radius

    def pressure(self, r: Field) -> Field:
        """Interpolate the pressure linearly between the radii of the row [force/length²]."""
        return np.interp(r, self.radii, np.array(self.row["p_over_pH"]) * HERTZ.peak_pressure)

    def shear(self, r: Field) -> Field:
        """Interpolate the outward shear linearly between the radii of the row [force/length²]."""
        limit = self.friction * HERTZ.peak_pressure
        return np.interp(r, self.radii, np.array(self.row["q_over_mu_pH"]) * limit)

    def size_of_shear(self, r: Field) -> Field:
        """Return the absolute value of the shear [force/length²]."""
        return np.abs(self.shear(r))
