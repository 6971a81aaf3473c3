"""Refinement levels of a problem: runs on finer and finer cells, finite elements or rings.

Levels with a penalty method in place of exact contact are included, as well as tolerances that
depend on the level.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from semi_analytical import SurfaceGrid, plan
from verification.judging.case import Level
from verification.judging.run import (
    BY_DEFAULT,
    OVER_RINGS,
    AnyRun,
    RadiiRun,
    Run,
    SectionRun,
    per_radius,
)
from verification.observed.ring_errors import judged_within
from verification.problems.paper_scene import ShiftedGrid
from verification.problems.problem import Problem
from verification.solver import Method

PER_OCTAVE = 5


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


CELLS = {
    "point": "cell",
    "edge": "√(contact area / π), cells at the edge counted in part",
    "stick": "√(stick area / π)",
    "axis": "of the cells around the axis",
    "domain": "window",
    "sum": "Σ",
    "between": "0.1 to 0.95",
    "but": "two cells around the stick edge apart, ",
}
HATS = {
    "point": "ring",
    "edge": "where the pressure ends, from its last two values",
    "stick": "stick radius",
    "axis": "on the axis",
    "domain": "contact",
    "sum": "∫",
    "but": "",
}
RINGS = HATS | {"edge": "radius of the contact"}
SPRINGS = HATS | {
    "point": "Gauss point",
    "edge": "where the pressure ends, by a fit of its square",
}

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
class SizedRun:
    """Hold one refinement level: a run, and the number of cells, elements or rings.

    run    run of a solver
    count  number of cells per side, of elements per contact radius, or of rings of the output
    reach  length over which `count` extends, in contact radii
    """

    run: AnyRun
    count: int
    reach: float = 1.0

    @property
    def words(self) -> dict[str, str]:
        """Words for measured quantities in the discretisation of this level, by placeholder.

        The description of an observable contains placeholders, such as {point} for "cell" or
        "ring".
        """
        if isinstance(self.run, Run):
            return CELLS
        if isinstance(self.run, RadiiRun):
            return RINGS
        hats = self.run.method is not Method.PENALTY
        within = f"{judged_within(self.count):.2g}"
        return (HATS if hats else SPRINGS) | {"within": within, "between": f"0.1 to {within}"}


@dataclass(frozen=True)
class RefinementLevels:
    """Hold the runs of one problem on several refinement levels.

    problem   problem with its known answer
    rungs     levels, coarse to fine
    judged    level on which values are judged
    followed  levels from which orders of convergence are computed; on cells they are without edge
              correction, because only the uncorrected method has an order
    """

    problem: Problem
    rungs: tuple[SizedRun, ...]
    judged: SizedRun
    followed: tuple[SizedRun, ...]

    @property
    def uncorrected(self) -> bool:
        """True if orders of convergence are computed from separate runs on cells without edge
        correction.
        """
        return isinstance(self.judged.run, Run) and self.followed != self.rungs

    @property
    def runs(self) -> tuple[AnyRun, ...]:
        """Runs from which orders of convergence are computed.

        These are the separate uncorrected runs if there are any, else the runs of all levels.
        """
        return tuple(rung.run for rung in (self.followed if self.uncorrected else self.rungs))

    @property
    def refined(self) -> SizedRun:
        """Level whose numerical error is estimated from the coarser levels.

        On cells with edge correction this is the finest level without the correction.
        """
        return self.followed[-1] if self.uncorrected else self.judged

    @property
    def levels(self) -> tuple[str, ...]:
        """Labels of the runs from which orders of convergence are computed, coarse to fine."""
        return tuple(rung.run.label for rung in self.followed)

    def of(self, count: int) -> SizedRun:
        """Return the refinement level with the given number of cells, elements or rings.

        Raises KeyError if there is no such level.
        """
        return {rung.count: rung for rung in self.rungs}[count]


def ladder(
    problem: Problem, rungs: Sequence[SizedRun], followed: Sequence[SizedRun] = ()
) -> RefinementLevels:
    """Combine runs of a problem to refinement levels; values are judged on the last run.

    problem   problem with its known answer
    rungs     levels, coarse to fine
    followed  levels from which orders of convergence are computed; default: all
    """
    return RefinementLevels(problem, tuple(rungs), rungs[-1], tuple(followed or rungs))


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

    def rung(n: int, offset: tuple[float, float] | None) -> SizedRun:
        name, grid = cells_label(n, of), SurfaceGrid((n, n), sides)
        if offset is not None:
            name += f", shifted by ({offset[0]:g}, {offset[1]:g}) cells"
            grid = ShiftedGrid((n, n), sides, offset)
        return SizedRun(Run(name, problem.scene, grid, problem=of), n, window)

    rungs = [rung(n, offset) for n in cells for offset in offsets or (None,)]
    corrected = plan(problem.scene, edge=BY_DEFAULT).edge != "off"
    followed = map(_without_edge_correction, rungs) if corrected and len(rungs) > 1 else rungs
    return ladder(problem, rungs, tuple(followed))


def _without_edge_correction(rung: SizedRun) -> SizedRun:
    assert isinstance(rung.run, Run)
    return replace(rung, run=replace(rung.run, label=f"{rung.run.label}, edge off", edge="off"))


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
    rungs = {mesh: _mesh_with_edge(problem, *mesh, of) for mesh in meshes}
    judged = max(meshes, key=lambda mesh: (mesh[0], -abs(mesh[1] - MIDDLE)))
    followed = tuple(rungs[mesh] for mesh in studied or meshes)
    return RefinementLevels(problem, tuple(rungs.values()), rungs[judged], followed)


def _mesh_with_edge(problem: Problem, n: int, place: float, of: str) -> SizedRun:
    mesh = per_radius(n, meshed(problem.radius, n, place))
    name = mesh_label(n, place, of)
    return SizedRun(SectionRun(name, problem.scene, mesh, beyond=MIDDLE, problem=of), n)


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
            SizedRun(
                SectionRun(mesh_label(n, of=of), problem.scene, per_radius(n, radius), problem=of),
                n,
            )
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

    def rung(times: float) -> SizedRun:
        label = name if times == 1 else f"{name}, {times:g} times as fine"
        scene = problem.scene
        return SizedRun(RadiiRun(label, scene, times, rings, EXACT, laws, at_points, name), rings)

    rungs = {times: rung(times) for times in fineness}
    return RefinementLevels(problem, tuple(rungs.values()), rungs[1], tuple(rungs.values()))


def on_springs(of: RefinementLevels, name: str, **penalty: float) -> RefinementLevels:
    """Create the finite element level with a penalty method in place of exact contact.

    of       refinement levels of exact contact, of which the judged level is used
    name     label of the new run
    penalty  fields of the discretisation that concern the penalty method
    """
    run = of.judged.run
    assert isinstance(run, SectionRun)
    mesh = run.discretisation.model_copy(update=penalty)
    sprung = replace(run, label=name, discretisation=mesh, method=Method.PENALTY)
    return ladder(of.problem, [replace(of.judged, run=sprung)])


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


def scaled_tolerance(figure: float, order: float) -> Callable[[SizedRun], float]:
    """Create a tolerance that scales with the mesh by the order of convergence.

    Returns a function from a refinement level to its tolerance.

    figure  tolerance at 64 elements per contact radius
    order   order of convergence
    """
    return lambda rung: figure * (TOLERANCE_ELEMENTS / rung.count) ** order


def part_of_side(part: float) -> Callable[[SizedRun], float]:
    """Create a tolerance that is a fraction of the cell or element side, over the contact radius.

    Returns a function from a refinement level to its tolerance.

    part  fraction of the side
    """
    return lambda rung: part * rung.reach / rung.count


def named(name: str, of: RefinementLevels) -> RefinementLevels:
    """Return refinement levels in which the judged run has another label.

    name  new label
    of    refinement levels
    """
    judged = replace(of.judged, run=replace(of.judged.run, label=name))

    def renamed(rungs: tuple[SizedRun, ...]) -> tuple[SizedRun, ...]:
        return tuple(judged if rung == of.judged else rung for rung in rungs)

    return RefinementLevels(of.problem, renamed(of.rungs), judged, renamed(of.followed))


ASKED = "required of this scene by the project's accuracy targets"
EDGE = "order 1: the edge is known to a fraction of a cell; the cap is a tenth of a cell"
STAIRCASE = (
    "the rim is a staircase of cells with infinite pressure, which changes the effective radius "
    "of the punch by a fraction of a cell"
)
STICK_BORDER = "order 1: the border is known to a fraction of a cell; the cap is a fifth of a "
"cell"
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
