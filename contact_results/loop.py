"""Numbers of a load cycle as a fretting test has them, from forces and shifts of its increments.

All are along the largest change of the tangential force. Q* and δ are half ranges of force and
shift, δ* that of the actuator of a rig. δ_g is half the opening of the loop at the middle force.
A = E_d/4Q*δ* and the friction of the energy, µ_e = E_d/4Wδ_g, compare the energy per cycle E_d with
that of rectangular loops. Mindlin's loop reaches gross slip at E_d/4Q*δ = 1/5.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from contact_results.surface import Rings, Surface
from contact_scene.array_types import Vector
from contact_scene.friction import CoulombFriction
from contact_scene.quantities.summary import Regime

if TYPE_CHECKING:
    from contact_results.surface import Increment

# Of the normal force: less tangential force is round-off, and of the work of force over shift.
ROUND_OFF, NO_SLIP = 1e-9, 1e-9
AT_GROSS_SLIP = 0.2  # E_d/4Q*δ


def loop_numbers(
    path: Sequence[Increment], dissipated: float, friction: CoulombFriction | None, surface: Surface
) -> dict[str, Any]:
    """Numbers of a cycle by the names of `contact_scene.quantities.summary.Closed`.

    path        increments, from the one at whose end the cycle begins
    dissipated  energy per cycle [force length]
    """
    end = path[-1]
    numbers: dict[str, Any] = {"stick_centre": _stick_centre(end, surface)}
    sticks = all(np.any(increment.in_stick) for increment in path[1:])
    numbers["regime"] = Regime.PARTIAL_SLIP if sticks else Regime.GROSS_SLIP
    given = [increment.tangential_force for increment in path]
    force = np.array([(0.0, 0.0) if pair is None else pair for pair in given], dtype=float)
    changes = force - force[0]
    furthest = changes[np.argmax(np.hypot(*changes.T))]
    size = float(np.hypot(*furthest))
    if size <= ROUND_OFF * end.normal_force:
        return numbers
    along = furthest / size
    forces, shifts = force @ along, _along(path, "tangential_shift", along)
    assert shifts is not None
    actuated = _along(path, "actuator_shift", along)
    Q, shift, opening = _half_range(forces), _half_range(shifts), _opening(forces, shifts)
    moved = shift if actuated is None else _half_range(actuated)
    limit = friction.carried(end.normal_force) if friction else None
    if dissipated <= NO_SLIP * Q * shift:
        numbers["regime"] = Regime.STICK
    return numbers | {
        "force_amplitude": Q,
        "shift_amplitude": shift,
        "actuator_amplitude": None if actuated is None else moved,
        "loop_opening": opening,
        "energy_ratio": dissipated / (4 * Q * moved),
        "energy_friction": dissipated / (4 * end.normal_force * opening) if opening else None,
        "limit_share": Q / limit if limit else None,
        "gross_slip_share": dissipated / (4 * Q * shift * AT_GROSS_SLIP),
    }


def _along(path: Sequence[Increment], name: str, direction: Vector) -> Vector | None:
    """Component of a vector of all increments; None where they have none."""
    values = [getattr(increment, name) for increment in path]
    if any(value is None for value in values):
        return None
    return np.asarray(np.array(values, dtype=float) @ direction)


def _half_range(values: Vector) -> float:
    return float(np.ptp(values)) / 2


def _opening(forces: Vector, shifts: Vector) -> float:
    """Half the distance of the shifts at the middle force. Within a branch the shift is a smooth
    function of the force: cubic through the two increments on either side."""
    apart = forces - (np.max(forces) + np.min(forces)) / 2
    rises = np.sign(np.diff(apart))
    found = []
    for n in np.flatnonzero((apart[:-1] * apart[1:] <= 0) & (rises != 0)).tolist():
        first = n - int(n > 0 and rises[n - 1] == rises[n])
        last = n + 1 + int(n + 2 < len(apart) and rises[min(n + 1, len(rises) - 1)] == rises[n])
        x, y = apart[first : last + 1], shifts[first : last + 1]
        others = [np.delete(x, k) for k in range(len(x))]
        found.append(sum(y[k] * np.prod(o / (o - x[k])) for k, o in enumerate(others)))
    return _half_range(np.array(found))


def _stick_centre(end: Increment, surface: Surface) -> tuple[float, float] | None:
    """Centre of the stick zone at the end of the cycle [length]; None without one."""
    stick = surface.scalar(end, "in_stick")
    if stick is None or not np.any(stick):
        return None
    weights = surface.weights * stick
    x, y = (float(np.sum(weights * place) / np.sum(weights)) for place in surface.positions)
    x, y = (0.0 if abs(place) <= ROUND_OFF * end.contact_radius else place for place in (x, y))
    if isinstance(surface, Rings) and not surface.whole:  # the other half is the mirror image
        c, s = surface.direction
        ahead = 0.0 if surface.angles is None else c * x + s * y
        x, y = c * ahead, s * ahead
    return x, y
