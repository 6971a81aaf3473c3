"""First tractions of a coupled increment, from the path so far: they take no convolutions.

While the normal load changes on a gap like r^k, a state is nearly the one before, dilated about its
centre of pressure; what the one before it missed of this state, the next one will miss too. The
pressure is dilated squared: towards the edge it falls like a root. While the normal load rests, the
path goes straight on.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from contact_scene.array_types import Field, VectorField
from semi_analytical.increments.increment import State
from semi_analytical.increments.increment_history import (
    FURTHEST,
    PreviousIncrement,
    further,
)
from semi_analytical.increments.normal_solve import NormalTarget
from semi_analytical.increments.tangential_solve import TangentialTarget
from semi_analytical.model import ContactModel
from semi_analytical.operator.domain import WINDOW, Parity, ReducedDomain

Start = tuple[Field, VectorField]


@dataclass(frozen=True)
class Lens:
    """Dilates fields of a domain by a factor about a centre, given in cells."""

    centre: tuple[float, float]
    factor: float
    domain: ReducedDomain = WINDOW

    @classmethod
    def over(cls, pressure: Field, factor: float, domain: ReducedDomain = WINDOW) -> Lens:
        """About the centre of a pressure, which lies on mirror planes."""
        lines = (np.sum(pressure, axis=1), np.sum(pressure, axis=0))
        x, y = (
            -0.5 if mirrored else float(np.sum(np.arange(len(line)) * line) / np.sum(line))
            for line, mirrored in zip(lines, domain.mirrors, strict=True)
        )
        return cls((x, y), factor, domain)

    def __call__(self, values: Field) -> Field:
        """What a scalar (nx, ny) or vector field (2, nx, ny) is at a place nearer to the centre by
        the factor: linear in between, and at the border as at its nearest cell."""
        if values.ndim == 2:
            return self._dilated(values, self.domain.scalar)
        components = zip(values, self.domain.vector, strict=True)
        return np.stack([self._dilated(one, parity) for one, parity in components])

    def _dilated(self, values: Field, parity: Parity) -> Field:
        for axis, (middle, sign) in enumerate(zip(self.centre, parity, strict=True)):
            count = values.shape[axis]
            at = middle + (np.arange(count) - middle) / self.factor
            beyond = at[0]
            at = np.clip(at, 0, count - 1)
            left = np.minimum(at.astype(int), count - 2)
            part = np.expand_dims(at - left, 1 - axis)
            one, other = (np.take(values, left + k, axis) for k in (0, 1))
            values = (1 - part) * one + part * other
            if sign < 0 and beyond < 0:  # between a cell and its image
                values[(0,) if axis == 0 else (slice(None), 0)] *= 1 + 2 * beyond
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
    behind = before.behind
    if before.target == normal:
        return _straight_on(seen, behind, tangential)
    return _dilated(model, seen, behind, normal)


def _straight_on(
    now: PreviousIncrement, behind: PreviousIncrement | None, tangential: TangentialTarget
) -> Start:
    """As much further as the tangential load goes straight on; else as before."""
    part = further(now, behind, tangential)
    if behind is None or part == 0:
        return now.pressure, now.shear
    p = now.pressure + part * (now.pressure - behind.pressure)
    return np.maximum(p, 0.0), now.shear + part * (now.shear - behind.shear)


def _dilated(
    model: ContactModel,
    now: PreviousIncrement,
    behind: PreviousIncrement | None,
    normal: NormalTarget,
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
    on, pressure = model.domain, now.pressure
    way = np.log(load / loads[0])
    last_way = np.log(loads[0] / loads[-1])
    if behind is None or abs(way) > FURTHEST * abs(last_way) or behind.normal_force <= 0:
        lens = Lens.over(pressure, np.exp(wider * way), on)
        return lens.grown(pressure, now.shear, np.exp(rise * way))
    part = way / last_way
    grown = 0.5 * np.log(now.covered_cells / behind.covered_cells)
    risen = np.log(now.normal_force / behind.normal_force)
    lens = Lens.over(pressure, np.exp(part * grown), on)
    p, q = lens.grown(pressure, now.shear, np.exp(part * risen))
    last = Lens.over(behind.pressure, np.exp(grown), on)
    p_missed, q_missed = last.grown(behind.pressure, behind.shear, np.exp(risen))
    p += part * lens(pressure - p_missed)
    q += part * lens(now.shear - q_missed)
    return np.maximum(p, 0.0), q
