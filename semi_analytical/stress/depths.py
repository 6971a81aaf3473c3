"""Depths of displacements and stresses, and the layer to which each depth belongs."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from contact_scene import Body
from semi_analytical.frf.depth import Level
from semi_analytical.frf.stack import Stack, stack_of

# Relative distance within which a depth is taken as that of an interface.
ON_INTERFACE = 1e-9

# Default depths in contact radii, dense where the stress of a smooth contact varies most.
DEFAULT_DEPTHS = (*np.linspace(0.0, 1.0, 21), 1.125, 1.25, 1.5, 1.75, 2.0, 2.5, 3.0)
# Further depths in a base below layers that reach deeper, over the depth of the base.
BELOW_LAYERS = (1.25, 1.5, 2.0, 3.0)

NEIGHBOURS = 4
ON_SAMPLE = 1e-9  # of the spacing


def levels_of(stack: Stack, depths: Sequence[float | Level]) -> tuple[Level, ...]:
    """Convert depths to levels, which are depths with the index of their layer.

    A number at an interface means its upper side. Raises ValueError for a depth that is negative,
    not finite or in a rigid base, and for a level outside of its layer.

    stack   layers and base of the body
    depths  depths [length], or levels
    """
    return tuple(
        _check_level(stack, depth)
        if isinstance(depth, Level)
        else _level_at_depth(stack, float(depth))
        for depth in depths
    )


def interfaces(body: Body | Stack) -> tuple[tuple[Level, ...], ...]:
    """Return the two levels of each interface between materials of a body, upper side first.

    A level is a depth with the index of its layer. A rigid base has no lower side.

    body  body, or its layers and base
    """
    stack = _stack_of_body(body)
    pairs = []
    for k, depth in enumerate(_layer_bottoms(stack)):
        sides = (Level(depth, k), Level(depth, k + 1))
        on_rigid_base = stack.base is None and k + 1 == len(stack.layers)
        pairs.append(sides[:1] if on_rigid_base else sides)
    return tuple(pairs)


def default_depths(body: Body | Stack, contact_radius: float) -> tuple[Level, ...]:
    """Choose the default depths for stress output, from the surface to three contact radii.

    The depths include both sides of each interface, three depths within each layer, and four in the
    base below layers that reach deeper than three contact radii.

    body            body, or its layers and base
    contact_radius  length over which the tractions act [length]
    """
    stack = _stack_of_body(body)
    bottoms = _layer_bottoms(stack)
    floor = bottoms[-1] if stack.base is None else np.inf
    depths = [d * contact_radius for d in DEFAULT_DEPTHS if d * contact_radius < floor]
    for top, bottom in zip((0.0, *bottoms), bottoms, strict=False):
        # Layers thinner than the spacing of the depths are resolved.
        depths += [top + (bottom - top) * part for part in (0.25, 0.5, 0.75)]
    if bottoms and DEFAULT_DEPTHS[-1] * contact_radius < bottoms[-1] < floor:
        depths += [bottoms[-1] * part for part in BELOW_LAYERS]
    sides = [side for pair in interfaces(stack) for side in pair]
    near = 1e-6 * contact_radius
    between = [_level_at_depth(stack, d) for d in depths if all(abs(d - z) > near for z in bottoms)]
    return tuple(sorted({*between, *sides}, key=lambda level: (level.depth, level.layer)))


def _stack_of_body(body: Body | Stack) -> Stack:
    """Return the layers and base of a body."""
    return body if isinstance(body, Stack) else stack_of(body)


def _layer_bottoms(stack: Stack) -> tuple[float, ...]:
    """Return the depth of the underside of each layer of a body [length]."""
    return tuple(float(z) for z in np.cumsum([film.thickness for film in stack.layers]))


def _level_at_depth(stack: Stack, depth: float) -> Level:
    """Find the layer to which a depth belongs; a depth at an interface belongs to the upper layer.

    stack  layers and base of the body
    depth  depth below the surface [length]

    Raises ValueError for a depth that is negative, not finite, or in a rigid base.
    """
    if not (np.isfinite(depth) and depth >= 0):
        raise ValueError(f"depth is {depth}, expected a finite length >= 0 (the body is z >= 0)")
    bottoms = _layer_bottoms(stack)
    for layer, bottom in enumerate(bottoms):
        if abs(depth - bottom) <= ON_INTERFACE * bottom:
            return Level(bottom, layer)
        if depth < bottom:
            return Level(depth, layer)
    if stack.base is None:
        raise ValueError(
            f"depth {depth} lies in the rigid base, which begins at {bottoms[-1] if bottoms else 0}"
            ". Use smaller depths"
        )
    return Level(depth, len(bottoms))


def _check_level(stack: Stack, level: Level) -> Level:
    """Return a level if its depth is in its layer; else raise ValueError.

    stack  layers and base of the body
    level  depth with the index of its layer
    """
    bottoms = (0.0, *_layer_bottoms(stack), np.inf)
    last = len(stack.layers) if stack.base is not None else len(stack.layers) - 1
    if not 0 <= level.layer <= last:
        raise ValueError(f"{level} names a layer that does not exist; the deepest is {last}")
    top, bottom = bottoms[level.layer], bottoms[level.layer + 1]
    if not top <= level.depth <= bottom or not np.isfinite(level.depth):
        raise ValueError(f"{level} is outside of its layer, which extends from {top} to {bottom}")
    return level


def line_weights(samples: NDArray[np.float64], at: float) -> NDArray[np.float64]:
    """Compute the weights of cubic Lagrange interpolation between equally spaced samples.

    Displacements and stresses between cell centres are interpolated by these weights.

    samples  positions of the samples, equally spaced, increasing [length]
    at       position of the interpolated value [length]
    returns  shape of the samples, at most four not zero; fewer samples give a lower degree
    raises   ValueError outside the samples
    """
    weights = np.zeros(len(samples))
    spacing = samples[1] - samples[0] if len(samples) > 1 else 1.0
    place = (at - samples[0]) / spacing
    nearest = round(place)
    if not -ON_SAMPLE <= place <= len(samples) - 1 + ON_SAMPLE:
        raise ValueError(f"{at} is outside of the samples {samples[0]} to {samples[-1]}")
    if abs(place - nearest) <= ON_SAMPLE:
        weights[nearest] = 1.0
        return weights
    count = min(NEIGHBOURS, len(samples))
    first = int(np.clip(np.floor(place) - (count // 2 - 1), 0, len(samples) - count))
    for k in range(first, first + count):
        others = [m for m in range(first, first + count) if m != k]
        weights[k] = np.prod([(place - m) / (k - m) for m in others])
    return weights
