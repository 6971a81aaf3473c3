"""Order, limit and verdict of one quantity over the levels of a study."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import hypot

from verification.convergence.observed_order import (
    ORDER_WIDTH,
    TRIPLETS_AGREE,
    ObservedOrder,
    RefinedValue,
    Triplets,
    observed_order,
    refined_value,
    triplets_agree,
    triplets_of_changes,
)
from verification.convergence.stored_field import change
from verification.judging.outcome import Status, order_status
from verification.running.row import CaseRecord, Row
from verification.studies.refinement.expected import Expected
from verification.studies.refinement.level_row import size_of, values_of

FEWEST_LEVELS = 4  # for values
FEWEST_JUDGED = 5  # for orders: through four levels a curve of three parameters fits by chance
ASSUMED = 1.0  # order on which a limit rests where none is expected
# Changes of fewer tolerances than this are the solver's, not the refinement's.
ABOVE_TOLERANCE = 100.0
VANISHES = 1e-6
APPROACHING = 0.1  # part of its distance from the expected order by which an order comes nearer
NEARING = 0.2  # how far from the expected order one may be that comes nearer to it


@dataclass(frozen=True)
class Fit:
    """What the levels say about one quantity; coarse to fine.

    sizes        h of the levels that have an error
    errors       relative to the scale: distance from the limit, or change to the next level
    finest       value on the finest level; None for a field
    limit        Richardson's value, uncertainty its standard uncertainty; None for a field
    remaining    error that is left on the finest level, relative to the scale
    observed     order of convergence; None where none can be read off the values
    triplets     orders by two triplets of levels, the finer first
    levels       number of levels
    """

    name: str
    expected: Expected | None
    sizes: tuple[float, ...]
    errors: tuple[float, ...]
    finest: float | None
    limit: float | None
    uncertainty: float | None
    remaining: float
    observed: ObservedOrder | None
    triplets: Triplets
    levels: int

    @property
    def is_field(self) -> bool:
        """Whether it is a field, which has changes and no value."""
        return self.finest is None

    @property
    def status(self) -> Status | None:
        """Inconclusive where levels are few, the interval is wide or triplets differ: there
        another order may be on its way to the expected one. Where they agree it is judged as it
        stands. None where no order is expected."""
        if self.expected is None:
            return None
        return order_status(None if self.unsettled else self._kept)

    @property
    def unsettled(self) -> str | None:
        """Why these levels do not allow a verdict on the order; None where they do."""
        if self.levels < FEWEST_JUDGED:
            return f"orders are judged from {FEWEST_JUDGED} levels on, and these are {self.levels}"
        if self.observed is None:
            return "no one power of the size goes through these levels"
        if self.observed.half_width > ORDER_WIDTH:
            return f"the interval is wider than ± {ORDER_WIDTH:g}"
        if not triplets_agree(self.triplets):
            return f"two triplets of levels differ by more than {TRIPLETS_AGREE:g}"
        if self.expected is not None and self._kept is None:
            return "the interval reaches below what is allowed"
        return None

    @property
    def _kept(self) -> bool | None:
        if self.observed is None or self.expected is None:
            return None
        off = max(self.expected.allowance, NEARING if self._approaches else 0.0)
        return self.observed.keeps(self.expected.order, off)

    @property
    def _approaches(self) -> bool:
        """Whether the finer triplet comes nearer to the expected order than the coarser, by a
        part that cannot be chance."""
        last, before = self.triplets
        if self.expected is None or last is None or before is None:
            return False
        away = abs(before - self.expected.order)
        return abs(last - self.expected.order) < (1 - APPROACHING) * away


def fits(
    records: Sequence[CaseRecord], expected: Mapping[str, Expected], tolerance: float
) -> tuple[Fit, ...]:
    """Fits of all quantities that change under refinement.

    records    at least four levels, coarse to fine
    tolerance  of the solver, relative: smaller changes are not looked at
    """
    found = []
    levels = [values_of(record) for record in records]
    for name in levels[-1]:
        if all(name in level for level in levels):
            values = [level[name] for level in levels]
            scale = _scale(name, records[-1])
            if scale > _round_off(name, records[-1]) and _changes(values, scale, tolerance):
                found.append(_scalar(name, records, values, scale, expected.get(name)))
    for name in records[-1].fields:
        field = _field(name, records, expected.get(name), tolerance)
        found += [] if field is None else [field]
    return tuple(found)


def _legible(observed: ObservedOrder | None) -> ObservedOrder | None:
    """The order, unless none can be read."""
    return observed if observed is not None and observed.is_legible else None


def _scale(name: str, record: Row) -> float:
    """What errors are relative to: the value, or the length of the vector it belongs to."""
    stem, _, axis = name.rpartition("_")
    values = values_of(record)
    if axis in ("x", "y"):
        return hypot(values[f"{stem}_x"], values[f"{stem}_y"])
    return abs(values[name])


def _round_off(name: str, record: Row) -> float:
    """Below this a motion or a load vanishes by symmetry: a small part of the approach or of the
    normal force, times the contact radius for rotations and moments."""
    values = values_of(record)
    approach, force = values["approach"], values["normal_force"]
    radius = values["contact_radius"]
    natural = {
        "tangential_shift": approach,
        "tangential_force": force,
        "tilt": approach / radius,
        "twist": approach / radius,
        "moment": force * radius,
        "torque": force * radius,
    }
    stem = name.removesuffix("_x").removesuffix("_y")
    return VANISHES * natural.get(stem, 0.0)


def _changes(values: Sequence[float], scale: float, tolerance: float) -> bool:
    return max(values) - min(values) > ABOVE_TOLERANCE * tolerance * scale


def _scalar(
    name: str,
    records: Sequence[CaseRecord],
    values: Sequence[float],
    scale: float,
    expected: Expected | None,
) -> Fit:
    sizes = [size_of(record) for record in records]
    order = ASSUMED if expected is None else expected.order
    fit: RefinedValue = refined_value(sizes, values, order)
    errors = tuple(abs(value - fit.limit) / scale for value in values)
    return Fit(
        name,
        expected,
        tuple(sizes),
        errors,
        values[-1],
        fit.limit,
        fit.uncertainty,
        errors[-1],
        _legible(fit.observed),
        fit.triplets,
        len(records),
    )


def _field(
    name: str, records: Sequence[CaseRecord], expected: Expected | None, tolerance: float
) -> Fit | None:
    """Its changes from level to level fall with the order of its error."""
    pairs = list(pairwise(records))
    changes = field_changes(name, records)
    if len(changes) < len(pairs) or max(changes) <= ABOVE_TOLERANCE * tolerance or 0 in changes:
        return None
    sizes = [size_of(coarse) for coarse, _ in pairs]
    order = ASSUMED if expected is None else expected.order
    ratio = size_of(records[-2]) / size_of(records[-1])
    return Fit(
        name,
        expected,
        tuple(sizes),
        tuple(changes),
        None,
        None,
        None,
        changes[-1] / (ratio**order - 1),
        _legible(observed_order(sizes, changes)),
        triplets_of_changes(sizes, changes),
        len(records),
    )


def field_changes(name: str, records: Sequence[CaseRecord]) -> tuple[float, ...]:
    """Changes of a field to the next level; fewer where a level has none."""
    fields = [record.fields[name] for record in records if name in record.fields]
    changes = (change(coarse, fine) for coarse, fine in pairwise(fields))
    return tuple(found for found in changes if found is not None)


def distance(record: CaseRecord, reference: CaseRecord) -> dict[str, float]:
    """By how much every quantity of the reference differs, relative to its scale there; without
    those that vanish by symmetry or that the record lacks."""
    found, values = {}, values_of(record)
    for name, value in values_of(reference).items():
        scale = _scale(name, reference)
        if name in values and scale > _round_off(name, reference):
            found[name] = abs(values[name] - value) / scale
    for name, field in reference.fields.items():
        difference = change(record.fields[name], field) if name in record.fields else None
        found |= {} if difference is None else {name: difference}
    return found
