"""Cubic interpolation between equally spaced samples."""

import numpy as np
from numpy.typing import NDArray

NEIGHBOURS = 4
ON_SAMPLE = 1e-9  # of the spacing


def line_weights(samples: NDArray[np.float64], at: float) -> NDArray[np.float64]:
    """Weights that give the value at a position: Lagrange's on the four samples around it.

    samples  equally spaced, increasing [length]
    returns  shape of the samples, few of them not zero; fewer samples give a lower degree
    raises   ValueError outside the samples
    """
    weights = np.zeros(len(samples))
    spacing = samples[1] - samples[0] if len(samples) > 1 else 1.0
    place = (at - samples[0]) / spacing
    nearest = round(place)
    if not -ON_SAMPLE <= place <= len(samples) - 1 + ON_SAMPLE:
        raise ValueError(f"{at} is outside of the samples, {samples[0]} to {samples[-1]}")
    if abs(place - nearest) <= ON_SAMPLE:
        weights[nearest] = 1.0
        return weights
    count = min(NEIGHBOURS, len(samples))
    first = int(np.clip(np.floor(place) - (count // 2 - 1), 0, len(samples) - count))
    for k in range(first, first + count):
        others = [m for m in range(first, first + count) if m != k]
        weights[k] = np.prod([(place - m) / (k - m) for m in others])
    return weights
