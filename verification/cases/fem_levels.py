"""Meshes of the finite-element cases, and how their figures follow from the ones asked for."""

from verification.judging.case import Level
from verification.judging.ladder import ASKED_AT, MIDDLE

# Several meshes below the finest, for the order of convergence; no two are alike at the edge.
_LEVELS = {
    Level.QUICK: (12, 16, 22, 32),
    Level.STANDARD: (12, 16, 22, 32, 45, 64),
    Level.FULL: (16, 22, 32, 45, 64, 90, 128),
}
PER_OCTAVE, OCTAVES = 5, 2.4
# Where in its element the edge of the contact lies on each mesh: all values depend on it, and only
# their root mean square falls with a power of the element.
PLACES = (0.1, 0.3, MIDDLE, 0.7, 0.9)


def levels(level: Level) -> tuple[int, ...]:
    """Elements per radius, coarse to fine."""
    return _LEVELS[level]


def order_levels(level: Level, per_octave: int = PER_OCTAVE) -> tuple[tuple[int, float], ...]:
    """Elements per radius and place of the edge in its element."""
    steps = range(round(OCTAVES * per_octave), -1, -1)
    many = tuple(dict.fromkeys(round(ASKED_AT / 2 ** (n / per_octave)) for n in steps))
    meshes = _LEVELS[level] if level is Level.QUICK else many
    return tuple((n, place) for n in meshes for place in PLACES)


def finest(level: Level) -> int:
    """Of the meshes of a level."""
    return _LEVELS[level][-1]


def because(order: float) -> str:
    """The reason that goes with `asked`."""
    return (
        f"asked of the finite elements at {ASKED_AT} per radius; on other meshes what the order "
        f"{order:g} makes of it"
    )
