"""First tractions of a coupled increment, from the path so far: they take no convolutions.

While the normal load changes on a gap like r^k, a state is nearly the one before, dilated about its
centre of pressure; what the one before it missed of this state, the next one will miss too. The
pressure is dilated squared: towards the edge it falls like a root. While the normal load rests, the
path goes straight on.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from semi_analytical.behind import FURTHEST, Behind, further
from semi_analytical.increment import State
from semi_analytical.model import ContactModel
from semi_analytical.pressing import NormalTarget
from semi_analytical.shearing import TangentialTarget

Field = NDArray[np.float64]
VectorField = NDArray[np.float64]
Start = tuple[Field, VectorField]


@dataclass(frozen=True)
class Lens:
    """Dilates fields by a factor about a centre, given in cells."""

    centre: tuple[float, float]
    factor: float

    @classmethod
    def over(cls, pressure: Field, factor: float) -> Lens:
        """About the centre of a pressure."""
        lines = (np.sum(pressure, axis=1), np.sum(pressure, axis=0))
        x, y = (float(np.sum(np.arange(len(line)) * line) / np.sum(line)) for line in lines)
        return cls((x, y), factor)

    def __call__(self, values: Field) -> Field:
        """What values (…, nx, ny) are at a place nearer to the centre by the factor: linear in
        between, and at the border as at its nearest cell."""
        for axis, middle in zip((-2, -1), self.centre, strict=True):
            count = values.shape[axis]
            at = np.clip(middle + (np.arange(count) - middle) / self.factor, 0, count - 1)
            left = np.minimum(at.astype(int), count - 2)
            part = np.expand_dims(at - left, -1 if axis == -2 else 0)
            one, other = (np.take(values, left + k, axis) for k in (0, 1))
            values = (1 - part) * one + part * other
        return values

    def grown(self, p: Field, q: VectorField, load: float) -> Start:
        """Tractions p and q of a contact dilated under a normal force `load` times as large; the
        shear keeps its share of the pressure."""
        pressure, below = np.sqrt(self(p * p)), self(p)
        share = self(q) / np.where(below > 0, below, 1.0)
        pressure *= load / self.factor**2
        return pressure, share * pressure


def predicted(
    model: ContactModel, before: State, normal: NormalTarget, tangential: TangentialTarget
) -> Start | None:
    """Pressure and shear at the end of an increment, roughly; None where the path says nothing."""
    seen = before.seen()
    if seen is None:
        return None
    if before.target == normal:
        return _straight_on(seen, before.behind, tangential)
    return _dilated(model, seen, before.behind, normal)


def _straight_on(now: Behind, behind: Behind | None, tangential: TangentialTarget) -> Start:
    """As much further as the tangential load goes straight on; else as before."""
    part = further(now, behind, tangential)
    if behind is None or part == 0:
        return now.pressure, now.shear
    p = now.pressure + part * (now.pressure - behind.pressure)
    return np.maximum(p, 0.0), now.shear + part * (now.shear - behind.shear)


def _dilated(
    model: ContactModel, now: Behind, behind: Behind | None, normal: NormalTarget
) -> Start | None:
    """As the gap has it at first, then as the contact has grown with its load so far."""
    exponent = model.scene.indenter.gap_exponent
    held = normal.tilting is None or (
        normal.tilting.moment is None and normal.tilting == now.target.tilting
    )
    if exponent is None or not held:
        return None
    if normal.force is not None:
        load, loads = normal.force, [seen.normal_force for seen in (now, behind) if seen]
        wider, rise = 1 / (exponent + 1), 1.0
    else:
        assert normal.approach is not None
        load, loads = normal.approach, [seen.approach for seen in (now, behind) if seen]
        wider, rise = 1 / exponent, 1 + 1 / exponent
    if min(load, *loads) <= 0:
        return None
    way = np.log(load / loads[0])
    last_way = np.log(loads[0] / loads[-1])
    if behind is None or abs(way) > FURTHEST * abs(last_way) or behind.normal_force <= 0:
        lens = Lens.over(now.pressure, np.exp(wider * way))
        return lens.grown(now.pressure, now.shear, np.exp(rise * way))
    part = way / last_way
    grown = 0.5 * np.log(now.covered_cells / behind.covered_cells)
    risen = np.log(now.normal_force / behind.normal_force)
    lens = Lens.over(now.pressure, np.exp(part * grown))
    p, q = lens.grown(now.pressure, now.shear, np.exp(part * risen))
    last = Lens.over(behind.pressure, np.exp(grown))
    p_missed, q_missed = last.grown(behind.pressure, behind.shear, np.exp(risen))
    p += part * lens(now.pressure - p_missed)
    q += part * lens(now.shear - q_missed)
    return np.maximum(p, 0.0), q
