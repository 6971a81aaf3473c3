"""The study of all solvers on the same contacts: moduli, thicknesses and friction."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from time import process_time
from typing import Any

from verification.cases.both_solvers.charts import difference_chart
from verification.cases.both_solvers.contacts import CONTACTS, CheckedContact
from verification.cases.both_solvers.costs import ORDER, cost_table, middle, ratio
from verification.cases.both_solvers.differences import differences
from verification.cases.both_solvers.left_out import MARGIN
from verification.cases.both_solvers.sides import CELLS, ELEMENTS, RADIAL, SIDES, Sides
from verification.cases.both_solvers.statements import answer, statements
from verification.cases.both_solvers.tables import (
    difference_table,
    number_table,
    reference_table,
)
from verification.cases.cross_check_tangential import PARTS, RATIO, SCENE, SIZES, Sizes
from verification.exhibits.numbers import plain
from verification.judging.case import Level
from verification.judging.run import RadiiRun
from verification.problems.paper_scene import FRICTION
from verification.quantities import shift_along_x
from verification.running.cold_cache import cold_cache
from verification.running.row import CaseRecord, found, value_of
from verification.running.study import Conclusion, Records, Settings, Statement, Study

CELLS_OF = {Level.QUICK: 128, Level.STANDARD: 256, Level.FULL: 256}
ELEMENTS_OF = {Level.QUICK: 64, Level.STANDARD: 64, Level.FULL: 128}
COATED = sum(contact.is_coated for contact in CONTACTS)
REMARKS = (
    "The own error of a side is the change from half as many cells, elements or rings: what is "
    "left on the finer one, were the order 1; of the radial solver without friction that to twice "
    "the orders and points. The joint uncertainty is the root of the sum of both "
    "squares. A difference beyond what is required is inconclusive as long as twice the joint "
    "uncertainty covers it. That of the elements is taken where the ripple of the coarser mesh's "
    "last five elements does not reach.",
    "Nothing is judged nearer to the axis than two cells or two elements, and no shear nearer to "
    "a kink: the edge of stick, and where that edge turned outward after it had come back by more "
    "than a cell or an element. What sticks keeps the kink that it had there, and both sides round "
    "it. Where that is within an element of the axis, the outward shear jumps there as far as "
    "elements can tell and the pressure has a logarithmic peak, with the same error two elements "
    "away on every mesh: nothing is judged at these two elements either.",
    "All take the same increments, but that the radial solver puts radii between those that are "
    "more than a tenth apart (half of the contact radius with 20 increments, an eighth with 80): "
    "what finite increments cost is hardly seen here.",
    "The cells' tractions are means over 16 directions by cubic splines; those of the elements are "
    "values at their rings, which the others are taken at.",
    "References: without friction an integral equation for every coating; with friction the "
    "self-similar solution of the homogeneous body and one coated body, neither with increments.",
)


PUSHED = "pushed"


@dataclass(frozen=True)
class CrossCheckRun:
    """A contact by all solvers, each on two finenesses."""

    sides: Sides

    @property
    def name(self) -> str:
        return f"{self.sides.contact.file_name}-{self.sides.cells}-{self.sides.elements}"

    def compute(self) -> CaseRecord:
        solved: dict[str, tuple[Any, Any]] = {}
        clock: dict[str, float] = {}
        for side, (coarse, fine) in self.sides.runs.items():
            beside = coarse.solve()  # imports, too, what the other is not to be charged with
            solved[side] = beside, _clocked(fine.solve, clock, side)
        record = self.sides.record(solved, self.sides.elements)
        return record.model_copy(update={"clock": clock})


@dataclass(frozen=True)
class PushedRun:
    """The coated contact of the case `cross_check_tangential`, pressed and pushed."""

    sizes: Sizes

    @property
    def name(self) -> str:
        return f"{PUSHED}-{self.sizes.cells}-{self.sizes.elements}-{self.sizes.harmonics}"

    def compute(self) -> CaseRecord:
        runs: dict[str, Any] = {
            CELLS: self.sizes.surface,
            ELEMENTS: self.sizes.section,
            RADIAL: RadiiRun("on radii", SCENE),
        }
        clock: dict[str, float] = {}
        measures: dict[str, float | None] = {}
        for side, run in runs.items():
            result = _clocked(run.solve, clock, side)
            for step, part in enumerate(PARTS[1:], 2):
                measures[f"shift_at_{part:g}_{side}"] = shift_along_x(result.steps[step - 1])
        return CaseRecord(
            parameters={"cells": self.sizes.cells, "elements": self.sizes.elements,
                        "harmonics": self.sizes.harmonics},
            measures=measures,
            units=dict.fromkeys(measures, "m"),
            clock=clock,
        )  # fmt: skip


def _clocked(solve: Callable[[], Any], clock: dict[str, float], side: str) -> Any:
    """What a solve returns; its CPU seconds with an empty cache are noted."""
    with cold_cache():
        started = process_time()
        result = solve()
        clock[side] = process_time() - started
    return result


def cases(settings: Settings) -> tuple[CrossCheckRun | PushedRun, ...]:
    """One case per contact, and the pushed one."""
    return (*_pressed(settings), PushedRun(SIZES[settings.level]))


def _pressed(settings: Settings) -> tuple[CrossCheckRun, ...]:
    cells, elements = settings.cells or CELLS_OF[settings.level], ELEMENTS_OF[settings.level]
    return tuple(CrossCheckRun(Sides(contact, cells, elements)) for contact in CONTACTS)


def conclude(settings: Settings, records: Records) -> Conclusion:
    """Differences with the error of each side, their curves, and the verdict."""
    runs = _pressed(settings)
    known: dict[CheckedContact, CaseRecord] = {
        run.sides.contact: record for run, record in found(runs, records).items()
    }
    apart = {contact: differences(record) for contact, record in known.items()}
    return Conclusion(
        statements=(*statements(known, apart), _pushed(settings, records)),
        answer=answer(apart, _fineness(runs[0].sides)),
        tables=(reference_table(apart), difference_table(apart), number_table(known))
        if known
        else (),
        charts=tuple(
            difference_chart(known, name, side)
            for name in ("pressure", "shear")
            for side in (CELLS, ELEMENTS)
            if known
        ),
        remarks=REMARKS,
    )


def _pushed(settings: Settings, records: Records) -> Statement:
    """Shifts of the pushed contact, as far apart as any two solvers are."""
    record = records.get(PushedRun(SIZES[settings.level]).name)
    parts = []
    for part in PARTS[1:]:
        if record is None:
            continue
        shifts = [value_of(record, f"shift_at_{part:g}_{side}") for side in SIDES]
        parts.append(f"{plain(max(shifts) / min(shifts) - 1, 2)} at {part:g} µW")
    return Statement(
        claim="how far apart any two are in the shift of the pushed coated body, relative",
        outcome=None,
        measured=", ".join(parts) or "not solved",
        because="a finding: the case cross_check_tangential judges it",
    )


def timed(settings: Settings, records: Records) -> Conclusion:
    """CPU seconds of all sides, scene by scene: a finding, no verdict."""
    every = found(cases(settings), records)
    clocks: dict[tuple[str, ...], Mapping[str, float]] = {
        (*_coordinates(run), run.name if isinstance(run, PushedRun) else "pressed"): record.clock
        for run, record in every.items()
    }
    groups: dict[str, list[Mapping[str, float]]] = {}
    for run, record in every.items():
        group = PUSHED if isinstance(run, PushedRun) else f"µ = {run.sides.contact.friction:g}"
        groups.setdefault(group, []).append(record.clock)
    said = [f"{ratio(middle(of))} ({group}, {plain(middle(of)[RADIAL], 2)} s)"
            for group, of in groups.items()]  # fmt: skip
    return Conclusion(
        statements=(),
        answer=f"CPU time {' : '.join(ORDER)}, medians, and what the first takes: "
        f"{'; '.join(said)}.",
        tables=(cost_table(clocks, ("E1/E2", "h / a_H", "µ", "scene")),) if clocks else (),
    )


def _coordinates(run: CrossCheckRun | PushedRun) -> tuple[str, str, str]:
    if isinstance(run, PushedRun):
        return f"{RATIO:g}", "1", f"{FRICTION:g}"
    contact = run.sides.contact
    return f"{contact.modulus_ratio:g}", f"{contact.thickness:g}", f"{contact.friction:g}"


def _fineness(sides: Sides) -> str:
    """Of cells and elements, on one scale."""
    cells = sides.cells / (2 * MARGIN)
    return f"{cells:.0f} cells and {sides.elements} elements per contact radius"


STUDY = Study(
    name="cross-check",
    title="Three solvers on the same coated contacts",
    question="A rigid ball is pressed on coated half-spaces with and without friction: "
    f"{len(CONTACTS)} scenes, {COATED} of them with a coating unlike its body, "
    "solved by cells with Fourier transforms, by axisymmetric finite elements, and on radii. The "
    "first and the last ask the same functions how layers answer one wavenumber; but for that the "
    "three share nothing but the scene. How far are they apart, does each side's own error explain "
    "it, and what do they take?",
    cases=cases,
    conclude=conclude,
    timed=timed,
)
