"""How fine the semi-analytical solver shall be: the table `[semi_analytical]`."""

from typing import Annotated

from pydantic import model_validator

from contact_scene.description import Description
from contact_scene.quantity import PositiveLength, Tolerance
from contact_scene.refusal import refusal
from contact_scene.whole_number import WholeNumber

MOST_CELLS = 2**26
Cells = Annotated[int, WholeNumber(8, 16384)]


class SurfaceDiscretisation(Description):
    """Cells and window of the surface, and the tolerance of the solver."""

    cells: tuple[Cells, Cells] | None = None
    """Number of cells along x and y; absent: chosen."""

    window: tuple[PositiveLength, PositiveLength] | None = None
    """Lengths of the window along x and y, centred on the origin [length]; absent: chosen."""

    tolerance: Tolerance = 1e-8
    """Bound of every dimensionless residual at the end of an increment."""

    @model_validator(mode="after")
    def _is_of_bounded_size(self) -> "SurfaceDiscretisation":
        if self.cells is not None and self.cells[0] * self.cells[1] > MOST_CELLS:
            raise refusal(
                f"got {self.cells[0]} x {self.cells[1]} cells", f"at most {MOST_CELLS} in all"
            )
        return self
