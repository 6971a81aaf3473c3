"""How fine each solver shall be: the tables `[semi_analytical]`, `[fem_reference]`, `[radial]`."""

from typing import Annotated, Literal

from contact_scene.reading.description import Description
from contact_scene.reading.quantity import (
    PositiveLength,
    Quantity,
    Tolerance,
    WholeNumber,
)
from contact_scene.reading.units import PURE_NUMBER

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

# At the end of which increments edges are put inside the cells.
EdgeCorrection = Literal["off", "last", "all"]


class SurfaceDiscretisation(Description):
    """Cells and window of the surface, and the tolerance of the solver."""

    cells: tuple[Cells, Cells] | None = None
    """Number of cells along x and y; absent: chosen. Whether they fit into memory is the solver's
    to say."""

    window: tuple[PositiveLength, PositiveLength] | None = None
    """Lengths of the window along x and y, centred on the origin [length]; absent: chosen."""

    tolerance: Tolerance = 1e-8
    """Bound of every dimensionless residual at the end of an increment."""

    path_accuracy: PathAccuracy = PATH_ACCURACY
    """Error of the shear that finite increments may leave at the end of a step, summed over the
    surface and relative to the friction limit. It sets the increments of steps that name none."""

    edge: EdgeCorrection = "last"
    """Whether tractions are put right at the edges of contact and stick, where constant on cells
    they are wrong by the order of a cell: at the end of each step ("last"), of each increment
    ("all"), or not at all ("off"); never where it is not known how, or not safe."""


class FiniteElementDiscretisation(Description):
    """Elements and size of the axisymmetric section, and the tolerance of the solver."""

    elements_per_radius: Elements = 32
    """Number of elements of equal side over the contact radius."""

    contact_radius: PositiveLength | None = None
    """Largest contact radius of the history, which the other numbers refer to [length]; absent:
    estimated. It lays out the mesh and does not decide the answer: a contact beyond it is refused,
    and one below two thirds of it is solved again on a mesh of its own."""

    box: BoxSize | None = None
    """Outer radius and depth of the section, in contact radii; absent: chosen, 100 and more where
    the layers are thick or stiff."""

    mesher: Literal["tensor", "gmsh"] = "tensor"
    """What makes the mesh: a graded grid of rectangles, or gmsh."""

    harmonics: Harmonics = 12
    """Highest angular harmonic where a tangential load and the pressure act on one another."""

    penalty: PenaltyFactor = 10.0
    """Stiffness of the penalty method against overlap and slip, in contact moduli per element."""

    augmentations: Augmentations = 100
    """How often the penalty method may correct its tractions in an increment; none leaves springs
    alone."""

    overlap: Overlap = 1e-3
    """Overlap that the penalty method may leave, relative to what the bodies move: it corrects its
    tractions until less is left, and is refused where more is left in the end."""

    tolerance: Tolerance = 1e-8
    """Bound of every dimensionless residual at the end of an increment."""

    def refined(self) -> "FiniteElementDiscretisation":
        """The same with twice the elements; ValueError beyond the bounds."""
        finer = {**self.model_dump(), "elements_per_radius": 2 * self.elements_per_radius}
        return FiniteElementDiscretisation.model_validate(finer)


class RadialDiscretisation(Description):
    """Where the radial solver shows its fields, and its tolerance; it needs no grid and chooses its
    orders and points itself."""

    rings: Rings = 64
    """Number of rings over the largest contact of the history, denser towards its edge, at which
    pressure and gap are told."""

    extrapolated: bool = False
    """Whether the history of a pushed contact is solved in twice the increments, too, and its
    scalars are told in the limit of fine increments; it takes three times as long."""

    tolerance: Tolerance = 1e-10
    """Bound of every dimensionless residual at the end of an increment."""
