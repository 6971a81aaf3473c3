"""The first law by finite elements, from the tractions and motions that they return.

Displacements are worked out anew from the tractions. Between two states the work of the loads must
be what is stored more, what is dissipated and what the increment leaves open, as on a surface grid
(`surface_energy`). Springs of a penalty are a part of the increment's error: of the work p·dg they
take, and of slip that differs from the motion of the surfaces, nothing is stored or dissipated.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fem_reference import Increment
from verification.observed.imbalance import Imbalance

Field = NDArray[np.float64]


@dataclass(frozen=True)
class EnergeticState:
    """An increment as its energy sees it; q, passed and slip (components, points).

    weights     area of the points [length^2]
    stored      in the bodies, and in springs that obey no other law [force length]
    undeformed  gap before any load [length]
    limit       of friction [force/length^2]
    gap         what the motion of the indenter leaves between the surfaces [length]
    passed      motion of the body's particles past the indenter's since the start [length]; None
                where undefined
    slip        as it is told [length]; less than the motion where particles first met on the way
    yields      whether springs take up what is left of overlap and motion
    """

    told: Increment
    weights: Field
    stored: float
    undeformed: Field
    pressure: Field
    gap: Field
    shear: Field
    limit: Field
    passed: Field | None
    slip: Field
    yields: bool = False


def energy_missing(states: Sequence[EnergeticState]) -> Iterator[Imbalance]:
    """What any increment cannot account for, or tells otherwise, over the largest energy so far."""
    before, worked, lost = None, 0.0, 0.0
    largest = 0.0
    for number, state in enumerate(states, start=1):
        work, told = state.told.trapezoidal_work, state.told.dissipated_energy
        dissipated = told or 0.0
        if work is None or state.passed is None or (np.any(state.shear) and told is None):
            return  # the motion is undefined, and with it all that follows
        largest = max(largest, *(abs(e) for e in (state.stored, work, dissipated)))
        alone = state.told.elastic_energy
        if alone is not None and state.told.overlap is None:
            difference = alone - state.stored
            yield Imbalance(number, largest, difference, stored=state.stored, stated=alone)
        if state.told.halvings == 0:  # else there are states in between
            spent = work - worked, dissipated - lost
            for difference, terms in _missing(before, state, *spent):
                yield Imbalance(number, largest, difference, **terms)
        before, worked, lost = state, work, dissipated


def _missing(
    before: EnergeticState | None, after: EnergeticState, work: float, dissipated: float
) -> Iterator[tuple[float, dict[str, float]]]:
    start = before or _at_rest(after)
    assert start.passed is not None
    assert after.passed is not None
    w, p, q = after.weights, (start.pressure, after.pressure), (start.shear, after.shear)
    passed = after.passed - start.passed
    slipped, limits = after.slip - start.slip, start.limit + after.limit
    # Along the shear, which slip opposes, and as large as the mean of the limits; what parts may
    # have stuck until then, and loses half its shear at the start along its way.
    size = np.abs(np.hypot.reduce(q[1], axis=0))
    along = np.divide(q[1], size, out=np.zeros_like(q[1]), where=size > 0)
    lost = -0.5 * limits * np.sum(along * slipped, axis=0)
    parts = (p[0] > 0) & (p[1] == 0)
    lost[parts] = 0.5 * (np.hypot.reduce(q[0], axis=0) * np.hypot.reduce(slipped, axis=0))[parts]
    own = float(np.sum(w * lost))
    closing = 0.5 * w * (p[1] * start.gap - p[0] * after.gap)
    if after.yields:
        closing = closing + 0.5 * w * (p[0] * start.gap - p[1] * after.gap)
    else:
        # What gap is left in a lasting contact is missing.
        closing = closing[(p[0] > 0) != (p[1] > 0)]
    turning = -own - 0.5 * float(np.sum(w * (q[0] + q[1]) * passed))
    stored, unresolved = after.stored - start.stored, float(np.sum(closing)) + turning
    terms = {"work": work, "stored": stored, "dissipated": own, "unresolved": unresolved}
    yield work - stored - own - unresolved, terms
    yield dissipated - own, {"dissipated": own, "stated": dissipated}


def _at_rest(state: EnergeticState) -> EnergeticState:
    """Before first touch, on the points of a state."""
    nothing, still = np.zeros_like(state.pressure), np.zeros_like(state.shear)
    return EnergeticState(
        state.told, state.weights, 0.0, state.undeformed, nothing, state.undeformed, still, nothing,
        still, still,
    )  # fmt: skip
