"""What became of one cell."""

from __future__ import annotations

from enum import StrEnum

from verification.running.row import CaseRecord, TypedRow, parameters_of
from verification.studies.stability.cell import StabilityCell


class Verdict(StrEnum):
    """How a cell ended."""

    CONVERGED = "converged"
    REFUSED = "refused"  # with a reason that the scene itself gives
    NOT_CONVERGED = "not converged"  # the solver says so
    SILENT = "silent"  # an answer that breaks the equations, given as if it were good


class Refusal(StrEnum):
    """What a cell is refused for."""

    NONE = ""
    FORCE = "force"  # above µW
    POSE = "pose"  # a scene that the solver has no model of
    OTHER = "other"


class CellRecord(TypedRow):
    """Verdict, residuals and cost of one cell."""

    verdict: Verdict
    refused_for: Refusal = Refusal.NONE
    reason: str = ""
    """Name and message of the error; empty where it converged."""

    tolerance: float
    residual: float | None = None
    """Largest residual of any increment, as the solver states it."""

    observed: float | None = None
    """Largest residual of any increment, found from its fields alone."""

    increments: int = 0
    halvings: int = 0
    """How often increments were cut in two."""

    rounds: int = 0
    """Most steps of any increment for pressure and shear together."""

    way: str = ""
    """How it was solved."""

    iterations: int = 0
    """Linear systems of finite elements, else steps of conjugate gradients."""

    convolutions: int = 0
    """None with finite elements."""

    def of_cell(self, cell: StabilityCell) -> CaseRecord:
        """As it is kept."""
        return CaseRecord(**dict(self.row()) | {"parameters": parameters_of(cell)})

    @property
    def work(self) -> int:
        """What the cell took: convolutions on a surface grid, linear systems on a section."""
        return self.convolutions or self.iterations

    @property
    def worst(self) -> float | None:
        """The larger of the two residuals."""
        known = [r for r in (self.residual, self.observed) if r is not None]
        return max(known, default=None)
