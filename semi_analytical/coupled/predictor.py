"""Predictor of the tractions of a coupled increment from previous increments, without convolutions.

While the normal load changes, the state on a gap r^k is nearly self-similar: it is the previous
state, dilated about its centre of pressure. The predictor adds the error that the preceding
dilation had. The square of the pressure is dilated, because the pressure falls like a root towards
the edge. At constant normal load the predictor extrapolates the tractions linearly.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from contact_scene.array_types import Field, VectorField
from semi_analytical.edge.contact_area import covered_cells
from semi_analytical.increments.increment import State
from semi_analytical.increments.increment_history import (
    FURTHEST,
    PreviousIncrement,
    further,
)
from semi_analytical.increments.normal_target import NormalTarget
from semi_analytical.increments.tangential_solve import TangentialTarget
from semi_analytical.model import ContactModel
from semi_analytical.operator.domain import WINDOW, Parity, ReducedDomain

Start = tuple[Field, VectorField]


@dataclass(frozen=True)
class Dilation:
    """Geometric dilation of surface fields, used to predict the tractions of a growing contact.

    A call returns the dilated field.

    centre  fixed point of the dilation in index coordinates (x, y)
    factor  ratio of lengths after and before the dilation
    domain  domain of the fields: full window or reduced by symmetry
    """

    centre: tuple[float, float]
    factor: float
    domain: ReducedDomain = WINDOW

    @classmethod
    def about(cls, pressure: Field, factor: float, domain: ReducedDomain = WINDOW) -> Dilation:
        """Create the dilation whose fixed point is the centroid of a pressure (nx, ny).

        Along an axis with a mirror plane the fixed point lies on the plane.

        pressure  pressure of the last state
        factor    ratio of lengths after and before the dilation
        domain    domain of the pressure
        """
        lines = (np.sum(pressure, axis=1), np.sum(pressure, axis=0))
        x, y = (
            -0.5 if mirrored else float(np.sum(np.arange(len(line)) * line) / np.sum(line))
            for line, mirrored in zip(lines, domain.mirrors, strict=True)
        )
        return cls((x, y), factor, domain)

    def __call__(self, values: Field) -> Field:
        """Compute the dilation of a field by bilinear interpolation between cell centres.

        The field is constant beyond the outermost cell centres.

        values  scalar (nx, ny) or vector field (2, nx, ny)
        """
        if values.ndim == 2:
            return self._dilate_component(values, self.domain.scalar)
        components = zip(values, self.domain.vector, strict=True)
        return np.stack([self._dilate_component(one, parity) for one, parity in components])

    def _dilate_component(self, values: Field, parity: Parity) -> Field:
        """Compute the dilation of a scalar field or one component of a vector field (nx, ny).

        values  field (nx, ny)
        parity  for x and y: -1 if the field is odd about the mirror plane, 1 if even, 0 without a
                plane
        """
        for axis, (middle, sign) in enumerate(zip(self.centre, parity, strict=True)):
            count = values.shape[axis]
            at = middle + (np.arange(count) - middle) / self.factor
            beyond = at[0]
            at = np.clip(at, 0, count - 1)
            left = np.minimum(at.astype(int), count - 2)
            weight = np.expand_dims(at - left, 1 - axis)
            one, other = (np.take(values, left + k, axis) for k in (0, 1))
            values = (1 - weight) * one + weight * other
            if sign < 0 and beyond < 0:  # between a cell and its odd image
                values[(0,) if axis == 0 else (slice(None), 0)] *= 1 + 2 * beyond
        return values

    def grown(self, p: Field, q: VectorField, load: float) -> Start:
        """Predict pressure and shear of a contact that has grown or shrunk by this dilation.

        The square of the pressure is dilated, because the pressure falls like a root towards the
        edge. The ratio q/p of shear and pressure at a dilated point is constant. Return pressure
        and shear.

        p, q  pressure (nx, ny) and shear (2, nx, ny) before the dilation
        load  ratio of the normal forces after and before
        """
        pressure, linear = np.sqrt(self(p * p)), self(p)
        ratio = self(q) / np.where(linear > 0, linear, 1.0)
        pressure *= load / self.factor**2
        return pressure, ratio * pressure


def predict_tractions(
    model: ContactModel, before: State, normal: NormalTarget, tangential: TangentialTarget
) -> Start | None:
    """Predict pressure and shear at the end of an increment from previous increments.

    The prediction is the initial guess of the coupled problem. None is returned without a
    prediction.

    model               contact model
    before              state at the start of the increment
    normal, tangential  prescribed loads at the end of the increment
    """
    now = before.seen()
    if now is None:
        return None
    if before.target == normal:
        return _extrapolate_tractions(now, before.behind, tangential)
    return _predict_by_dilation(model, now, before.behind, normal)


def _extrapolate_tractions(
    now: PreviousIncrement, behind: PreviousIncrement | None, tangential: TangentialTarget
) -> Start:
    """Predict pressure and shear by linear extrapolation, at constant normal load.

    Without a valid extrapolation, such as after a change of direction of the tangential load, the
    last pressure and shear are returned.

    now, behind  data of the last converged state and of the state before
    tangential   tangential load of the next increment
    """
    ratio = further(now, behind, tangential)
    if behind is None or ratio == 0:
        return now.pressure, now.shear
    p = now.pressure + ratio * (now.pressure - behind.pressure)
    return np.maximum(p, 0.0), now.shear + ratio * (now.shear - behind.shear)


def _predict_by_dilation(
    model: ContactModel,
    now: PreviousIncrement,
    behind: PreviousIncrement | None,
    normal: NormalTarget,
) -> Start | None:
    """Predict pressure and shear under a changed normal load by dilation of the last state.

    The dilation continues the growth of the contact in the last increment. Without a preceding
    increment, or after a much smaller one, contact radius and force follow from the power k of the
    undeformed gap r^k. None is returned without a prediction, also if the predicted contact lies
    between the centres of the cells.

    model        contact model
    now, behind  data of the last converged state and of the state before
    normal       prescribed normal load at the end of the increment
    """
    indenter = model.scene.indenter
    exponent, degree = indenter.gap_exponent, indenter.load_exponent
    tilts = normal.moment is not None or normal.tilt != now.target.tilt
    if exponent is None or degree is None or tilts:
        return None
    if normal.force is not None:
        load, loads = normal.force, [state.normal_force for state in (now, behind) if state]
        of_radius, of_force = 1 / degree, 1.0
    else:
        assert normal.approach is not None
        load, loads = normal.approach, [state.approach for state in (now, behind) if state]
        of_radius, of_force = 1 / exponent, degree / exponent
    if min(load, *loads) <= 0:
        return None
    domain, pressure = model.domain, now.pressure
    change = np.log(load / loads[0])
    last_change = np.log(loads[0] / loads[-1])
    if behind is None or abs(change) > FURTHEST * abs(last_change) or behind.normal_force <= 0:
        dilation = Dilation.about(pressure, np.exp(of_radius * change), domain)
        p, q = dilation.grown(pressure, now.shear, np.exp(of_force * change))
        return (p, q) if np.any(p) else None
    ratio = change / last_change
    areas = [covered_cells(p, p > 0, domain) for p in (pressure, behind.pressure)]
    radius = 0.5 * np.log(areas[0] / areas[1])
    force = np.log(now.normal_force / behind.normal_force)
    dilation = Dilation.about(pressure, np.exp(ratio * radius), domain)
    p, q = dilation.grown(pressure, now.shear, np.exp(ratio * force))
    last = Dilation.about(behind.pressure, np.exp(radius), domain)
    last_p, last_q = last.grown(behind.pressure, behind.shear, np.exp(force))
    p += ratio * dilation(pressure - last_p)
    q += ratio * dilation(now.shear - last_q)
    return (np.maximum(p, 0.0), q) if np.any(p > 0) else None
