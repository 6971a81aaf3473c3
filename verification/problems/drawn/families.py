"""The families of scenes that are drawn, and how many of each are judged."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from zlib import crc32

import numpy as np

from verification.problems.drawn import coated, coated_indented, homogeneous, refined
from verification.problems.drawn.drawing import Rng
from verification.problems.drawn.known_scene import KnownScene

# The scenes that set the rules are not those that judge them.
TRAINING, JUDGING = 1, 7


@dataclass(frozen=True)
class Family:
    """Scenes drawn alike.

    count  judged above the quick level, which takes one of each
    """

    draw: Callable[[Rng], KnownScene]
    count: int


FAMILIES = {
    "hertz": Family(homogeneous.hertz, 78),
    "shapes": Family(homogeneous.shapes, 8),
    "ellipse": Family(homogeneous.ellipse, 8),
    "cattaneo": Family(homogeneous.cattaneo, 36),
    "sliding": Family(homogeneous.sliding, 6),
    "twisted": Family(homogeneous.twisted, 6),
    "indented": Family(homogeneous.indented, 10),
    "coated": Family(coated.pressed, 120),
    "coated-stress": Family(partial(coated.pressed, stressed=True), 26),
    "coated-twisted": Family(coated.twisted, 140),
    "coated-sheared": Family(refined.sheared, 45),
    "coated-indented": Family(coated_indented.pressed, 40),
    "coated-pushed": Family(refined.coupled, 16),
    "sections": Family(partial(homogeneous.hertz, sections=True), 3),
    "sections-cattaneo": Family(partial(homogeneous.cattaneo, sections=True), 4),
    "sections-indented": Family(partial(homogeneous.indented, sections=True), 5),
    "sections-coated": Family(partial(coated.pressed, sections=True), 15),
    "sections-coated-twisted": Family(partial(coated.twisted, sections=True), 15),
}


def drawn(family: str, seed: int, number: int) -> KnownScene:
    """One scene of a family, the same at every call."""
    return FAMILIES[family].draw(np.random.default_rng([seed, crc32(family.encode()), number]))
