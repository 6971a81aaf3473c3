"""A coupled increment linearised in its zones of contact, stick and slip, and its solution."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from contact_scene.solver_errors import NotConverged
from semi_analytical.coupled_problem import CoupledProblem
from semi_analytical.generalised_derivative import Field, Natural, Point, Tractions, Zones
from semi_analytical.graded_preconditioner import GradedPreconditioner
from semi_analytical.krylov import least_residual

Matrix = NDArray[np.float64]
Vector = NDArray[np.float64]

MOST_ITERATIONS = 40
# Of the sums of tractions: what a zone that slips one way does not determine.
UNDETERMINED = 1e-12


@dataclass(frozen=True)
class Step:
    """Change of tractions and displacements (3, nx, ny) and of the closure, and its iterations."""

    tractions: Tractions
    displacements: Field
    closure: float | Field
    iterations: int


class LinearisedIncrement:
    """The derivative in given zones under the loads: rigid motions whose forces are given are
    unknowns beside the tractions, and the tractions keep these forces."""

    def __init__(
        self, problem: CoupledProblem, zones: Zones, last: "LinearisedIncrement | None" = None
    ) -> None:
        """last  in nearly these zones: what carried its loads will do here too"""
        self._problem, self._zones = problem, zones
        self._precondition = GradedPreconditioner(zones, problem)
        shape = problem.gap.shape
        self._shifts = problem.tangential_load.free_motions((2, *shape))
        self._closures = problem.normal_load.free_motions(shape)
        count = len(self._shifts) + len(self._closures)
        self._images: Field = np.empty((count, 3, *shape))
        for number, unit in enumerate(self._units()):
            self._images[number] = (
                zones.free(last._images[number]) if last else self._precondition(zones.free(unit))
            )
        responses = np.array([self._forces(image) for image in self._images])
        self._inverse = np.linalg.pinv(responses.reshape(count, count).T, rcond=UNDETERMINED)

    def _units(self) -> Iterator[Field]:
        """Unit motions whose forces are given (3, nx, ny)."""
        for parts, motions in ((slice(2), self._shifts), (slice(2, 3), self._closures)):
            for motion in motions:
                unit = np.zeros((3, *self._problem.gap.shape))
                unit[parts] = motion
                yield unit

    def _free_units(self) -> Matrix:
        """The free parts of these (k, 3 nx ny)."""
        units = np.empty((len(self._images), 3 * self._problem.gap.size))
        for row, unit in zip(units, self._units(), strict=True):
            row[:] = self._zones.free(unit).ravel()
        return units

    def admissible(self, tractions: Tractions) -> Tractions:
        """Tractions in the zones that friction allows and that carry the loads, near given ones.

        raises  NotConverged where the zones cannot carry the loads
        """
        problem, zones, load = self._problem, self._zones, self._problem.tangential_load
        p = problem.normal_load.admissible(np.maximum(tractions[2], 0.0) * zones.contact)
        bound = problem.friction_limit(p)
        if load.exhausts(bound):
            raise NotConverged("the coupled increment", 0, np.inf, 0.0)
        t = zones.tractions(zones.free(np.concatenate([tractions[:2], p[None]])))
        images = self._images[: len(self._shifts), :2]
        forces = np.array([load.forces(image) for image in images])
        forces = forces.reshape(len(images), len(images))
        missing = load.given - load.forces(t[:2])
        shares = np.linalg.pinv(forces.T, rcond=UNDETERMINED) @ missing
        t[:2] += np.einsum("i,icjk->cjk", shares, images)
        t[:2] = load.admissible(t[:2], bound)
        return t

    def solved(self, base: Point, natural: Natural, depth: float) -> Step:
        """The step from a point to where the linearised increment is solved, but for the part
        `depth` of what it does not fulfil now."""
        zones, problem = self._zones, self._problem
        missing = np.empty_like(base.tractions)
        missing[:2] = natural.slipped - zones.tangent * (
            zones.turning * zones.along(base.tractions)
        )
        missing[2] = np.where(zones.contact > 0, -natural.gap, 0.0)

        def apply(v: Field) -> tuple[Field, Field]:
            free = self._unknowns(v)
            u = problem.together(zones.tractions(free))
            return zones.rows(free, u), u

        right = zones.free(missing)
        found = least_residual(apply, right, self._free_units(), depth, MOST_ITERATIONS)
        closing = zip(found.motion[len(self._shifts) :], self._closures, strict=True)
        return Step(
            zones.tractions(self._unknowns(found.solution)),
            found.along,
            sum((-m * closure for m, closure in closing), 0.0),
            found.iterations,
        )

    def _unknowns(self, rows: Field) -> Field:
        """Free unknowns, roughly, that the derivative makes rows of; they change no given force."""
        free = self._precondition(rows)
        for share, image in zip(self._inverse @ self._forces(free), self._images, strict=True):
            free -= share * image
        return free

    def _forces(self, free: Field) -> Vector:
        """The given forces, of the tractions of free unknowns."""
        t = self._zones.tractions(free)
        pressed = [np.sum(closure * t[2]) for closure in self._closures]
        return np.array([*self._problem.tangential_load.forces(t[:2]), *pressed])
