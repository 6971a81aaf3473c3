"""From records to points: what is plotted, tabled and judged."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from verification.judging.run import SOLVER_TOLERANCE
from verification.studies.work_precision.point import Point
from verification.studies.work_precision.setting import Measured, Method, PrecisionCase

Found = Mapping[PrecisionCase, Measured]

ORDER = 2  # of approach, shift and peak, by the cases that judge it
# Norms have no sign that could be extrapolated, energies and largest errors no such order.
EXTRAPOLATED = ("peak", "approach")


def points_of(found: Found, contact: str, quantity: str) -> tuple[Point, ...]:
    """Of all settings on a contact that give the quantity; those of two grids included."""
    own = [
        _point(case, record, quantity)
        for case, record in found.items()
        if case.contact == contact and quantity in record.errors
    ]
    return (*own, *(_extrapolated(found, contact, quantity)))


def setting_text(case: PrecisionCase) -> str:
    """A setting for people."""
    n = case.fineness
    words = [f"{n} elements per radius" if case.by_sections else f"{n} x {n}"]
    words += [f"tolerance {case.tolerance:g}"] if case.tolerance != SOLVER_TOLERANCE else []
    words += [f"c = {case.penalty:g}"] if case.penalty else []
    if any(case.sampling):
        refinement, extension = case.sampling
        samples = "1 sample" if refinement == 1 else f"{refinement} samples"
        words += [f"{samples} per cell side", f"period {2 * extension} windows"]
    if case.increments:
        words += ["1 increment" if case.increments == 1 else f"{case.increments} increments"]
    return ", ".join(words)


def _point(case: PrecisionCase, record: Measured, quantity: str) -> Point:
    curve = f"{case.tolerance:g} {case.penalty:g} {case.sampling} {case.increments}"
    return Point(
        case.method.value,
        curve,
        setting_text(case),
        case.fineness,
        abs(record.errors[quantity]),
        record.seconds,
        record.operations,
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
        error = (weight * fine.errors[quantity] - coarse.errors[quantity]) / (weight - 1)
        yield Point(
            Method.EXTRAPOLATED.value,
            "",
            f"{n // 2} and {n} cells per side",
            n,
            abs(error),
            fine.seconds + coarse.seconds,
            fine.operations + coarse.operations,
        )
