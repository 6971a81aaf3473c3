"""Names of the solvers and contact methods, for modules that must not import the solvers."""

from enum import StrEnum


class Solver(StrEnum):
    """Name of one of the three contact solvers: cells, finite elements or radial."""

    CELLS = "semi-analytical"
    ELEMENTS = "finite elements"
    RADII = "radial"


class Method(StrEnum):
    """Name of the method by which finite elements enforce contact and friction laws.

    The values are those of `fem_reference.Method`.
    """

    COMPLEMENTARITY = "complementarity"
    PENALTY = "penalty"
