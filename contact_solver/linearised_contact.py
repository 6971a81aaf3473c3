"""Linear system of one semismooth Newton step in fixed zones of contact, stick and slip.

The system is solved by GMRES.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from contact_scene.array_types import Field, Matrix, Vector
from contact_scene.solver_errors import NotConverged
from contact_solver.admissible_shear import admissible_shear
from contact_solver.conjugate_gradients import Map
from contact_solver.coupled_problem import CoupledProblem
from contact_solver.krylov import least_residual
from contact_solver.natural_map import (
    Natural,
    NewtonPoint,
    Tractions,
)
from contact_solver.zones import Zones

MAX_ITERATIONS = 40
# Relative cutoff of the pseudo-inverse: slip in one direction leaves a force undetermined.
UNDETERMINED = 1e-12


@dataclass(frozen=True)
class Step:
    """Newton step of a coupled increment: changes of the iterate.

    tractions      changes of the tractions (q_x, q_y, p) (3, n) [force/length^2]
    displacements  changes of the surface displacements (3, n) [length]
    closure        change of the reduction of the gap by approach and tilt, a number or a field (nx,
                   ny) [length]
    iterations     GMRES iterations of the linear solve
    """

    tractions: Tractions
    displacements: Field
    closure: Field
    iterations: int


class LinearisedContact:
    """Linear system of a Newton step in given zones of contact, stick and slip.

    Unknowns are the free tractions (shear in the stick zone, shear across the slip direction,
    pressure in contact) and the rigid motions with a prescribed force. Steps do not change the
    prescribed forces.

    problem   operators, loads and friction law of the increment
    zones     zones of the iterate
    carriers  tractions that change the prescribed forces (k, unknowns), one row per force; None to
              compute them
    """

    def __init__(
        self, problem: CoupledProblem, zones: Zones, carriers: Matrix | None = None
    ) -> None:
        """Assemble the linear system of a Newton step.

        carriers  tractions that change the prescribed forces, from similar zones (see
                  `Zones.transfer`), which saves their computation; None to compute them
        """
        self._problem, self.zones = problem, zones
        self._shifts, self._closures = problem.shifting.held, problem.closing.held
        units = self._free_units
        if carriers is None:
            carriers = units if problem.inverse.exact else self._precondition(units)
        self.carriers = carriers

    @cached_property
    def _precondition(self) -> Map:
        """Inverse in the zones, on first use: a converged iterate may need none."""
        return self._problem.inverse.in_zones(self.zones)

    @cached_property
    def _free_units(self) -> Matrix:
        """Restrict the unit rigid motions of the indenter to the free unknowns (k, unknowns).

        Only motions with a prescribed force are included. Rows are the shifts and the twist of the
        tangential load, then approach and tilts of the normal load.
        """
        zones, free = self.zones, []
        for parts, motions in ((slice(2), self._shifts), (slice(2, 3), self._closures)):
            for motion in motions.each:
                unit = np.zeros((3, zones.contact.size))
                unit[parts] = motion.shape
                free.append(zones.free(unit))
        return np.array(free).reshape(len(free), zones.size)

    def admissible(self, tractions: Tractions) -> Tractions:
        """Return tractions near given ones that satisfy friction and loads in the present zones.

        Pressure is non-negative and zero outside the contact zone. The shear is within the friction
        limit, and at the limit in the slip zone. Forces have the prescribed values.

        tractions  (q_x, q_y, p), shape (3, n)
        raises     NotConverged if the load reaches the friction limit
        """
        problem, zones, shifts = self._problem, self.zones, self._shifts
        p = problem.pressing.admissible(np.maximum(tractions[2], 0.0) * zones.contact)
        bound = problem.friction_limit(p)
        if problem.exhausts_friction(bound):
            raise NotConverged("the coupled increment", 0, np.inf, 0.0)
        t = zones.admissible_tractions(np.concatenate([tractions[:2], p[None]]), bound)
        carriers = self.carriers[: len(shifts)]
        forces = np.array([shifts.forces(zones.field(carrier)[:2]) for carrier in carriers])
        forces = forces.reshape(len(carriers), len(carriers))
        weights = np.linalg.pinv(forces.T, rcond=UNDETERMINED) @ (
            shifts.prescribed_forces - shifts.forces(t[:2])
        )
        t[:2] += zones.field(np.einsum("i,ik->k", weights, carriers))[:2]
        t[:2] = admissible_shear(problem.shifting, t[:2], bound)
        return t

    def residual(self, base: NewtonPoint, natural: Natural) -> Vector:
        """Compute the residual of the linearised contact and friction conditions of a Newton step.

        The residual has one row per free unknown [length]: slip in the stick zone, slip across the
        slip direction less the term of the slip compliance in the slip zone, and negative gap in
        contact.

        base, natural  iterate, and natural map at the iterate
        """
        zones = self.zones
        rows = zones.free(np.concatenate([natural.slipped, -natural.gap[None]]))
        rows -= zones.slip_terms(zones.free(base.tractions))
        return rows

    def solve(self, residual: Vector, depth: float) -> Step:
        """Solve the linearised contact and friction conditions for a Newton step, by GMRES.

        residual  residual of the iterate, one row per free unknown [length]
        depth     reduction of the residual at which GMRES stops
        """
        zones, problem = self.zones, self._problem
        responses = np.einsum("ki,ji->kj", self._force_rows, self.carriers)
        weights = np.linalg.pinv(responses, rcond=UNDETERMINED)

        def apply_operator(rows: Vector) -> tuple[Vector, Vector, Vector]:
            """Precondition, correct to constant prescribed forces, and apply the operator."""
            free = self._precondition(rows[None])[0]
            changes = weights @ np.einsum("ki,i->k", self._force_rows, free)
            for change, carrier in zip(changes, self.carriers, strict=True):
                free -= change * carrier
            u = problem.together(zones.tractions(free))
            return free, zones.free(u) + zones.slip_terms(free), zones.restrict_to_fixed(u)

        extra = 3 * zones.contact.size - zones.size
        found = least_residual(
            apply_operator, residual, self._free_units, extra, depth, MAX_ITERATIONS
        )
        free = found.solution
        return Step(
            zones.tractions(free),
            zones.assemble_field(found.image - zones.slip_terms(free), found.extra),
            -self._closures.displacement(found.motion[len(self._shifts) :])[0],
            found.iterations,
        )

    def solve_exactly(self, point: NewtonPoint, motion: Vector) -> Step:
        """Compute the Newton step with the exact inverse of the compliance in the zones.

        The step starts at any tractions. The rigid motions are the multipliers of the forces.

        point   tractions and displacements of the iterate
        motion  rigid tangential motion of the iterate
        """
        problem, zones = self._problem, self.zones
        p = np.maximum(point.tractions[2], 0.0)
        t = zones.admissible_tractions(
            np.concatenate([point.tractions[:2], p[None]]), problem.friction_limit(p)
        )
        u = problem.together(t)
        slipped = problem.target - u[:2] + problem.shifting.displacement(motion)
        overlap = point.closure - problem.gap - u[2]
        rows = zones.free(np.concatenate([slipped, overlap[None]]))
        rows -= zones.slip_terms(zones.free(t))
        free = self._precondition(np.concatenate([rows[None], self._free_units]))
        forces = np.einsum("ki,ji->kj", self._force_rows, free)
        forces[:, 0] += [*self._shifts.forces(t[:2]), *self._closures.forces(t[2:])]
        forces[:, 0] -= [*self._shifts.prescribed_forces, *self._closures.prescribed_forces]
        further = np.linalg.pinv(forces[:, 1:], rcond=UNDETERMINED) @ forces[:, 0]
        change = zones.tractions(free[0] - further @ free[1:])
        return Step(
            t + change - point.tractions,
            u + problem.together(change) - point.displacements,
            -self._closures.displacement(further[len(self._shifts) :])[0],
            1,
        )

    @cached_property
    def _force_rows(self) -> Matrix:
        """Changes of the prescribed forces by changes of the free unknowns (k, unknowns)."""
        zones, rows = self.zones, self._free_units.copy()
        before = zones.size - len(zones.contact_points)
        pressed = before + np.searchsorted(zones.contact_points, zones.slip)
        assert zones.friction_slope is not None
        along = self._shifts.shapes.at(zones.slip).along(zones.friction_slope)
        rows[: len(self._shifts), pressed] += along
        return rows
