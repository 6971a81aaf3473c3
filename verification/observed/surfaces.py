"""What the semi-analytical method returns, against the laws: from its fields and nothing else."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from contact_scene.friction import FRICTIONLESS, CoulombFriction
from semi_analytical import Increment, Result
from verification.observed.imbalance import largest_of
from verification.observed.prescribed import missed
from verification.observed.unseen import is_corrected

Field = NDArray[np.float64]

# Slip is judged relative to the approach where there is hardly any.
LEAST_SLIP = 1e-3
# Where the border of stick is not fitted, the shear follows the corrected pressure in the cells
# along the edge, about a tenth of the contact, and carries the force to the change in these.
BORDER = 10.0
INNER = 0.1  # of the change, to which the solves of the correction end


def surface_violation(result: Result) -> float:
    """The largest violation of a law in any increment, dimensionless; infinite if a number is not
    finite.

    With corrected edges, complementarity and the forces hold to the last change of the
    correction: these violations are relative to that change over the tolerance. Slip is that before
    the correction, and is not compared.
    """
    place = _Place.of(result)
    befores: list[Increment | None] = [None, *result.increments]
    pairs = zip(befores, result.increments, strict=False)
    found = [v for before, now in pairs for v in _violations(before, now, place)]
    found += missed(result.scene, result.steps)
    return largest_of(found)


@dataclass(frozen=True)
class _Place:
    """Where the fields are.

    friction   its law
    tolerance  of the solve
    """

    x: Field
    y: Field
    cell_area: float
    friction: CoulombFriction
    tolerance: float

    def eased(self, now: Increment, times: float = 1.0) -> float:
        """Tolerance over that of corrected fields."""
        return self.tolerance / max(self.tolerance, times * (now.edge_change or 0.0))

    @classmethod
    def of(cls, result: Result) -> _Place:
        grid, friction = result.grid, result.scene.friction or FRICTIONLESS
        x, y = grid.coordinates()
        on_cells = friction.on(grid.cells, grid.spacing)
        return cls(x, y, grid.cell_area, on_cells, result.tolerance)


def _violations(before: Increment | None, now: Increment, place: _Place) -> Iterator[float]:
    p, delta = now.pressure, now.approach
    open_gap = np.where(np.isposinf(now.gap), 0.0, now.gap)
    # A tilted indenter may touch while its axis stands higher than at first touch.
    scale = float(np.max(np.abs(_tilted(now, place)), initial=abs(delta)))
    yield float(np.max(-p) / np.max(p))
    yield float(np.max(-open_gap) / scale)
    yield place.eased(now) * float(np.sum(p * np.abs(open_gap)) / (np.sum(p) * scale))
    missing = abs(np.sum(p) * place.cell_area / now.normal_force - 1)
    yield float(missing) * place.eased(now, INNER)
    yield from _moments(now, place)
    limit = place.friction.limit(p)
    if now.shear is None:
        return
    q = now.shear
    if not np.any(limit):
        yield float(np.max(np.hypot(*q)) / np.max(p))
        return
    yield float(np.max(np.hypot(*q) - limit) / np.max(limit))
    assert now.tangential_force is not None
    carried = np.sum(q, axis=(1, 2)) * place.cell_area
    missing = np.hypot(*(carried - now.tangential_force)) / (np.sum(limit) * place.cell_area)
    fitted = now.edge_report is None or now.edge_report.border
    yield float(missing) * place.eased(now, INNER if fitted else BORDER)
    if now.slip is not None and now.dissipated_energy is not None:
        yield from _traces(before, now, place)
        # In an increment that was halved slip may have turned on the way.
        if now.halvings == 0 and not is_corrected(now):
            yield from _slip_violations(before, now, limit)


def _tilted(now: Increment, place: _Place) -> Field:
    """How far the indenter has come nearer at each place [length]."""
    phi_x, phi_y = (0.0, 0.0) if now.tilt is None else now.tilt
    return np.asarray((now.approach + phi_x * place.y + phi_y * place.x)[now.pressure > 0])


def _moments(now: Increment, place: _Place) -> Iterator[float]:
    """Σ p (y, x) = M and Σ (q_y x - q_x y) = M_z."""
    p, arm = now.pressure, np.hypot(place.x, place.y)
    if now.moment is not None:
        carried = np.array([np.sum(p * place.y), np.sum(p * place.x)]) * place.cell_area
        yield float(np.hypot(*(carried - now.moment)) / (np.sum(p * arm) * place.cell_area))
    limit = place.friction.limit(p)
    if now.torque is not None and now.shear is not None and np.any(limit):
        turned = np.sum(now.shear[1] * place.x - now.shear[0] * place.y) * place.cell_area
        yield float(abs(turned - now.torque) / (np.sum(limit * arm) * place.cell_area))


def _traces(before: Increment | None, now: Increment, place: _Place) -> Iterator[float]:
    """What slip leaves on the surface adds up to what is told of the whole."""
    assert now.dissipated_energy is not None
    if now.dissipation is None or now.slip_distance is None or now.slip is None:
        return
    most = max(now.dissipated_energy, float(np.finfo(float).tiny))
    yield abs(float(np.sum(now.dissipation)) * place.cell_area - now.dissipated_energy) / most
    way, slip = now.slip_distance, now.slip
    if before is not None and before.slip_distance is not None and before.slip is not None:
        way, slip = way - before.slip_distance, slip - before.slip
    longest = max(float(np.max(now.slip_distance)), float(np.finfo(float).tiny))
    direct = np.hypot(*slip)
    yield float(np.max(direct - way) / longest)  # no way is shorter
    if now.halvings == 0:
        yield float(np.max(np.abs(direct - way)) / longest)


def _slip_violations(before: Increment | None, now: Increment, limit: Field) -> Iterator[float]:
    """Slip opposes shear at its limit, and dissipates."""
    assert now.slip is not None
    assert now.shear is not None
    assert now.dissipated_energy is not None
    slip, lost = now.slip, now.dissipated_energy
    if before is not None and before.slip is not None and before.dissipated_energy is not None:
        slip, lost = slip - before.slip, lost - before.dissipated_energy
    work = limit * np.hypot(*slip)
    least = LEAST_SLIP * np.sum(limit) * abs(now.approach) * np.max(limit) / np.max(now.pressure)
    scale = max(float(np.sum(work)), float(least))
    yield float(np.sum(work + now.shear[0] * slip[0] + now.shear[1] * slip[1]) / scale)
    yield float(-lost / max(now.dissipated_energy, np.finfo(float).tiny))
