"""Grids of a refinement study."""

PER_OCTAVE = 5


def refinement(coarsest: int, finest: int) -> tuple[int, ...]:
    """Even counts of cells per side, five per doubling, down from the finest.

    Many levels that are not multiples of each other: how a round contact cuts the cells differs
    from grid to grid, and only many grids tell that scatter from the order of convergence.
    """
    counts = []
    number = 0
    while (cells := 2 * round(finest * 2 ** (-number / PER_OCTAVE) / 2)) >= coarsest:
        counts.append(cells)
        number += 1
    return tuple(reversed(counts))
