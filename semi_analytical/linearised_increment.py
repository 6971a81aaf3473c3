"""A coupled increment linearised in its zones of contact, stick and slip, and its solution."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from contact_scene.solver_errors import NotConverged
from semi_analytical.coupled_problem import CoupledProblem
from semi_analytical.generalised_derivative import Field, Natural, Point, Tractions, Zones
from semi_analytical.graded_preconditioner import GradedPreconditioner
from semi_analytical.krylov import least_residual

Matrix = NDArray[np.float64]

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
        shifts = problem.tangential_load.free_motions((2, *shape))
        self._closures = problem.normal_load.free_motions(shape)
        self._shifts = len(shifts)
        units = np.zeros((self._shifts + len(self._closures), 3, *shape))
        for unit, shift in zip(units, shifts, strict=False):
            unit[:2] = shift
        for unit, closure in zip(units[self._shifts :], self._closures, strict=True):
            unit[2] = closure
        free, images, forces = np.empty((3, *units.shape))
        for number, unit in enumerate(units):
            free[number] = zones.free(unit)
            images[number] = (
                zones.free(last._images[number]) if last else self._precondition(free[number])
            )
            # Forces of free unknowns are the product with these.
            forces[number] = zones.forces_on(unit)
        self._images: Field = images
        flat = (len(units), 3 * problem.gap.size)
        self._free, images, forces = (part.reshape(flat) for part in (free, images, forces))
        inverse = np.linalg.pinv(np.einsum("ik,jk->ij", forces, images), rcond=UNDETERMINED)
        self._excess = np.einsum("ij,jk->ik", inverse, forces)

    def admissible(self, tractions: Tractions) -> Tractions:
        """Tractions in the zones that friction allows and that carry the loads, near given ones.

        raises  NotConverged where the zones cannot carry the loads
        """
        problem, zones, load = self._problem, self._zones, self._problem.tangential_load
        p = problem.normal_load.admissible(np.maximum(tractions[2], 0.0) * zones.contact)
        bound = problem.friction_limit(p)
        if load.exhausts(bound):
            raise NotConverged("the coupled increment", 0, np.inf, 0.0)
        t = zones.tractions(np.concatenate([tractions[:2] * zones.stick, p[None]]))
        images = self._images[: self._shifts, :2]
        forces = np.array([load.forces(image) for image in images])
        forces = forces.reshape(self._shifts, self._shifts)
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
        missing[2] = np.where(natural.contact, -natural.gap, 0.0)

        def apply(v: Field) -> tuple[Field, Field]:
            free = self._unknowns(v)
            u = problem.together(zones.tractions(free))
            return zones.rows(free, u), u

        found = least_residual(apply, zones.free(missing), self._free, depth, MOST_ITERATIONS)
        closing = zip(found.motion[self._shifts :], self._closures, strict=True)
        return Step(
            zones.tractions(self._unknowns(found.solution)),
            found.along,
            sum((-m * closure for m, closure in closing), 0.0),
            found.iterations,
        )

    def _unknowns(self, rows: Field) -> Field:
        """Free unknowns, roughly, that the derivative makes rows of; they change no given force."""
        free = self._precondition(rows)
        excess = np.einsum("ik,k->i", self._excess, free.ravel())
        free -= np.einsum("i,icjk->cjk", excess, self._images)
        return free
