"""The law of the pressure at its edge that the bodies of a scene call for."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from contact_scene import Body
from semi_analytical.edge.film import FilmLaw
from semi_analytical.frf.stack import Stack, stack_of
from semi_analytical.frf.surface import remainder_scalars

Field = NDArray[np.float64]

# Sides of a cell: an outermost layer that is thicker is a half-space to the few cells of an edge.
THICK = 16.0
# Of X from 1, below which layers are told from nothing by no edge.
LEAST_CONTRAST = 1e-3
SAMPLED = np.geomspace(1e-3, 10.0, 41)


def film_law(lower: Body, upper: Body, spacing: tuple[float, float]) -> FilmLaw | None:
    """That of the layers on both; None where the pressure goes like a root over a few cells, and on
    a rigid base, over which long waves do not reach.

    spacing  cell sides [length]
    """
    stacks = [stack_of(body) for body in (lower, upper) if body.deforms]
    layered = [stack for stack in stacks if stack.layers]
    if not layered or any(stack.base is None for stack in layered):
        return None
    thickness = min(stack.layers[0].thickness for stack in layered)
    if thickness > THICK * max(spacing):
        return None
    unit = sum(map(_compliance, stacks))

    def response(k: Field) -> Field:
        alpha = k / thickness
        return np.asarray(
            1 + alpha / unit * np.sum([remainder_scalars(s, alpha).c22 for s in layered], axis=0)
        )

    if np.max(np.abs(response(SAMPLED) - 1)) < LEAST_CONTRAST:
        return None
    return FilmLaw(response, (spacing[0] / thickness, spacing[1] / thickness))


def _compliance(stack: Stack) -> float:
    """k F_zz of its outermost material [length²/force]."""
    outer = stack.outer
    return (1 - outer.poisson_ratio) / outer.shear_modulus
