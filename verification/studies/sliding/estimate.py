"""T_fs with everything that is known about its error."""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot

from verification.studies.sliding.full_slip import FullSlip, full_slip
from verification.studies.sliding.path import SlidingPath


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
    def parts(self) -> tuple[float, ...]:
        """Of the bar."""
        return (
            self.full_slip.uncertainty, self.by_cells, self.by_shift_steps, self.by_normal_steps
        )  # fmt: skip

    @property
    def uncertainty(self) -> float:
        """Root of the sum of squares of all four."""
        return hypot(*self.parts)

    @property
    def text(self) -> str:
        """Force and bar for people."""
        return f"{self.force:.3f} ± {max(self.uncertainty, 0.001):.3f}"


def estimate(
    base: SlidingPath, coarse: SlidingPath, half_shift: SlidingPath, half_normal: SlidingPath
) -> Estimate | None:
    """T_fs of a contact; None if one of the computations does not resolve it.

    base, coarse  finest grid, and half its cells along each side
    half_shift    finest grid, steps half as large in shift
    half_normal   half the cells, normal steps half as large
    """
    found = [full_slip(path) for path in (base, coarse, half_shift, half_normal)]
    known = [fs for fs in found if fs is not None]
    if len(known) < len(found):
        return None
    on_base, on_coarse, by_shift, by_normal = (fs.force for fs in known)
    return Estimate(
        known[2],
        by_cells=abs(on_base - on_coarse),
        by_shift_steps=abs(by_shift - on_base),
        by_normal_steps=abs(by_normal - on_coarse),
    )
