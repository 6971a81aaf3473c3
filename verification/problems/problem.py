"""A problem whose answer is known: what is solved, and who says what comes out."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from contact_scene import Scene
from verification.problems.reference import ROUNDING, Reference, ReferenceKind

Field = NDArray[np.float64]
OVER_RADIUS, OVER_PEAK = "the contact radius", "p_H"


@dataclass(frozen=True)
class Problem:
    """A scene and its answer.

    ends         exact answer at the end of every loading step: records whose attributes are called
                 like the quantities of a result, fields being functions of the distance from the
                 axis, or of x and y where the contact is not round
    radius       of the contact, or its semi-axis along x [length]
    source       who vouches for the answer
    scales       what errors may be relative to, by name, beside the contact radius
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
        """What errors are divided by; raises KeyError for a name that is not known."""
        return self.radius if name == OVER_RADIUS else self.scales[name]

    def on_surface(self, exact: Callable[..., Field], x: Field, y: Field | float) -> Field:
        """A field of the answer at positions on the surface [length]."""
        return exact(np.hypot(x, y)) if self.across is None else exact(x, y)

    def reference(self, value: float, scale: float | None = None) -> Reference:
        """A number of the answer, uncertain relative to itself or to the scale of its errors."""
        uncertainty = self.uncertainty * abs(value if scale is None else scale)
        return Reference(value, self.kind, self.source, uncertainty)

    def no_error(self, scale: float) -> Reference:
        """Reference of the norm of an error: zero, as uncertain as the answer is."""
        return Reference(0.0, self.kind, self.source, self.uncertainty * scale)
