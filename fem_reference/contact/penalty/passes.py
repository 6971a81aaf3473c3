"""One increment of the penalty method: passes by Newton or springs, then what is remembered."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import pi

import numpy as np
from numpy.typing import NDArray

from contact_scene.friction import sliding_friction
from contact_scene.solver_errors import NotConverged, motion_undefined
from fem_reference.contact.augmentation import Penalty, augmented
from fem_reference.contact.first_touch import touching_share
from fem_reference.contact.friction_limit import reaches_limit
from fem_reference.contact.penalty.newton import Iterate, defect, solve_by_newton
from fem_reference.contact.penalty.problem import PenaltyProblem
from fem_reference.contact.penalty.spring_contact import PenaltyLaw
from fem_reference.contact.penalty.spring_residuals import penalty_residuals
from fem_reference.contact.penalty.spring_state import PenaltyState, Solution, untouched
from fem_reference.contact.penalty.springs import NORMAL, solve_by_springs
from fem_reference.contact.penalty.surface import ElasticSurface, Target
from fem_reference.contact.zone_edge import refuse_contact_at_edge
from fem_reference.loads import Loads
from fem_reference.residuals import over

Field = NDArray[np.float64]

# Springs stiff enough need one update to be as good as the mesh. The multiplier of the pressure
# starts from zero in every increment, so that no ripples pile up from one to the next; that of the
# shear, which remembers, goes on from the last one.
FEWEST_UPDATES = 1
# A mesh's zone of equal elements is so much wider than its contact, at most.
WIDEST_ZONE = 1.25
# Overlap over approach up to which springs do not move the edge of the contact visibly.
AT_EDGE = 5e-3
# Of the approach: shorter tangential motions are round-off of bodies that do not couple.
ROUND_OFF = 1e-6
# Part of the tolerance that passes are solved to, so that the residuals meet it.
ENOUGH = 0.1


def advance(
    problem: PenaltyProblem,
    penalty: Penalty,
    before: PenaltyState | None,
    loads: Loads,
    tolerance: float,
) -> PenaltyState:
    """The state at the end of an increment.

    raises  NotConverged, SurfacesOverlap, GrossSliding, ContactAtZoneEdge
    """
    last = before or untouched(problem.surface.gap)
    if np.isnan(last.motion).any():
        raise motion_undefined()
    solver = _Passes(problem.surface, problem.target(loads), ENOUGH * tolerance, tolerance)
    limit = None
    if problem.driven and solver.target.free[1]:
        limit = _at_limit(problem, penalty, last, loads, solver)
    state = limit or _advanced(problem, penalty, last, loads, solver)
    at_edge = problem.open_end and state.traction[0, -1] > 0
    refuse_contact_at_edge(at_edge, problem.points.radii[-1])
    state.residuals.require(tolerance, "the increment", state.iterations)
    return state


@dataclass(frozen=True)
class _Passes:
    """How one pass is solved: by Newton's method, and by springs in series where that fails.

    tolerance  that is aimed at
    allowed    what will do where round-off stops the springs: the shear that pressing causes
               cancels in the slip, of which little friction resolves little
    """

    surface: ElasticSurface
    target: Target
    tolerance: float
    allowed: float

    def solve(self, law: PenaltyLaw, starts: Sequence[Iterate]) -> Iterate:
        """The solution, by Newton's method from the first start that leads to one; raises
        NotConverged."""
        spent = 0
        for start in starts:
            if np.any(start.traction[0] > 0):
                found = solve_by_newton(self.surface, law, self.target, start, self.tolerance)
                spent += found.iterations
                if found.residual <= self.tolerance:
                    return replace(found, iterations=spent)
        found = solve_by_springs(self.surface, law, self.target, starts[0], self.tolerance)
        spent += found.iterations
        if not found.residual <= self.allowed:
            raise NotConverged("the penalty model", spent, found.residual, self.allowed)
        return replace(found, iterations=spent)

    def starts(self, law: PenaltyLaw, last: PenaltyState) -> list[Iterate]:
        """Where the increment before ended, and as far beyond as its own change: there, what
        slipped goes on slipping. The one nearer to a solution comes first."""
        ended = last.first_pass
        if ended is None:
            nothing = np.zeros_like(self.surface.gap)
            return [self._driven(nothing, np.zeros(len(self.target.free)))]
        starts = [self._driven(ended.traction, ended.coordinates)]
        if last.change is not None:
            traction, coordinates = last.change
            starts.append(self._driven(ended.traction + traction, ended.coordinates + coordinates))
        return sorted(starts, key=lambda start: defect(self.surface, law, start, self.target)[0])

    def _driven(self, traction: Field, coordinates: Field) -> Iterate:
        """With prescribed coordinates where they are to be."""
        target = self.target
        return Iterate(traction, np.where(target.free, coordinates, target.value))


def _advanced(
    problem: PenaltyProblem,
    penalty: Penalty,
    last: PenaltyState,
    loads: Loads,
    solver: _Passes,
) -> PenaltyState:
    """The state below the friction limit."""
    surface, law = problem.surface, _law(problem, last)
    passes = augmented(
        _Pass(law, solver.solve(law, solver.starts(law, last))),
        lambda one: one.followed(solver),
        lambda one: max(one.left(surface)) * one.fineness(problem) ** 2,
        penalty,
        FEWEST_UPDATES,
    )
    law, reached = passes[-1].law, passes[-1].reached
    overlap = surface.overlap(reached.traction, reached.coordinates)
    response = law.response(overlap)
    # What the law gives is reported: it obeys friction exactly, and the load to the tolerance.
    traction = response.traction
    slip, dissipated = last.slip, last.dissipated
    edged = next((one for one in passes if one.left(surface)[0] <= AT_EDGE), passes[-1])
    edges = edged.reached.traction
    if slip is not None:
        grown = (law.trial_shear(overlap[1:]) - traction[1:])[0] / law.stiffness
        share = touching_share(
            problem.points.radii,
            ~last.in_contact & (last.overlap[0] < 0),
            ~response.in_contact,
            problem.contact_radius(last.edges[0]),
            problem.contact_radius(edges[0]),
        )
        grown = share * grown
        assert dissipated is not None
        slip = slip - grown
        bounds = (problem.friction.limit(state[NORMAL]) for state in (last.traction, traction))
        friction = sliding_friction(last.traction[1:], traction[1:], grown[None], *bounds)[0]
        dissipated += 2 * pi * float(np.sum(surface.weights * friction * grown))
    first = passes[0].reached
    return PenaltyState(
        loads=loads,
        traction=traction,
        overlap=overlap,
        motion=reached.coordinates,
        resultant=2 * pi * surface.resultant(traction),
        in_slip=response.in_slip,
        slip=slip,
        dissipated=dissipated,
        first_pass=first,
        edges=edges,
        augmentations=len(passes) - 1,
        change=_change(last.first_pass, first),
        residuals=penalty_residuals(problem, solver.target, reached, response),
        solution=Solution.SPRINGS if any(one.reached.sweeps for one in passes) else Solution.NEWTON,
        iterations=sum(one.reached.iterations for one in passes),
        sweeps=sum(one.reached.sweeps for one in passes),
    )


@dataclass(frozen=True)
class _Pass:
    """What was reached by a law."""

    law: PenaltyLaw
    reached: Iterate

    def followed(self, solver: _Passes) -> "_Pass":
        """The pass whose multipliers are the tractions of this one."""
        law = self.law.carrying(self.reached.traction)
        return _Pass(law, solver.solve(law, [self.reached]))

    def left(self, surface: ElasticSurface) -> tuple[float, float]:
        """Largest overlap over approach; and the strain of springs along the surface over what the
        surfaces have moved there, both as means weighted with the shear."""
        traction, approach = self.reached.traction, abs(float(self.reached.coordinates[0]))
        sprung = np.abs(traction - self.law.multiplier) / self.law.stiffness
        across = over(float(np.max(sprung[0], where=traction[0] > 0, initial=0.0)), approach)
        if len(traction) == 1:
            return across, 0.0
        worked = surface.weights * np.abs(traction[1:])
        moved = worked * np.abs(surface.displacement(traction)[1:])
        scale = float(np.sum(moved)) + ROUND_OFF * approach * float(np.sum(worked))
        return across, over(float(np.sum(worked * sprung[1:])), scale)

    def fineness(self, problem: PenaltyProblem) -> float:
        """Part of the mesh's contact zone that touches, at most 1: the error that elements make is
        inverse to its square, and overlap need not be smaller than that."""
        touching = np.flatnonzero(self.reached.traction[0] > 0)
        reached = problem.points.radii[touching[-1]] if len(touching) else problem.reach
        return min(1.0, WIDEST_ZONE * float(reached) / problem.reach)


def _law(problem: PenaltyProblem, last: PenaltyState) -> PenaltyLaw:
    """The law of a first pass: it remembers the shear and where it was reached."""
    multiplier = last.traction.copy()
    multiplier[NORMAL] = 0.0
    return PenaltyLaw(problem.stiffness, problem.friction, multiplier, last.overlap[1:])


def _change(before: Iterate | None, after: Iterate) -> tuple[Field, Field] | None:
    if before is None:
        return None
    return after.traction - before.traction, after.coordinates - before.coordinates


def _at_limit(
    problem: PenaltyProblem,
    penalty: Penalty,
    last: PenaltyState,
    loads: Loads,
    solver: _Passes,
) -> PenaltyState | None:
    """The state at the friction limit, where the shear is known and the motion is not; None below
    it. Raises GrossSliding beyond.

    Only for bodies whose pressure does not depend on the shear. Where friction carries nothing at
    all, because its coefficient vanishes, the indenter stays.
    """
    alone = problem.pressing_alone()
    pressing = replace(solver, surface=alone.surface, target=solver.target.part(NORMAL))
    pressed = _advanced(alone, penalty, last.pressing_alone(), loads, pressing)
    load = float(solver.target.value[1])
    capacity = problem.capacity(pressed.traction[0])
    if not reaches_limit(load, capacity):
        return None
    surface, sign = problem.surface, np.sign(load)
    traction = np.vstack([pressed.traction, sign * problem.friction.limit(pressed.traction)])
    motion = np.append(pressed.motion, np.nan if sign else last.motion[1])
    return replace(
        pressed,
        traction=traction,
        overlap=surface.overlap(traction, np.where(np.isnan(motion), 0.0, motion)),
        motion=motion,
        resultant=2 * pi * surface.resultant(traction),
        in_slip=pressed.in_contact,
        slip=last.slip,
        dissipated=None if sign else last.dissipated,
        first_pass=Iterate(traction, motion),
        edges=traction,
        change=None,
    )
