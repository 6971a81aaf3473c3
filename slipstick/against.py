"""Comparison of a stored run with a measured loop or profile, for the command `slipstick against`.

A loop of tangential force over shift is compared in four steps:

- closure: a measured loop of one or more cycles returns to its first point except for drift. A
  drift that grows in proportion to the number of points is subtracted from shift and force. Without
  a drift of the force, the energy is then the sum of (T - mean T) Δδ over the measured steps
- centre: mean of the largest and the smallest shift, and of the largest and the smallest force
- slope (ratio of the ranges of force and shift) and area (energy per cycle)
- forces at equal shifts, after both loops were moved to a common centre; the shifts are those of
  the loop with fewer points
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from contact_results.files.stored_run import StoredRun
from contact_results.surface import Rings
from contact_scene.checks.line_contact import lacks_reference
from contact_scene.quantities.per_length import shown_unit
from contact_scene.quantities.summary import StepSummary
from contact_scene.reading import units
from contact_scene.reading.text_table import ColumnNames
from contact_scene.rig import compliances

Numbers = NDArray[np.float64]
SHIFT = "tangential_shift"
ACTUATOR = "actuator_shift"
LOAD = "tangential_force"
LOAD_PER_LENGTH = "tangential_force_per_length"
PLACE = "x"
PRESSURE = "pressure"
SHEAR = "shear"
STEP = "step"
_HEADS_OF_LOAD = frozenset({"t", "f", "force", "tangential_force", "tangential_force_x"})
# Accepted heads of measured columns, including those of increments.csv and profiles.csv. The unit
# of a load decides whether it is per length, as that of a line contact.
MEASURED: ColumnNames = {
    SHIFT: (
        units.LENGTH,
        frozenset({"shift", "delta", "δ", "tangential_shift", "tangential_shift_x"}),
    ),
    ACTUATOR: (units.LENGTH, frozenset({"actuator_shift", "actuator_shift_x", "delta*", "δ*"})),
    LOAD: (units.FORCE, _HEADS_OF_LOAD),
    LOAD_PER_LENGTH: (units.FORCE_PER_LENGTH, _HEADS_OF_LOAD),
    PLACE: (units.LENGTH, frozenset({"x"})),
    PRESSURE: (units.PRESSURE, frozenset({"p", "pressure"})),
    SHEAR: (units.PRESSURE, frozenset({"q", "shear", "shear_x"})),
}
# The load step of each row of a profile.
STEPS: ColumnNames = {STEP: (units.COUNT, frozenset({"step"}))}
# Largest distance of the last shift of a loop from its first, relative to the range: one half if
# four points go around, and 1 for one branch.
GAP = 0.75
# Error of a profile over its change without every second point. Halfway between cells of side h,
# interpolated means err by at most (1/8 + 1/24) h² times the curvature, and the change is h²/4
# times it. Means and interpolation across the profile err by as much again.
BOTH_AXES = 2.0
OVERALL = "overall"  # requirement without the name of a number


class NothingToCompare(ValueError):
    """Error raised for a measured table that has no counterpart in the run."""


@dataclass(frozen=True, eq=False)
class ComparedNumber:
    """Comparison of one measured number with the computed number of a run, in the unit `unit`.

    name                description of the number, such as "energy per cycle"
    measured, computed  numbers of the table and of the run
    error               stated error of the computed number; None if unknown
    gap                 absolute difference; for curves, the root mean square of the differences at
                        all points
    of_table            error of the measured number, from the closure of a loop and the distance of
                        its points; None if unknown
    differences         measured minus computed values at the points of a curve (n,); None for other
                        numbers
    uncertainty         validation uncertainty of the difference, two standard deviations; None if
                        it is not asked for or unknown
    """

    name: str
    unit: str
    measured: float
    computed: float
    error: float | None
    gap: float
    of_table: float | None = None
    differences: Numbers | None = None
    uncertainty: float | None = None

    @property
    def ratio(self) -> float | None:
        """Ratio of the measured to the computed number.

        The ratio is None if the computed number is zero within its error.
        """
        return self.measured / self.computed if abs(self.computed) > (self.error or 0.0) else None

    @property
    def ours(self) -> float | None:
        """Largest fraction of the difference that the error of the computed number explains.

        The fraction is 1 if the error of the computed number exceeds the difference, and None if
        the error is unknown.
        """
        if self.error is None:
            return None
        return self.error / self.gap if self.error < self.gap else 1.0


@dataclass(frozen=True, eq=False)
class ComparedCurve:
    """Measured and computed curve of a comparison, in SI units.

    place, name         quantities along and across: shift and force, or x and a traction
    place_unit, unit    their units
    measured, computed  points of the curves (2, n)
    """

    place: str
    place_unit: str
    name: str
    unit: str
    measured: Numbers
    computed: Numbers


@dataclass(frozen=True, eq=False)
class Comparison:
    """Comparison of a measured table with a run: numbers, and the curves that they belong to."""

    numbers: tuple[ComparedNumber, ...]
    curves: tuple[ComparedCurve, ...]


def comparison(table: Mapping[str, Numbers], run: StoredRun, step: int | None = None) -> Comparison:
    """Compare a measured table with a stored run.

    Raises NothingToCompare if the columns of the table or the run do not allow a comparison.

    table  columns by name in SI units: shift and T of a loop, T per length for a line contact; or x
           with p, q or both of a profile, and the load step of each row if the table has several
    run    stored run
    step   load step at whose end profiles are compared, from 1; the last of the run if None
    """
    motions = [motion for motion in (ACTUATOR, SHIFT) if motion in table]
    if motions and {LOAD, LOAD_PER_LENGTH} & table.keys():
        if step is not None:
            raise NothingToCompare("a loop is compared with the last load cycle; omit --step")
        return _compare_loops(np.stack([table[motions[0]], _load(table, run)]), run, motions[0])
    if PLACE in table and {PRESSURE, SHEAR} & table.keys():
        count = len(run.summary.steps)
        step = step or count
        return _compare_profiles(_rows_of_step(table, step, count), run, step)
    raise NothingToCompare(
        f"got values in the columns {', '.join(table) or 'none'}, expected shift or actuator_shift "
        "with T (a loop), or x with p or q (a profile); write heads such as 'shift [um]' and "
        "'T [N]'"
    )


def _load(table: Mapping[str, Numbers], run: StoredRun) -> Numbers:
    """Return the tangential force of a loop: per length for a line contact.

    Raises NothingToCompare for a force that has not the unit of the contact, and for a line contact
    without shift.
    """
    if not run.scene.indenter.is_line:
        if LOAD not in table:
            raise NothingToCompare(
                "got T per length, and the contact is no line contact; give T in N, such as 'T [N]'"
            )
        return table[LOAD]
    if LOAD_PER_LENGTH not in table:
        raise NothingToCompare(
            "got T in N, and a line contact has forces per length; divide T by the length of the "
            "contact, and name its unit, such as 'T [N/mm]'"
        )
    if lacks_reference(run.scene.indenter, run.scene.body):
        raise NothingToCompare(
            "the shift of a line contact depends on the distance at which the surface is fixed; "
            'add indenter.reference_length to the scene, such as "20 mm"'
        )
    return table[LOAD_PER_LENGTH]


@dataclass(frozen=True, eq=False)
class _Loop:
    """Closed loop of tangential force over shift: one or more load cycles with n points.

    The last point is followed by the first one.

    shift  tangential shift at each point (n,) [length]
    force  tangential force at each point (n,) [force]
    """

    shift: Numbers
    force: Numbers

    @property
    def slope(self) -> float:
        """Ratio of the range of the force to the range of the shift [force/length]."""
        return float(np.ptp(self.force) / np.ptp(self.shift))

    @property
    def area(self) -> float:
        """Area of the polygon through the points: energy of all cycles [force length].

        The area is negative if the points are in reversed order.
        """
        turn = np.roll(self.shift, -1) * self.force - self.shift * np.roll(self.force, -1)
        return 0.5 * float(np.sum(turn))

    @property
    def area_error(self) -> float:
        """Error of the area due to the distance of the points: its change without every second."""
        halves = (_Loop(self.shift[first::2], self.force[first::2]) for first in (0, 1))
        return max(abs(half.area - self.area) for half in halves)

    @property
    def about_centre(self) -> Numbers:
        """Shift and force of the closed loop, relative to its centre (2, n + 1)."""
        points = np.stack([self.shift, self.force])
        points -= np.array([_loop_centre(self.shift), _loop_centre(self.force)])[:, None]
        return np.concatenate([points, points[:, :1]], axis=1)

    @cached_property
    def cycles(self) -> tuple[_Loop, ...]:
        """The load cycles, each from its smallest shift; empty if there is none.

        In a cycle, the shift exceeds a quarter of its range on either side of the centre.
        """
        begin = int(np.argmin(self.shift))
        points = np.roll(np.stack([self.shift, self.force]), -begin, axis=1)
        apart = points[0] - _loop_centre(points[0])
        outer = np.flatnonzero(np.abs(apart) > np.ptp(apart) / 4)
        turns = np.flatnonzero(np.diff(np.sign(apart[outer]))) + 1
        sides = np.split(outer, turns)
        count = len(sides) // 2  # a last side without its counterpart belongs to the first one
        starts = [side[np.argmin(apart[side])] for side in sides[2 : 2 * count : 2]]
        return tuple(_Loop(*each) for each in np.split(points, starts, axis=1)) if count else ()

    @property
    def branches(self) -> tuple[tuple[Numbers, Numbers], ...]:
        """The two branches of the loop: pairs of shift and force, both relative to the centre.

        One branch has the points from the smallest to the largest shift, the other the points of
        the way back. The shifts of each branch are in ascending order.
        """
        begin = int(np.argmin(self.shift))
        shift, force = (
            np.roll(each, -begin) - _loop_centre(each) for each in (self.shift, self.force)
        )
        turn = int(np.argmax(shift))
        back = np.arange(turn, len(shift) + 1)[::-1] % len(shift)
        return (shift[: turn + 1], force[: turn + 1]), (shift[back], force[back])


def _loop_centre(values: Numbers) -> float:
    return float(np.max(values) + np.min(values)) / 2


def _close_loop(points: Numbers) -> _Loop:
    """Close a measured loop.

    The last point of the table precedes the first one by one step, or repeats it. The change from
    the last point to the first is a step if it resembles the first or the last step of the table:
    half to twice its shift and half to twice its force. Any other change is due to drift, which is
    subtracted in proportion to the number of points. Raises NothingToCompare unless the points make
    up whole cycles.

    points  shift and force (2, n)
    """
    gap = points[:, -1] - points[:, 0]
    adjacent = np.diff(points, axis=1)[:, [0, -1]].T if points.shape[1] > 1 else ()
    if any(np.all((step / 2 + gap) * (2 * step + gap) <= 0) for step in adjacent):
        loop = _Loop(*points)
    else:
        drift = gap[:, None] * np.linspace(0.0, 1.0, points.shape[1])
        loop = _Loop(*(points - drift)[:, : max(1, points.shape[1] - 1)])
    most = GAP * float(np.ptp(points[0]))
    if not loop.cycles or not abs(gap[0]) < most:
        raise NothingToCompare(
            f"cycles in the table: got {len(loop.cycles)}, expected the points of one or more "
            "whole cycles in order; gap between the last shift and the first: got "
            f"{abs(gap[0]):.3g} m, expected less than {most:.3g} m"
        )
    return loop


def unmet(comparison: Comparison, required: Mapping[str, float]) -> tuple[str, ...]:
    """Return a sentence on each number whose difference exceeds the required share.

    required  largest allowed difference by name of the number, with underscores, relative to the
              measured number; the name `overall` stands for all numbers except gaps and centres

    Raises NothingToCompare for a name that the comparison does not have.
    """
    known = {each.name.replace(" ", "_"): each for each in comparison.numbers}
    if unknown := required.keys() - known.keys() - {OVERALL}:
        raise NothingToCompare(
            f"got the required numbers {', '.join(sorted(unknown))}, expected one of "
            f"{', '.join(known)}, or a share without a name"
        )
    around = ("gap", "centre")  # zero in a perfect test, so that a share of them says nothing
    overall = required.get(OVERALL)
    shares = {} if overall is None else {n: overall for n in known if not n.startswith(around)}
    shares |= {name: share for name, share in required.items() if name != OVERALL}
    return tuple(
        f"{known[name].name}: the difference is "
        f"{100 * known[name].gap / abs(known[name].measured):.3g} % of the measured number, "
        f"required {100 * share:.4g} %"
        if known[name].measured
        else f"{known[name].name}: the measured number is 0, the computed one is not"
        for name, share in shares.items()
        if known[name].gap > share * abs(known[name].measured)
    )


def _compare_loops(table: Numbers, run: StoredRun, motion: str) -> Comparison:
    """Compare a measured loop of force over shift with the last load cycle of a run.

    Compares the gaps between last and first point, centre, slope and area, and the forces along the
    loop. Raises NothingToCompare if the table has no whole cycles, or if no
    load cycle of the run closes with slip under changing force and shift.

    table   measured shift and force (2, n)
    motion  name of the compared shift: that of the actuator of a test rig, or of the contact
    """
    theirs = _close_loop(table)
    # Both ratios have a value only if the force and both shifts change in the cycle.
    numbered = [
        (n, end)
        for n, end in enumerate(run.summary.steps, 1)
        if end.energy_ratio and end.gross_slip_share
    ]
    if not numbered:
        raise NothingToCompare(
            "the table is a loop, and no load cycle of the run closes with slip under a force and "
            "a shift that change; end a load step with the loads of an earlier one"
        )
    (last, end), increments = numbered[-1], run.increments
    steps = increments["step"].array
    start = np.flatnonzero(steps == end.cycle_start)[-1]
    path = slice(start, np.flatnonzero(steps == last)[-1] + 1)
    motion = motion if compliances(run.scene.rig)[1] else SHIFT
    moves, loads = (increments[name].array[path].T for name in (motion, LOAD))
    change = loads[:, np.argmax(np.hypot(*(loads - loads[:, :1])))] - loads[:, 0]
    along = change / np.hypot(*change) * np.sign(change[np.argmax(np.abs(change))])
    ours = _Loop(along @ moves, along @ loads)
    of_shift, of_force, of_energy = (
        _stated_error(end, name) for name in (motion, LOAD, "energy_per_cycle")
    )
    of_slope = None
    if of_shift is not None and of_force is not None:
        parts = of_shift / np.ptp(ours.shift) + of_force / np.ptp(ours.force)
        of_slope = float(2 * parts * ours.slope)
    newton, joule, stiffness = (
        shown_unit(unit, line=run.scene.indenter.is_line) for unit in ("N", "J", "N/m")
    )
    gaps = table[:, -1] - table[:, 0]
    numbers = []
    for name, unit, gap, each, error in (
        ("gap of shift", "m", gaps[0], ours.shift, of_shift),
        ("gap of force", newton, gaps[1], ours.force, of_force),
    ):
        own = float(each[-1] - each[0])
        numbers.append(_compare_number(name, unit, float(gap), own, error))
    for name, unit, measured, computed, error in (
        ("centre of shift", "m", theirs.shift, ours.shift, of_shift),
        ("centre of force", newton, theirs.force, ours.force, of_force),
    ):
        centres = _loop_centre(measured), _loop_centre(computed)
        numbers.append(_compare_number(name, unit, *centres, error))
    numbers.append(_compare_number("slope", stiffness, theirs.slope, ours.slope, of_slope))
    # A drift of any course changes the energy by less than its size times the largest distance of
    # the other coordinate from its mean.
    furthest = [np.max(np.abs(each - np.mean(each))) for each in (theirs.force, theirs.shift)]
    cycles = len(theirs.cycles)
    energy = _compare_number(
        "energy per cycle", joule, theirs.area / cycles, end.energy_per_cycle or 0.0, of_energy
    )
    of_table = float(np.abs(gaps) @ furthest + theirs.area_error) / cycles
    numbers.append(replace(energy, of_table=of_table))
    differences = []
    for cycle in theirs.cycles:
        few, many = sorted((cycle, ours), key=lambda loop: len(loop.shift))
        sign = 1.0 if few is cycle else -1.0
        differences += [
            sign * (force - np.interp(shift, *finer))
            for (shift, force), finer in zip(few.branches, many.branches, strict=True)
        ]
    theirs_half, ours_half = (float(np.ptp(loop.force)) / 2 for loop in (theirs, ours))
    error = None if of_slope is None else of_slope * float(np.ptp(ours.shift)) / 2
    along_loop = np.concatenate(differences)
    along = _compare_curves(
        "force along the loop", newton, theirs_half, ours_half, error, along_loop
    )
    # A drift of another course than the subtracted one, after the loops have a common centre.
    of_drift = float(abs(gaps[1]) + abs(gaps[0]) * theirs.slope) / 2
    numbers.append(replace(along, of_table=of_drift))
    curve = ComparedCurve("shift", "m", "force", newton, theirs.about_centre, ours.about_centre)
    return Comparison(tuple(numbers), (curve,))


def _rows_of_step(table: Mapping[str, Numbers], step: int, count: int) -> Mapping[str, Numbers]:
    """Return the rows of a load step; all rows of a table without a column of load steps.

    count  number of load steps of the run

    Raises NothingToCompare if the table has no row of the load step, or if the column has other
    numbers than load steps of the run.
    """
    if STEP not in table:
        return table
    if not np.all(np.isin(table[STEP], np.arange(1, count + 1))):
        raise NothingToCompare(
            f"the column 'step' has {min(table[STEP]):g} to {max(table[STEP]):g}, expected load "
            f"steps of the run, 1 to {count}; rename the column if it has none"
        )
    rows = table[STEP] == step
    if not np.any(rows):
        found = ", ".join(f"{each:g}" for each in np.unique(table[STEP]))
        raise NothingToCompare(
            f"the table has no row of load step {step}: its column 'step' has {found}; "
            "choose the load step with --step"
        )
    return {name: column[rows] for name, column in table.items()}


def _compare_profiles(table: Mapping[str, Numbers], run: StoredRun, step: int) -> Comparison:
    """Compare measured profiles of pressure and shear with those of a run.

    Compares the largest values, and the values at the positions x of the table.
    The tractions of the run are 0 outside its window.

    table  x with pressure, shear or both, in SI units
    step   load step at whose end the profiles are compared, from 1
    """
    end, surface = run.summary.steps[step - 1], run.surface
    if isinstance(surface, Rings):
        surface = surface.on_both_sides()
    state: Any = run.end_of_step(step - 1)
    shear = surface.vector(state, SHEAR)
    of_run = {
        PRESSURE: surface.scalar(state, PRESSURE),
        SHEAR: None if shear is None else np.tensordot(surface.direction, shear, 1),
    }
    # The relative error of tractions is that of the peak pressure; that of shear includes the
    # errors of tangential force and shift. A line contact without reference length has no shift,
    # and its shear does not depend on that length: the error of the stick zone replaces it.
    moved = "stick_radius" if lacks_reference(run.scene.indenter, run.scene.body) else SHIFT
    shares = [_relative_error(end, "peak_pressure")]
    numbers, curves = [], []
    for name in (PRESSURE, SHEAR):
        if name not in table:
            continue
        field = of_run[name]
        if name == SHEAR:
            shares += [_relative_error(end, of) for of in (moved, LOAD)]
        if field is None:
            raise NothingToCompare("the run has no shear; leave the column out or add friction")
        places, along = surface.profile_line.places, surface.along(field)
        measured, computed = np.stack([table[PLACE], table[name]]), np.stack([places, along])
        curves.append(ComparedCurve(PLACE, "m", name, "Pa", measured, computed))
        ours = np.interp(table[PLACE], places, along, 0.0, 0.0)
        measured_largest, largest = (float(np.max(np.abs(each))) for each in (table[name], ours))
        known = [share for share in shares if share is not None]
        of_largest = of_curve = None
        if len(known) == len(shares):
            changes = [ours - each for each in _every_second(table[PLACE], *computed)]
            peak = np.argmax(np.abs(ours))
            at_peak = max(abs(float(change[peak])) for change in changes)
            of_largest = sum(known) * largest + BOTH_AXES * at_peak
            of_curve = sum(known) * largest + BOTH_AXES * max(map(root_mean_square, changes))
        pair = measured_largest, largest
        numbers.append(_compare_number(f"largest {name}", "Pa", *pair, of_largest))
        label = f"{name} at the places"
        numbers.append(_compare_curves(label, "Pa", *pair, of_curve, table[name] - ours))
    return Comparison(tuple(numbers), tuple(curves))


def _every_second(at: Numbers, places: Numbers, values: Numbers) -> tuple[Numbers, Numbers]:
    """Interpolate a profile to the places `at` from its odd points, and from its even ones."""
    odd, even = (np.interp(at, places[k::2], values[k::2], 0.0, 0.0) for k in (0, 1))
    return odd, even


def _stated_error(end: StepSummary, name: str) -> float | None:
    """Return the stated error of a scalar, of a vector the larger one; None if unknown."""
    stated = (end.errors or {}).get(name)
    return None if stated is None or stated.error is None else float(np.max(stated.error))


def _relative_error(end: StepSummary, name: str) -> float | None:
    error, value = _stated_error(end, name), np.max(np.abs(getattr(end, name) or 0.0))
    return error / float(value) if error and value else error


def _compare_number(
    name: str, unit: str, measured: float, computed: float, error: float | None
) -> ComparedNumber:
    return ComparedNumber(name, unit, measured, computed, error, abs(measured - computed))


def _compare_curves(
    name: str,
    unit: str,
    measured: float,
    computed: float,
    error: float | None,
    differences: Numbers,
) -> ComparedNumber:
    gap = root_mean_square(differences)
    return ComparedNumber(name, unit, measured, computed, error, gap, differences=differences)


def root_mean_square(values: Numbers) -> float:
    """Return the root mean square of the differences of two curves."""
    return float(np.sqrt(np.mean(values**2)))
