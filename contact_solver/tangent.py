"""Tangent of a converged increment: change of the forces by the rigid motions of the indenter.

In given zones of contact, stick and slip, the equations of an increment are linear in the changes
of tractions t and rigid motions m (see `natural_map`). One linear solve for each motion gives the
tractions by its unit value. With the shapes R of the motions, the tangent is

    K_kl = ∂F_k/∂m_l = Σ R_k·∂t/∂m_l

In the zones of the solution the matrix is that of the last Newton step, and K the exact derivative
of the forces at the end of the increment, whose start is kept: slip continues. With stick in the
whole contact, K is the slope after a load reversal. Moving edges of the zones do not contribute,
because pressure, gap and slip vanish there.
"""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from contact_scene.array_types import Field, Mask, Matrix, Vector, VectorField
from contact_scene.solver_errors import NotConverged
from contact_solver.admissible_shear import magnitude
from contact_solver.conjugate_gradients import Map, Point, inner, solve_in_zones
from contact_solver.coupled_problem import CoupledProblem
from contact_solver.krylov import least_residual
from contact_solver.natural_map import MAX_SLIP_COMPLIANCE, zones_of
from contact_solver.newton_iterate import evaluate_point, natural_map
from contact_solver.pressure import PressureProblem
from contact_solver.rigid_motion import RigidMotions
from contact_solver.shear import ShearProblem
from contact_solver.shear_zones import ShearZones
from contact_solver.zones import Zones

# Reduction of the residual by GMRES, of which the error of the tangent is a small multiple.
REDUCTION = 1e-9
# Reduction by conjugate gradients. The error of the tangent is of the order of its square.
ROOT_REDUCTION = 1e-6
MAX_ITERATIONS = 1000
# Vectors of GMRES before a restart.
MAX_VECTORS = 40
# Relative size of a motion, and of a singular value, that is round-off.
ROUND_OFF = 1e-12


def pressing_tangent(problem: PressureProblem, p: Vector) -> Matrix:
    """Compute the derivative of the forces by the motions that close the gap (k, k).

    problem  contact without penetration at a given shear
    p        its solution (n,)
    raises   NotConverged
    """
    inside, inverse = (p > 0).astype(np.float64), problem.inverse_on(p > 0)
    return _symmetric_tangent(
        lambda t: problem.displace(t[0])[None],
        lambda v: inside * v,
        lambda d, d_u: inside * d_u,
        lambda r: inside * inverse(r[0])[None],
        problem.motions,
        (1, len(p)),
    )


def shearing_tangent(problem: ShearProblem, z: VectorField, motions: RigidMotions) -> Matrix:
    """Compute the derivative of the tangential forces by tangential motions (k, k).

    problem  stick and slip at a given friction limit
    z        argument of the friction law in its solution (2, n), see `NaturalShear`; 0 for stick
    motions  motions of the derivative, which may include those that the target contains
    raises   NotConverged
    """
    zones = ShearZones(z, problem.bound, problem.self_compliance)
    return _symmetric_tangent(
        problem.displace,
        zones.free,
        lambda d, d_u: zones.free(d_u) + zones.slip_compliance * d,
        problem.inverse_in(zones),
        motions,
        z.shape,
    )


def _symmetric_tangent(
    displace: Map,
    restrict: Map,
    rows: Callable[[Field, Field], Field],
    precondition: Map,
    motions: RigidMotions,
    shape: tuple[int, ...],
) -> Matrix:
    """Compute the tangent of a symmetric problem by conjugate gradients, one solve per motion.

    The formula F_k(t_l) + F_l(t_k) - t_k·A t_l, with the matrix A of the zones, is exact up to the
    square of the errors of the solutions t.

    displace, rows, precondition  see `solve_in_zones`
    restrict                      restriction to the free components in the zones
    motions                       motions of the derivative
    shape                         shape (c, n) of the tractions
    """
    found = []
    start = Point(np.zeros(shape), np.zeros(shape))
    for one in motions.each:
        right = restrict(np.broadcast_to(one.shape, shape))
        solution, iterations = solve_in_zones(
            displace, rows, precondition, start, right, ROOT_REDUCTION, MAX_ITERATIONS
        )
        if iterations == MAX_ITERATIONS:
            raise NotConverged("the contact stiffness", iterations, np.inf, ROOT_REDUCTION)
        found.append(solution)
    forces = np.array([motions.forces(t) for t, _ in found]).reshape(len(found), len(found))
    energies = [[inner(t, rows(d, d_u)) for d, d_u in found] for t, _ in found]
    return np.asarray(forces + forces.T - np.reshape(energies, forces.shape))


def coupled_tangent(problem: CoupledProblem, zones: Zones, motions: RigidMotions) -> Matrix:
    """Compute the derivative of the forces by the motions of pressure and shear together (k, k).

    problem  pressure and shear of an increment
    zones    zones of contact, stick and slip, see `zones_of_solution` and `zones_of_stick`
    motions  motions of the derivative, of three components
    raises   NotConverged
    """
    inverse = problem.inverse.in_zones(zones)

    def apply_operator(rows: Vector) -> tuple[Vector, Vector, Vector]:
        free = inverse(rows[None])[0]
        u = problem.together(zones.tractions(free))
        return free, zones.free(u) + zones.slip_terms(free), np.zeros(0)

    slides = not np.any(zones.stick) and np.all(zones.slip_compliance >= _sliding(problem))
    forces = []
    for one in motions.each:
        if slides and np.any(one.shape[:2]):
            forces.append(np.zeros(len(motions)))
            continue
        right = zones.free(np.broadcast_to(one.shape, (3, zones.contact.size)))
        free = _solve_by_gmres(apply_operator, right)
        forces.append(motions.forces(zones.tractions(free)))
    return np.transpose(forces)


def zones_of_solution(problem: CoupledProblem, tractions: Field, motion: Vector | None) -> Zones:
    """Return the zones of contact, stick and slip of the solution of an increment.

    In gross slip under prescribed forces all points slide on, in the direction of their shear.

    problem    pressure and shear of an increment
    tractions  shear and pressure (q_x, q_y, p) of its solution (3, n)
    motion     tangential rigid motions; None in gross slip under prescribed forces, and without
               friction
    """
    if motion is not None:
        natural = natural_map(problem, evaluate_point(problem, tractions, motion)[0])
        return zones_of(natural, problem)
    q, p = tractions[:2], tractions[2]
    slip = np.flatnonzero((p > 0) & np.any(q, axis=0))
    normal = q[:, slip] / magnitude(q[:, slip])
    nothing = np.zeros(p.size, dtype=bool)
    slope = problem.friction_slope(p)[slip] * normal
    across = np.stack([-normal[1], normal[0]])
    return Zones(p > 0, nothing, slip, across, slope, np.full(slip.size, _sliding(problem)))


def _sliding(problem: CoupledProblem) -> float:
    """Return the slip compliance of points whose slip is so large that its direction is fixed."""
    return MAX_SLIP_COMPLIANCE * problem.self_compliance


def zones_of_stick(pressure: Vector, bound: Vector) -> Zones:
    """Return the zones of a contact whose points stick, unless they carry no shear.

    pressure  p (n,)
    bound     friction limit (n,)
    """
    none = np.zeros((2, 0))
    return Zones(pressure > 0, bound > 0, np.zeros(0, dtype=np.intp), none, none, none[0])


def _solve_by_gmres(
    apply_operator: Callable[[Vector], tuple[Vector, Vector, Vector]], right: Vector
) -> Vector:
    """Solve a linear system by GMRES with restarts.

    apply_operator  see `least_residual`
    right           right-hand side (n,)
    raises          NotConverged
    """
    solution, left, iterations = np.zeros_like(right), right, 0
    least = REDUCTION * float(np.linalg.norm(right))
    while (size := float(np.linalg.norm(left))) > least:
        if iterations >= MAX_ITERATIONS:
            raise NotConverged("the contact stiffness", iterations, size, least)
        none = np.empty((0, right.size))
        found = least_residual(apply_operator, left, none, 0, 0.5 * least / size, MAX_VECTORS)
        solution, left = solution + found.solution, left - found.image
        iterations += found.iterations
    return solution


def null_if_stalled(compute: Callable[[], dict[str, float]]) -> dict[str, Any]:
    """Return the computed stiffnesses, or none if a linear solve does not converge."""
    try:
        return compute()
    except NotConverged:
        return {}


def stiffnesses(
    tangents: Mapping[bool, Matrix],
    motions: RigidMotions,
    along: Mapping[str, Vector],
    changes: Mapping[str, bool],
    springs: Mapping[str, float],
) -> dict[str, float]:
    """Compute the change of the force along each of several motions by this motion, by name.

    Other forces that are prescribed do not change, and other motions are fixed. A name without a
    motion has no stiffness.

    tangents  derivative of the forces by the motions (k, k) in the zones of the solution, for
              True, and with stick in the whole contact, for False
    motions   the motions, with their prescribed forces
    along     unit vector of each motion (k,), zero for a motion that symmetry excludes
    changes   key of the tangent of each motion
    springs   compliances of springs in series that the tangents contain and the results do not
    """
    return {
        name: _stiffness_along(
            tangents[changes[name]], motions.is_held, unit, springs.get(name, 0.0)
        )
        for name, unit in along.items()
        if np.any(unit)
    }


def _stiffness_along(tangent: Matrix, released: Mask, along: Vector, spring: float) -> float:
    """Compute the change of the force along a motion by this motion.

    released  motions whose force is kept (k,)
    along     unit vector of the motion (k,)
    spring    compliance of the spring to remove
    """
    others = np.eye(len(along))[released]
    others -= np.outer(others @ along, along)
    others = others[np.linalg.norm(others, axis=1) > ROUND_OFF]
    inside, by_motion = others @ tangent @ others.T, others @ tangent @ along
    sizes = np.sqrt(np.abs(np.diag(inside)))
    scales = np.divide(1.0, sizes, out=np.zeros_like(sizes), where=sizes > 0)
    inverse = np.linalg.pinv(inside * np.outer(scales, scales), rcond=ROUND_OFF)
    followed = scales * (inverse @ (scales * by_motion))
    stiffness = float(along @ tangent @ along - (along @ tangent @ others.T) @ followed)
    return stiffness / (1 - spring * stiffness)
