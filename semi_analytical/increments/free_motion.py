"""Free motion of cells until they come into contact in an increment of growing loads."""

import numpy as np

from contact_scene.array_types import Field, Mask, Vector, VectorField
from contact_scene.rig import compliances
from contact_scene.stepping.growing_contact import GrowingContact
from contact_solver.conjugate_gradients import Point
from semi_analytical.increments.normal_solve import NormalState
from semi_analytical.increments.tangential_solve import TangentialTarget
from semi_analytical.increments.tangential_state import TangentialState, at_nearest_edge
from semi_analytical.model import ContactModel
from semi_analytical.operator.points import map_of_points, points_of


def growth_without_slip(
    model: ContactModel,
    last: TangentialState,
    load: TangentialTarget,
    pressing: NormalState | None,
    pressed: NormalState,
) -> tuple[Point, Vector, VectorField] | None:
    """Compute the shear of an increment in which the contact grows without slip.

    The results are shear with displacement and tangential shift (2,) [length], as an initial guess,
    and the free motion of each cell until its contact (2, nx, ny) [length]. None is returned if the
    contact does not grow, or if the tangential load does not change.

    last      tangential state at the start of the increment
    load      prescribed tangential load at the end of the increment
    pressing  solution of the normal problem at the start; None before first contact
    pressed   solution of the normal problem at the end
    """
    assert last.shift is not None
    prescribed = load.force if load.shift is None else load.shift
    assert prescribed is not None
    change = prescribed - (last.force if load.shift is None else last.shift)
    cells = pressed.pressure.shape
    start, closed, approach = np.zeros(cells), pressed.displacement, pressed.approach
    if pressing is not None:
        start = pressing.pressure
        closed, approach = closed - pressing.displacement, approach - pressing.approach

    def at_nearest(values: Field, known: Mask) -> Field:
        """Return the values at the nearest known cells, for the cells that come into contact."""
        touched = known.reshape(cells)
        wanted = (pressed.pressure > 0) & ~touched
        return points_of(at_nearest_edge(values.reshape(-1, *cells), touched, wanted))

    # By symmetry the domain may exclude shear in a direction without load.
    axes = np.eye(2)[change != 0]
    growth = GrowingContact(
        model.grid.cell_area,
        points_of(start),
        points_of(pressed.pressure),
        points_of(model.gap > 0),
        approach,
        compliances(model.scene.rig),
        at_nearest,
    ).without_slip(
        axes @ change,
        axes[:, :, None] * np.ones(start.size),
        map_of_points(model.operator(cells).tangential, cells),
        lambda grown: points_of(closed),
        map_of_points(model.friction_limit, cells),
        by_force=load.shift is None,
    )
    if growth is None:
        return None
    shear, moved, free = (
        field.reshape(last.shear.shape) for field in (growth.shear, growth.moved, growth.free)
    )
    return (
        Point(last.shear + shear, last.displacement + moved),
        last.shift + growth.shift @ axes,
        free,
    )
