"""Tangent of a converged increment: change of the forces by the rigid motions of the indenter.

In the zones of contact, stick and slip of the increment, its equations are linear in the changes of
tractions t and rigid motions m (see `natural_map`). One linear solve for each motion gives the
tractions by its unit value. With the shapes R of the motions, the tangent is

    K_kl = ∂F_k/∂m_l = Σ R_k·∂t/∂m_l

The matrix is that of the last Newton step, and K the exact derivative of the forces at the end of
the increment, whose start is kept. Moving edges of the
zones do not contribute: pressure, gap and slip vanish there.
"""

from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np

from contact_scene.array_types import Field, Mask, Matrix, Vector
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
# Points whose shear is below the friction limit by less than this fraction slip. After an increment
# of constant loads the shear of slipping points is at the limit up to the tolerance.
TIE = 1e-7
# Relative singular value below which prescribed forces leave a motion undetermined.
UNDETERMINED = 1e-12


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


def shearing_tangent(
    problem: ShearProblem, solution: Point, motion: Vector, motions: RigidMotions
) -> Matrix:
    """Compute the derivative of the tangential forces by tangential motions (k, k).

    problem   stick and slip at a given friction limit
    solution  shear of its solution, with the displacement
    motion    rigid motions of the solution
    motions   motions of the derivative, which may include those that the target contains
    raises    NotConverged
    """
    z = (1 + TIE) * problem.natural(solution, motion).z
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


def coupled_tangent(
    problem: CoupledProblem, tractions: Field, motion: Vector | None, motions: RigidMotions
) -> Matrix:
    """Compute the derivative of the forces by the motions of pressure and shear together (k, k).

    A contact in gross slip under prescribed forces continues to slide: the shear follows the
    pressure, and the forces do not depend on the tangential motions.

    problem    pressure and shear of an increment
    tractions  shear and pressure (q_x, q_y, p) of its solution (3, n)
    motion     tangential rigid motions of the solution; None in gross slip under prescribed forces
               and without friction
    motions    motions of the derivative, of three components
    raises     NotConverged
    """
    if motion is None:
        zones = _zones_of_gross_slip(problem, tractions)
    else:
        natural = natural_map(problem, evaluate_point(problem, tractions, motion)[0])
        z, length = (1 + TIE) * natural.z, (1 + TIE) * natural.length
        slip = natural.contact & (length > natural.bound)
        zones = zones_of(replace(natural, z=z, length=length, slip=slip), problem)
    inverse = problem.inverse.in_zones(zones)

    def apply_operator(rows: Vector) -> tuple[Vector, Vector, Vector]:
        free = inverse(rows[None])[0]
        u = problem.together(zones.tractions(free))
        return free, zones.free(u) + zones.slip_terms(free), np.zeros(0)

    forces = []
    for one in motions.each:
        if motion is None and np.any(one.shape[:2]):
            forces.append(np.zeros(len(motions)))
            continue
        right = zones.free(np.broadcast_to(one.shape, tractions.shape))
        free = _solve_by_gmres(apply_operator, right)
        forces.append(motions.forces(zones.tractions(free)))
    return np.transpose(forces)


def _zones_of_gross_slip(problem: CoupledProblem, tractions: Field) -> Zones:
    """Return the zones of a contact that slides in the direction of its shear.

    The slip is large, so that the shear does not change its direction.

    tractions  shear and pressure (q_x, q_y, p) (3, n)
    """
    q, p = tractions[:2], tractions[2]
    slip = np.flatnonzero((p > 0) & np.any(q, axis=0))
    normal = q[:, slip] / magnitude(q[:, slip])
    return Zones(
        contact=p > 0,
        stick=np.zeros(p.size, dtype=bool),
        slip=slip,
        tangent=np.stack([-normal[1], normal[0]]),
        friction_slope=problem.friction_slope(p)[slip] * normal,
        slip_compliance=np.full(slip.size, MAX_SLIP_COMPLIANCE * problem.self_compliance),
    )


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


def stiffnesses(
    tangent: Matrix,
    motions: RigidMotions,
    along: Mapping[str, Vector],
    springs: Mapping[str, float],
) -> dict[str, float]:
    """Compute the change of the force along each of several motions by this motion, by name.

    Other forces that are prescribed do not change, and other motions are fixed. A name without a
    motion has no stiffness.

    tangent  derivative of the forces by the motions (k, k)
    motions  the motions, with their prescribed forces
    along    unit vector of each motion (k,), zero for a motion that symmetry excludes
    springs  compliances of springs in series that the tangent contains and the results do not
    """
    return {
        name: _stiffness_along(tangent, motions.is_held, unit, springs.get(name, 0.0))
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
    inside, by_motion = others @ tangent @ others.T, others @ tangent @ along
    sizes = np.sqrt(np.abs(np.diag(inside)))
    scales = np.divide(1.0, sizes, out=np.zeros_like(sizes), where=sizes > 0)
    inverse = np.linalg.pinv(inside * np.outer(scales, scales), rcond=UNDETERMINED)
    followed = scales * (inverse @ (scales * by_motion))
    stiffness = float(along @ tangent @ along - (along @ tangent @ others.T) @ followed)
    return stiffness / (1 - spring * stiffness)
