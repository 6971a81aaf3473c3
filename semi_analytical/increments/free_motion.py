"""Free motion of cells until they come into contact in an increment of growing loads."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from contact_scene.array_types import Vector, VectorField
from contact_scene.stepping.growing_contact import GrowingContact
from contact_solver.conjugate_gradients import Point
from semi_analytical.increments.normal_solve import NormalState
from semi_analytical.increments.tangential_solve import TangentialTarget
from semi_analytical.increments.tangential_state import TangentialState
from semi_analytical.model import ContactModel, everywhere


class Growth(NamedTuple):
    """Shear of a contact that grows without slip in an increment, as the initial guess of a solve.

    point  shear at the end, with its displacement
    shift  tangential shift at the end (2,) [length]
    free   free motion of each cell until its contact (2, nx, ny) [length]; 0 in cells that were in
           contact before
    """

    point: Point
    shift: Vector
    free: VectorField


def growth_without_slip(
    model: ContactModel,
    last: TangentialState,
    load: TangentialTarget,
    pressing: NormalState | None,
    pressed: NormalState,
) -> Growth | None:
    """Compute the shear of an increment in which the contact grows without slip.

    None is returned if the contact does not grow, or if the tangential load does not change.

    last      tangential state at the start of the increment
    load      prescribed tangential load at the end of the increment
    pressing  solution of the normal problem at the start; None before first contact
    pressed   solution of the normal problem at the end
    """
    assert last.shift is not None
    prescribed = load.force if load.shift is None else load.shift
    assert prescribed is not None
    change = prescribed - (last.force if load.shift is None else last.shift)
    start = np.zeros_like(pressed.pressure) if pressing is None else pressing.pressure
    grown = pressed.pressure - start
    area = model.grid.cell_area
    more = float(np.sum(grown))
    approach = pressed.approach - (0.0 if pressing is None else pressing.approach)
    begins = (start == 0) & (model.gap > 0)
    if (
        min(more, approach) <= 0
        or not np.any(change)
        or not np.any(begins & (pressed.pressure > 0))
    ):
        return None
    # By symmetry the domain may exclude shear in a direction without load.
    axes = np.eye(2)[change != 0]
    unit = np.array([everywhere(axis) for axis in axes])
    down, along = model.springs
    operator = model.operator(grown.shape)
    displacements = np.array([operator.tangential(one * grown) for one in unit])
    closed = pressed.displacement - (0.0 if pressing is None else pressing.displacement)
    bodies = displacements - along * more * unit
    points = (len(unit), 2, -1)
    rigid = np.broadcast_to(unit, displacements.shape).reshape(points)
    growing = GrowingContact(
        pressure=(start + pressed.pressure).ravel() * area,
        normal=(closed - down * more).ravel(),
        along=bodies.reshape(points),
        unit=rigid,
        approach=approach - down * more,
        load=more * area,
        limit=float(np.sum(model.friction_limit(pressed.pressure) - model.friction_limit(start)))
        * area,
        spring=along / area,
    )
    k, shift = growing.ratio(axes @ change, by_force=load.shift is None)
    moved = np.einsum("i,icxy->cxy", k, bodies) - everywhere(shift @ axes)
    ratio = k @ axes
    point = Point(
        last.shear + everywhere(ratio) * grown,
        last.displacement + np.einsum("i,icxy->cxy", k, displacements),
    )
    return Growth(
        point,
        last.shift + shift @ axes + along * more * ratio,
        np.where(begins, moved, 0.0),
    )
