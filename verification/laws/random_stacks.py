"""Random layered bodies and wave vectors over the range that the FRFs claim."""

import numpy as np
from numpy.random import Generator

from semi_analytical.frf.stack import Film, HalfSpace, Stack

SPECIAL_RATIOS = (0.0, 0.3, 0.5)


def decades(rng: Generator, low: float, high: float) -> float:
    """A number between two powers of ten, every decade alike."""
    return float(10 ** rng.uniform(low, high))


def half_space(rng: Generator) -> HalfSpace:
    """Any material: contrasts to 1e6, ν from -0.95 to exactly one half."""
    ratio = rng.choice(SPECIAL_RATIOS) if rng.random() < 0.3 else rng.uniform(-0.95, 0.5)
    return HalfSpace(decades(rng, -3, 3), float(ratio))


def film(rng: Generator) -> Film:
    """Any layer."""
    return Film(*half_space(rng), decades(rng, -2, 2))


def stack(rng: Generator, most_layers: int = 5) -> Stack:
    """One to five layers on a half-space or, one time in four, on a rigid base."""
    films = [film(rng) for _ in range(rng.integers(1, most_layers, endpoint=True))]
    return Stack(films, None if rng.random() < 0.25 else half_space(rng))


def wave_vector(rng: Generator) -> tuple[float, float]:
    """Any direction, wavenumbers from 1e-4 to 1e4."""
    alpha, angle = decades(rng, -4, 4), rng.uniform(-np.pi, np.pi)
    return float(alpha * np.cos(angle)), float(alpha * np.sin(angle))
