"""From rows to points: what is plotted, tabled and judged."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from verification.running.row import CaseRecord, value_of
from verification.studies.work_precision.point import Point
from verification.studies.work_precision.setting import OPERATIONS, Method, PrecisionCase

Found = Mapping[PrecisionCase, CaseRecord]

ORDER = 2  # of approach, shift and peak, by the cases that judge it
# Norms have no sign that could be extrapolated, energies and largest errors no such order.
EXTRAPOLATED = ("peak", "approach")


def points_of(found: Found, contact: str, quantity: str) -> tuple[Point, ...]:
    """Of all settings on a contact that give the quantity; those of two grids included."""
    own = [
        _point(case, record, quantity)
        for case, record in found.items()
        if case.contact == contact and quantity in record.measures
    ]
    return (*own, *(_extrapolated(found, contact, quantity)))


def _point(case: PrecisionCase, record: CaseRecord, quantity: str) -> Point:
    curve = f"{case.tolerance:g} {case.penalty:g} {case.increments}"
    return Point(
        case.method.value,
        curve,
        case.text,
        case.fineness,
        abs(value_of(record, quantity)),
        record.seconds,
        value_of(record, OPERATIONS),
    )


def _extrapolated(found: Found, contact: str, quantity: str) -> Iterator[Point]:
    """Richardson's value from a grid and the one with half its cells; both are paid for."""
    if quantity not in EXTRAPOLATED:
        return
    grids = {
        case.fineness: record
        for case, record in found.items()
        if case == PrecisionCase(contact, Method.SURFACE, case.fineness)
    }
    for n, fine in grids.items():
        if n // 2 not in grids:
            continue
        coarse = grids[n // 2]
        weight = 2**ORDER
        error = (weight * value_of(fine, quantity) - value_of(coarse, quantity)) / (weight - 1)
        yield Point(
            Method.EXTRAPOLATED.value,
            "",
            f"{n // 2} and {n} cells per side",
            n,
            abs(error),
            fine.seconds + coarse.seconds,
            value_of(fine, OPERATIONS) + value_of(coarse, OPERATIONS),
        )
