"""The laws of contact and friction, looked for in what a solver returns and nowhere else."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from semi_analytical import Increment

Field = NDArray[np.float64]

# Slip is judged relative to the approach where there is hardly any.
LEAST_SLIP = 1e-3


def observed(increments: Sequence[Increment], cell_area: float, friction: float | Field) -> float:
    """The largest violation in any increment, dimensionless; infinite if a number is not finite.

    cell_area  [length²]
    friction   µ, a number or (nx, ny)
    """
    befores: list[Increment | None] = [None, *increments]
    pairs = zip(befores, increments, strict=False)
    found = [v for before, now in pairs for v in _violations(before, now, cell_area, friction)]
    return max(found) if np.all(np.isfinite(found)) else float("inf")


def _violations(
    before: Increment | None, now: Increment, cell_area: float, friction: float | Field
) -> Iterator[float]:
    p, delta = now.pressure, now.approach
    open_gap = np.where(np.isposinf(now.gap), 0.0, now.gap)
    yield float(np.max(-p) / np.max(p))
    yield float(np.max(-open_gap) / delta)
    yield float(np.sum(p * np.abs(open_gap)) / (np.sum(p) * delta))
    yield float(abs(np.sum(p) * cell_area / now.normal_force - 1))
    limit = friction * p
    if now.shear is None or not np.any(limit):
        return
    q = now.shear
    yield float(np.max(np.hypot(*q) - limit) / np.max(limit))
    assert now.tangential_force is not None
    carried = np.sum(q, axis=(1, 2)) * cell_area
    yield float(np.hypot(*(carried - now.tangential_force)) / (np.sum(limit) * cell_area))
    # In an increment that was halved slip may have turned on the way.
    if now.slip is not None and now.dissipated_energy is not None and now.halvings == 0:
        yield from _slip_violations(before, now, limit)


def _slip_violations(before: Increment | None, now: Increment, limit: Field) -> Iterator[float]:
    """Slip opposes shear at its limit, and dissipates."""
    assert now.slip is not None
    assert now.shear is not None
    assert now.dissipated_energy is not None
    slip, lost = now.slip, now.dissipated_energy
    if before is not None and before.slip is not None and before.dissipated_energy is not None:
        slip, lost = slip - before.slip, lost - before.dissipated_energy
    work = limit * np.hypot(*slip)
    least = LEAST_SLIP * np.sum(limit) * now.approach * np.max(limit) / np.max(now.pressure)
    scale = max(float(np.sum(work)), float(least))
    yield float(np.sum(work + now.shear[0] * slip[0] + now.shear[1] * slip[1]) / scale)
    yield float(-lost / max(now.dissipated_energy, np.finfo(float).tiny))
