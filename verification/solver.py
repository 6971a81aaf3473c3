"""Names of the solvers and contact methods, for modules that must not import the solvers."""

from enum import StrEnum


class Solver(StrEnum):
    """Name of one of the three solvers of this program."""

    CELLS = "semi-analytical"
    ELEMENTS = "finite elements"
    RADII = "radial"


class Method(StrEnum):
    """Method by which finite elements enforce contact and friction, as in
    `fem_reference.Method`."""

    COMPLEMENTARITY = "complementarity"
    PENALTY = "penalty"
