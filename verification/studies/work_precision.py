"""Study of work and precision: relative error against CPU time for every solution method and
setting."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import Any

import numpy as np

import radial
from contact_results.surface import surface_of
from contact_scene.array_types import Field
from contact_scene.discretisation import EdgeCorrection
from contact_scene.quantities.residuals import worst
from semi_analytical import SurfaceGrid
from verification import norms, solver
from verification.cases import coatings as coated
from verification.exhibits.chart import (
    NONE,
    Chart,
    Look,
    Points,
    Table,
    log_chart,
    plain,
    point_curves,
)
from verification.judging import field_errors
from verification.judging.case import (
    SOLVER_TOLERANCE,
    Level,
    RadiiRun,
    Run,
    SectionRun,
    per_radius,
)
from verification.judging.declared_case import (
    APPROACH,
    ENERGY_PER_CYCLE,
    EXACT,
    LARGEST_SHIFT_ERROR,
    PEAK_PRESSURE,
    SHIFT,
    Observable,
    error_norm,
    meshed,
)
from verification.judging.field_errors import pressure_at, shear_at
from verification.norms import max_norm
from verification.problems.cattaneo_mindlin import (
    FRETTING_WINDOW,
    OVER_LIMIT,
    fretting_loop_problem,
    sheared,
)
from verification.problems.indentation import BALL, COATED
from verification.problems.problem import (
    FRICTION,
    NU_ZERO,
    OVER_PEAK,
    WINDOW_PER_RADIUS,
    Problem,
    square_grid,
)
from verification.quantities import shear_of
from verification.running.cold_cache import timed
from verification.running.study import (
    CaseRecord,
    Conclusion,
    Records,
    Settings,
    Statement,
    Study,
    found,
    judged,
    parameters_of,
    solved,
    value_of,
)

Errors = Mapping[str, float]

SHEARED = 0.9  # of µW
QUARTER = 3  # increments from T = 0 to the largest
JUDGED = (0.1 - 1e-9, 0.9 + 1e-9)  # part of the radius where the tractions under friction are


@dataclass(frozen=True)
class PreciseContact:
    """Contact with a reference solution, on which the study measures errors and CPU times.

    name         name in files
    title        name for readers
    errors       measured errors in words, by name: norms of fields and errors of scalars
    observables  the same errors as functions of the result of a solver
    posed        function that returns the problem for a number of increments
    window       side of the window over the contact radius
    increments   number passed to `posed` unless the study varies it; None for 1
    """

    name: str
    title: str
    errors: Mapping[str, str]
    observables: tuple[Observable, ...]
    posed: Callable[[int], Problem]
    window: float = WINDOW_PER_RADIUS
    increments: int | None = None

    @property
    def problem(self) -> Problem:
        """Verification problem of the contact, with its reference solution.

        Each path-dependent load step has one increment.
        """
        return self.posed(1)

    def errors_of(self, result: Any) -> Errors:
        """Compute all measured errors of a result against the reference solution, by name of the
        error.

        result  result of a solver for the contact
        """
        named = zip(self.errors, self.observables, strict=True)
        return {name: one.error(self.problem)(result) for name, one in named}

    def grid(self, cells: int) -> SurfaceGrid:
        """Return a square surface grid around the contact with the given number of cells per
        side."""
        return square_grid(cells, self.window / 2 * self.problem.radius)


def _pressure_l2(result: Any, step: int, problem: Problem) -> float:
    """Compute the relative L2 error of the pressure at the end of a load step against the exact
    pressure.

    On a surface grid the exact pressure is averaged over each cell. On rings of the radial solver
    it is evaluated at each ring, and the norm is weighted by area.

    result   result of a solver
    step     index of the load step
    problem  verification problem with its exact solution
    """
    end, exact = result.steps[step], problem.ends[step].pressure
    if hasattr(result, "grid"):
        return norms.relative_l2(end.pressure, field_errors.exact_means(result, exact, problem))
    if not isinstance(result, radial.Result):
        return field_errors.pressure_l2(result, step, problem)
    surface: Any = surface_of(result)
    part = np.sqrt(surface.weights)
    known = exact(np.hypot(*surface.positions))
    return norms.relative_l2(part * surface.scalar(end, "pressure"), part * known)


def _shear_l1(result: Any, step: int, problem: Problem) -> float:
    """Compute the relative L1 error of the shear traction at the end of a load step.

    The error is Σ|q - q_exact| / Σµp over cells, or with weights by area over rings.

    result   result of a solver
    step     index of the load step
    problem  verification problem with its exact solution
    """
    end, exact = result.steps[step], problem.ends[step].shear
    if hasattr(result, "grid"):
        known = field_errors.exact_means(result, exact, problem)
        return norms.shear_error(shear_of(end), known, FRICTION * end.pressure)
    if not isinstance(result, radial.Result):
        return field_errors.shear_error(result, step, problem)
    surface: Any = surface_of(result)
    areas, known = surface.weights, exact(np.hypot(*surface.positions))
    limit = areas * FRICTION * surface.scalar(end, "pressure")
    return norms.shear_error(areas * surface.vector(end, "shear"), areas * known, limit)


def _largest_error(
    at: Callable[[Any, Field], Field], exact: Callable[[Any], Callable[[Field], Field]], scale: str
) -> Observable:
    """Return the observable of the largest error of a traction from 0.1 to 0.9 of the contact
    radius.

    Used for the contact that is pressed with friction.

    at     function of the result and radii r that returns the computed traction
    exact  function of the reference solution that returns the traction as a function of r
    scale  name of the scale by which the error is divided
    """

    def measure(result: Any, step: int, problem: Problem) -> float:
        answer = problem.ends[step]
        part = answer.radii / problem.radius
        r = answer.radii[(part >= JUDGED[0]) & (part <= JUDGED[1])]
        error = at(result, r) - exact(answer)(r)[:, None]
        return max_norm(error) / problem.scale(scale)

    return error_norm("traction", "", measure, scale)


PRESSURE = error_norm("pressure", "pressure over the {domain}, L2", _pressure_l2, norm="L2")
SHEAR = error_norm("shear", "{sum}|q - q_exact| / {sum}µp{when}", _shear_l1, "Σµp")
HERTZIAN = PreciseContact(
    "hertz",
    "Hertz",
    {"pressure": "pressure, L2", "peak": "peak pressure", "approach": "approach"},
    (PRESSURE, PEAK_PRESSURE, APPROACH),
    lambda _: BALL,
)
CATTANEO = PreciseContact(
    "cattaneo",
    "Cattaneo-Mindlin, ν = 0",
    {"shear": "shear at 0.9 µW, Σ|q - q_exact| / Σµp", "shift": "shift over the sliding shift"},
    (SHEAR, SHIFT),
    lambda increments: sheared("Cattaneo-Mindlin, ν = 0", (SHEARED,), increments=increments),
)
COATING = PreciseContact(
    "coated",
    "Coated, E1/E2 = 2, without friction",
    {"pressure": "pressure, L2", "approach": "approach"},
    (PRESSURE, APPROACH),
    lambda _: coated.EXACT,
)
INDENTATION = PreciseContact(
    "indentation",
    "Coated, pressed with friction",
    {
        "shear": "shear from 0.1 to 0.9 of the radius, largest, over µp_H",
        "pressure": "pressure there, largest, over p_H",
        "approach": "approach",
    },
    (
        _largest_error(shear_at, lambda answer: answer.shear, OVER_LIMIT),
        _largest_error(pressure_at, lambda answer: answer.pressure, OVER_PEAK),
        APPROACH,
    ),
    COATED.problem,
    increments=20,
)
LOOP = PreciseContact(
    "loop",
    "Fretting loop, ν = 0",
    {"energy": "energy of a cycle", "shift": "largest error of the shift"},
    (ENERGY_PER_CYCLE, LARGEST_SHIFT_ERROR),
    lambda quarter: fretting_loop_problem("Fretting loop, ν = 0", NU_ZERO, quarter),
    window=FRETTING_WINDOW,
    increments=QUARTER,
)
CONTACTS = {c.name: c for c in (HERTZIAN, CATTANEO, COATING, INDENTATION, LOOP)}


# Of the radial solver the fineness is in twelfths of its own; fields are given at so many radii,
# between which a table is interpolated.
OWN = 12
TOLD = 512
CELLS = {Level.QUICK: (16, 32, 64, 128), Level.STANDARD: (16, 32, 64, 128, 256)}
# More where a norm of the field means the edge: without correction the finest grids reach 0.1 %.
TO_THE_EDGE: dict[str, dict[Level, tuple[int, ...]]] = {
    HERTZIAN.name: {Level.QUICK: (256, 512), Level.STANDARD: (512,), Level.FULL: (512, 1024)},
    COATING.name: {Level.QUICK: (256, 512), Level.STANDARD: (512,), Level.FULL: (512, 1024)},
    CATTANEO.name: {Level.QUICK: (256,), Level.STANDARD: (512,), Level.FULL: (512,)},
}
ELEMENTS = {
    Level.QUICK: (8, 16, 32),
    Level.STANDARD: (8, 16, 32, 64),
    Level.FULL: (8, 16, 32, 64, 128),
}
LOOSE = {Level.QUICK: (1e-4,), Level.STANDARD: (1e-2, 1e-4)}  # tolerances of the solver
PENALTIES = {Level.QUICK: (1.0, 10.0), Level.STANDARD: (1.0, 10.0, 100.0)}
RINGS = {
    Level.QUICK: (OWN // 2, OWN),
    Level.STANDARD: (OWN // 2, OWN, 3 * OWN // 2),
    Level.FULL: (OWN // 2, OWN, 3 * OWN // 2, 2 * OWN),
}
# The edge correction does not change the energies and shifts of a loop.
WITH_EDGES = (HERTZIAN.name, CATTANEO.name, COATING.name, INDENTATION.name)
INCREMENTS = {Level.QUICK: (5,), Level.STANDARD: (5, 10, 40)}  # beside the usual ones
MAX_SPRINGS = 64  # elements; finer penalty solves take longer than all other cases


class Method(StrEnum):
    """Solution method of a contact in the study of work and precision.

    A method is a solver, with or without edge correction or penalty.
    """

    SURFACE = "semi-analytical"
    EDGES = "semi-analytical, edges inside cells"
    ELEMENTS = "finite elements"
    PENALTY = "finite elements, penalty"
    RADIAL = "radial"


@dataclass(frozen=True)
class PrecisionCase:
    """Solve of one contact by one method with one setting, whose error and CPU time are measured.

    contact     key of CONTACTS
    method      solution method
    fineness    cells per side of the window, elements per contact radius, or twelfths of the number
                of rings and orders that the radial solver chooses
    tolerance   tolerance of the solver
    penalty     factor c of the penalty stiffness; 0 without penalty
    increments  number of increments of the path-dependent load steps; 0 for that of the contact
    """

    contact: str
    method: Method
    fineness: int
    tolerance: float = SOLVER_TOLERANCE
    penalty: float = 0.0
    increments: int = 0

    @property
    def name(self) -> str:
        """File name of the record: contact, solution method, fineness and other settings."""
        parts = [self.contact, self.method.name.lower(), f"n{self.fineness}"]
        parts += [f"t{self.tolerance:.0e}"] if self.tolerance != SOLVER_TOLERANCE else []
        parts += [f"c{self.penalty:g}"] if self.penalty else []
        parts += [f"k{self.increments}"] if self.increments else []
        return "-".join(parts).replace(".", "p")

    @property
    def solved(self) -> PreciseContact:
        """Contact that the case solves, from the table of all contacts of the study."""
        return CONTACTS[self.contact]

    @property
    def text(self) -> str:
        """Setting of the solution method in words, such as "64 x 64, tolerance 0.01"."""
        n = self.fineness
        words = [f"{n} x {n}"]
        if self.method in (Method.ELEMENTS, Method.PENALTY):
            words = [f"{n} elements per radius"]
        elif self.method is Method.RADIAL:
            words = [f"{n / OWN:g} times its own rings"]
        words += [f"tolerance {self.tolerance:g}"] if self.tolerance != SOLVER_TOLERANCE else []
        words += [f"c = {self.penalty:g}"] if self.penalty else []
        words += [f"{self.increments} increments"] if self.increments else []
        return ", ".join(words)

    def compute(self) -> CaseRecord:
        """Solve the contact with empty caches, and record its relative errors, work and CPU time.

        Raises the errors of the solvers.
        """
        result, seconds, repeats = timed(self._solve_contact)
        names = ("iterations", "convolutions", "factorizations")
        found = {name: [getattr(i, name, 0) or 0 for i in result.increments] for name in names}
        counters = {"increments": len(result.increments)}
        counters |= {name: sum(counts) for name, counts in found.items() if any(counts)}
        return CaseRecord(
            parameters=parameters_of(self),
            measures={**self.solved.errors_of(result)},
            counters=counters,
            words={"setting": self.text},
            seconds=seconds,
            repeats=repeats,
        )

    def _solve_contact(self) -> Any:
        contact, n = self.solved, self.fineness
        scene = contact.posed(self.increments or contact.increments or 1).scene
        if self.method is Method.RADIAL:
            return RadiiRun(self.name, scene, n / OWN, TOLD, EXACT).solve()
        if self.method in (Method.SURFACE, Method.EDGES):
            edge: EdgeCorrection = "last" if self.method is Method.EDGES else "off"
            return Run(self.name, scene, contact.grid(n), self.tolerance, edge=edge).solve()
        # The edge of the contact lies in the middle of an element on every mesh.
        mesh = per_radius(n, meshed(contact.problem.radius, n))
        if self.method is Method.ELEMENTS:
            return SectionRun(self.name, scene, mesh).solve()
        stiff = mesh.model_copy(update={"penalty": self.penalty})
        return SectionRun(self.name, scene, stiff, solver.Method.PENALTY).solve()


def _cases_of_contact(contact: str, level: Level) -> Iterator[PrecisionCase]:
    upper = min(level, Level.STANDARD)
    for n in CELLS[upper]:
        for tolerance in (SOLVER_TOLERANCE, *LOOSE[upper]):
            yield PrecisionCase(contact, Method.SURFACE, n, tolerance)
        if contact in WITH_EDGES:
            yield PrecisionCase(contact, Method.EDGES, n)
    # The radial solver has the closed form of an uncoated ball, and one of a coated ball.
    if contact != HERTZIAN.name:
        for n in (OWN,) if contact == COATING.name else RINGS[level]:
            yield PrecisionCase(contact, Method.RADIAL, n)
    for n in ELEMENTS[level]:
        yield PrecisionCase(contact, Method.ELEMENTS, n)
        for penalty in PENALTIES[upper] if n <= MAX_SPRINGS else ():
            yield PrecisionCase(contact, Method.PENALTY, n, penalty=penalty)
    for increments in INCREMENTS[upper] if contact == INDENTATION.name else ():
        for n in CELLS[upper]:
            yield PrecisionCase(contact, Method.SURFACE, n, increments=increments)
        for n in ELEMENTS[max(level, Level.STANDARD)]:
            yield PrecisionCase(contact, Method.ELEMENTS, n, increments=increments)
        yield PrecisionCase(contact, Method.RADIAL, OWN, increments=increments)
    for n in TO_THE_EDGE.get(contact, {}).get(level, ()):
        yield PrecisionCase(contact, Method.SURFACE, n)


TARGETS = (0.1, 0.01, 0.001, 0.0001)
ASKED = 0.001  # the target of the answer
REACHED = 0.01  # what some setting must reach at every level, for every quantity
FLOOR = 1e-9  # of what can be drawn on a logarithmic axis
REMARKS = (
    "A setting counts as accurate to what the finer ones of its curve keep: an error that happens "
    "to change sign earns nothing. The finest of a curve has none above it.",
    "Edges are put inside the cells at the end of every step, or, where bodies couple, in every "
    "increment; energies and shifts stay those of cells, so that no loop was run so. The radial "
    "solver is asked for what it has no closed form of.",
    "An error norm of a field means the edge, where pressure is a square root. Every method is "
    "asked for what its values mean: cells for means over cells, with edges inside them or not, "
    "the radial solver for values at its rings, finite elements for what is linear between theirs.",
    "Seconds are CPU seconds of one thread, the median of up to five runs, each with an empty "
    "cache; imports do not count. They are of the machine and the moment that the provenance "
    "names, and are no verdict.",
)


@dataclass(frozen=True)
class Point:
    """Error and cost of one setting of a solution method, as a point of a chart of work and
    precision.

    method    name of the solution method
    curve     key of the curve; settings of one curve differ in fineness only
    setting   setting in words
    fineness  number of cells or elements along a length
    error     relative error, not negative
    seconds   CPU time [s]
    """

    method: str
    curve: str
    setting: str
    fineness: int
    error: float
    seconds: float


def points_of(
    known: Mapping[PrecisionCase, CaseRecord], contact: str, quantity: str
) -> tuple[Point, ...]:
    """Return error and CPU time of all settings by which one contact was solved.

    Records without the given error are left out.

    known     records by case
    contact   name of the contact
    quantity  name of the error
    """
    return tuple(
        Point(
            case.method.value,
            f"{case.tolerance:g} {case.penalty:g} {case.increments}",
            case.text,
            case.fineness,
            abs(value_of(record, quantity)),
            record.seconds,
        )
        for case, record in known.items()
        if case.contact == contact and quantity in record.measures
    )


def dependable(points: Iterable[Point]) -> tuple[Point, ...]:
    """Replace the error of each setting by the largest error of all settings that are at least as
    fine.

    Only settings of the same curve are compared. The replacement is needed because the error of a
    coarse setting may be small by chance, where it changes sign. An error that is NaN makes the
    errors of all coarser settings NaN.
    """
    found: list[Point] = []
    largest: dict[tuple[str, str], float] = {}
    for point in sorted(points, key=lambda p: -p.fineness):
        curve = point.method, point.curve
        largest[curve] = worst(largest.get(curve, 0.0), point.error)
        found.append(replace(point, error=largest[curve]))
    return tuple(found)


def pareto(points: Iterable[Point]) -> tuple[Point, ...]:
    """Return the settings on the Pareto front of error and CPU time, in ascending order of cost.

    For these settings no cheaper setting has an error as small.
    """
    line: list[Point] = []
    for point in sorted(points, key=lambda p: (p.seconds, p.error)):
        if not line or point.error < line[-1].error:
            line.append(point)
    return tuple(line)


def cheapest(points: Iterable[Point], target: float) -> Point | None:
    """Return the setting with the least CPU time whose error is at most `target`; None if there is
    none.

    points  error and CPU time of the settings
    target  relative error
    """
    return next((point for point in pareto(points) if point.error <= target), None)


def cases(settings: Settings) -> tuple[PrecisionCase, ...]:
    """Return the solves of all contacts by all methods and settings, at the level (quick, standard
    or full) of the study.
    """
    return tuple(
        case for contact in CONTACTS for case in _cases_of_contact(contact, settings.level)
    )


def conclude(settings: Settings, records: Records) -> Conclusion:
    """Judge that some setting reaches an error of 1 % for every quantity; list the cheapest
    settings.

    The conclusion has a table and a chart of error against CPU time for every contact and quantity.
    """
    known = found(cases(settings), records)
    everything = {
        (contact.name, quantity): dependable(points)
        for contact in CONTACTS.values()
        for quantity in contact.errors
        if (points := points_of(known, contact.name, quantity))
    }
    best = {key: cheapest(points, ASKED) for key, points in everything.items()}
    missed = [_error_text(*key) for key, p in everything.items() if cheapest(p, REACHED) is None]
    had = len(everything) - len(missed)
    reached = Statement(
        claim=f"every quantity is had to {_percent_text(REACHED)}",
        outcome=judged(not missed and bool(everything)),
        measured=f"{had} of {len(everything)}" + (f"; not {'; '.join(missed)}" if missed else ""),
        because="some setting of some method of ours, and all finer ones of its curve",
    )
    good = [point for point in best.values() if point is not None]
    most = f", in at most {_cost_text(max(good, key=lambda p: p.seconds))}" if good else ""
    return Conclusion(
        statements=(
            solved("every setting is solved", len(known), len(cases(settings))),
            reached,
            *(
                Statement(
                    claim=f"{_error_text(*key)} to {_percent_text(ASKED)}",
                    outcome=None,
                    measured="not reached" if p is None else f"{p.method}, {_setting_text(p)}",
                )
                for key, p in best.items()
            ),
        ),
        answer=f"{_percent_text(ASKED)} is reached for {len(good)} of {len(best)} "
        f"quantities{most}.",
        tables=tuple(_setting_table(*key, points) for key, points in everything.items()),
        charts=tuple(_precision_chart(*key, points) for key, points in everything.items()),
        remarks=(
            *REMARKS,
            *(f"Reference, {c.title}: {c.problem.source}." for c in CONTACTS.values()),
        ),
    )


def _points_by_method(points: tuple[Point, ...]) -> Iterator[tuple[str, list[Point]]]:
    for method in Method:
        yield method.value, [p for p in points if p.method == method.value]


def _setting_table(contact: str, quantity: str, points: tuple[Point, ...]) -> Table:
    rows = (
        (method, *(_setting_text(cheapest(own, target)) for target in TARGETS))
        for method, own in _points_by_method(points)
        if own
    )
    return Table(
        title=f"Cheapest setting by CPU time, {_error_text(contact, quantity)}",
        columns=("method", *map(_percent_text, TARGETS)),
        rows=tuple(rows),
        note="CPU seconds, and the setting; – where no setting that was tried reaches it.",
        units=NONE,
    )


def _precision_chart(contact: str, quantity: str, points: tuple[Point, ...]) -> Chart:
    def drawn(points: Iterable[Point]) -> Points:
        return [(p.seconds, max(p.error, FLOOR)) for p in pareto(points)]

    meaning = CONTACTS[contact].errors[quantity]
    lines = [(method, drawn(own)) for method, own in _points_by_method(points)]
    return log_chart(
        f"precision_{contact}_{quantity}",
        _error_text(contact, quantity),
        f"Error of the {meaning} against CPU seconds, set-up included, of the best settings of "
        "every method; thin black dashes are the Pareto line of all of them.",
        "CPU seconds",
        "relative error",
        point_curves(lines) + point_curves([("Pareto line", drawn(points))], Look.BOUND),
    )


def _error_text(contact: str, quantity: str) -> str:
    """Return the title of a contact and one of its measured errors in words."""
    return f"{CONTACTS[contact].title}: {CONTACTS[contact].errors[quantity]}"


def _setting_text(point: Point | None) -> str:
    return "–" if point is None else f"{_cost_text(point)}: {point.setting}"


def _cost_text(point: Point) -> str:
    return f"{plain(point.seconds, 2)} s"


def _percent_text(part: float) -> str:
    return f"{100 * part:g} %"


STUDY = Study(
    name="work-precision",
    title="What accuracy costs",
    question="Which method and which setting reach an accuracy in the least time, and what does "
    "0.1 % cost with each of them?",
    cases=cases,
    conclude=conclude,
)
