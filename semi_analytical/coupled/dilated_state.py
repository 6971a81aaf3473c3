"""States of self-similar contacts, dilated about the point of first contact."""

from __future__ import annotations

from dataclasses import replace
from math import pi

import numpy as np

from contact_scene.array_types import Field, Vector, VectorField
from contact_scene.stepping.self_similar_growth import LEAST_POINTS, Mixing, Similarity
from semi_analytical.coupled.predictor import Dilation
from semi_analytical.increments.increment import State
from semi_analytical.increments.normal_target import NormalTarget
from semi_analytical.increments.tangential_state import TangentialState, rigid
from semi_analytical.model import ContactModel

# Relative distance of a source from that of the dilation which is round-off.
ROUND_OFF = 1e-9


def dilated_state(
    model: ContactModel,
    state: State,
    similarity: Similarity,
    mixing: Mixing,
) -> State | None:
    """Return the state of a self-similar contact at another contact radius.

    None is returned if the tangential shift is undefined, or if few cells are in contact.

    model       contact model
    state       state of the contact, which has grown from nothing
    similarity  ratio of the contact radii, and powers of it
    mixing      acceleration of the solves
    """
    sheared, pressing, target = state.sheared, state.pressing, state.target
    if sheared is None or sheared.shift is None:
        return None
    if np.sqrt(model.domain.images * np.count_nonzero(pressing.pressure) / pi) < LEAST_POINTS:
        return None
    dilation = Dilation(_first_contact(model), similarity.factor, model.domain)
    length, force = similarity.displacement, similarity.force
    p, q = dilation.grown(pressing.pressure, sheared.shear, force)
    # Interpolation would extend the contact by a cell.
    inside = dilation((pressing.pressure > 0).astype(np.float64)) >= 0.5
    p, q = np.where(inside, p, 0.0), np.where(inside, q, 0.0)
    shift = length * sheared.shift
    relative = sheared.displacement - rigid(model, sheared.motion)
    locked = mixing.next_field(_locked(model, sheared, relative, similarity, dilation))
    slid = length * dilation(sheared.slip_distance)
    lost = similarity.energy / similarity.factor**2 * dilation(sheared.dissipation)
    smaller = replace(
        sheared,
        shear=q,
        pressure=p,
        displacement=locked + rigid(model, shift),
        shift=shift,
        slip=length * dilation(sheared.slip),
        slip_distance=slid,
        dissipation=lost,
        dissipated_energy=float(np.sum(lost)) * model.grid.cell_area,
        force=force * sheared.force,
    )
    reached = NormalTarget(
        None if target.force is None else force * target.force,
        None if target.approach is None else length * target.approach,
        target.moment,
        target.tilt,
    )
    pressed = replace(
        pressing,
        pressure=p,
        displacement=length * dilation(pressing.displacement),
        approach=length * pressing.approach,
    )
    return replace(
        state,
        target=reached,
        normal_force=force * state.normal_force,
        pressing=pressed,
        sheared=smaller,
        behind=None,
    )


def with_free_motion(model: ContactModel, after: State) -> State:
    """Return a state at the end of the first increment, completed by the free motion in it.

    The free motion is the motion relative to the indenter until the dilated state from which the
    increment was solved. The slip that the energy balance of the increment counts comes after.

    model  contact model
    after  state at the end of the increment
    """
    sheared, start = after.sheared, after.behind
    if sheared is None or start is None:
        return after
    free = start.displacement - rigid(model, start.shift)
    return replace(after, sheared=replace(sheared, free=free))


def _first_contact(model: ContactModel) -> tuple[float, float]:
    """Return the index coordinates (x, y) of the point of first contact, the origin."""
    x, y = model.grid.coordinates()
    dx, dy = model.grid.spacing
    return -float(x.flat[0]) / dx, -float(y.flat[0]) / dy


def _locked(
    model: ContactModel,
    sheared: TangentialState,
    relative: VectorField,
    similarity: Similarity,
    dilation: Dilation,
) -> VectorField:
    """Compute the relative displacement at the start of a solve, with which particles stick.

    A particle that sticks at the end has the displacement with which the border of the stick zone
    passed it. Other particles have that of the dilated contact (2, nx, ny) [length].

    model       contact model
    sheared     tangential state at the end
    relative    displacement relative to the indenter at the end (2, nx, ny) [length]
    similarity  ratio of the contact radii
    dilation    dilation to the contact at the start
    """
    centre, shape = np.array(dilation.centre)[:, None], sheared.in_stick.shape
    last = np.array(shape)[:, None] - 1
    cells = np.indices(shape).reshape(2, -1) - centre
    cells_away = np.hypot(*cells)
    times = np.full(cells_away.shape, 1 / similarity.factor)
    # A cell on the point of first contact is on no ray, and has moved with the indenter.
    sticks = cells_away > 0
    on_ray = sticks.copy()
    while np.any(sticks):
        at = times * cells + centre
        x, y = np.rint(np.clip(at, 0, last)).astype(int)
        sticks = sheared.in_stick[x, y] & on_ray & np.all(at <= last + 0.5, axis=0)
        times[sticks] += 1 / cells_away[sticks]
    source = np.clip(times * cells + centre, 0, last)
    found = similarity.displacement * dilation(relative)
    chained = (times > (1 + ROUND_OFF) / similarity.factor).reshape(shape)
    scale = times**-similarity.exponent
    border = scale * np.stack([_interpolate(one, source) for one in relative])
    return np.where(chained, border.reshape(relative.shape), found)


def _interpolate(values: Field, at: Field) -> Vector:
    """Interpolate a field bilinearly at index coordinates (2, n) inside the grid.

    values  field (nx, ny)
    at      index coordinates (x, y)
    """
    x, y = at
    i = np.minimum(x.astype(int), values.shape[0] - 2)
    j = np.minimum(y.astype(int), values.shape[1] - 2)
    u, v = x - i, y - j
    lower = (1 - v) * values[i, j] + v * values[i, j + 1]
    upper = (1 - v) * values[i + 1, j] + v * values[i + 1, j + 1]
    return np.asarray((1 - u) * lower + u * upper)
