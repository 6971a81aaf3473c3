"""Load stepping: the loop over the increments of all load steps, with bisection.

An increment that does not converge is bisected, down to `MAX_HALVINGS` levels.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Generic, Protocol, TypeVar

from contact_scene.array_types import Field
from contact_scene.bulk_strain import add_bulk_strain
from contact_scene.geometry import ShapedBody
from contact_scene.quantities.separation import (
    add_values_at_separation,
    position,
    ramp_since_separation,
    separated_increment,
    virgin_increment,
)
from contact_scene.quantities.summary import ContactStatus
from contact_scene.scene import Scene
from contact_scene.solver_errors import NotConverged, NothingTouches, SolverError, UnsupportedScene
from contact_scene.stepping.checkpoint import (
    Checkpoint,
    ResumePoint,
)
from contact_scene.stepping.load_path import (
    ControlKind,
    LoadRamp,
)

MAX_HALVINGS = 4
# Least reference length of a line contact in half-widths: its approach is positive from one on, and
# the surface there moves as under a concentrated load, to the square of the ratio.
LEAST_REFERENCE = 10.0

S = TypeVar("S")
Report = TypeVar("Report")


@dataclass(frozen=True)
class IncrementPosition:
    """Position of an increment in the load history.

    step   number of the load step, counted from 1
    index  number of the increment in the load step, counted from 1
    increments_in_step
           number of increments of the load step
    """

    step: int
    index: int
    increments_in_step: int


@dataclass(frozen=True)
class ConvergedIncrement(Generic[S]):
    """Converged solve of a load increment, from which a solver creates its reported increment.

    place     position of the increment in the load history
    before    state of the solver at the start of the increment; None before first contact
    state     state of the solver at the end of the increment
    halvings  number of bisections of the increment
    spent     work of the solver for the increment, in the unit that the solver chooses
    """

    place: IncrementPosition
    before: S | None
    state: S
    halvings: int
    spent: float


class Solver(Protocol[S, Report]):
    """Interface of a solver of single load increments, which the load stepping calls.

    The load stepping is the loop over all increments of the history. An increment that does not
    converge is bisected. A solver that inherits from this class sets no limit of its work.
    """

    @property
    def most_spent(self) -> float:
        """Work above which an increment that does not converge is not bisected any further."""
        return 0.0

    def spent(self) -> float:
        """Return the work of the solver on the load history so far, in a unit of its choice.

        The load stepping does not bisect an increment that has taken too much work. The work is 0
        if the solver does not count it.
        """
        return 0.0

    def advance(self, ramp: LoadRamp, start: S | None, before: S | None, fraction: float) -> S:
        """Solve for the contact state at a fraction of a load ramp.

        A load ramp is the linear change of all loads in a load step.

        ramp      prescribed forces and displacements at the start and end of the load step
        start     state at the start of the ramp; None without contact
        before    state at the end of the previous increment; None without contact
        fraction  fraction of the ramp, from 0 to 1

        Raises NotConverged, after which load stepping bisects the increment, and other errors that
        a bisection does not remedy.
        """

    def report(self, reached: ConvergedIncrement[S], last: Report | None) -> Report:
        """Create the reported increment, with scalars and fields, from a converged solve.

        reached  converged solve: states at start and end, and position in the load history
        last     previous reported increment, whose energies are continued; None before the first
        """

    def undeformed_gap(self, last: Report, tilt: Any) -> Field:
        """Compute the gap of the undeformed bodies at an approach of 0 and a given tilt [length].

        Used for increments in which the bodies are separated.

        last  reported increment at whose points the gap is computed
        tilt  tilt (x, y) of the indenter [radian]; None without tilt
        """


def resumable_increments(
    scene: Scene, counts: Sequence[int], solver: Solver[S, Report], since: Checkpoint | None
) -> Iterator[tuple[Report, ResumePoint[S]]]:
    """Solve the load history; yield every reported increment with its resume point.

    An increment within a step that has no contact at its approach, before first contact or before
    separation, is the empty contact. Such increments before the first contact of the history are
    yielded together with the first increment in contact, which determines the shapes of their
    fields.

    Parameters
    ----------
    counts : sequence of int
        Number of increments of each load step.
    since : Checkpoint or None
        Checkpoint of the same history, from which the solve continues.

    Raises
    ------
    SolverError
        From the solver, with the last converged increment as `last_state`.
    """

    def empty(
        last: Report, ramp: LoadRamp, end: float, approach: float | None, place: IncrementPosition
    ) -> Report:
        """Return the reported increment of separated bodies at a fraction of a load ramp.

        Separated bodies have no tractions (empty contact), so that no solve is needed.

        last      preceding reported increment
        ramp      prescribed forces and displacements of the load step
        end       fraction of the ramp at the end of the increment
        approach  prescribed approach [length]; None for the approach of first contact
        place     position of the increment in the load history
        """
        gap = solver.undeformed_gap(last, position(last, ramp, end)["tilt"])
        return add_bulk_strain(
            separated_increment(last, ramp, end, gap, vars(place), approach), ramp.strain(end)
        )

    point: ResumePoint[S] | None = since.point if since else None
    earlier: Sequence[Any] = since.increments if since else ()
    last: Report | None = earlier[-1] if earlier else None
    apart = next((i for i in reversed(earlier) if i.status is ContactStatus.SEPARATED), None)
    # `here` is the last increment of this contact, counted from its first contact.
    state, done, here = point.state if point else None, 0, point.last if point else None
    for ramp, count in zip(scene.load_path(), counts, strict=True):
        completed = point.completed_in_step(done, count) if point else 0
        start = point.start if point and 0 < completed < count else state
        done += completed
        ends = [0.0, *fractions(scene, ramp, count)]
        counted, falls = ramp_since_separation(ramp, apart) if apart else ramp, ramp.normal.end == 0
        untouched: list[tuple[float, float | None, IncrementPosition]] = []
        for index in range(completed + 1, len(ends)):
            place, end = IncrementPosition(ramp.step, index, count), ends[index]
            done, before, begun = done + 1, state, solver.spent()
            reached: ConvergedIncrement[S] | None = None
            approach = None
            try:
                if not (falls and (start is None or index == count)):
                    most = begun + solver.most_spent
                    found, halvings = _solve_with_bisection(
                        solver, counted, start, before, (ends[index - 1], end), most
                    )
                    reached = ConvergedIncrement(
                        place, before, found, halvings, solver.spent() - begun
                    )
            except SolverError as error:
                within = isinstance(error, NothingTouches) and index < count
                if not (within and (falls or before is None)):
                    error.where = f"step {ramp.step}, increment {index} of {count}"
                    error.last_state = last
                    raise
                approach = ramp.normal.prescribed(end, (0.0, 0.0))[1]
            if reached is not None:
                state = reached.state
                here = add_bulk_strain(
                    solver.report(reached, here if apart else last), ramp.strain(end)
                )
                _refuse_end_of_shape(scene.indenter, here, last)
                for before_touch, approach, at in untouched:
                    last = apart = empty(
                        apart or virgin_increment(here), ramp, before_touch, approach, at
                    )
                    yield apart, ResumePoint(done - index + at.index, None, start)
                untouched.clear()
                last = add_values_at_separation(apart, here) if apart else here
                yield last, ResumePoint(done, state, start, here if apart else None)
            elif last is None:
                untouched.append((end, approach, place))
            else:
                last = apart = empty(last, ramp, end, approach, place)
                state = here = None
                yield last, ResumePoint(done, state, start)


def _refuse_end_of_shape(indenter: ShapedBody, here: Any, last: Any) -> None:
    """Raise UnsupportedScene if a contact extends beyond the points of a measured indenter.

    The contact of a line contact must also be small compared with its reference length.

    indenter  indenter with its shape
    here      reported increment
    last      previous reported increment; None before the first
    """
    length = getattr(indenter, "reference_length", None)
    error = None
    if length is not None and LEAST_REFERENCE * here.contact_radius > length:
        error = UnsupportedScene(
            f"the half-width of the contact is {here.contact_radius:.4g} m, and reference_length "
            f"is {length:.4g} m. Use at least {LEAST_REFERENCE:g} half-widths"
        )
    if here.contact_radius > indenter.known_radius:
        error = UnsupportedScene(
            f"the contact radius of {here.contact_radius:.4g} m exceeds the last radius of the "
            f"profile, {indenter.known_radius:.4g} m. Use a smaller load or a wider profile"
        )
    if error is not None:
        error.where = f"step {here.step}, increment {here.index} of {here.increments_in_step}"
        error.last_state = last
        raise error


def fractions(scene: Scene, ramp: LoadRamp, count: int) -> list[float]:
    """Compute the fractions of a load ramp at which its increments end.

    A load ramp is the linear change of the loads in a load step. The increments are uniform in the
    contact radius if the normal load starts or ends below its change in one increment, such as at
    0, else uniform in the load.

    scene    contact problem with the shape of the indenter
    ramp     load ramp of the load step
    count    number of increments
    returns  fractions in ascending order; the last is 1
    """
    start, end = ramp.normal.start, ramp.normal.end
    if start is None:
        start = end or 1.0
    less, more = min(start, end), max(start, end)
    if less > (more - less) / count:
        return [k / count for k in range(1, count + 1)]
    by_force = ramp.normal.kind is ControlKind.FORCE
    exponent = scene.indenter.load_exponent if by_force else scene.indenter.gap_exponent
    power, share = exponent or 1, less / (more or 1.0)
    least = share ** (1 / power)
    loads = [(least + (1 - least) * k / count) ** power for k in range(1, count)]
    parts = [(load - share) / (1 - share) for load in loads]
    return [1 - part for part in reversed([0.0, *parts])] if end == less else [*parts, 1.0]


def _solve_with_bisection(
    solver: Solver[S, Any],
    ramp: LoadRamp,
    start: S | None,
    before: S | None,
    fractions: tuple[float, float],
    most_spent: float,
    halvings_left: int = MAX_HALVINGS,
) -> tuple[S, int]:
    """Solve one load increment, in two halves if the solve of the whole does not converge.

    Each half may be divided again. All parts but the last only provide the state from which the
    next part starts.

    solver         solver of single increments
    ramp           load ramp of the load step
    start          state at the start of the ramp
    before         state at the start of the increment; None before first contact
    fractions      fractions of the ramp at the start and the end of the increment
    most_spent     total work of the solver above which no further bisection starts
    halvings_left  number of further levels of bisection
    returns        state at the end of the increment, number of bisections
    """
    begin, end = fractions
    try:
        return solver.advance(ramp, start, before, end), 0
    except NotConverged:
        if halvings_left == 0 or solver.spent() > most_spent:
            raise
    middle, limits = 0.5 * (begin + end), (most_spent, halvings_left - 1)
    half, first = None, 0  # the empty contact
    try:
        half, first = _solve_with_bisection(solver, ramp, start, before, (begin, middle), *limits)
    except NothingTouches:
        if before is not None:
            raise
    whole, second = _solve_with_bisection(solver, ramp, start, half, (middle, end), *limits)
    return whole, 1 + first + second
