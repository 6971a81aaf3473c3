"""What is measured along a history that ends in sliding."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from contact_results.quantities import shear_of
from contact_scene.description import Description
from contact_scene.summary import ContactStatus
from verification.problems.paper_scene import FRICTION, FRICTION_LIMIT

if TYPE_CHECKING:
    from semi_analytical import Increment, Result

Field = NDArray[np.float64]

# Slip below this part of the largest has no direction worth measuring.
LEAST_SLIP = 1e-3


class SlidingPoint(Description):
    """The contact at one shift."""

    shift: float
    """Of the indenter along x [length]."""

    force: float
    """T / µW along x."""

    stick_fraction: float
    """Stick area over contact area."""

    stick_cells: int
    mean_cosine: float
    """⟨cosψ⟩: mean over the pressure of the cosine between shear and x axis."""

    full_slip: bool
    status: ContactStatus
    slip_angle: float | None = None
    """Angle between shear and the slip increment's opposite, root mean square weighted by the
    work of friction [degree]; null without slip."""

    largest_slip_angle: float | None = None
    """The largest such angle of a cell that slips by more than 1e-3 of the largest slip."""

    residual: float
    """Largest residual of the increment."""


class SlidingPath(Description):
    """A history of points, and what it cost."""

    points: tuple[SlidingPoint, ...]
    cell_over_radius: float
    """Cell side over contact radius."""

    increments: int
    halvings: int
    convolutions: int
    seconds: float

    @property
    def largest_residual(self) -> float:
        """Of all points."""
        return max(point.residual for point in self.points)


def mean_cosine(pressure: Field, shear: Field) -> float:
    """Mean of cosψ over the pressure; cells without shear have no direction and count as zero."""
    size = np.hypot(shear[0], shear[1])
    cosine = np.divide(shear[0], size, out=np.zeros_like(size), where=size > 0)
    return float(np.sum(pressure * cosine) / np.sum(pressure))


def point_of(increment: Increment, before: Increment | None) -> SlidingPoint:
    """The state at the end of an increment that was reached from another."""
    assert increment.in_stick is not None
    assert increment.stick_area is not None
    assert increment.tangential_shift is not None
    assert increment.tangential_force is not None
    angles = _slip_angles(increment, before)
    return SlidingPoint(
        shift=float(increment.tangential_shift[0]),
        force=float(increment.tangential_force[0]) / FRICTION_LIMIT,
        stick_fraction=increment.stick_area / increment.contact_area,
        stick_cells=int(np.count_nonzero(increment.in_stick)),
        mean_cosine=mean_cosine(increment.pressure, shear_of(increment)),
        full_slip=not np.any(increment.in_stick),
        status=increment.status,
        slip_angle=angles[0],
        largest_slip_angle=angles[1],
        residual=increment.residuals.worst,
    )


def path_of(result: Result, first_step: int, seconds: float) -> SlidingPath:
    """The increments of a result from the end of the step before `first_step` on."""
    increments = result.increments
    start = sum(i.step < first_step for i in increments) - 1
    before = [None, *increments]
    points = [point_of(increments[n], before[n]) for n in range(start, len(increments))]
    return joined(result, points, increments, seconds)


def joined(
    result: Result,
    points: Sequence[SlidingPoint],
    increments: Sequence[Increment],
    seconds: float,
) -> SlidingPath:
    """Points and the cost of the increments that led to them."""
    return SlidingPath(
        points=tuple(points),
        cell_over_radius=result.grid.spacing[0] / result.increments[-1].contact_radius,
        increments=len(increments),
        halvings=sum(i.halvings for i in increments),
        convolutions=sum(i.convolutions for i in increments),
        seconds=seconds,
    )


def _slip_angles(
    increment: Increment, before: Increment | None
) -> tuple[float, float] | tuple[None, None]:
    """Between q and -Δs: root mean square weighted by µp|Δs|, and largest [degree]."""
    assert increment.in_stick is not None
    assert increment.slip is not None
    slip = increment.slip if before is None or before.slip is None else increment.slip - before.slip
    q = shear_of(increment)
    size, distance = np.hypot(q[0], q[1]), np.hypot(slip[0], slip[1])
    slipping = increment.in_contact & ~increment.in_stick & (size > 0)
    slipping &= distance > LEAST_SLIP * np.max(distance, initial=0.0)
    if not np.any(slipping):
        return None, None
    across = np.abs(q[0] * slip[1] - q[1] * slip[0])
    along = -(q[0] * slip[0] + q[1] * slip[1])
    angle = np.degrees(np.arctan2(across, along)[slipping])
    work = (FRICTION * increment.pressure * distance)[slipping]
    return float(np.sqrt(np.sum(work * angle**2) / np.sum(work))), float(np.max(angle))
