"""T_fs with everything that is known about its error."""

from __future__ import annotations

from dataclasses import dataclass
from math import sqrt

from verification.studies.sliding.full_slip import FullSlip, full_slip
from verification.studies.sliding.path import SlidingPath


@dataclass(frozen=True)
class Evidence:
    """The same history on the finest grid, on cells twice as large, and with halved steps.

    base, coarse  finest grid, and half its cells along each side
    half_shift    finest grid, steps half as large in shift
    half_normal   half the cells, normal steps half as large
    """

    base: SlidingPath
    coarse: SlidingPath
    half_shift: SlidingPath
    half_normal: SlidingPath

    @property
    def paths(self) -> tuple[SlidingPath, ...]:
        """All of them."""
        return self.base, self.coarse, self.half_shift, self.half_normal


@dataclass(frozen=True)
class Estimate:
    """T_fs / µW from the finest computation, and what each refinement changed.

    full_slip           with the bar of the extrapolation (half a cell of stick radius, scatter)
    by_cells            change from half the cells to all
    by_shift_steps      change by halving the steps in shift
    by_normal_steps     change by halving the normal steps
    """

    full_slip: FullSlip
    by_cells: float
    by_shift_steps: float
    by_normal_steps: float

    @property
    def force(self) -> float:
        """T_fs / µW."""
        return self.full_slip.force

    @property
    def uncertainty(self) -> float:
        """Root of the sum of squares of all four."""
        parts = (
            self.full_slip.uncertainty, self.by_cells, self.by_shift_steps, self.by_normal_steps
        )  # fmt: skip
        return sqrt(sum(part**2 for part in parts))

    @property
    def text(self) -> str:
        """Force and bar for people."""
        return f"{self.force:.3f} ± {max(self.uncertainty, 0.001):.3f}"


def estimate(evidence: Evidence) -> Estimate | None:
    """T_fs of a contact; None if one of the computations does not resolve it."""
    base, coarse, half_shift, half_normal = (full_slip(path) for path in evidence.paths)
    if base is None or coarse is None or half_shift is None or half_normal is None:
        return None
    return Estimate(
        half_shift,
        by_cells=abs(base.force - coarse.force),
        by_shift_steps=abs(half_shift.force - base.force),
        by_normal_steps=abs(half_normal.force - coarse.force),
    )
