"""What a shear is within the cells at the edge of a contact where bodies couple: what the pressure
is there, times the ratio of the two."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import correlate1d

from semi_analytical.edge.displacement import Within
from semi_analytical.edge.rim import Rim
from semi_analytical.edge_correction.shear import BESIDE

Field = NDArray[np.float64]
VectorField = NDArray[np.float64]
WithinVector = tuple[Within, Within]

# Of the largest pressure, below which a cell does not tell the ratio of shear to pressure.
TOLD = 0.02
# Of cells outwards from there that have the ratio of those beside: more than a rim has.
LAYERS = 4


def shear_over_pressure(p: Field, q: VectorField) -> VectorField:
    """q/p (2, nx, ny), where there is little pressure that of the cells beside, layer by layer."""
    told = p > TOLD * np.max(p)
    ratio = np.where(told, q / np.where(told, p, 1.0), 0.0)
    for _ in range(LAYERS):
        count, *about = (_sum_about(field) for field in (told.astype(float), *ratio))
        new = ~told & (count > 0.5)
        ratio = np.where(new, about / np.where(new, count, 1.0), ratio)
        told |= new
    return ratio


def _sum_about(field: Field) -> Field:
    beside = correlate1d(field, BESIDE, 0, mode="constant")
    return np.asarray(correlate1d(beside, BESIDE, 1, mode="constant"))


def shear_within(q: VectorField, p: Field, by_p: Within, edge: Rim) -> WithinVector:
    """What a shear is within the cells: along the edge the pressure times the ratio of the two,
    elsewhere central differences."""
    x, y = (
        _times(r, q_k, p, by_p, edge) for r, q_k in zip(shear_over_pressure(p, q), q, strict=True)
    )
    return x, y


def _times(ratio: Field, q: Field, p: Field, by_p: Within, edge: Rim) -> Within:
    slopes = np.stack(list(np.gradient(q))) * (p > 0)
    along_edge = ratio * by_p.slopes + p * np.stack(list(np.gradient(ratio)))
    slopes[:, edge.i, edge.j] = along_edge[:, edge.i, edge.j]
    return Within.summed(slopes, [(ratio, by_p)])
