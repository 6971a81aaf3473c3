"""A coupled increment linearised in its zones of contact, stick and slip, and its solution."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from contact_scene.array_types import Field, Matrix, Vector
from contact_scene.solver_errors import NotConverged
from semi_analytical.coupled.coupled_problem import CoupledProblem
from semi_analytical.coupled.generalised_derivative import (
    Natural,
    Point,
    Tractions,
    Zones,
)
from semi_analytical.coupled.krylov import least_residual
from semi_analytical.operator.slip_compliance_bins import shares

MAX_ITERATIONS = 40
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
        self, problem: CoupledProblem, zones: Zones, carriers: Matrix | None = None
    ) -> None:
        """carriers  of the loads, from nearly these zones: see `carriers_in`"""
        self._problem, self._zones = problem, zones
        self._precondition = GradedPreconditioner(zones, problem)
        shape = problem.gap.shape
        self._shifts = problem.tangential_load.free_motions((2, *shape))
        self._closures = problem.normal_load.free_motions(shape)
        if carriers is None:
            units = self._free_units()
            for number, unit in enumerate(units):
                units[number] = self._precondition(unit)
            carriers = units
        self._carriers, count = carriers, len(carriers)
        responses = np.array([self._forces(carrier) for carrier in carriers])
        self._inverse = np.linalg.pinv(responses.reshape(count, count).T, rcond=UNDETERMINED)

    def carriers_in(self, zones: Zones) -> Matrix:
        """What carries its loads, in other zones, where they may do so, too (k, unknowns)."""
        own = (zones.free(self._zones.field(carrier)) for carrier in self._carriers)
        return np.array([*own]).reshape(-1, zones.size)

    def _free_units(self) -> Matrix:
        """The free parts of unit motions whose forces are given (k, unknowns)."""
        zones, free = self._zones, []
        for parts, motions in ((slice(2), self._shifts), (slice(2, 3), self._closures)):
            for motion in motions:
                unit = np.zeros((3, *self._problem.gap.shape))
                unit[parts] = motion
                free.append(zones.free(unit))
        return np.array(free).reshape(len(free), zones.size)

    def admissible(self, tractions: Tractions) -> Tractions:
        """Tractions in the zones that friction allows and that carry the loads, near given ones.

        raises  NotConverged where the zones cannot carry the loads
        """
        problem, zones, load = self._problem, self._zones, self._problem.tangential_load
        p = problem.normal_load.admissible(np.maximum(tractions[2], 0.0) * zones.contact)
        bound = problem.friction_limit(p)
        if load.exhausts(bound):
            raise NotConverged("the coupled increment", 0, np.inf, 0.0)
        t = zones.nearest(np.concatenate([tractions[:2], p[None]]), bound)
        carriers = self._carriers[: len(self._shifts)]
        forces = np.array([load.forces(zones.field(carrier)[:2]) for carrier in carriers])
        forces = forces.reshape(len(carriers), len(carriers))
        missing = load.given - load.forces(t[:2])
        shares = np.linalg.pinv(forces.T, rcond=UNDETERMINED) @ missing
        t[:2] += zones.field(np.einsum("i,ik->k", shares, carriers))[:2]
        t[:2] = load.admissible(t[:2], bound)
        return t

    def unsolved(self, base: Point, natural: Natural) -> Vector:
        """What the linearised increment does not fulfil at a point."""
        zones = self._zones
        missing = zones.free(np.concatenate([natural.slipped, -natural.gap[None]]))
        missing -= zones.held(zones.free(base.tractions))
        return missing

    def solved(self, unsolved: Vector, depth: float) -> Step:
        """The step from a point to where the linearised increment is solved, but for the part
        `depth` of what it does not fulfil now."""
        zones, problem = self._zones, self._problem

        def apply(v: Vector) -> tuple[Vector, Vector]:
            free = self._unknowns(v)
            u = problem.together(zones.tractions(free))
            return zones.free(u) + zones.held(free), zones.rest(u)

        extra = 3 * zones.contact.size - zones.size
        found = least_residual(apply, unsolved, self._free_units(), extra, depth, MAX_ITERATIONS)
        free = self._unknowns(found.solution)
        closing = zip(found.motion[len(self._shifts) :], self._closures, strict=True)
        return Step(
            zones.tractions(free),
            zones.whole(found.image - zones.held(free), found.along),
            sum((-m * closure for m, closure in closing), 0.0),
            found.iterations,
        )

    def _unknowns(self, rows: Vector) -> Vector:
        """Free unknowns, roughly, that the derivative makes rows of; they change no given force."""
        free = self._precondition(rows)
        for share, carrier in zip(self._inverse @ self._forces(free), self._carriers, strict=True):
            free -= share * carrier
        return free

    def _forces(self, free: Vector) -> Vector:
        """The given forces, of the tractions of free unknowns."""
        t = self._zones.tractions(free)
        pressed = [np.sum(closure * t[2]) for closure in self._closures]
        return np.array([*self._problem.tangential_load.forces(t[:2]), *pressed])


class GradedPreconditioner:
    """Approximate inverse of the generalised derivative, graded by the stiffness of slip.

    On stick the derivative is the tangential operator; where a cell slips, its stiffness d is added
    (see `slip_compliance_bins`). The inverse of neither part approximates that of their sum:

        M = Π F⁻¹ Π + Σ_j χ_j t (f + d_j)⁻¹ t χ_j,    Π = stick + χ_0 t t

    F is the tangential spectrum with the unpadded period, f its scalar mean. Rows and free unknowns
    are vectors of the zones.
    """

    def __init__(self, zones: Zones, problem: CoupledProblem) -> None:
        self._zones, self._inverse = zones, problem.precondition_together
        self._shares = shares(zones.turning / problem.self_compliance)

    def __call__(self, rows: Vector) -> Vector:
        """M rows."""
        zones, slip, shares = self._zones, self._zones.slip, self._shares
        shape = zones.contact.shape
        v: NDArray[Any] = np.zeros((2 + len(shares), zones.contact.size), dtype=np.float32)
        v[:3] = zones.field(rows).reshape(3, -1)
        along = zones.parts(rows)[1]
        for one in v[:2]:
            one[slip] *= shares[0]
        for one, share in zip(v[3:], shares[1:], strict=True):
            one[slip] = share * along
        u = self._inverse(v.reshape(-1, *shape)).reshape(v.shape)
        for one in u[:2]:
            one[slip] *= shares[0]
        free = zones.free(u[:3])
        turned = zones.parts(free)[1]
        for one, share in zip(u[3:], shares[1:], strict=True):
            turned += share * one[slip]
        return free
