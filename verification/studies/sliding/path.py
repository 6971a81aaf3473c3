"""What is measured along a history that ends in sliding."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from contact_scene.description import Description
from contact_scene.summary import ContactStatus
from verification.problems.paper_scene import FRICTION, FRICTION_LIMIT
from verification.quantities import shear_of
from verification.running.row import CaseRecord, Row, TypedRow, parameters_of
from verification.running.rules import RESIDUAL

if TYPE_CHECKING:
    from semi_analytical import Increment

Field = NDArray[np.float64]

# Slip below this part of the largest has no direction worth measuring.
LEAST_SLIP = 1e-3
PRESSING = 1  # the loading step that comes before the path


class SlidingPoint(TypedRow):
    """The contact at one shift."""

    PARAMETERS = ("step",)
    UNITS: ClassVar[Mapping[str, str]] = {
        "shift": "m", "slip_angle": "deg", "largest_slip_angle": "deg",
    }  # fmt: skip

    step: int
    """Number of the loading step."""

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

    largest_residual: float
    """Of the increment; as a measure, RESIDUAL."""


class SolvedPoint(SlidingPoint):
    """The same where the product's solver found the pressure, too."""

    UNITS: ClassVar[Mapping[str, str]] = {**SlidingPoint.UNITS,
        "normal_force": "N", "approach": "m", "contact_radius": "m", "peak_pressure": "Pa",
    }  # fmt: skip

    normal_force: float
    approach: float
    contact_radius: float
    peak_pressure: float


class SlidingPath(Description):
    """The way from the end of the normal loading on.

    cell_over_radius  cell side over contact radius
    """

    points: tuple[SlidingPoint, ...]
    cell_over_radius: float

    @classmethod
    def of(cls, record: CaseRecord) -> SlidingPath:
        """Of a run."""
        rows = increments(record)
        pressed = sum(row.parameters["step"] == PRESSING for row in rows)
        points = map(SlidingPoint.of, rows[max(pressed - 1, 0) :])
        cell = record.measures["cell_over_radius"]
        assert cell is not None
        return cls(points=tuple(points), cell_over_radius=cell)


def increments(record: CaseRecord) -> list[Row]:
    """The parts of a record that are ends of increments."""
    return [part for part in record.parts if "step" in part.parameters]


def record_of(
    run: Any,
    parts: Iterable[Row],
    cell_over_radius: float,
    counters: dict[str, int],
    **measures: float,
) -> CaseRecord:
    """What a run leaves: the ends of its increments, and what they took."""
    rows = tuple(parts)
    residuals = [row.measures[RESIDUAL] for row in rows if RESIDUAL in row.measures]
    known = [np.nan if residual is None else residual for residual in residuals]
    return CaseRecord(
        parameters=parameters_of(run),
        measures={
            "cell_over_radius": cell_over_radius,
            RESIDUAL: float(np.max(known)),
            **measures,
        },
        counters=counters,
        parts=rows,
    )


def counted(done: Sequence[Increment]) -> dict[str, int]:
    """What these increments took."""
    return {
        "increments": len(done),
        "halvings": sum(i.halvings for i in done),
        "convolutions": sum(i.convolutions for i in done),
    }


def mean_cosine(pressure: Field, shear: Field) -> float:
    """Mean of cosψ over the pressure; cells without shear have no direction and count as zero."""
    size = np.hypot(shear[0], shear[1])
    cosine = np.divide(shear[0], size, out=np.zeros_like(size), where=size > 0)
    return float(np.sum(pressure * cosine) / np.sum(pressure))


def row_of(increment: Increment, before: Increment | None, step: int | None = None) -> Row:
    """The end of an increment that was reached from another.

    step  to keep it as one of; None for its own
    """
    assert increment.in_stick is not None
    assert increment.stick_area is not None
    assert increment.tangential_shift is not None
    assert increment.tangential_force is not None
    angles = _slip_angles(increment, before)
    return SolvedPoint(
        step=step or increment.step,
        shift=float(increment.tangential_shift[0]),
        force=float(increment.tangential_force[0]) / FRICTION_LIMIT,
        stick_fraction=increment.stick_area / increment.contact_area,
        stick_cells=int(np.count_nonzero(increment.in_stick)),
        mean_cosine=mean_cosine(increment.pressure, shear_of(increment)),
        full_slip=not np.any(increment.in_stick),
        status=increment.status,
        slip_angle=angles[0],
        largest_slip_angle=angles[1],
        largest_residual=increment.residuals.worst,
        normal_force=increment.normal_force,
        approach=increment.approach,
        contact_radius=increment.contact_radius,
        peak_pressure=increment.peak_pressure,
    ).row()


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
