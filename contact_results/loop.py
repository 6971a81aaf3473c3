"""Numbers of one load cycle as in a fretting test, from forces and shifts of its increments.

Forces and shifts are components along the largest change of the tangential force. Symbols:

- Q* is half the range of the tangential force in the cycle,
- δ is half the range of the tangential shift, δ* that of the actuator of a test rig,
- δ_g is half the opening of the loop of force over shift, at the mean of the extreme forces,
- E_d is the energy lost to friction per cycle, W the normal force,
- A = E_d/4Q*δ* compares E_d with the energy of a rectangular loop,
- µ_e = E_d/4Wδ_g is the coefficient of friction of a rectangular loop with E_d and δ_g.

Mindlin's loop reaches gross slip at E_d/4Q*δ = 1/5.
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

# Round-off: of a tangential force relative to the largest normal force of the cycle, and of a
# motion relative to the largest approach or motion. Limit of a cycle without slip: dissipated
# energy relative to force amplitude times shift amplitude.
ROUND_OFF = 1e-9
NO_SLIP = 1e-9
AT_GROSS_SLIP = 0.2  # E_d/4Q*δ of Mindlin's loop at gross slip


def loop_numbers(
    path: Sequence[Increment], dissipated: float, friction: CoulombFriction | None, surface: Surface
) -> dict[str, Any]:
    """Compute the numbers of one load cycle: slip regime, amplitudes, energy ratios, stick centre.

    path        increments of the cycle, preceded by the increment at whose end the cycle begins
    dissipated  energy lost to friction in the cycle [force length]
    friction    friction law of the scene; None without friction
    surface     surface grid of the increments

    Returns the numbers by the names of `contact_scene.quantities.summary.ClosedCycle`. A ratio is
    None if its denominator is 0 or round-off, such as the energy ratio of a cycle at constant
    shift. A cycle with constant tangential force has only the regime and the stick centre.
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
    normal, approach = (
        max(abs(getattr(i, name) or 0.0) for i in path) for name in ("normal_force", "approach")
    )
    along = furthest / (size or 1.0)
    shifts = _components_along(path, "tangential_shift", along)
    if size <= ROUND_OFF * normal or shifts is None:
        if dissipated <= np.finfo(float).eps * normal * approach:
            numbers["regime"] = Regime.STICK
        return numbers
    actuated = _components_along(path, "actuator_shift", along)
    motions = shifts if actuated is None else actuated
    forces = force @ along
    Q, shift, opening = _half_range(forces), _half_range(shifts), _half_opening(forces, shifts)
    moved = _half_range(motions)
    limit = friction.largest_tangential_force(end.normal_force) if friction else None
    negligible = ROUND_OFF * max(approach, float(np.max(np.abs([shifts, motions]))))
    # Forces at constant shift: the surfaces move by about as much as under the normal force.
    if dissipated * normal <= NO_SLIP * Q * max(shift * normal, approach * Q):
        numbers["regime"] = Regime.STICK

    def share(force: float, length: float) -> float | None:
        """Compare the dissipated energy with that of a rectangular loop of these half ranges."""
        resolved = force > ROUND_OFF * normal and length > negligible
        return dissipated / (4 * force * length) if resolved else None

    of_gross_slip = share(Q, shift)
    return numbers | {
        "force_amplitude": Q,
        "shift_amplitude": shift,
        "actuator_amplitude": None if actuated is None else moved,
        "loop_opening": opening,
        "energy_ratio": share(Q, moved),
        "energy_friction": share(end.normal_force, opening),
        "limit_share": Q / limit if limit else None,
        "gross_slip_share": None if of_gross_slip is None else of_gross_slip / AT_GROSS_SLIP,
    }


def _components_along(path: Sequence[Increment], name: str, direction: Vector) -> Vector | None:
    values = [getattr(increment, name) for increment in path]
    if any(value is None for value in values):
        return None
    return np.asarray(np.array(values, dtype=float) @ direction)


def _half_range(values: Vector) -> float:
    return float(np.ptp(values)) / 2


def _half_opening(forces: Vector, shifts: Vector) -> float:
    """Compute half the opening of a fretting loop at the middle of its force range [length].

    The tangential shift is interpolated at each point where the loop passes the mean of the extreme
    forces. Within a branch of the loop the shift is a smooth function of the force. Therefore the
    interpolation is a cubic through the two increments on either side of the point, with fewer
    increments next to the end of a branch. It is a line between these two where the cubic leaves
    their range, as in gross slip, where the shift increases at a constant force. The result is half
    the range of the interpolated shifts.

    forces, shifts  tangential force and shift at the ends of the increments (n,)
    """
    apart = forces - (np.max(forces) + np.min(forces)) / 2
    rises = np.sign(np.diff(apart))
    found = []
    for n in np.flatnonzero((apart[:-1] * apart[1:] <= 0) & (rises != 0)).tolist():
        first = n - int(n > 0 and rises[n - 1] == rises[n])
        last = n + 1 + int(n + 2 < len(apart) and rises[min(n + 1, len(rises) - 1)] == rises[n])
        x, y = apart[first : last + 1], shifts[first : last + 1]
        others = [np.delete(x, k) for k in range(len(x))]
        cubic = sum(y[k] * np.prod(o / (o - x[k])) for k, o in enumerate(others))
        low, high = sorted(shifts[n : n + 2])
        line = shifts[n] + (shifts[n + 1] - shifts[n]) * apart[n] / (apart[n] - apart[n + 1])
        found.append(cubic if low <= cubic <= high else line)
    return _half_range(np.array(found))


def _stick_centre(end: Increment, surface: Surface) -> tuple[float, float] | None:
    """Compute the centroid (x, y) of the stick zone at the end of a load cycle [length].

    Coordinates that are round-off relative to the contact radius become 0. Returns None if no point
    of the contact sticks.
    """
    stick = surface.scalar(end, "in_stick")
    if stick is None or not np.any(stick):
        return None
    weights = surface.weights * stick
    x, y = (float(np.sum(weights * place) / np.sum(weights)) for place in surface.positions)
    x, y = (0.0 if abs(place) <= ROUND_OFF * end.contact_radius else place for place in (x, y))
    if (
        isinstance(surface, Rings) and not surface.covers_circle
    ):  # the other half is the mirror image
        c, s = surface.direction
        ahead = 0.0 if surface.angles is None else c * x + s * y
        x, y = c * ahead, s * ahead
    return x, y
