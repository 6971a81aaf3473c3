"""One Newton step of the penalty model: the linear system of tractions and rigid coordinates."""

import numpy as np
from numpy.typing import NDArray

from fem_reference.contact.penalty.spring_contact import Response
from fem_reference.contact.penalty.surface import ElasticSurface

Field = NDArray[np.float64]
Mask = NDArray[np.bool_]
Vector = NDArray[np.float64]


def newton_step(
    surface: ElasticSurface,
    stiffness: float,
    response: Response,
    missing: Field,
    unbalanced: Vector,
    free: Mask,
) -> tuple[Field, Vector]:
    """Changes of tractions (c, n) and coordinates (c,) that meet law and load to first order.

    With v = motion d − A D t − gap, A the compliance, D the weights and L = ∂t/∂v, the law
    t = t(v) becomes (I + L A D) dt − L motion dd = missing.

    stiffness   ε, by which the coordinates are scaled [force/length^3]
    missing     t(v) − t [force/length^2]
    unbalanced  load minus resultant, over 2π; read where the coordinate is free
    raises      LinAlgError
    """
    tangent = _resisting(surface, stiffness, response, free)
    # Apart from the contact the tangent is zero and the change of traction known.
    points = np.flatnonzero(np.any(tangent != 0, axis=(0, 1)))
    known = missing.copy()
    known[:, points] = 0.0
    traction = known.copy()
    coordinates = np.zeros(len(free))
    if len(points) == 0:
        return traction, coordinates
    L, weights = tangent[:, :, points], surface.weights[points]
    motion = surface.motion[:, points] / surface.lever[:, None]
    pushed = surface.displacement(known)[:, points]
    unbalanced = unbalanced - surface.resultant(known)
    right = missing[:, points] - np.einsum("ijg,jg->ig", L, pushed)
    coupled = np.einsum("ijg,jgkh->igkh", L, surface.compliance[:, points][:, :, :, points])
    size = right.size
    loose = np.flatnonzero(free)
    system = np.zeros((size + len(loose), size + len(loose)))
    system[:size, :size] = (coupled * weights).reshape(size, size)
    system[np.arange(size), np.arange(size)] += 1.0
    # Scaled so that all entries are pure numbers: coordinates as tractions, loads as mean ones.
    scale, area = surface.lever * stiffness, surface.lever * np.sum(weights)
    for column, component in enumerate(loose, start=size):
        system[:size, column] = -(L[:, component] * motion[component]).ravel() / stiffness
        share = weights * motion[component] / np.sum(weights)
        system[column, component * len(points) : (component + 1) * len(points)] = share
    solution = np.linalg.solve(
        system, np.concatenate([right.ravel(), unbalanced[loose] / area[loose]])
    )
    traction[:, points] = solution[:size].reshape(right.shape)
    coordinates[loose] = solution[size:] / scale[loose]
    return traction, coordinates


def _resisting(surface: ElasticSurface, stiffness: float, response: Response, free: Mask) -> Field:
    """The tangent, made elastic in a component whose free coordinate nothing resists.

    That is so where all points slip or are apart; the step would be infinite.
    """
    tangent, touching = response.tangent, response.in_contact
    if not np.any(touching):
        touching = np.ones_like(touching)
    for component in np.flatnonzero(free):
        if np.any(tangent[component, component] * surface.motion[component] != 0):
            continue
        tangent = tangent.copy()
        tangent[component, component] = stiffness * touching
    return tangent
