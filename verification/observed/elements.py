"""States of the contact surface from finite element results, for the evaluation of the laws.

The stated gap contains no overlap (penetration of a penalty method). Gap and relative motion are
therefore computed again from the tractions. After an augmentation of a penalty the pressure at a
Gauss point is p = ⟨λ + εv⟩, with v the overlap and λ the pressure of the preceding pass, which the
result does not contain. For every λ ≥ 0 the overlap is at most p/ε. With λ = p - εv the change of
the shear between the passes is at most the sum of the friction limits of p and λ.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from contact_scene import IsotropicMaterial
from fem_reference import Increment, Path, Result
from verification.observed.contact_state import BISECTED, UNDEFINED, Balance, ContactState
from verification.observed.rings import Rings

Field = NDArray[np.float64]


def states_on_elements(result: Result) -> list[ContactState]:
    """Compute the states of the contact surface in all increments of a finite element result.

    Raises ValueError for an augmented penalty with harmonics: the result does not contain the
    deformation of the contact springs.
    """
    last = result.increments[-1]
    penalty, harmonics = last.overlap is not None, result.plan.path is Path.HARMONICS
    if penalty and harmonics and any(i.augmentations for i in result.increments):
        raise ValueError("springs on harmonics were augmented: take augmentations = 0")
    rings = Rings.of(result, on_points=penalty and not harmonics)
    element = last.radii[1] - last.radii[0] if harmonics else float(rings.model.radii[2])
    give = 1 / _spring_stiffness(result, element) if penalty else 0.0
    return [_state(increment, rings, result, give) for increment in result.increments]


def _spring_stiffness(result: Result, element: float) -> float:
    """Compute the penalty stiffness ε = c E*/h with E* of the outermost materials [force/length^3].

    element  length h of a contact edge of an element [length]
    """
    softness = 0.0
    for body in (result.scene.body, result.scene.indenter):
        outermost = body.layers[0].material if body.layers else body.material
        if isinstance(outermost, IsotropicMaterial):
            softness += (1 - outermost.poisson_ratio**2) / outermost.young_modulus
    return result.discretisation.penalty / (softness * element)


def _state(increment: Increment, rings: Rings, result: Result, give: float) -> ContactState:
    p, q = rings.on_grid(increment.pressure), rings.vector(increment, "shear")
    along, u_z = rings.displacement(p, q)
    if result.plan.path is Path.HARMONICS:  # springs that are known exactly are part of the bodies
        along, u_z, give = along + give * q, u_z + give * p, 0.0
    force, motion = _load(increment, result)
    if motion is None and force == 0.0:
        motion = 0.0
    w, friction, depth = rings.weights, rings.model.friction, abs(increment.approach)
    limit, stretched = friction.limit(p), rings.stretched(increment)
    gap, driven = rings.undeformed + u_z - increment.approach, rings.driven
    apart = np.where(p > 0, 0.0, gap)
    stated = [float(np.max(np.abs(apart - rings.on_grid(increment.gap))) / depth)]
    loose: Field | float = 0.0
    if give:
        assert increment.overlap is not None
        overlap = float(np.max(np.abs(gap), where=p > 0, initial=0.0))
        stated.append(abs(overlap - increment.overlap) / depth)
        loose = (limit + friction.limit(np.maximum(p + gap / give, 0.0))) * give
    most = float(np.sum(w * limit * np.hypot(*driven))) or float(np.sum(w * limit))
    balances = [Balance(rings.integral(p), increment.normal_force, increment.normal_force)]
    if most:
        balances.append(Balance(float(np.sum(w * driven * q)), force, most))
    slip, passed = rings.vector(increment, "slip"), along + stretched - (motion or 0.0) * driven
    if increment.angles is None and result.plan.path is not Path.SHEARING and not give:
        passed[:, 0] = slip[:, 0]  # on the axis there is neither shear nor slip
    undefined = motion is None or (bool(np.any(q)) and increment.dissipated_energy is None)
    skipped = BISECTED if increment.halvings else UNDEFINED if undefined else ""
    strain = 0.0 if increment.bulk_strain is None else increment.bulk_strain[0]
    return ContactState(
        increment, w, rings.undeformed, p, gap, q, limit, slip, None if undefined else passed,
        np.array([increment.normal_force, force, float(np.sum(w * q[0] * rings.arms[:, None]))]),
        np.array([increment.approach, motion or 0.0, -strain]), depth, tuple(balances),
        tuple(stated), give, loose, unseen=skipped, open=skipped,
    )  # fmt: skip


def _load(increment: Increment, result: Result) -> tuple[float, float | None]:
    """Return the force and the shift along the tangential load, or in torsion the torque and the
    twist.

    The shift or twist is None if it is undefined.
    """
    if result.plan.path is Path.TWISTING:
        return increment.torque or 0.0, increment.twist
    direction, shift = result.plan.direction, increment.tangential_shift
    force = float(np.dot(increment.tangential_force or (0.0, 0.0), direction))
    return force, None if shift is None else float(np.dot(shift, direction))
