"""Discretisation settings of each solver: the tables `[semi_analytical]`, `[fem_reference]` and
`[radial]` of a scene file."""

from typing import Annotated, Any, Literal

from pydantic import Discriminator, Tag

from contact_scene.reading.description import Description
from contact_scene.reading.quantity import (
    PositiveLength,
    Quantity,
    Tolerance,
    WholeNumber,
)
from contact_scene.reading.units import PURE_NUMBER

# Default of `SurfaceDiscretisation.path_accuracy`: allowed relative increment error of the shear.
PATH_ACCURACY = 1e-2

Cells = Annotated[int, WholeNumber(8, 16384)]
Elements = Annotated[int, WholeNumber(4, 512)]
Rings = Annotated[int, WholeNumber(8, 4096)]
Harmonics = Annotated[int, WholeNumber(2, 64)]
Augmentations = Annotated[int, WholeNumber(0, 100)]
BoxSize = Annotated[
    float, Quantity(PURE_NUMBER, "a number from 5 to 1e6", at_least=5.0, at_most=1e6)
]
PenaltyFactor = Annotated[
    float, Quantity(PURE_NUMBER, "a number from 0.01 to 1e4", at_least=0.01, at_most=1e4)
]
Overlap = Annotated[
    float, Quantity(PURE_NUMBER, "a number from 1e-8 to 100", at_least=1e-8, at_most=100.0)
]
PathAccuracy = Annotated[
    float, Quantity(PURE_NUMBER, "a number from 1e-4 to 1", at_least=1e-4, at_most=1.0)
]

# Increments at whose end the edge correction is applied.
EdgeCorrection = Literal["off", "last", "all"]


def _dimension(value: Any) -> str:
    return "<along x>" if isinstance(value, int | float | str) else "<along x and y>"


SurfaceCells = Annotated[
    Annotated[tuple[Cells, Cells], Tag("<along x and y>")] | Annotated[Cells, Tag("<along x>")],
    Discriminator(_dimension),
]
Window = Annotated[
    Annotated[tuple[PositiveLength, PositiveLength], Tag("<along x and y>")]
    | Annotated[PositiveLength, Tag("<along x>")],
    Discriminator(_dimension),
]


class SurfaceDiscretisation(Description):
    """Grid of surface cells, increments and tolerance of the semi-analytical solver."""

    cells: SurfaceCells | None = None
    """Number of cells along x and y; absent: chosen. The solver refuses numbers that exceed the
    available memory. Line contacts: one number, of strips along x."""

    window: Window | None = None
    """Side lengths of the window along x and y [length], centred on the origin; absent: chosen.
    Line contacts: one length, along x."""

    tolerance: Tolerance = 1e-8
    """Limit of every dimensionless residual at the end of an increment."""

    path_accuracy: PathAccuracy = PATH_ACCURACY
    """Allowed increment error of the shear at the end of a step, summed over the surface and
    relative to the sum of the friction limit. Sets the number of increments of steps without
    one."""

    edge: EdgeCorrection = "last"
    """Edge correction of tractions at the edges of contact and stick zone, where constant
    tractions per cell have an error of first order in the cell size. Applied at the end of each
    step ("last"), of each increment ("all"), or never ("off"). Omitted where no safe correction is
    available."""


class FiniteElementDiscretisation(Description):
    """Mesh of the axisymmetric section, penalty and tolerance of the finite-element solvers."""

    elements_per_radius: Elements = 32
    """Number of elements of equal side over the contact radius."""

    contact_radius: PositiveLength | None = None
    """Largest contact radius of the history [length], which the other numbers refer to; absent:
    estimated. Determines the mesh only: a larger contact is refused, a contact smaller than two
    thirds of the radius is solved again on a mesh for its radius."""

    box: BoxSize | None = None
    """Outer radius and depth of the section, in contact radii; absent: chosen, at least 100, more
    for thick or stiff layers."""

    mesher: Literal["tensor", "gmsh"] = "tensor"
    """Mesh generator: a graded grid of rectangles, or gmsh."""

    harmonics: Harmonics = 12
    """Highest angular harmonic, for a tangential load that is coupled with the pressure."""

    penalty: PenaltyFactor = 10.0
    """Stiffness of the penalty method against overlap and slip, in units of the contact modulus
    divided by the element size."""

    augmentations: Augmentations = 100
    """Largest number of updates of the multipliers per increment (augmented Lagrangian); 0: pure
    penalty method."""

    overlap: Overlap = 1e-3
    """Allowed overlap in the penalty method, relative to the displacement of the bodies. The
    multipliers are updated until the overlap is smaller; a larger final overlap is an error."""

    tolerance: Tolerance = 1e-8
    """Limit of every dimensionless residual at the end of an increment."""


class RadialDiscretisation(Description):
    """Output points and tolerance of the radial solver, which chooses its orders and points."""

    rings: Rings = 64
    """Number of output radii of the fields over the largest contact of the history, denser towards
    its edge. A contact that is solved on rings is output at these rings instead."""

    tolerance: Tolerance = 1e-10
    """Limit of every dimensionless residual at the end of an increment."""
