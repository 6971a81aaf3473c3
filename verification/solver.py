"""By what a run is solved, for those who need not import it."""

from enum import StrEnum


class Solver(StrEnum):
    """The three solvers."""

    CELLS = "semi-analytical"
    ELEMENTS = "finite elements"
    RADII = "radial"


class Method(StrEnum):
    """How finite elements enforce contact and friction, by the names of `fem_reference.Method`."""

    COMPLEMENTARITY = "complementarity"
    PENALTY = "penalty"
