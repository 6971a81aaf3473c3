"""A problem on finer and finer cells or elements, or under stiffer and stiffer springs."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from semi_analytical import SurfaceGrid, plan
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
from verification.problems.problem import Problem
from verification.problems.shifted_grid import ShiftedGrid
from verification.solver import Method

PER_OCTAVE = 5


def refinement(coarsest: int, finest: int) -> tuple[int, ...]:
    """Even counts of cells per side, five per doubling, down from the finest.

    Many levels that are not multiples of each other: how a round contact cuts the cells differs
    from grid to grid, and only many grids tell that scatter from the order of convergence.
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
RINGS_SHOWN = 64  # where the radial solver tells its fields
EXACT = 1e-10  # tolerance of its residuals, so that rings alone make errors
MIDDLE = 0.5  # of an element
ASKED_AT = 64  # elements per radius


@dataclass(frozen=True)
class RefinementLevel:
    """A run, and how fine it is.

    count  cells per side, elements per radius, or rings at which fields are told
    reach  that these go over, in radii
    """

    run: AnyRun
    count: int
    reach: float = 1.0

    @property
    def words(self) -> dict[str, str]:
        """What this discretisation calls what is measured."""
        if isinstance(self.run, Run):
            return CELLS
        if isinstance(self.run, RadiiRun):
            return RINGS
        hats = self.run.method is not Method.PENALTY
        within = f"{judged_within(self.count):.2g}"
        return (HATS if hats else SPRINGS) | {"within": within, "between": f"0.1 to {within}"}


@dataclass(frozen=True)
class RefinementLevels:
    """Runs of one problem.

    rungs     coarse to fine
    judged    the one that numbers are judged on
    followed  those that orders are read off; on cells without edge correction, as only the errors
              of the uncorrected method have an order
    """

    problem: Problem
    rungs: tuple[RefinementLevel, ...]
    judged: RefinementLevel
    followed: tuple[RefinementLevel, ...]

    @property
    def uncorrected(self) -> bool:
        """Return True if orders are read off runs of their own, without edge correction."""
        return isinstance(self.judged.run, Run) and self.followed != self.rungs

    @property
    def runs(self) -> tuple[AnyRun, ...]:
        """Runs of all levels, those that orders are read off."""
        return tuple(rung.run for rung in (self.followed if self.uncorrected else self.rungs))

    @property
    def refined(self) -> RefinementLevel:
        """The level whose error follows from refinement: on cells the finest uncorrected one."""
        return self.followed[-1] if self.uncorrected else self.judged

    @property
    def levels(self) -> tuple[str, ...]:
        """Labels of the runs that orders are read off."""
        return tuple(rung.run.label for rung in self.followed)

    def of(self, count: int) -> RefinementLevel:
        """The rung that is so fine; KeyError if there is none."""
        return {rung.count: rung for rung in self.rungs}[count]


def ladder(
    problem: Problem, rungs: Sequence[RefinementLevel], followed: Sequence[RefinementLevel] = ()
) -> RefinementLevels:
    """The last rung is judged; orders are read off all unless others are named."""
    return RefinementLevels(problem, tuple(rungs), rungs[-1], tuple(followed or rungs))


def on_cells(
    problem: Problem,
    cells: Sequence[int],
    window: float = WINDOW_PER_RADIUS,
    of: str = "",
    offsets: Sequence[tuple[float, float]] = (),
) -> RefinementLevels:
    """Grids around the contact, as many cells along x and y.

    window   over the contact, along x and y
    of       which problem of the case it is, in words; begins the labels
    offsets  of the centre from the contact's axis, in cells: as many grids of each size
    """
    sides = window * problem.radius, window * (problem.across or problem.radius)

    def rung(n: int, offset: tuple[float, float] | None) -> RefinementLevel:
        name, grid = cells_label(n, of), SurfaceGrid((n, n), sides)
        if offset is not None:
            name += f", shifted by ({offset[0]:g}, {offset[1]:g}) cells"
            grid = ShiftedGrid((n, n), sides, offset)
        return RefinementLevel(Run(name, problem.scene, grid, problem=of), n, window)

    rungs = [rung(n, offset) for n in cells for offset in offsets or (None,)]
    corrected = plan(problem.scene, edge=BY_DEFAULT).edge != "off"
    followed = map(_uncorrected, rungs) if corrected and len(rungs) > 1 else rungs
    return ladder(problem, rungs, tuple(followed))


def _uncorrected(rung: RefinementLevel) -> RefinementLevel:
    assert isinstance(rung.run, Run)
    return replace(rung, run=replace(rung.run, label=f"{rung.run.label}, edge off", edge="off"))


def with_edge_at(
    problem: Problem,
    elements: Sequence[int],
    studied: Sequence[tuple[int, float]] = (),
    of: str = "",
) -> RefinementLevels:
    """Meshes that have the edge of the contact at a part of an element: values are judged with the
    edge in the middle of one, as where it lies moves an error more than a few elements do.

    studied  elements and place of the edge, for the orders; none: the same meshes
    """
    meshes = tuple(dict.fromkeys((*((n, MIDDLE) for n in elements), *studied)))
    rungs = {mesh: _placed(problem, *mesh, of) for mesh in meshes}
    judged = max(meshes, key=lambda mesh: (mesh[0], -abs(mesh[1] - MIDDLE)))
    followed = tuple(rungs[mesh] for mesh in studied or meshes)
    return RefinementLevels(problem, tuple(rungs.values()), rungs[judged], followed)


def _placed(problem: Problem, n: int, place: float, of: str) -> RefinementLevel:
    mesh = per_radius(n, meshed(problem.radius, n, place))
    name = mesh_label(n, place, of)
    return RefinementLevel(SectionRun(name, problem.scene, mesh, beyond=MIDDLE, problem=of), n)


def meshed(radius: float, elements: int, place: float = MIDDLE) -> float:
    """The radius over which so many elements go where the edge of the contact is to lie at this
    part of the next one [length]."""
    return radius * elements / (elements + place)


def on_elements(
    problem: Problem,
    elements: Sequence[int],
    over: float | None = None,
    of: str = "",
) -> RefinementLevels:
    """Meshes of so many elements over a part of the contact radius, or over its estimate.

    of  which problem of the case it is, in words; begins the labels
    """
    radius = None if over is None else over * problem.radius
    return ladder(
        problem,
        [
            RefinementLevel(
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
    """Discs, or rings so many times as fine as the solver chooses; values are judged at 1.

    name  of the run; the others as `RadiiRun` has them
    """

    def rung(times: float) -> RefinementLevel:
        label = name if times == 1 else f"{name}, {times:g} times as fine"
        scene = problem.scene
        return RefinementLevel(
            RadiiRun(label, scene, times, rings, EXACT, laws, at_points, name), rings
        )

    rungs = {times: rung(times) for times in fineness}
    return RefinementLevels(problem, tuple(rungs.values()), rungs[1], tuple(rungs.values()))


def on_springs(of: RefinementLevels, name: str, **penalty: float) -> RefinementLevels:
    """Return the judged mesh with springs instead of exact contact.

    name     of the run
    penalty  fields of the discretisation that are about the springs
    """
    run = of.judged.run
    assert isinstance(run, SectionRun)
    mesh = run.discretisation.model_copy(update=penalty)
    sprung = replace(run, label=name, discretisation=mesh, method=Method.PENALTY)
    return ladder(of.problem, [replace(of.judged, run=sprung)])


def cells_label(cells: int, of: str = "") -> str:
    """Of a run on a grid."""
    return f"{of}, {cells}x{cells}" if of else f"{cells}x{cells}"


def mesh_label(elements: int, place: float = MIDDLE, of: str = "") -> str:
    """Of a run on a mesh."""
    name = f"{of}, " if of else ""
    aside = "" if place == MIDDLE else f", edge at {place:g}"
    return f"{name}{elements} elements per radius{aside}"


def asked(figure: float, order: float) -> Callable[[RefinementLevel], float]:
    """Scale a tolerance for 64 elements per radius to other meshes by the convergence order."""
    return lambda rung: figure * (ASKED_AT / rung.count) ** order


def part_of_side(part: float) -> Callable[[RefinementLevel], float]:
    """Return a part of a cell or element over the radius."""
    return lambda rung: part * rung.reach / rung.count


def named(name: str, of: RefinementLevels) -> RefinementLevels:
    """The same with another label of the judged run."""
    judged = replace(of.judged, run=replace(of.judged.run, label=name))

    def renamed(rungs: tuple[RefinementLevel, ...]) -> tuple[RefinementLevel, ...]:
        return tuple(judged if rung == of.judged else rung for rung in rungs)

    return RefinementLevels(of.problem, renamed(of.rungs), judged, renamed(of.followed))
