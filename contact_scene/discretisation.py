"""How fine the semi-analytical solver shall be: the table `[semi_analytical]`."""

from typing import Annotated

from contact_scene.description import Description
from contact_scene.quantity import PositiveLength, Tolerance
from contact_scene.whole_number import WholeNumber

Cells = Annotated[int, WholeNumber(8, 16384)]


class SurfaceDiscretisation(Description):
    """Cells and window of the surface, and the tolerance of the solver."""

    cells: tuple[Cells, Cells] | None = None
    """Number of cells along x and y; absent: chosen. Whether they fit into memory is the solver's
    to say."""

    window: tuple[PositiveLength, PositiveLength] | None = None
    """Lengths of the window along x and y, centred on the origin [length]; absent: chosen."""

    tolerance: Tolerance = 1e-8
    """Bound of every dimensionless residual at the end of an increment."""
