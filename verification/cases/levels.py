"""Numbers of finite elements on the refinement levels, and reasons of tolerances of several
cases."""

from verification.judging.case import Level
from verification.judging.refinement_levels import (
    ASKED_AT,
    MIDDLE,
)

ASKED = "required of this scene by the project's accuracy targets"
EDGE = "order 1: the edge is known to a fraction of a cell; the cap is a tenth of a cell"
STAIRCASE = (
    "the rim is a staircase of cells with infinite pressure, which changes the effective radius "
    "of the punch by a fraction of a cell"
)
STICK_BORDER = "order 1: the border is known to a fraction of a cell; the cap is a fifth of a "
"cell"
SQUARE_ROOTS = "square-root edges of stick zone and contact"
ELEMENT_RADIUS = "accuracy target of the finite elements at 64 per radius"
PENALTY = "accuracy target of the finite elements with a penalty, at their default penalty"
IDENTITY = "an identity, in which nothing converges"
DERIVED = "tolerances are derived from the orders of hertz_point on equal grids"
JUDGED_BY = "on one discretisation: the orders of the method are judged in {}"

# Several meshes below the finest, for the order of convergence; each has another edge position.
_LEVELS = {
    Level.QUICK: (12, 16, 22, 32),
    Level.STANDARD: (12, 16, 22, 32, 45, 64),
    Level.FULL: (16, 22, 32, 45, 64, 90, 128),
}
PER_OCTAVE, OCTAVES = 5, 2.4
# Positions of the contact edge in its element on each mesh: all values depend on the position, and
# only their root mean square falls with a power of the element.
PLACES = (0.1, 0.3, MIDDLE, 0.7, 0.9)


def levels(level: Level) -> tuple[int, ...]:
    """Return the numbers of elements per contact radius for an amount of computation, coarse to
    fine."""
    return _LEVELS[level]


def order_levels(level: Level, per_octave: int = PER_OCTAVE) -> tuple[tuple[int, float], ...]:
    """Return the meshes from which orders of convergence are computed.

    Each mesh has a number of elements per contact radius, and a position of the contact edge in its
    element.

    per_octave  number of meshes per doubling of the number of elements
    """
    steps = range(round(OCTAVES * per_octave), -1, -1)
    many = tuple(dict.fromkeys(round(ASKED_AT / 2 ** (n / per_octave)) for n in steps))
    meshes = _LEVELS[level] if level is Level.QUICK else many
    return tuple((n, place) for n in meshes for place in PLACES)


def finest(level: Level) -> int:
    """Return the number of elements per contact radius of the finest mesh for an amount of
    computation."""
    return _LEVELS[level][-1]


def because(order: float) -> str:
    """Return the reason for a tolerance that is scaled from 64 elements per radius to other meshes.

    order  order of convergence by which the tolerance is scaled
    """
    return (
        f"accuracy target of the finite elements at {ASKED_AT} per radius; on other meshes "
        f"scaled by the order {order:g}"
    )
