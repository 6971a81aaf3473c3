"""Short declaration of verification cases by refinement levels and rows of judged quantities.

Refinement levels are runs of one problem on finer and finer cells, finite elements or rings. A row
names an observable (a number read from results) and the way in which it is judged. `judged` expands
the rows into the runs, quantities and orders of a case.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from contact_scene.quantities.increment import (
    SCALARS,
    components,
)
from semi_analytical import SurfaceGrid, plan
from semi_analytical.default_grid import STRIP_LENGTH, align_to_edges
from verification.exhibits.chart import Chart
from verification.judging import field_errors
from verification.judging.case import (
    BY_DEFAULT,
    OVER_RINGS,
    AnyRun,
    Case,
    Derived,
    Level,
    NotYetAsymptotic,
    Order,
    Quantity,
    RadiiRun,
    Required,
    Run,
    SectionRun,
    per_radius,
)
from verification.observed.ring_errors import central_pressure
from verification.problems.cattaneo_mindlin import (
    OVER_LARGEST_SHIFT,
    OVER_LIMIT,
    OVER_SLIDING_SHIFT,
    OVER_SLIDING_WORK,
    in_any_increment,
    loop_energy,
)
from verification.problems.problem import (
    OVER_PEAK,
    OVER_RADIUS,
    Problem,
    Reference,
    ReferenceKind,
    ShiftedGrid,
)
from verification.quantities import shift_along_x, unit_of
from verification.solver import Method

PER_OCTAVE = 5
STRIPS = 1024
STRIPS_WINDOW = 2.5  # over the half width of the contact


def refinement(coarsest: int, finest: int) -> tuple[int, ...]:
    """Return numbers of cells per side for a convergence study, coarse to fine, five per doubling.

    The last number is `finest`; no number is smaller than `coarsest`, and all are even. The numbers
    are not multiples of each other, because the error depends on the positions of the cells
    relative to the round contact edge. Many different grids separate this scatter from the order of
    convergence.
    """
    counts = []
    number = 0
    while (cells := 2 * round(finest * 2 ** (-number / PER_OCTAVE) / 2)) >= coarsest:
        counts.append(cells)
        number += 1
    return tuple(reversed(counts))


# Tolerance that depends on the refinement level: a function of the run and the contact radius.
ScaledTolerance = Callable[[AnyRun, float], float]

WINDOW_PER_RADIUS = 3.0
# Number of rings at which the radial solver returns its fields.
RINGS_SHOWN = 64
# Tolerance of the residuals of the radial solver: all errors are then those of the rings.
EXACT = 1e-10
# Position of the contact edge in the middle of an element, as a fraction of the element.
MIDDLE = 0.5
# Number of elements per radius to which the accuracy targets refer.
TOLERANCE_ELEMENTS = 64


@dataclass(frozen=True)
class RefinementLevels:
    """Hold the runs of one problem on several refinement levels.

    problem   problem with its known answer
    runs      levels, coarse to fine
    judged    level on which values are judged
    followed  levels from which orders of convergence are computed; on cells they are without edge
              correction, because only the uncorrected method has an order
    """

    problem: Problem
    runs: tuple[AnyRun, ...]
    judged: AnyRun
    followed: tuple[AnyRun, ...]

    @property
    def uncorrected(self) -> bool:
        """True if orders of convergence are computed from separate runs on cells without edge
        correction.
        """
        return isinstance(self.judged, Run) and self.followed != self.runs

    @property
    def refined(self) -> AnyRun:
        """Level whose numerical error is estimated from the coarser levels.

        On cells with edge correction this is the finest level without the correction.
        """
        return self.followed[-1] if self.uncorrected else self.judged

    @property
    def levels(self) -> tuple[str, ...]:
        """Labels of the runs from which orders of convergence are computed, coarse to fine."""
        return tuple(run.label for run in self.followed)


def ladder(
    problem: Problem, runs: Sequence[AnyRun], followed: Sequence[AnyRun] = ()
) -> RefinementLevels:
    """Combine runs of a problem to refinement levels; values are judged on the last run.

    problem   problem with its known answer
    runs      levels, coarse to fine
    followed  levels from which orders of convergence are computed; default: all
    """
    return RefinementLevels(problem, tuple(runs), runs[-1], tuple(followed or runs))


def on_cells(
    problem: Problem,
    cells: Sequence[int],
    window: float = WINDOW_PER_RADIUS,
    of: str = "",
    offsets: Sequence[tuple[float, float]] = (),
) -> RefinementLevels:
    """Create refinement levels of a problem on grids of cells, for the semi-analytical solver.

    problem  problem with its known answer
    cells    numbers of cells per side, coarse to fine
    window   side of the grid over the contact radius (or semi-axis), along x and y
    of       name of the problem within its case, with which the labels begin
    offsets  positions of the grid centre relative to the contact axis, in cells; each number of
             cells gets one grid for each offset
    """
    sides = window * problem.radius, window * (problem.across or problem.radius)

    def level(n: int, offset: tuple[float, float] | None) -> Run:
        name, grid = cells_label(n, of), SurfaceGrid((n, n), sides)
        if offset is not None:
            name += f", shifted by ({offset[0]:g}, {offset[1]:g}) cells"
            grid = ShiftedGrid((n, n), sides, offset)
        return Run(name, problem.scene, grid, problem=of)

    runs = [level(n, offset) for n in cells for offset in offsets or (None,)]
    corrected = plan(problem.scene, edge=BY_DEFAULT).edge != "off"
    followed = map(_without_edge_correction, runs) if corrected and len(runs) > 1 else runs
    return ladder(problem, runs, tuple(followed))


def on_strips(problem: Problem, of: str = "") -> RefinementLevels:
    """Create the run of a line contact on strips, for the semi-analytical solver.

    The window is 2.5 half widths of the contact long.

    problem  problem with its known answer
    of       name of the problem within its case, with which the label begins
    """
    grid = SurfaceGrid((STRIPS, 1), (STRIPS_WINDOW * problem.radius, STRIP_LENGTH))
    grid = align_to_edges(problem.scene, grid)
    label = f"{of}, {STRIPS} strips".removeprefix(", ")
    return ladder(problem, [Run(label, problem.scene, grid, problem=of)])


def _without_edge_correction(run: Run) -> Run:
    return replace(run, label=f"{run.label}, edge off", edge="off")


def with_edge_at(
    problem: Problem,
    elements: Sequence[int],
    studied: Sequence[tuple[int, float]] = (),
    of: str = "",
) -> RefinementLevels:
    """Create refinement levels of finite elements with a prescribed position of the contact edge.

    The position of the edge within an element changes the error more than a few elements do. Values
    are judged with the edge in the middle of an element.

    problem   problem with its known answer
    elements  numbers of elements per contact radius, with the edge in the middle of an element
    studied   numbers of elements with the position of the edge (fraction of an element), for the
              orders of convergence; default: the meshes of `elements`
    of        name of the problem within its case, with which the labels begin
    """
    meshes = tuple(dict.fromkeys((*((n, MIDDLE) for n in elements), *studied)))
    runs = {mesh: _mesh_with_edge(problem, *mesh, of) for mesh in meshes}
    judged = max(meshes, key=lambda mesh: (mesh[0], -abs(mesh[1] - MIDDLE)))
    followed = tuple(runs[mesh] for mesh in studied or meshes)
    return RefinementLevels(problem, tuple(runs.values()), runs[judged], followed)


def _mesh_with_edge(problem: Problem, n: int, place: float, of: str) -> SectionRun:
    mesh = per_radius(n, meshed(problem.radius, n, place))
    name = mesh_label(n, place, of)
    return SectionRun(name, problem.scene, mesh, beyond=MIDDLE, problem=of)


def meshed(radius: float, elements: int, place: float = MIDDLE) -> float:
    """Compute the radius that a mesh must divide so that the contact edge has a given position
    [length].

    The mesh divides this radius, slightly smaller than the contact radius, into the number of
    elements.

    radius    contact radius [length]
    elements  number of complete elements inside the contact
    place     position of the contact edge in the next element, as a fraction of that element
    """
    return radius * elements / (elements + place)


def on_elements(
    problem: Problem,
    elements: Sequence[int],
    over: float | None = None,
    of: str = "",
) -> RefinementLevels:
    """Create refinement levels of a problem on finite elements with given numbers of elements.

    problem   problem with its known answer
    elements  numbers of elements per contact radius, coarse to fine
    over      radius over which the elements are counted, in contact radii; None: the solver
              estimates the contact radius
    of        name of the problem within its case, with which the labels begin
    """
    radius = None if over is None else over * problem.radius
    return ladder(
        problem,
        [
            SectionRun(mesh_label(n, of=of), problem.scene, per_radius(n, radius), problem=of)
            for n in elements
        ],
    )


def on_radii(
    problem: Problem,
    name: str,
    fineness: Sequence[float] = (1,),
    *,
    rings: int = RINGS_SHOWN,
    laws: float = OVER_RINGS,
    at_points: bool = False,
) -> RefinementLevels:
    """Create refinement levels of a problem for the radial solver; values are judged at fineness 1.

    problem    problem with its known answer
    name       label of the run of fineness 1
    fineness   factors on the numbers of polynomials and rings that the solver chooses; must include
               1
    rings      number of rings at which the solver returns its fields
    laws       largest accepted violation of a law of contact or friction [1]
    at_points  True if torsion is solved at points on rings although a closed form would suffice
    """

    def level(times: float) -> RadiiRun:
        label = name if times == 1 else f"{name}, {times:g} times as fine"
        scene = problem.scene
        return RadiiRun(label, scene, times, rings, EXACT, laws, at_points, problem=name)

    runs = {times: level(times) for times in fineness}
    return RefinementLevels(problem, tuple(runs.values()), runs[1], tuple(runs.values()))


def on_springs(of: RefinementLevels, name: str, **penalty: float) -> RefinementLevels:
    """Create the finite element level with a penalty method in place of exact contact.

    of       refinement levels of exact contact, of which the judged level is used
    name     label of the new run
    penalty  fields of the discretisation that concern the penalty method
    """
    run = of.judged
    assert isinstance(run, SectionRun)
    mesh = run.discretisation.model_copy(update=penalty)
    sprung = replace(run, label=name, discretisation=mesh, method=Method.PENALTY)
    return ladder(of.problem, [sprung])


def cells_label(cells: int, of: str = "") -> str:
    """Return the label of a run on cells × cells cells, such as "ball, 128x128".

    of  name of the problem, with which the label begins; may be empty
    """
    return f"{of}, {cells}x{cells}" if of else f"{cells}x{cells}"


def mesh_label(elements: int, place: float = MIDDLE, of: str = "") -> str:
    """Return the label of a run on finite elements, such as "ball, 32 elements per radius".

    elements  number of elements per contact radius
    place     position of the contact edge within an element, as a fraction
    of        name of the problem, with which the label begins; may be empty
    """
    name = f"{of}, " if of else ""
    aside = "" if place == MIDDLE else f", edge at {place:g}"
    return f"{name}{elements} elements per radius{aside}"


def scaled_tolerance(figure: float, order: float) -> ScaledTolerance:
    """Create a tolerance that scales with the mesh by the order of convergence.

    figure  tolerance at 64 elements per contact radius
    order   order of convergence
    """
    return lambda run, _: figure * (TOLERANCE_ELEMENTS / run.count) ** order


def part_of_side(part: float) -> ScaledTolerance:
    """Create a tolerance that is a fraction of the cell or element side, over the contact radius.

    part  fraction of the side
    """
    return lambda run, radius: part * run.side_over(radius)


def named(name: str, of: RefinementLevels) -> RefinementLevels:
    """Return refinement levels in which the judged run has another label.

    name  new label
    of    refinement levels
    """
    judged = replace(of.judged, label=name)

    def renamed(runs: tuple[AnyRun, ...]) -> tuple[AnyRun, ...]:
        return tuple(judged if run == of.judged else run for run in runs)

    return RefinementLevels(of.problem, renamed(of.runs), judged, renamed(of.followed))


ASKED = "required of this scene by the project's accuracy targets"
EDGE = "order 1: the edge is known to a fraction of a cell; the cap is a tenth of a cell"
STAIRCASE = (
    "the rim is a staircase of cells with infinite pressure, which changes the effective radius "
    "of the punch by a fraction of a cell"
)
STICK_BORDER = "order 1: the border is known to a fraction of a cell; the cap is a fifth of a cell"
SQUARE_ROOTS = "square-root edges of stick zone and contact"
ELEMENT_RADIUS = "accuracy target of the finite elements at 64 per radius"
PENALTY = "accuracy target of the finite elements with a penalty, at their default penalty"
IDENTITY = "an identity, in which nothing converges"
DERIVED = "tolerances are derived from the orders of hertz_point on equal grids"
JUDGED_BY = "on one discretisation: the orders of the method are judged in {}"

# Several meshes below the finest, for the order of convergence; each has another edge position.
_LEVELS = {
    Level.QUICK: (12, 16, 22, 32),
    Level.STANDARD: (12, 16, 22, 32, 45, 64),
    Level.FULL: (16, 22, 32, 45, 64, 90, 128),
}
OCTAVES = 2.4
# Positions of the contact edge in its element on each mesh: all values depend on the position, and
# only their root mean square falls with a power of the element.
PLACES = (0.1, 0.3, MIDDLE, 0.7, 0.9)


def levels(level: Level) -> tuple[int, ...]:
    """Return the numbers of finite elements per contact radius at which a case is solved, coarse to
    fine.

    level  amount of computation: quick, standard or full
    """
    return _LEVELS[level]


def order_levels(level: Level, per_octave: int = PER_OCTAVE) -> tuple[tuple[int, float], ...]:
    """Return the finite element meshes from which orders of convergence are computed.

    Each mesh is a number of elements per contact radius, and a position of the contact edge within
    its element (0 to 1). Each number of elements has five positions.

    level       amount of computation: quick, standard or full
    per_octave  number of meshes per doubling of the number of elements, above the quick level
    """
    steps = range(round(OCTAVES * per_octave), -1, -1)
    many = tuple(dict.fromkeys(round(TOLERANCE_ELEMENTS / 2 ** (n / per_octave)) for n in steps))
    meshes = _LEVELS[level] if level is Level.QUICK else many
    return tuple((n, place) for n in meshes for place in PLACES)


def finest(level: Level) -> int:
    """Return the largest number of finite elements per contact radius at which a case is solved.

    level  amount of computation: quick, standard or full
    """
    return _LEVELS[level][-1]


def because(order: float) -> str:
    """Return the text that justifies a tolerance for finite elements, scaled from 64 elements per
    radius.

    order  order of convergence by which the tolerance is scaled to other meshes
    """
    return (
        f"accuracy target of the finite elements at {TOLERANCE_ELEMENTS} per radius; on other "
        f"meshes scaled by the order {order:g}"
    )


Measure = Callable[[Any, int, Problem], float]


@dataclass(frozen=True)
class Observable:
    """Number that a case reads from any result at the end of a load step: a value, or an error
    norm.

    name     name of the number; its order of convergence is named `order_of_` + name
    meaning  description, with placeholders in braces for words of the discretisation
    unit     SI unit; empty for a ratio
    measure  function from a result, the index of a load step and the problem to the number
    value    function from the exact answer of the step to the exact number; None for the norm of an
             error, whose exact value is zero
    over     name of the error scale in the problem; empty: the exact value, or 1 for an error norm
    over_is  description of the error scale, if `over` is empty
    of       quantity whose order of convergence the error has
    step     index of the load step
    label    name in charts
    source   source of the exact value, if it differs from the source of the problem
    part     load at the end of the step as a fraction of its limit, if verdict names need it
    scalar   name and component of the registered scalar, for which solvers state errors; None for
             other numbers
    """

    name: str
    meaning: str
    unit: str
    measure: Measure
    value: Callable[[Any], float] | None
    over: str = ""
    over_is: str = ""
    of: str = ""
    step: int = -1
    label: str = ""
    source: str = ""
    part: float | None = None
    scalar: tuple[str, int] | None = None

    def at(self, step: int, part: float, of: str) -> Observable:
        """Return the observable at the end of another load step, with the load of that step as
        label.

        step  index of the load step
        part  load at the end of the step, as a fraction of `of`
        of    reference load in words, such as "µW" (friction limit)
        """
        when = f"{part:g} {of}"
        return replace(
            self,
            meaning=self.meaning.replace("{when}", f" at {when}"),
            step=step,
            label=when,
            part=part,
        )

    @property
    def verdict(self) -> str:
        """Name of the verdict on the observable: the name of the observable, with the load fraction
        if set.
        """
        return self.name if self.part is None else f"{self.name}_at_{self.part:g}"

    def over_stops(self, stops: str) -> Observable:
        """Return an observable for the root mean square error over all load steps but the first.

        Errors of single steps change sign from grid to grid, because the edges of the contact and
        of the stick zone lie at arbitrary positions within cells. Their root mean square varies
        less, so that an order of convergence can be determined.

        stops  description of the load steps, in words
        """

        def mean(result: Any, step: int, problem: Problem) -> float:
            each = (replace(self, step=k).error(problem) for k in range(1, len(problem.ends)))
            return float(np.sqrt(np.mean([error(result) ** 2 for error in each])))

        meaning = self.meaning.replace("{when}", f" at {stops}, root mean square")
        changed = replace(self, meaning=meaning, unit="", measure=mean, value=None, over="")
        return replace(changed, scalar=None)

    def said(self, words: Mapping[str, str]) -> str:
        """Return the description of the observable with its placeholders replaced by words.

        words  words by placeholder, such as "cell" or "ring" for {point}
        """
        return self.meaning.format_map({"when": "", **words})

    def read(self, problem: Problem) -> Callable[[Any], float]:
        """Return a function from a result of the problem to the value of the observable."""
        return lambda result: self.measure(result, self.step, problem)

    def reference(self, problem: Problem) -> Reference:
        """Return the exact value of the observable in a problem, with its uncertainty and source.

        For the norm of an error the exact value is zero.
        """
        scale = problem.scale(self.over) if self.over else None
        if self.value is None:
            known = replace(problem.reference(1.0, scale), value=0.0)
        else:
            known = problem.reference(self.value(problem.ends[self.step]), scale)
        return replace(known, source=self.source or known.source)

    def scale(self, problem: Problem) -> float | None:
        """Return the number by which errors of the observable are divided, in the unit of the
        observable.

        The result is None if errors are relative to the exact value.
        """
        if self.over:
            return problem.scale(self.over)
        return 1.0 if self.value is None else None

    @property
    def scale_name(self) -> str:
        """Description of the number by which errors of the observable are divided."""
        return self.over or self.over_is or "the reference"

    def error(self, problem: Problem) -> Callable[[Any], float]:
        """Return a function from a result to the relative error of the observable, of either sign
        [1].

        problem  problem with the exact value
        """
        read, value, scale = self.read(problem), self.reference(problem).value, self.scale(problem)
        if scale is None:
            return lambda result: read(result) / value - 1
        return lambda result: (read(result) - value) / scale


def number(
    name: str,
    meaning: str,
    *,
    quantity: str = "",
    exact: str = "",
    over: str = "",
    of: str = "",
    source: str = "",
) -> Observable:
    """Create an observable for a scalar that all solvers return, such as the approach, at a step's
    end.

    The observable is NaN if the step does not have the scalar.

    name      name of the observable
    meaning   description of the scalar
    quantity  registered name of the scalar, with _x or _y for a vector; default: `name`
    exact     attribute of the exact answer; default: `name`
    over      name of the error scale in the problem; empty: the exact value
    of        quantity whose order of convergence the error has
    source    source of the exact value, if it differs from the source of the problem
    """
    quantity = quantity or name
    known = next(known for known in SCALARS if quantity in components(known))
    part = components(known).index(quantity)

    def read(result: Any, step: int, _: Problem) -> float:
        value = getattr(result.steps[step], known)
        return float("nan") if value is None else float(np.ravel(value)[part])

    return Observable(
        name,
        meaning,
        unit_of(quantity),
        read,
        lambda end: float(getattr(end, exact or name)),
        over,
        of=of,
        label=of,
        source=source,
        scalar=(known, part),
    )


def error_norm(
    name: str,
    meaning: str,
    measure: Measure,
    over_is: str = "the exact field",
    *,
    unit: str = "",
    over: str = "",
    of: str = "",
    norm: str = "",
    source: str = "",
) -> Observable:
    """Create an observable for the norm of the error of a field, such as the L1 error of the
    pressure.

    The exact value of the norm is zero.

    name     name of the observable
    meaning  description of the norm
    measure  function from a result, the index of a load step and the problem to the norm
    over_is  description of the error scale, if `over` is empty
    unit     SI unit of the norm; empty for a ratio
    over     name of the error scale in the problem
    of       quantity whose order of convergence the norm has
    norm     name of the norm in charts
    source   source of the exact field, if it differs from the source of the problem
    """
    label = f"{of} ({norm})" if norm else of
    return Observable(
        name, meaning, unit, measure, None, over, over_is, of, label=label, source=source
    )


APPROACH = number("approach", "approach of the bodies since first touch", of="approach")
PEAK_PRESSURE = number("peak_pressure", "largest pressure of any {point}", of="peak pressure")
CONTACT_RADIUS = number("contact_radius", "{edge}", of="contact radius")
FORCE = number("normal_force", "force that the approach takes", exact="load")
CENTRAL_PRESSURE = Observable(
    "central_pressure",
    "pressure {axis}",
    "Pa",
    lambda result, step, _: central_pressure(result, step),
    lambda exact: float(exact.pressure(0.0)),
    of="peak pressure",
    label="central pressure",
)
SHIFT = number(
    "shift",
    "tangential shift{when}",
    quantity="tangential_shift_x",
    over=OVER_SLIDING_SHIFT,
    of="tangential shift",
)
STICK_RADIUS = number("stick_radius", "{stick}{when}", over=OVER_RADIUS)
ENERGY = number(
    "energy",
    "energy dissipated{when}",
    quantity="dissipated_energy",
    exact="dissipated_energy",
    of="dissipated energy",
    source="Mindlin and Deresiewicz 1953",
)
WORK = replace(ENERGY, over=OVER_SLIDING_WORK)
TWIST = number("twist", "twist{when}", of="twist")
PRESSURE_L1 = error_norm(
    "pressure",
    "pressure over the {domain}, L1",
    field_errors.pressure_l1,
    of="pressure",
    norm="L1",
)
PRESSURE_L2 = error_norm(
    "pressure",
    "pressure over the {domain}, L2",
    field_errors.pressure_l2,
    of="pressure",
    norm="L2",
)
PRESSURE_WITHIN = error_norm(
    "pressure",
    "largest error of the pressure within {within} of the radius, over p_H",
    field_errors.largest_pressure_error,
    OVER_PEAK,
)
SHEAR = error_norm(
    "shear",
    "{sum}|q - q_exact| / {sum}µp{when}",
    field_errors.shear_error,
    "Σµp",
    of="shear",
)
SHEAR_AROUND = error_norm(
    "shear",
    "largest error of the shear{when}, a tenth of the radius to either side of the stick edge "
    "apart, over µp_H",
    field_errors.shear_around_error,
    OVER_LIMIT,
)
# Observables of a whole fretting loop, whose exact answer is an `ExactLoop`.
LARGEST_SHIFT_ERROR = error_norm(
    "largest_shift_error",
    "largest difference of the shift in any increment",
    in_any_increment(lambda _, found, exact: abs(shift_along_x(found) - exact.shift)),
    unit="m",
    over=OVER_LARGEST_SHIFT,
)
LARGEST_STICK_RADIUS_ERROR = error_norm(
    "largest_stick_radius_error",
    "largest difference of the stick radius in any increment",
    in_any_increment(lambda _, found, exact: abs((found.stick_radius or 0.0) - exact.stick_radius)),
    unit="m",
    over=OVER_RADIUS,
)
LARGEST_SHEAR_ERROR = error_norm(
    "largest_shear_error",
    "largest Σ|q - q_exact| / Σµp of any increment",
    in_any_increment(field_errors.shear_error_of_loop),
    "Σµp",
)
ENERGY_PER_CYCLE = Observable(
    "energy_per_cycle",
    "energy dissipated from 0.9 µW to -0.9 µW and back",
    "J",
    lambda result, *_: loop_energy(result),
    lambda loop: float(loop.energy_per_cycle),
    scalar=("energy_per_cycle", 0),
)


Allowed = float | Mapping[int, float] | ScaledTolerance
Results = Mapping[str, Any]
Drawing = Callable[[Results], Chart]


@dataclass(frozen=True)
class Within:
    """Row of a case that judges an observable by a prescribed tolerance.

    what     observable
    allowed  tolerance relative to the error scale: a number, a number for each number of cells
             (then exactly these levels are judged), or a function of the refinement level
    because  reason for the tolerance
    name     name of the verdict, if it differs from that of the observable
    each     True if every refinement level is judged; else only the finest is judged
    """

    what: Observable
    allowed: Allowed
    because: str
    name: str = ""
    each: bool = False


@dataclass(frozen=True)
class Refined:
    """Row of a case that judges an observable by a tolerance derived from refinement levels.

    The tolerance is the expanded numerical uncertainty (2 standard uncertainties).

    what     observable
    order    expected order of convergence
    cap      upper bound of the tolerance
    because  reason for order and cap
    """

    what: Observable
    order: float
    cap: Allowed
    because: str


@dataclass(frozen=True)
class Falls:
    """Row of a case that judges the order of convergence at which the error of an observable falls.

    what      observable
    expected  expected order
    because   reason for the expected order
    not_yet   allowance for levels that are not asymptotic
    """

    what: Observable
    expected: float
    because: str
    not_yet: NotYetAsymptotic | None = None


Row = Within | Refined | Falls


def at_stops(stops: Mapping[int, float], of: str, *rows: Row) -> tuple[Row, ...]:
    """Return rows for the end of each of several load steps, with the load of the step as label.

    stops  load at the end of each step over `of`, by index of the step
    of     reference load in words, such as "µW" (friction limit)
    rows   rows of one load step
    """
    return tuple(
        replace(row, what=row.what.at(*stop, of)) for stop in stops.items() for row in rows
    )


@dataclass(frozen=True)
class Judged:
    """Runs on the refinement levels of one problem, and all numbers that are judged on them.

    runs        runs to solve
    quantities  numbers that are judged against references
    orders      orders of convergence that are judged
    equations   governing equations of the reference, in LaTeX
    """

    runs: tuple[AnyRun, ...] = ()
    quantities: tuple[Quantity, ...] = ()
    orders: tuple[Order, ...] = ()
    equations: tuple[str, ...] = ()


def judged(ladder: RefinementLevels, rows: Sequence[Row]) -> Judged:
    """Expand the rows of one problem into runs, judged quantities and orders.

    A case consists of one or more of these expanded parts. Separate runs without edge correction
    are kept only if a row needs them.

    ladder  refinement levels of the problem
    rows    observables with the way in which each is judged
    """
    quantities = tuple(quantity for row in rows for quantity in _quantities(row, ladder))
    runs = ladder.runs
    if ladder.uncorrected:
        named = {quantity.run for quantity in quantities}
        if not rows or not all(isinstance(row, Falls) for row in rows):
            named.add(ladder.judged.label)
        corrected = tuple(run for run in ladder.runs if run.label in named)
        ordered = any(isinstance(row, Falls | Refined) for row in rows)
        runs = (*corrected, *(ladder.followed if ordered else ()))
    return Judged(
        runs,
        quantities,
        tuple(_order(row, ladder) for row in rows if isinstance(row, Falls)),
        ladder.problem.equations,
    )


def compared(
    name: str,
    meaning: str,
    one: AnyRun,
    other: AnyRun,
    difference: Callable[[Any, Any], float],
    allowed: float,
    because: str,
    source: str,
    kind: ReferenceKind = ReferenceKind.IDENTITY,
    uncertainty: float = 0.0,
    coarse: str = "",
) -> Judged:
    """Create two runs that must agree, because both describe one problem, with their difference.

    one, other   runs; the difference is relative to the second
    difference   function from both results to a dimensionless difference, 0 if they agree; it may
                 be the error of a quantity that follows from both results
    allowed      largest accepted difference
    because      reason for this tolerance
    source       source that predicts the difference 0
    kind         kind of this source
    uncertainty  standard uncertainty of the prediction, relative to the scale of the difference;
                 that of another solver or refinement follows from a coarser solve if it is 0
    coarse       label of this coarser solve; empty: the second run on half its cells
    """
    quantity = Quantity(
        name,
        meaning,
        "",
        f"{one.label} and {other.label}",
        difference,
        Reference(0.0, kind, source, uncertainty),
        Required(allowed, because),
        1.0,
        "the second run's",
        runs=(one.label, other.label),
        coarse=coarse,
    )
    return Judged((one, other), (quantity,))


def case(
    name: str,
    title: str,
    problem: str,
    *parts: Judged,
    charts: Sequence[Drawing] = (),
    equations: tuple[str, ...] = (),
    **more: Any,
) -> Case:
    """Create a verification case from expanded rows and from additional runs and quantities.

    name       identifier for commands and files
    title      title in reports
    problem    description of the problem and of the source of its answer
    parts      expanded rows on refinement levels, and what is judged besides; several parts may
               share runs
    charts     functions from the results to one chart each
    equations  further governing equations, in LaTeX
    more       limits, reason for no order, and requirements of the `Case`
    """
    return Case(
        name,
        title,
        problem,
        tuple(dict.fromkeys(run for part in parts for run in part.runs)),
        tuple(quantity for part in parts for quantity in part.quantities),
        tuple(order for part in parts for order in part.orders),
        (lambda results: tuple(draw(results) for draw in charts)) if charts else None,
        equations=tuple(dict.fromkeys((*(e for p in parts for e in p.equations), *equations))),
        **more,
    )


def _quantities(row: Row, ladder: RefinementLevels) -> tuple[Quantity, ...]:
    if isinstance(row, Refined):
        cap = _allowed(row.cap, ladder.judged, ladder)
        derived = Derived(ladder.levels, row.order, cap, row.because)
        found = (_quantity(row.what, ladder, ladder.refined, derived),)
        if ladder.refined == ladder.judged or row.what.scalar is None:
            return found
        # With the edge correction there is no order of convergence from which a tolerance follows.
        return (*found, _quantity(row.what, ladder, ladder.judged, Required(cap, row.because)))
    if not isinstance(row, Within):
        return ()
    if isinstance(row.allowed, Mapping):
        runs = [run for run in ladder.runs if run.count in row.allowed]
    else:
        runs = list(ladder.runs) if row.each else [ladder.judged]
    return tuple(
        _quantity(
            row.what,
            ladder,
            run,
            Required(_allowed(row.allowed, run, ladder), row.because),
            row.name,
        )
        for run in runs
    )


def _allowed(allowed: Allowed, run: AnyRun, ladder: RefinementLevels) -> float:
    if callable(allowed):
        return allowed(run, ladder.problem.radius)
    return allowed[run.count] if isinstance(allowed, Mapping) else allowed


def _quantity(
    what: Observable,
    ladder: RefinementLevels,
    run: AnyRun,
    tolerance: Required | Derived,
    name: str = "",
) -> Quantity:
    problem = ladder.problem
    return Quantity(
        name=name or what.verdict,
        meaning=what.said(run.words),
        unit=what.unit,
        run=run.label,
        measure=what.read(problem),
        reference=what.reference(problem),
        tolerance=tolerance,
        scale=what.scale(problem),
        scale_name=what.scale_name,
        scalar=None if what.scalar is None else (*what.scalar, what.step),
    )


def _order(row: Falls, ladder: RefinementLevels) -> Order:
    what = row.what
    return Order(
        name=f"order_of_{what.name}",
        of=what.of,
        meaning=what.said(ladder.judged.words),
        levels=ladder.levels,
        error=what.error(ladder.problem),
        expected=row.expected,
        because=row.because,
        not_yet=row.not_yet,
    )
